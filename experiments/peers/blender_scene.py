"""Runs inside Blender: builds the scene that was exported beside this file and renders one picture with Cycles.

usage: blender --background --factory-startup --python THIS.py -- OUT.exr WIDTH HEIGHT THREADS BOUNCES SAMPLES

Set so that one sample is one of Whittle's rays for each pixel, with its shadow ray and its mirror rays: a pixel
filter of a hundredth of a pixel, lights without size, no light but theirs on matte surfaces, no Russian roulette, no
adaptive sampling. Cycles may still send one ray on from each matte surface; neither objects nor background can be
seen by such rays. Of a glass surface's two branches, and of several lights, a sample takes one at random.
"""
import json
import math
import pathlib
import sys

import bpy
import mathutils
import numpy

SCENE = {}  # written by the exporter
MIRROR_ROUGHNESS = 0.2  # below it Whittle takes a surface for smooth


class Nodes:
    """A material's node tree, one call for each node: names of inputs and what goes there, a value or another node's
    output."""

    def __init__(self, owner):
        owner.use_nodes = True
        self.tree = owner.node_tree
        self.tree.nodes.clear()

    def add(self, kind, inputs=(), output=0, **settings):
        node = self.tree.nodes.new(kind)
        for key, value in settings.items():
            setattr(node, key, value)
        for name, value in dict(inputs).items():
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[name])
            else:
                node.inputs[name].default_value = value
        return node.outputs[output] if node.outputs else node

    def mix(self, factor, first, second):
        return self.add("ShaderNodeMixShader", {0: factor, 1: first, 2: second})

    def minus(self, a, b):
        return self.add("ShaderNodeMath", {0: a, 1: b}, operation="SUBTRACT")


def rgba(values):
    return (*values, 1.0)


def mirror(nodes, colour):
    """Schlick's c + (1 - c) (1 - cos)^5, glTF 2.0 appendix B."""
    normal = nodes.add("ShaderNodeNewGeometry", output="Normal")
    incoming = nodes.add("ShaderNodeNewGeometry", output="Incoming")
    cosine = nodes.add("ShaderNodeVectorMath", {0: normal, 1: incoming}, output="Value", operation="DOT_PRODUCT")
    rise = nodes.add("ShaderNodeMath", {0: nodes.minus(1.0, cosine), 1: 5.0}, operation="POWER")
    reflectance = nodes.add("ShaderNodeMixRGB", {0: rise, 1: rgba(colour), 2: rgba((1.0,) * 3)})
    return nodes.add("ShaderNodeBsdfGlossy", {"Color": reflectance}, distribution="SHARP")


def glass(nodes, colour, ior):
    """Reflects and refracts; shadow rays go straight through, dimmed by 1 - F on each surface as if they came from
    outside."""
    surface = nodes.add("ShaderNodeBsdfGlass", {"Color": rgba(colour), "IOR": ior}, distribution="SHARP")
    back = nodes.add("ShaderNodeNewGeometry", output="Backfacing")
    # Fresnel inverts the index behind a surface: handed the inverse there, it uses the index itself.
    index = nodes.add("ShaderNodeMath", {0: back, 1: 1 / ior - ior, 2: ior}, operation="MULTIPLY_ADD")
    through = nodes.minus(1.0, nodes.add("ShaderNodeFresnel", {"IOR": index}))
    tint = nodes.add("ShaderNodeMixRGB", {0: through, 1: rgba((0.0,) * 3), 2: rgba(colour)})
    shadow = nodes.add("ShaderNodeBsdfTransparent", {"Color": tint})
    return nodes.mix(nodes.add("ShaderNodeLightPath", output="Is Shadow Ray"), surface, shadow)


def emitter(nodes, radiance, doubleSided):
    light = nodes.add("ShaderNodeEmission", {"Color": rgba(radiance), "Strength": 1.0})
    if doubleSided:
        return light
    dark = nodes.add("ShaderNodeEmission", {"Strength": 0.0})
    return nodes.mix(nodes.add("ShaderNodeNewGeometry", output="Backfacing"), light, dark)


def makeMaterial(m):
    material = bpy.data.materials.new(m["name"])
    material.cycles.sample_as_light = False  # shines on no matte surface, as in Whitted's algorithm
    nodes = Nodes(material)
    if m["transmission"] > 0:
        surface = glass(nodes, m["baseColor"], m["ior"])
    elif m["metallic"] > 0 and m["roughness"] < MIRROR_ROUGHNESS:
        surface = mirror(nodes, m["baseColor"])
    elif any(m["emission"]):
        surface = emitter(nodes, m["emission"], m["doubleSided"])
    else:
        surface = nodes.add("ShaderNodeBsdfDiffuse", {"Color": rgba(m["baseColor"])})
    nodes.add("ShaderNodeOutputMaterial", {"Surface": surface})
    return material


def makeMesh(name, positions, triangles, normals):
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(positions))
    mesh.vertices.foreach_set("co", positions.ravel())
    mesh.loops.add(triangles.size)
    mesh.loops.foreach_set("vertex_index", triangles.ravel())
    mesh.polygons.add(len(triangles))
    mesh.polygons.foreach_set("loop_start", numpy.arange(0, triangles.size, 3, dtype=numpy.int32))
    mesh.polygons.foreach_set("loop_total", numpy.full(len(triangles), 3, dtype=numpy.int32))
    mesh.polygons.foreach_set("use_smooth", numpy.full(len(triangles), normals is not None))
    mesh.update(calc_edges=True)
    if normals is not None:
        mesh.use_auto_smooth = True  # Blender's switch for normals of one's own
        mesh.normals_split_custom_set_from_vertices(normals.tolist())
    return mesh


def place(name, data, pose):
    thing = bpy.data.objects.new(name, data)
    thing.matrix_world = pose
    bpy.context.scene.collection.objects.link(thing)
    return thing


def addMeshes(arrays):
    materials = [makeMaterial(m) for m in SCENE["materials"]]
    for i, described in enumerate(SCENE["meshes"]):
        normals = arrays[f"normals{i}"] if described["smooth"] else None
        mesh = makeMesh(described["name"], arrays[f"positions{i}"], arrays[f"triangles{i}"], normals)
        mesh.materials.append(materials[described["material"]])
        thing = place(described["name"], mesh, mathutils.Matrix())
        thing.visible_diffuse = False
        thing.cycles.shadow_terminator_geometry_offset = 0
        thing.cycles.shadow_terminator_offset = 0


def addLight(described):
    light = bpy.data.lights.new("light", {"point": "POINT", "spot": "SPOT", "directional": "SUN"}[described["kind"]])
    light.color = (1, 1, 1)
    strength = max(described["colour"])
    light.energy = strength
    if strength > 0:
        light.color = [c / strength for c in described["colour"]]
    light.cycles.cast_shadow = described["castsShadows"]
    light.cycles.use_multiple_importance_sampling = False
    if described["kind"] == "directional":
        light.angle = 0
    else:
        light.shadow_soft_size = 0
    if described["kind"] == "spot":  # Blender's edge is another curve between the same two angles
        light.spot_size = 2 * described["outerCone"]
        light.spot_blend = 1 - math.tan(described["innerCone"]) / math.tan(described["outerCone"])
    towards = mathutils.Vector(described["direction"]).to_track_quat("-Z", "Y").to_matrix().to_4x4()
    place("light", light, mathutils.Matrix.Translation(described["position"]) @ towards)


def addCamera(described):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.sensor_height = described["sensor"]
    camera.lens = described["lens"]
    camera.clip_start = 1e-4
    camera.clip_end = 1e6
    bpy.context.scene.camera = place("camera", camera, mathutils.Matrix(described["pose"]))


def setBackground(radiance):
    world = bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    nodes = Nodes(world)
    sky = nodes.add("ShaderNodeBackground", {"Color": rgba(radiance), "Strength": 1.0})
    nodes.add("ShaderNodeOutputWorld", {"Surface": sky})
    world.cycles.sampling_method = "NONE"
    world.cycles_visibility.diffuse = False  # seen by the eye and in mirrors, lights nothing


def setCycles(threads, bounces, samples):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.threads_mode = "FIXED"
    scene.render.threads = threads
    cycles = scene.cycles
    cycles.samples = samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.glossy_bounces = cycles.transmission_bounces = bounces - 1
    cycles.diffuse_bounces = cycles.volume_bounces = 0
    cycles.transparent_max_bounces = 64  # surfaces of glass that a shadow ray goes through
    cycles.min_light_bounces = cycles.min_transparent_bounces = 64  # no Russian roulette before
    cycles.light_sampling_threshold = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.pixel_filter_type = "GAUSSIAN"
    cycles.filter_width = 0.01  # pixels; a box filter's width is always 1 here


def setPicture(out, width, height):
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "32"
    render.use_compositing = render.use_sequencer = False
    render.filepath = out


def main():
    out = sys.argv[sys.argv.index("--") + 1]
    width, height, threads, bounces, samples = map(int, sys.argv[sys.argv.index("--") + 2:])
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    addMeshes(numpy.load(pathlib.Path(__file__).with_suffix(".npz")))
    for light in SCENE["lights"]:
        addLight(light)
    addCamera(SCENE["camera"])
    setBackground(SCENE["background"])
    setCycles(threads, bounces, samples)
    setPicture(out, width, height)
    bpy.ops.render.render(write_still=True)


main()
