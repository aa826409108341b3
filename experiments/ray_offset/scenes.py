"""Scenes whose pictures are known beforehand, at any scale and at any distance from the origin.

All corners lie on a grid of 2^-10 of the scene's height (but for the gaps), so that a scene moved by up to 10^4 heights
is the same scene bit for bit, in single precision too. Bodies are convex, and suns shine across the x axis along which
they stand: no shadow falls on what can be seen of them. Units here: heights; `Place` turns them into metres.
"""
import dataclasses
import itertools
import math

import numpy

from lib import glb

GRID = 2.0**-10
WIDTH, HEIGHT = 512, 256  # pixels of 4 grid squares
EYE = 0.75  # height of the camera's plane, in which eye rays begin
GAPS = [2.0**-k for k in range(4, 24)]
# Suns of one colour each, so that a picture tells which of them was lost: from straight ahead, slanted, grazing.
TILTS = [math.radians(a) for a in (20, 70, -88)]
BALL, FLAT, ROOM, PLATES = (0.05, 0.45), (0.55, 0.95), (1.3, 1.6), (1.65, 1.98)  # along x
SLANTED, LEANING, LOW = (1.0, 1.08), (1.1, 1.18), (1.2, 1.28)  # single facets


@dataclasses.dataclass(frozen=True)
class Place:
    """A scene's height and the distance of its corner from the origin along each axis, in metres."""
    size: float
    away: float = 0.0

    def at(self, points):
        return (numpy.asarray(points, float) * self.size + self.away).astype("<f4")


def onGrid(points):
    return numpy.round(numpy.asarray(points) / GRID) * GRID


def icosahedron():
    g = (1 + math.sqrt(5)) / 2
    corners = numpy.array([p for a, b in itertools.product((-1, 1), (-g, g))
                           for p in ((0, a, b), (a, b, 0), (b, 0, a))])
    near = [set(numpy.flatnonzero(numpy.isclose(numpy.linalg.norm(corners - c, axis=1), 2))) for c in corners]
    faces = [(i, j, k) for i in range(12) for j in near[i] for k in near[i] & near[j] if i < j < k]
    return corners, [outwards(corners, f) for f in faces]


def outwards(corners, face):
    a, b, c = corners[list(face)]
    return face if numpy.dot(numpy.cross(b - a, c - a), a) > 0 else face[::-1]


def ball():
    """Eighty facets: corners on the unit sphere, and triangles."""
    corners, faces = icosahedron()
    points, made, halves = list(corners), [], {}
    for face in faces:
        middle = []
        for i, j in itertools.combinations(sorted(face), 2):
            if (i, j) not in halves:
                halves[i, j] = len(points)
                points.append(points[i] + points[j])
            middle.append(halves[i, j])
        low, mid, high = sorted(face)
        ab, ac, bc = middle
        made += [(low, ab, ac), (mid, ab, bc), (high, ac, bc), (ab, ac, bc)]
    points = numpy.array(points)
    points /= numpy.linalg.norm(points, axis=1, keepdims=True)
    return points, [outwards(points, f) for f in made]


def isConvex(points, triangles):
    """No corner on the outer side of any face; exact, since grid points and their products are whole numbers."""
    whole = numpy.round(points / GRID).astype(object)
    for a, b, c in triangles:
        u, v = whole[b] - whole[a], whole[c] - whole[a]
        n = numpy.array([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])
        if max((whole - whole[a]) @ n) > 0:
            return False
    return True


def ellipsoid(centre, radii):
    """Corners on the grid, the true surface's normals, triangles."""
    points, triangles = ball()
    corners = onGrid(centre + points * radii)
    assert isConvex(corners, triangles)
    normals = points / radii
    return corners, normals / numpy.linalg.norm(normals, axis=1, keepdims=True), triangles


def bodies(scene, place, material, flatToo=True):
    """A ball, and one pressed flat, whose normals lie up to 60 degrees off its facets."""
    both = [(BALL, (0.2, 0.2, 0.2)), (FLAT, (0.2, 0.07, 0.2))]
    for (low, high), radii in both[:2 if flatToo else 1]:
        corners, normals, triangles = ellipsoid(((low + high) / 2, 0.5, 0.35), radii)
        scene.mesh(place.at(corners), triangles, material, normals)


def facets(scene, place, material):
    """One slanted; one with normals that lean 80 to 88 degrees over, as on the smoothed rim of a thin plate; one that
    nearly lies in the plane z = 0, as most grounds do."""
    for span, heights in ((SLANTED, (0.1, 0.7, 0.3)), (LEANING, (0.1, 0.15, 0.3)), (LOW, (GRID, 2 * GRID, 3 * GRID))):
        xs, ys = (span[0], span[1], span[0] + 0.02), (0.05, 0.5, 0.95)
        corners = onGrid(list(zip(xs, ys, heights)))
        normals = None
        if span == LEANING:
            n_g = numpy.cross(corners[1] - corners[0], corners[2] - corners[0])
            n_g /= numpy.linalg.norm(n_g)
            along = numpy.cross(n_g, (0, 1, 0))  # towards the camera
            along /= numpy.linalg.norm(along)
            normals = [math.cos(math.radians(a)) * n_g + math.sin(math.radians(a)) * along for a in (80, 85, 88)]
        scene.mesh(place.at(corners), [(0, 1, 2)], material, normals)


def prism(low, high, section):
    """Closed, over a triangle in the plane of y and z, from x = low to high."""
    points = [(x, y, z) for x in (low, high) for y, z in section]
    return points, [(0, 2, 1), (3, 4, 5), (0, 1, 4), (0, 4, 3), (1, 2, 5), (1, 5, 4), (2, 0, 3), (2, 3, 5)]


def room(scene, place, material):
    """A wedge whose floor and roof meet at 25 degrees, of walls as thick as the grid: light outside, dark inside."""
    low, high, g = *ROOM, GRID
    inside = [(0.05, EYE), (0.95, EYE - 0.4), (0.95, EYE + 0.05)]
    outside = [(0.05 - 5 * g, EYE + g), (0.95 + g, EYE - 0.4 - 2 * g), (0.95 + g, EYE + 0.05 + 2 * g)]
    for points, triangles in (prism(low, high, inside), prism(low - g, high + g, outside)):
        scene.mesh(place.at(onGrid(points)), triangles, material)


def tile(k):
    """Middle of the k-th pair of plates."""
    return PLATES[0] + 0.08 + 0.16 * (k % 2), 0.068 + 0.096 * (k // 2)


def plates(scene, place, lower, upper):
    """Pairs with the plane of the eye rays' origins between them."""
    for k, gap in enumerate(GAPS):
        x, y = tile(k)
        for z, material in ((EYE - gap / 2, lower), (EYE + gap / 2, upper)):
            corners = [(x + i * 0.07, y + j * 0.04, z) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            corners = [(*onGrid(c[:2]), c[2]) for c in corners]
            scene.mesh(place.at(corners), [(0, 1, 2), (0, 2, 3)], material)


def fromAbove(scene, place):
    scene.camera(glb.ORTHOGRAPHIC, {"xmag": place.size, "ymag": place.size / 2, "znear": 0, "zfar": 1},
                 place.at((1, 0.5, EYE)))


def shadowScene(place):
    """Matte bodies, a room and plates under three suns."""
    scene = glb.Scene()
    white = scene.material(**glb.matte())
    bodies(scene, place, white)
    facets(scene, place, white)
    room(scene, place, white)
    plates(scene, place, white, white)
    for channel, tilt in enumerate(TILTS):
        scene.sun(tilt, [float(c == channel) for c in range(3)])
    fromAbove(scene, place)
    return scene


def mirrorScene(place):
    """A mirror ball in uniform radiance 1: each pixel is 1."""
    scene = glb.Scene((1.0, 1.0, 1.0))
    bodies(scene, place, scene.material(**glb.mirror()), flatToo=False)
    fromAbove(scene, place)
    return scene


def airScene(place):
    """Bodies of air in uniform radiance 1: each pixel is 1. And mirrors under black plates: each pixel is 0."""
    scene = glb.Scene((1.0, 1.0, 1.0))
    bodies(scene, place, scene.material(**glb.air()))
    plates(scene, place, scene.material(**glb.mirror()), scene.material(**glb.matte(0.0)))
    fromAbove(scene, place)
    return scene


def columns(span):
    """Pixels from side to side of what lies in `span` of x, a pixel away from its edges."""
    scale = WIDTH / 2
    return slice(math.ceil(span[0] * scale) + 1, math.floor(span[1] * scale) - 1)


def tilePixels(k):
    """Rows and columns in the middle of the k-th pair of plates, where the shadow of the upper one covers the lower."""
    x, y = tile(k)
    column, row = int(x * WIDTH / 2), int((1 - y) * HEIGHT)
    return slice(row - 2, row + 3), slice(column - 3, column + 4)
