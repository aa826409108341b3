"""Writes small binary glTF 2.0 scenes out of numpy arrays: meshes, materials, suns and one camera."""
import json
import math
import struct

import numpy

FLOAT, UNSIGNED, ORTHOGRAPHIC, PERSPECTIVE = 5126, 5125, "orthographic", "perspective"


class Scene:
    """Positions in metres; materials and lights as glTF has them."""

    def __init__(self, background=(0.0, 0.0, 0.0)):
        self.binary, self.views, self.accessors = b"", [], []
        self.nodes, self.meshes, self.materials, self.lights, self.cameras = [], [], [], [], []
        self.background = list(background)

    def array(self, values, kind, width):
        self.views.append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": values.nbytes})
        accessor = {"bufferView": len(self.views) - 1, "componentType": kind, "count": values.size // width,
                    "type": {1: "SCALAR", 3: "VEC3"}[width]}
        if kind == FLOAT:
            accessor |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
        self.accessors.append(accessor)
        self.binary += values.tobytes()
        return len(self.accessors) - 1

    def material(self, **fields):
        self.materials.append(fields)
        return len(self.materials) - 1

    def mesh(self, positions, triangles, material, normals=None):
        """positions [v, 3], rounded to single precision; triangles [t, 3], anticlockwise from outside."""
        attributes = {"POSITION": self.array(numpy.asarray(positions, "<f4"), FLOAT, 3)}
        if normals is not None:
            attributes["NORMAL"] = self.array(numpy.asarray(normals, "<f4"), FLOAT, 3)
        indices = self.array(numpy.asarray(triangles, "<u4").reshape(-1), UNSIGNED, 1)
        self.meshes.append({"primitives": [{"attributes": attributes, "indices": indices, "material": material}]})
        self.nodes.append({"mesh": len(self.meshes) - 1})

    def sun(self, tilt, irradiance):
        """Shines from (0, sin tilt, cos tilt); tilt in radians, irradiance RGB in W/m2."""
        strongest = max(irradiance)
        colour = [c / strongest for c in irradiance]
        self.lights.append({"type": "directional", "intensity": strongest, "color": colour})
        self.nodes.append({"rotation": [-math.sin(tilt / 2), 0, 0, math.cos(tilt / 2)],
                           "extensions": {"KHR_lights_punctual": {"light": len(self.lights) - 1}}})

    def camera(self, kind, lens, position, matrix=None):
        """matrix: the columns right, up, backwards; looking along -z without."""
        self.cameras.append({"type": kind, kind: lens})
        node = {"camera": len(self.cameras) - 1}
        if matrix is None:
            node["translation"] = list(map(float, position))
        else:
            columns = numpy.eye(4)
            columns[:3, :3], columns[:3, 3] = matrix, position
            node["matrix"] = columns.T.reshape(-1).tolist()
        self.nodes.append(node)

    def document(self):
        text = {"asset": {"version": "2.0"}, "scene": 0, "nodes": self.nodes, "meshes": self.meshes,
                "scenes": [{"nodes": list(range(len(self.nodes))),
                            "extras": {"whittle": {"background": self.background}}}],
                "materials": self.materials, "cameras": self.cameras, "accessors": self.accessors,
                "bufferViews": self.views, "buffers": [{"byteLength": len(self.binary)}]}
        used = sorted({name for m in self.materials for name in m.get("extensions", {})})
        if self.lights:
            text["extensions"] = {"KHR_lights_punctual": {"lights": self.lights}}
            used.append("KHR_lights_punctual")
        if used:
            text["extensionsUsed"] = used
        return text

    def write(self, file):
        text = json.dumps(self.document()).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(self.binary), 0x004E4942)
        chunks += self.binary
        file.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
        return file


def matte(colour=1.0, doubleSided=True):
    """A reflectance and nothing else, as in scenes/."""
    return {"pbrMetallicRoughness": {"baseColorFactor": [colour, colour, colour, 1], "metallicFactor": 0,
                                     "roughnessFactor": 1},
            "doubleSided": doubleSided, "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}


def mirror():
    """Reflects everything."""
    return {"pbrMetallicRoughness": {"metallicFactor": 1, "roughnessFactor": 0}}


def air():
    """A solid that nobody can see: it transmits everything and bends nothing."""
    return {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1},
                           "KHR_materials_volume": {"thicknessFactor": 1}}}
