"""A binary glTF 2.0 scene as numpy arrays in world space: what the writers for other renderers need of it, and no more.

Read: triangles with normals, node transforms, factors of materials (and of the KHR extensions that Whittle knows),
punctual lights, perspective cameras, our background. Not read: textures, vertex colours, skins, morphs, animation;
`ignored` names what a scene has of these, so that nobody takes a picture without them for the same scene. Units:
metres, radiance in W/(m2 sr), intensity in W/sr, irradiance of directional lights in W/m2.
"""
import dataclasses
import json
import struct

import numpy

COMPONENTS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
TRIANGLES = 4


class SceneError(Exception):
    """One line that names the file and what is wrong."""


@dataclasses.dataclass
class Mesh:
    name: str
    positions: numpy.ndarray  # n x 3, float32, world space
    normals: numpy.ndarray | None  # n x 3, unit, world space; None: flat
    triangles: numpy.ndarray  # m x 3, counter-clockwise seen from the front
    material: int


@dataclasses.dataclass
class Material:
    name: str
    baseColor: tuple
    metallic: float
    roughness: float
    emission: tuple  # W/(m2 sr), from the front alone unless doubleSided
    doubleSided: bool
    transmission: float
    ior: float
    specular: float
    solid: bool  # the surface bounds a volume: light bends


@dataclasses.dataclass
class Light:
    kind: str  # point, spot, directional
    position: numpy.ndarray
    direction: numpy.ndarray  # unit, the way the light goes
    intensity: tuple  # RGB, W/sr or W/m2
    innerCone: float  # radians from the axis
    outerCone: float
    castsShadows: bool


@dataclasses.dataclass
class Camera:
    position: numpy.ndarray
    right: numpy.ndarray  # these three: unit, orthogonal
    up: numpy.ndarray
    forward: numpy.ndarray
    yfov: float  # radians, full vertical angle


@dataclasses.dataclass
class Scene:
    meshes: list
    materials: list
    lights: list
    cameras: list
    background: tuple
    ignored: list

    def triangleCount(self):
        return sum(len(m.triangles) for m in self.meshes)


def load(file):
    """The default scene of a GLB."""
    return Reader(file).scene()


def eyeDirection(camera, x, y, width, height):
    """Unit direction through (x, y) in pixels from the upper left corner of the picture: glTF 2.0, 3.10.3."""
    t = numpy.tan(0.5 * camera.yfov)
    across = (2 * x / width - 1) * t * width / height
    upwards = (1 - 2 * y / height) * t
    d = camera.forward + across * camera.right + upwards * camera.up
    return d / numpy.linalg.norm(d)


def localTransform(node):
    """4 x 4, applied to columns; glTF stores matrices by columns and quaternions as x, y, z, w."""
    if "matrix" in node:
        return numpy.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", [0, 0, 0, 1])
    turn = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    transform = numpy.eye(4)
    transform[:3, :3] = turn * numpy.array(node.get("scale", [1, 1, 1]))
    transform[:3, 3] = node.get("translation", [0, 0, 0])
    return transform


def unit(v):
    return v / numpy.linalg.norm(v, axis=-1, keepdims=True)


class Reader:
    def __init__(self, file):
        self.file = file
        with open(file, "rb") as stream:
            data = stream.read()
        if data[:4] != b"glTF":
            raise SceneError(f"{file}: not a binary glTF file; write it as .glb")
        length = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20:20 + length])
        self.binary = data[28 + length:]
        self.ignored = set()

    def scene(self):
        self.out = Scene([], [self.material(m) for m in self.json.get("materials", [])], [], [], (0.0, 0.0, 0.0), [])
        self.out.materials.append(self.material({}))  # index -1: a primitive without a material
        described = self.json["scenes"][self.json.get("scene", 0)]
        self.out.background = tuple(described.get("extras", {}).get("whittle", {}).get("background", (0.0, 0.0, 0.0)))
        for node in described.get("nodes", []):
            self.visit(node, numpy.eye(4))
        if not self.out.cameras:
            raise SceneError(f"{self.file}: no perspective camera; add one to the file")
        self.out.ignored = sorted(self.ignored)
        return self.out

    def visit(self, index, above):
        node = self.json["nodes"][index]
        toWorld = above @ localTransform(node)
        if "mesh" in node:
            for part in self.json["meshes"][node["mesh"]]["primitives"]:
                self.readMesh(node.get("name", ""), part, toWorld)
        if "camera" in node:
            self.readCamera(self.json["cameras"][node["camera"]], toWorld)
        if "light" in node.get("extensions", {}).get("KHR_lights_punctual", {}):
            self.readLight(node, toWorld)
        for key in ("skin", "weights"):
            if key in node:
                self.ignored.add(key)
        for child in node.get("children", []):
            self.visit(child, toWorld)

    def accessor(self, index):
        a = self.json["accessors"][index]
        if "sparse" in a or a.get("normalized"):
            raise SceneError(f"{self.file}: accessor {index} is sparse or normalised, which is not supported here")
        view = self.json["bufferViews"][a["bufferView"]]
        kind = numpy.dtype(COMPONENTS[a["componentType"]])
        width = WIDTHS[a["type"]]
        start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        strides = (view.get("byteStride", kind.itemsize * width), kind.itemsize)
        return numpy.ndarray((a["count"], width), kind, self.binary, start, strides)

    def readMesh(self, name, part, toWorld):
        if part.get("mode", TRIANGLES) != TRIANGLES:
            self.ignored.add("primitives that are no triangles")
            return
        self.ignored.update(a for a in part["attributes"] if a.startswith("COLOR"))
        positions = self.accessor(part["attributes"]["POSITION"])
        turn = toWorld[:3, :3]
        world = (positions @ turn.T + toWorld[:3, 3]).astype(numpy.float32)
        normals = None
        if "NORMAL" in part["attributes"]:
            # Cofactors: the inverse transpose but for a factor, whose sign a mirrored node needs.
            normals = unit(self.accessor(part["attributes"]["NORMAL"]) @ numpy.linalg.inv(turn)).astype(numpy.float32)
        corners = self.accessor(part["indices"])[:, 0] if "indices" in part else numpy.arange(len(positions))
        triangles = corners.astype(numpy.int32).reshape(-1, 3)
        if numpy.linalg.det(turn) < 0:
            triangles = triangles[:, [0, 2, 1]]  # glTF 2.0, 3.7.4: a mirrored node turns fronts round
        self.out.meshes.append(Mesh(name, world, normals, triangles, part.get("material", -1)))

    def material(self, m):
        pbr = m.get("pbrMetallicRoughness", {})
        extensions = {name.removeprefix("KHR_materials_"): e for name, e in m.get("extensions", {}).items()}
        self.noteIgnored(m, pbr, extensions)
        strength = extensions.get("emissive_strength", {}).get("emissiveStrength", 1.0)
        volume = extensions.get("volume", {})
        return Material(name=m.get("name", ""), baseColor=tuple(pbr.get("baseColorFactor", (1.0,) * 4)[:3]),
                        metallic=pbr.get("metallicFactor", 1.0), roughness=pbr.get("roughnessFactor", 1.0),
                        emission=tuple(strength * e for e in m.get("emissiveFactor", (0.0,) * 3)),
                        doubleSided=m.get("doubleSided", False),
                        transmission=extensions.get("transmission", {}).get("transmissionFactor", 0.0),
                        ior=extensions.get("ior", {}).get("ior", 1.5),
                        specular=extensions.get("specular", {}).get("specularFactor", 1.0),
                        solid=volume.get("thicknessFactor", 0.0) > 0)

    def noteIgnored(self, m, pbr, extensions):
        parts = [m, pbr, *extensions.values()]
        if any(key.endswith("Texture") for part in parts for key in part):
            self.ignored.add("textures")
        if m.get("alphaMode", "OPAQUE") != "OPAQUE":
            self.ignored.add("alpha")
        if "attenuationDistance" in extensions.get("volume", {}):
            self.ignored.add("absorption in volumes")
        if "specularColorFactor" in extensions.get("specular", {}):
            self.ignored.add("specular colours")
        known = {"emissive_strength", "volume", "transmission", "ior", "specular"}
        self.ignored.update(f"KHR_materials_{name}" for name in extensions.keys() - known)

    def readCamera(self, lens, toWorld):
        if lens["type"] != "perspective":
            self.ignored.add("orthographic cameras")
            return
        forward = unit(-toWorld[:3, 2])
        up = unit(toWorld[:3, 1] - forward * (toWorld[:3, 1] @ forward))
        camera = Camera(toWorld[:3, 3], numpy.cross(forward, up), up, forward, lens["perspective"]["yfov"])
        self.out.cameras.append(camera)

    def readLight(self, node, toWorld):
        index = node["extensions"]["KHR_lights_punctual"]["light"]
        light = self.json["extensions"]["KHR_lights_punctual"]["lights"][index]
        if "range" in light:
            self.ignored.add("ranges of lights")
        cone = light.get("spot", {})
        shadows = all(part.get("extras", {}).get("castsShadows", True) for part in (light, node))
        self.out.lights.append(Light(
            kind=light["type"], position=toWorld[:3, 3], direction=unit(-toWorld[:3, 2]),
            intensity=tuple(light.get("intensity", 1.0) * c for c in light.get("color", (1.0,) * 3)),
            innerCone=cone.get("innerConeAngle", 0.0), outerCone=cone.get("outerConeAngle", numpy.pi / 4),
            castsShadows=shadows))


def keepFirstLight(file, out):
    """Writes a copy of a GLB whose other light nodes shine no more; everything else, the binary chunk included, as it
    was."""
    with open(file, "rb") as stream:
        data = stream.read()
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20:20 + length])
    lit = [n for n in document["nodes"] if "KHR_lights_punctual" in n.get("extensions", {})]
    for node in lit[1:]:
        del node["extensions"]["KHR_lights_punctual"]
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)  # chunks are multiples of four bytes
    rest = data[20 + length:]
    with open(out, "wb") as stream:
        stream.write(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A))
        stream.write(text + rest)
