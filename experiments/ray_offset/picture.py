"""The sheet that shows what an offset does wrong: a ball, a card over the floor and a tent that no light enters."""
import math

import numpy

from lib import glb, style
from peers.pictures import pixels, shown
from ray_offset.scenes import GRID, Place, ellipsoid, onGrid

PLACES = {"1 m": Place(1.0), "0.1 mm": Place(1e-4), "1 m, 10 km\nfrom the origin": Place(1.0, 1e4)}
WIDTH, HEIGHT = 320, 240


def sheet(scene, place, corners, material):
    scene.mesh(place.at(onGrid(corners)), [(0, 1, 2), (0, 2, 3)], material)


def turned(position, target):
    """Columns right, up, backwards of a camera."""
    backwards = numpy.subtract(position, target)
    backwards = backwards / numpy.linalg.norm(backwards)
    right = numpy.cross((0, 1, 0), backwards)
    right /= numpy.linalg.norm(right)
    return numpy.stack([right, numpy.cross(backwards, right), backwards], axis=1)


def stillLife(place):
    """Two heights wide; the sun stands across the tent, so that its open end lets nothing in. The ground is a little
    out of level."""
    scene = glb.Scene((0.02, 0.03, 0.05))
    grey, white, warm = (scene.material(**glb.matte(c)) for c in (0.5, 0.9, 0.7))
    sheet(scene, place, [(0, 2 * GRID, 2), (2, 4 * GRID, 2), (2, 2 * GRID, 0), (0, 0, 0)], grey)
    corners, normals, triangles = ellipsoid((1.45, 0.3125, 1.3), (0.3, 0.3, 0.3))
    scene.mesh(place.at(corners), triangles, white, normals)
    sheet(scene, place, [(0.5, 0.03, 1.7), (1.0, 0.03, 1.7), (1.0, 0.08, 1.2), (0.5, 0.08, 1.2)], warm)
    ridge, back, front = (0.4, 0.55), (0.0, 0.15), (0.0, 0.95)  # y, z
    for (y, z) in (back, front):
        sheet(scene, place, [(0.4, y, z), (1.6, y, z), (1.6, *ridge), (0.4, *ridge)], warm)
    scene.mesh(place.at(onGrid([(0.4, *back), (0.4, *front), (0.4, *ridge)])), [(0, 1, 2)], warm)
    scene.sun(math.radians(44), (2.2, 2.1, 1.9))
    eye, target = (3.3, 1.5, 2.6), (1.05, 0.15, 0.9)
    position = numpy.multiply(eye, place.size) + place.away
    scene.camera(glb.PERSPECTIVE, {"yfov": math.radians(29), "znear": 1e-3 * place.size}, position, turned(eye, target))
    return scene


def render(context, variants):
    """OUT/ray_offset_why.png: a column for each of the variants (title -> Variant), a row for each place."""
    figure, axes = style.pyplot.subplots(len(PLACES), len(variants), figsize=(11, 1.4 * len(PLACES) + 0.3),
                                         squeeze=False)
    for axis, title in zip(axes[0], variants):
        axis.set_title(title, fontsize=9)
    for line, (where, place) in zip(axes, PLACES.items()):
        scene = stillLife(place).write(context.folder / f"ray_offset_why_{place.size:g}_{place.away:g}.glb")
        for k, (axis, variant) in enumerate(zip(line, variants.values())):
            # A new name for each: OpenImageIO keeps files that it read.
            picture = context.folder / f"ray_offset_why_{place.size:g}_{place.away:g}_{k}.exr"
            context.render(scene, "--width", WIDTH, "--height", HEIGHT, "--bounces", 1, "--keep-all-features",
                           "-o", picture, *variant.options(context, place))
            axis.imshow(shown(pixels(picture)), interpolation="nearest")
            axis.set(xticks=[], yticks=[])
        line[0].set_ylabel(where, fontsize=9)
    figure.savefig(context.out / "ray_offset_why.png", dpi=200)
    style.pyplot.close(figure)
