"""Writes a scene for POV-Ray 3.7 such that a render without anti-aliasing is Whittle's one ray for each pixel.

How the units meet (POV-Ray's reference, "Light Source", "Finish", "Camera"):
- Diffuse reflection is pigment x light colour x cosine, without the 1/pi of a reflectance; so light colours are
  divided by pi.
- `fade_power 2 fade_distance f` dims by 2 / (1 + (d/f)^2) = 2 f^2 / d^2 x 1 / (1 + f^2/d^2). With f = 1e-4 m the
  last factor is 1 to 1e-6 from a distance of 0.1 m on, so a colour of I / (2 pi f^2) gives I / (pi d^2).
- `reflection {c, 1 falloff 5}` is Schlick's c + (1 - c) (1 - cos)^5, what glTF asks of a smooth metal.
- Axes are given as vectors, so POV-Ray's left-handed ones do not matter. `direction` has length 1, `right` and `up`
  span the picture at that distance.
- What stays different: shadow rays pass glass without its Fresnel loss; two to four pixels in ten thousand of the hills
  are black (not looked into); an emitter glows on both sides; a spot's edge is another curve.
- `max_trace_level n`: eye rays are level 1, so that n is Whittle's bounces; `adc_bailout 0` follows every ray to
  that depth.
"""
import math
import pathlib

import numpy

FADE_DISTANCE = 1e-4  # metres
MIRROR_ROUGHNESS = 0.2  # below it Whittle takes a surface for smooth
FAR = 1e4  # metres from the origin to the place of a directional light

HEADER = """#version 3.7;
#ifndef (Bounces) #declare Bounces = {bounces}; #end
global_settings {{ assumed_gamma 1 max_trace_level Bounces adc_bailout 0 }}
#default {{ finish {{ ambient 0 diffuse 0 }} }}
background {{ rgb {background} }}
"""

CAMERA = """camera {{
  perspective location {position} direction {forward}
  right {right} * (2 * {t} * image_width / image_height)
  up {up} * (2 * {t})
}}
"""


def write(scene, file, bounces):
    """Leaves FILE; camera 0 looks."""
    with open(file, "w", encoding="ascii") as out:
        out.write(HEADER.format(bounces=bounces, background=vector(scene.background)))
        out.write(cameraText(scene.cameras[0]))
        for light in scene.lights:
            out.write(lightText(light))
        for mesh in scene.meshes:
            writeMesh(out, mesh, scene.materials[mesh.material])


def command(file, out, width, height, threads, bounces):
    """One ray through the centre of each pixel, half floats in linear radiance."""
    file, out = pathlib.Path(file), pathlib.Path(out)
    return ["povray", f"+I{file}", f"+O{out}", f"+W{width}", f"+H{height}", "+FE", "-A", "-D", f"+WT{threads}",
            "Output_Alpha=off", f"Declare=Bounces={bounces}"]


def vector(values):
    return "<" + ",".join(f"{float(v):.9g}" for v in values) + ">"


def cameraText(camera):
    return CAMERA.format(position=vector(camera.position), forward=vector(camera.forward), right=vector(camera.right),
                         up=vector(camera.up), t=f"{math.tan(0.5 * camera.yfov):.9g}")


def lightText(light):
    shadow = "" if light.castsShadows else " shadowless"
    if light.kind == "directional":
        colour = vector(c / math.pi for c in light.intensity)
        return (f"light_source {{ {vector(-FAR * light.direction)} rgb {colour} "
                f"parallel point_at <0,0,0>{shadow} }}\n")
    colour = vector(c / (2 * math.pi * FADE_DISTANCE ** 2) for c in light.intensity)
    cone = ""
    if light.kind == "spot":  # POV-Ray's edge is another curve between the same two angles
        cone = (f" spotlight point_at {vector(light.position + light.direction)} tightness 0 "
                f"radius {math.degrees(light.innerCone):.9g} falloff {math.degrees(light.outerCone):.9g}")
    return (f"light_source {{ {vector(light.position)} rgb {colour}{cone} "
            f"fade_power 2 fade_distance {FADE_DISTANCE:g}{shadow} }}\n")


def materialText(m):
    if m.transmission > 0:
        # `fresnel` and `conserve_energy`: what is not reflected goes through.
        return (f"texture {{ pigment {{ rgbf {vector([*m.baseColor, m.transmission])} }} "
                f"finish {{ reflection {{ 0, 1 fresnel on }} conserve_energy }} }} interior {{ ior {m.ior:.9g} }}")
    if m.metallic > 0 and m.roughness < MIRROR_ROUGHNESS:
        return ("texture { pigment { rgb 0 } "
                f"finish {{ reflection {{ rgb {vector(m.baseColor)}, rgb 1 falloff 5 }} }} }}")
    if any(m.emission):
        return f"texture {{ pigment {{ rgb {vector(m.emission)} }} finish {{ emission 1 }} }}"
    return f"texture {{ pigment {{ rgb {vector(m.baseColor)} }} finish {{ diffuse 1 }} }}"


def writeMesh(out, mesh, material):
    out.write(f"// {mesh.name}\nmesh2 {{\n")
    writeVectors(out, "vertex_vectors", mesh.positions, "%.9g")
    if mesh.normals is not None:
        writeVectors(out, "normal_vectors", mesh.normals, "%.7g")
    writeVectors(out, "face_indices", mesh.triangles, "%d")
    out.write(materialText(material) + "\n}\n")


def writeVectors(out, name, rows, number):
    """One format for all rows: 30 times as fast as one row at a time."""
    row = f"<{number},{number},{number}>,"
    text = (row * len(rows)) % tuple(numpy.ascontiguousarray(rows).ravel().tolist())
    out.write(f"{name} {{ {len(rows)},\n{text[:-1]}\n}}\n")
