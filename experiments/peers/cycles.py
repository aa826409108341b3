"""Writes a scene for Blender's Cycles: FILE.py, which Blender runs, and FILE.npz, the arrays that it reads.

Why not Blender's own glTF importer: it changes lights to Blender's units by rules that moved from version to
version, gives materials a Principled BSDF whose metal is not glTF's Schlick formula, and knows neither our
background nor lights without shadows. The script sets each of these itself, from the same arrays that POV-Ray gets.
"""
import json
import math
import pathlib

import numpy

SENSOR = 24.0  # mm, the height that the lens is measured by; any number gives the same picture
SCRIPT = pathlib.Path(__file__).resolve().parent / "blender_scene.py"


def write(scene, file):
    """Leaves FILE (ends in .py) and its arrays beside it; camera 0 looks."""
    file = pathlib.Path(file)
    arrays = {}
    for i, mesh in enumerate(scene.meshes):
        arrays[f"positions{i}"] = mesh.positions
        arrays[f"triangles{i}"] = mesh.triangles
        if mesh.normals is not None:
            arrays[f"normals{i}"] = mesh.normals
    numpy.savez(file.with_suffix(".npz"), **arrays)
    text = SCRIPT.read_text(encoding="utf-8")
    described = f"SCENE = json.loads({json.dumps(describe(scene))!r})"
    file.write_text(text.replace("SCENE = {}", described), encoding="utf-8")


def command(file, out, width, height, threads, bounces, samples):
    return ["blender", "--background", "--factory-startup", "--debug-cycles", "--verbose", "3",
            "--python-exit-code", "1", "--python", str(file), "--", str(out),
            *map(str, (width, height, threads, bounces, samples))]


def describe(scene):
    """All but the arrays, as JSON."""
    return {"meshes": [{"name": m.name, "material": m.material, "smooth": m.normals is not None} for m in scene.meshes],
            "materials": [vars(m) for m in scene.materials], "lights": [describeLight(light) for light in scene.lights],
            "camera": describeCamera(scene.cameras[0]), "background": list(scene.background)}


def describeCamera(camera):
    """A lens of `lens` mm before a sensor SENSOR mm high; Blender's cameras look along -Z with +Y up, as glTF's do."""
    pose = numpy.eye(4)
    pose[:3, :3] = numpy.column_stack([camera.right, camera.up, -camera.forward])
    pose[:3, 3] = camera.position
    return {"lens": 0.5 * SENSOR / math.tan(0.5 * camera.yfov), "sensor": SENSOR, "pose": pose.tolist()}


def describeLight(light):
    """Blender gives point and spot lights in watts, 4 pi times the intensity, and suns in W/m2."""
    colour = numpy.array(light.intensity) * (1 if light.kind == "directional" else 4 * math.pi)
    return {"kind": light.kind, "position": light.position.tolist(), "direction": light.direction.tolist(),
            "colour": colour.tolist(), "castsShadows": light.castsShadows, "innerCone": light.innerCone,
            "outerCone": light.outerCone}
