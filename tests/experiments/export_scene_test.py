"""What is written for POV-Ray and Blender is our scene: eye rays by each program's own camera formula, light that
arrives, triangles where the node transforms put them. The scene is made here, each expected number from the glTF
specification.

usage: /usr/bin/python3 test_export_scene.py   (status 77 where numpy is missing: skipped)
"""
import ast
import json
import math
import pathlib
import re
import struct
import sys
import tempfile
import unittest

try:
    import numpy
except ImportError:
    print("skipped: install Debian's python3-numpy")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "experiments"))
from peers import cycles, gltf, povray  # noqa: E402

WIDTH, HEIGHT = 160, 90
YFOV = math.radians(50)
TURN = math.sqrt(0.5)  # sine and cosine of 45 degrees: a quaternion with it turns by 90

# Two triangles with normals to +Z, 16-bit indices, positions and normals interleaved.
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
INDICES = (0, 1, 2, 0, 2, 3)

NODES = [
    {"mesh": 0, "scale": [1, 1, 3], "translation": [0, 0, -5], "children": [1]},
    # Below a stretched node mirrored and turned by 45 degrees about Y: its normals follow the inverse transpose.
    {"mesh": 0, "scale": [-2, 1, 1], "rotation": [0, math.sin(math.pi / 8), 0, math.cos(math.pi / 8)],
     "translation": [0, 0, 1]},
    # Columns: -90 degrees about X, then (3, 4, 5).
    {"mesh": 1, "matrix": [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 3, 4, 5, 1]},
    {"rotation": [0, TURN, 0, TURN], "translation": [10, 0, 0], "children": [4]},  # 90 degrees about Y
    {"camera": 0, "rotation": [TURN, 0, 0, TURN], "translation": [0, 2, 0]},  # 90 about X: looks up
    {"translation": [1, 2, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}},
    {"rotation": [0, TURN, 0, TURN], "extensions": {"KHR_lights_punctual": {"light": 1}}},
]

# Node 4's world: R_y(90) R_x(90). Its columns are right, up and minus forward.
RIGHT, UP, FORWARD = (0, 0, -1), (1, 0, 0), (0, 1, 0)


def sceneFile(folder):
    interleaved = b"".join(struct.pack("<6f", *c, 0, 0, 1) for c in CORNERS)
    indices = struct.pack("<6H", *INDICES)
    flat = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)  # no indices, no normals
    binary = interleaved + indices + flat
    views = [{"buffer": 0, "byteLength": 96, "byteStride": 24}, {"buffer": 0, "byteOffset": 96, "byteLength": 12},
             {"buffer": 0, "byteOffset": 108, "byteLength": 36}]
    accessors = [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                 {"bufferView": 0, "byteOffset": 12, "componentType": 5126, "count": 4, "type": "VEC3"},
                 {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                 {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC3"}]
    lights = [{"type": "point", "color": [1, 0.5, 0.25], "intensity": 8},
              {"type": "directional", "intensity": 3, "extras": {"castsShadows": False}}]
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "buffers": [{"byteLength": len(binary)}], "bufferViews": views,
        "accessors": accessors, "nodes": NODES,
        "scenes": [{"nodes": [0, 2, 3, 5, 6], "extras": {"whittle": {"background": [0.1, 0.2, 0.3]}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]},
                   {"primitives": [{"attributes": {"POSITION": 3}, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.4, 0.3, 1], "metallicFactor": 0},
                       "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": YFOV, "aspectRatio": 1, "znear": 0.1}}],
        "extensions": {"KHR_lights_punctual": {"lights": lights}}}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    file = folder / "own.glb"
    file.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)) +
                     struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) +
                     binary)
    return file


def expectedDirection(x, y):
    """Back through glTF's projection matrix, at the picture's aspect ratio: clip space, z = -1, w = 1."""
    near, t = 0.1, math.tan(0.5 * YFOV)
    inCamera = numpy.array([(2 * x / WIDTH - 1) * WIDTH / HEIGHT * t * near, (1 - 2 * y / HEIGHT) * t * near, -near])
    world = numpy.column_stack([RIGHT, UP, numpy.negative(FORWARD)]) @ inCamera
    return world / numpy.linalg.norm(world)


def unit(v):
    return v / numpy.linalg.norm(v)


def povVector(text, name):
    """A vector after a keyword, times the factor in brackets after it."""
    vector, factor = re.search(name + r" <([^>]*)>(?: \* \(([^)]*)\))?", text).groups()
    factor = (factor or "1").replace("image_width", str(WIDTH)).replace("image_height", str(HEIGHT))
    value = 1.0
    for sign, number in re.findall(r"([*/]?) ?([-0-9.e]+)", factor):
        value = value / float(number) if sign == "/" else value * float(number)
    return numpy.array([float(v) for v in vector.split(",")]) * value


class ExportScene(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.temporary.name)
        cls.file = sceneFile(folder)
        cls.scene = gltf.load(cls.file)
        povray.write(cls.scene, folder / "own.pov", 8)
        cycles.write(cls.scene, folder / "own.py")
        cls.pov = (folder / "own.pov").read_text()
        cls.arrays = numpy.load(folder / "own.npz")
        literal = re.search(r"^SCENE = json\.loads\((.*)\)  #", (folder / "own.py").read_text(), re.MULTILINE)[1]
        cls.blender = json.loads(ast.literal_eval(literal))

    @classmethod
    def tearDownClass(cls):
        cls.arrays.close()
        cls.temporary.cleanup()

    def assertClose(self, a, b, tolerance=1e-6):  # single precision, and nine digits of text
        numpy.testing.assert_allclose(a, b, rtol=0, atol=tolerance)

    PIXELS = [(0.5, 0.5), (WIDTH - 0.5, 0.5), (0.5, HEIGHT - 0.5), (80, 45), (37.5, 61.5)]

    def testEyeRaysOfTheReader(self):
        for x, y in self.PIXELS:
            self.assertClose(gltf.eyeDirection(self.scene.cameras[0], x, y, WIDTH, HEIGHT), expectedDirection(x, y))

    def testEyeRaysOfPovRay(self):
        """POV-Ray's reference, "Camera Ray": direction, and up to half of right and of up beside it."""
        right, up, forward = (povVector(self.pov, name) for name in ("right", "up", "direction"))
        self.assertClose(povVector(self.pov, "location"), (10, 2, 0))
        for x, y in self.PIXELS:
            direction = forward + (x / WIDTH - 0.5) * right + (0.5 - y / HEIGHT) * up
            self.assertClose(unit(direction), expectedDirection(x, y))

    def testEyeRaysOfBlender(self):
        """A point of the sensor seen from the centre of the lens; the camera looks along -Z of its matrix."""
        camera = self.blender["camera"]
        pose = numpy.array(camera["pose"])
        self.assertClose(pose[:3, 3], (10, 2, 0))
        pixel = camera["sensor"] / HEIGHT  # mm; vertical fit
        for x, y in self.PIXELS:
            local = [(x - WIDTH / 2) * pixel, (HEIGHT / 2 - y) * pixel, -camera["lens"]]
            self.assertClose(unit(pose[:3, :3] @ local), expectedDirection(x, y))

    def testTrianglesAreWhereTheNodesPutThem(self):
        below = [(-2 * TURN * x, y, 3 * (2 * TURN * x + 1) - 5) for x, y, _ in CORNERS]
        matrix = [(3, 4, 5), (4, 4, 5), (3, 4, 4)]
        expected = [[(x, y, z - 5) for x, y, z in CORNERS], below, matrix]
        self.assertEqual(self.scene.triangleCount(), 5)
        for i, corners in enumerate(expected):
            self.assertClose(self.arrays[f"positions{i}"], corners)
        vectors = re.findall(r"vertex_vectors \{ \d+,\n(.*)\n\}", self.pov)
        for text, corners in zip(vectors, expected, strict=True):
            written = [[float(v) for v in row.split(",")] for row in re.findall(r"<([^>]*)>", text)]
            self.assertClose(written, corners)
        counts = [int(n) for n in re.findall(r"face_indices \{ (\d+),", self.pov)]
        self.assertEqual(counts, [2, 2, 1])
        self.assertEqual([len(self.arrays[f"triangles{i}"]) for i in range(3)], counts)

    def testFrontsAgreeWithNormalsBelowAMirror(self):
        for i in (0, 1):
            p, n = self.arrays[f"positions{i}"], self.arrays[f"normals{i}"]
            for a, b, c in self.arrays[f"triangles{i}"]:
                self.assertClose(unit(numpy.cross(p[b] - p[a], p[c] - p[a])), n[a])
        self.assertNotIn("normals2", self.arrays)
        self.assertEqual(self.pov.count("normal_vectors"), 2)

    def testPointLightFallsOffAsOurs(self):
        """White matte facing the light at a distance d sends out I / (pi d^2)."""
        text = re.search(r"light_source \{ <1,2,3> rgb <([^>]*)>.*fade_power 2 fade_distance (\S+) \}", self.pov)
        fade = float(text[2])
        for d in (0.5, 2.0, 30.0):
            radiance = [float(c) * 2 / (1 + (d / fade) ** 2) for c in text[1].split(",")]  # POV-Ray's reference, fading
            expected = numpy.array([8, 4, 2]) / (math.pi * d * d)
            numpy.testing.assert_allclose(radiance, expected, rtol=1e-6)  # (f/d)^2 and nine digits
        watts = numpy.array(self.blender["lights"][0]["colour"])
        self.assertClose(watts / (4 * math.pi), (8, 4, 2))  # a sphere has 4 pi sr
        self.assertClose(self.blender["lights"][0]["position"], (1, 2, 3))

    def testDirectionalLight(self):
        """Node 6 looks along -X; irradiance 3, radiance of white matte 3 / pi; it casts no shadow."""
        text = re.search(r"light_source \{ <([^>]*)> rgb <([^>]*)> parallel point_at <0,0,0> shadowless", self.pov)
        position = numpy.array([float(v) for v in text[1].split(",")])
        self.assertClose(unit(-position), (-1, 0, 0))
        self.assertClose([float(v) for v in text[2].split(",")], [3 / math.pi] * 3)
        sun = self.blender["lights"][1]
        self.assertClose(sun["direction"], (-1, 0, 0))
        self.assertClose(sun["colour"], [3] * 3)
        self.assertFalse(sun["castsShadows"])

    def testMatteAndBackground(self):
        self.assertIn("pigment { rgb <0.5,0.4,0.3> } finish { diffuse 1 }", self.pov)
        self.assertIn("background { rgb <0.1,0.2,0.3> }", self.pov)
        self.assertEqual(self.scene.ignored, [])

    def testFirstLightAlone(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "one.glb"
            gltf.keepFirstLight(self.file, file)
            one = gltf.load(file)
        self.assertEqual([light.kind for light in one.lights], ["point"])
        self.assertEqual(one.triangleCount(), 5)
        self.assertClose(one.meshes[1].positions, self.scene.meshes[1].positions)

    def testWhatIsNoGlbIsNamed(self):
        file = pathlib.Path(self.temporary.name) / "text.glb"
        file.write_text("no scene")
        with self.assertRaisesRegex(gltf.SceneError, r"text\.glb: not a binary glTF file"):
            gltf.load(file)


if __name__ == "__main__":
    unittest.main()
