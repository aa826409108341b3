"""glTF files that move in every way, for viewer.py: written here so that what they hold is known."""
import base64
import math
import struct


class File:
    """Appends to one buffer and the lists of a glTF file."""

    def __init__(self):
        self.bytes = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "accessors": [], "bufferViews": [], "materials": [],
                     "animations": [{"channels": [], "samplers": []}], "extensionsUsed": []}

    def push(self, kind, value):
        self.json.setdefault(kind, []).append(value)
        return len(self.json[kind]) - 1

    def accessor(self, kind, code, rows):
        rows = [row if isinstance(row, (list, tuple)) else [row] for row in rows]
        data = b"".join(struct.pack(f"<{len(row)}{code}", *row) for row in rows)
        view = self.push("bufferViews", {"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data + bytes(-len(data) % 4)
        columns = list(zip(*rows))
        return self.push("accessors", {
            "bufferView": view, "count": len(rows), "type": kind,
            "componentType": {"f": 5126, "H": 5123, "B": 5121}[code],
            "min": [min(c) for c in columns], "max": [max(c) for c in columns]})

    def node(self, value, is_root=True):
        index = self.push("nodes", value)
        if is_root:
            self.json["scenes"][0]["nodes"].append(index)
        return index

    def mesh(self, points, normals, indices, colour, **further):
        material = self.push("materials", {"pbrMetallicRoughness": {"baseColorFactor": [*colour, 1]}})
        attributes = {"POSITION": self.accessor("VEC3", "f", points), "NORMAL": self.accessor("VEC3", "f", normals)}
        attributes.update(further.pop("attributes", {}))
        return self.push("meshes", {"primitives": [{"attributes": attributes, "material": material,
                                                    "indices": self.accessor("SCALAR", "H", indices), **further}]})

    def animate(self, target, kind, times, values, interpolation="LINEAR", code="f"):
        animation = self.json["animations"][0]
        animation["samplers"].append({"input": self.accessor("SCALAR", "f", times), "interpolation": interpolation,
                                      "output": self.accessor(kind, code, values)})
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": target})

    def point(self, pointer, *values, **further):
        extension = {"KHR_animation_pointer": {"pointer": pointer}}
        self.animate({"path": "pointer", "extensions": extension}, *values, **further)

    def done(self):
        data = base64.b64encode(self.bytes).decode()
        self.json["buffers"] = [{"byteLength": len(self.bytes), "uri": f"data:application/octet-stream;base64,{data}"}]
        return self.json


def box(half):
    """A box with a normal for each side: points, normals, indices."""
    points, normals, indices = [], [], []
    for axis in range(3):
        for sign in (1, -1):
            first = len(points)
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p = [0, 0, 0]
                p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = sign * half, sign * u * half, v * half
                points.append(p)
                normals.append([sign if i == axis else 0 for i in range(3)])
            indices += [first + i for i in (0, 1, 2, 0, 2, 3)]
    return points, normals, indices


def tube(rings=17, sides=16, radius=0.2, height=2.0):
    """Along +Y from 0."""
    points, normals, indices = [], [], []
    for r in range(rings):
        for s in range(sides + 1):
            a = 2 * math.pi * s / sides
            normals.append([math.cos(a), 0, -math.sin(a)])
            points.append([radius * math.cos(a), height * r / (rings - 1), -radius * math.sin(a)])
    for r in range(rings - 1):
        for s in range(sides):
            a, b = r * (sides + 1) + s, (r + 1) * (sides + 1) + s
            indices += [a, a + 1, b, a + 1, b + 1, b]
    return points, normals, indices


def turn(axis, degrees):
    half = math.radians(degrees) / 2
    return [*(math.sin(half) * c for c in axis), math.cos(half)]


def moving_parts():
    """A skinned tube that bends at two joints, a box of two morph targets, a turning box with a jumping child, and one
    on a spline."""
    f = File()
    points, normals, indices = tube()
    weight = [max(0.0, min(1.0, p[1] - 0.5)) for p in points]  # of the upper joint
    bones = f.accessor("VEC4", "B", [[0, 1, 0, 0]] * len(points))
    shares = f.accessor("VEC4", "f", [[1 - w, w, 0, 0] for w in weight])
    mesh = f.mesh(points, normals, indices, (0.8, 0.5, 0.2), attributes={"JOINTS_0": bones, "WEIGHTS_0": shares})
    upper = f.node({"translation": [0, 1, 0]}, False)
    lower = f.node({"children": [upper]})
    inverse = [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, y, 0, 1] for y in (0, -1)]
    f.push("skins", {"joints": [lower, upper], "inverseBindMatrices": f.accessor("MAT4", "f", inverse)})
    f.node({"mesh": mesh, "skin": 0})
    f.animate({"node": upper, "path": "rotation"}, "VEC4", [0, 1, 2],
              [turn((0, 0, 1), 0), turn((0, 0, 1), 70), turn((1, 0, 0), 40)])
    f.animate({"node": lower, "path": "rotation"}, "VEC4", [0, 2], [turn((0, 0, 1), -20), turn((0, 0, 1), 15)])
    points, normals, indices = box(0.4)
    grown = [[0, 0.5 if p[1] > 0 else 0, 0] for p in points]
    leant = [[0.4 if p[1] > 0 else 0, 0, 0] for p in points]
    targets = [{"POSITION": f.accessor("VEC3", "f", t)} for t in (grown, leant)]
    mesh = f.mesh(points, normals, indices, (0.2, 0.5, 0.8), targets=targets)
    f.json["meshes"][mesh]["weights"] = [0, 0]
    morphed = f.node({"mesh": mesh, "translation": [-1.3, 0.4, 0]})
    f.animate({"node": morphed, "path": "weights"}, "SCALAR", [0, 0.8, 2], [0, 0, 1, 0, 0.3, 1])
    mesh = f.mesh(*box(0.3), (0.3, 0.8, 0.3))
    child = f.node({"mesh": mesh, "translation": [0, 0.8, 0], "scale": [0.5, 0.5, 0.5]}, False)
    parent = f.node({"mesh": mesh, "translation": [1.3, 0.4, 0], "children": [child]})
    f.animate({"node": parent, "path": "rotation"}, "VEC4", [0, 1, 2],
              [turn((0, 1, 0), 0), turn((0, 1, 0), 120), turn((0, 1, 0), 240)])
    f.animate({"node": parent, "path": "scale"}, "VEC3", [0, 2], [[1, 1, 1], [1, 1.8, 1]])
    f.animate({"node": child, "path": "translation"}, "VEC3", [0, 0.5, 1.2], [[0, 0.8, 0], [0.4, 0.8, 0], [0, 1, 0.4]],
              "STEP")
    sprung = f.node({"mesh": f.mesh(*box(0.2), (0.8, 0.2, 0.3)), "translation": [0, 0.2, 1]})
    f.animate({"node": sprung, "path": "translation"}, "VEC3", [0, 2],
              [[0, 0, 0], [-1, 0.2, 1], [0, 3, 0], [0, -3, 0], [1, 0.2, 1], [0, 0, 0]], "CUBICSPLINE")
    return f.done()


def pointers():
    """Boxes whose colours, glow and places change by pointer, seen by a camera whose angle does. All have names, by
    which the plugin for three.js finds them."""
    f = File()
    f.json["extensionsUsed"] = ["KHR_animation_pointer", "KHR_materials_emissive_strength"]
    for x, name, colour in ((-1, "left", (0.8, 0.2, 0.2)), (0, "middle", (0.2, 0.8, 0.2)),
                            (1, "right", (0.2, 0.2, 0.8))):
        f.node({"name": f"{name}_box", "mesh": f.mesh(*box(0.35), colour), "translation": [x, 0, 0],
                "rotation": turn((0, 1, 0), 25)})
        f.json["materials"][-1]["name"] = f"{name}_paint"
    f.json["materials"][1]["emissiveFactor"] = [0.1, 0, 0]
    f.json["materials"][2].update(emissiveFactor=[0, 0.3, 0.1],
                                  extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 1}})
    f.push("cameras", {"name": "lens", "type": "perspective",
                       "perspective": {"yfov": 0.7, "znear": 0.01, "zfar": 100}})
    f.node({"name": "eye", "camera": 0, "translation": [0, 0.5, 5]})
    f.point("/materials/0/pbrMetallicRoughness/baseColorFactor", "VEC4", [0, 2],
            [[0.8, 0.2, 0.2, 1], [0.1, 0.9, 0.9, 1]])
    f.point("/materials/1/emissiveFactor", "VEC3", [0, 1, 2], [[0, 0, 0], [0.6, 0, 0], [0, 0, 0.6]], "STEP")
    f.point("/materials/2/extensions/KHR_materials_emissive_strength/emissiveStrength", "SCALAR", [0, 2], [0, 3])
    f.point("/nodes/1/translation", "VEC3", [0, 2], [[0, -0.5, 0], [0, 0.8, 0]])
    f.point("/cameras/0/perspective/yfov", "SCALAR", [0, 2], [0.6, 1.0])
    return f.done()
