#!/usr/bin/python3
"""Are the small files that showed faults right? Each of shared/scenes/tried/ with what its README asks for, as a table:
what was seen, what is right, and whether they agree. Radiance is read at the middle of an .exr before a black
background. Exit status 1 if one does not agree; files of formats that the program does not know yet are left out.

usage: experiments/run tried [-- --whittle FILE]
needs: Debian's python3-numpy and python3-openimageio; /usr/bin/python3
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

import numpy
import OpenImageIO as oiio

from same_bits import ROOT, SHARED

TRIED = SHARED / "tried"
BLACK = ["--background", "0,0,0"]


class Bench:
    def __init__(self, whittle, folder):
        self.whittle, self.folder, self.failed = whittle, folder, 0
        print("case", "seen", "right", "", sep="\t")

    def run(self, scene, *options, picture="a.exr"):
        """Values of the picture, [height, width, channels], and what was said."""
        command = [self.whittle, "render", TRIED / scene, "-o", self.folder / picture, *options]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            return None, done.stderr
        image = oiio.ImageInput.open(str(self.folder / picture))
        values = image.read_image(oiio.UINT8 if picture.endswith(".png") else oiio.FLOAT)
        image.close()
        return values, done.stderr

    def line(self, case, seen, right, agrees):
        self.failed += not agrees
        print(case, seen, right, "yes" if agrees else "NO", sep="\t", flush=True)

    def middle(self, scene, right, *options, within=1e-5):
        values, said = self.run(scene, "--width", "33", "--height", "33", *BLACK, *options)
        if values is None:
            self.line(scene, said.strip(), right, False)
            return
        seen = values[16, 16, :3]
        self.line(f"{scene} {' '.join(options)}".strip(), " ".join(f"{v:.6g}" for v in seen),
                  " ".join(f"{v:g}" for v in right), numpy.allclose(seen, right, atol=within, rtol=within))

    def says(self, scene, word, *options):
        _, said = self.run(scene, "--width", "32", "--height", "18", *options)
        lines = [line for line in said.split("\n") if word in line]
        self.line(scene, lines[0] if lines else said.strip(), f"a line with '{word}'", bool(lines))


def transparency(bench):
    for bounces in ("1", "8"):
        bench.middle("transparent-layers/blend_12_a0.1.glb", [0.9**12] * 3, "--bounces", bounces, within=1e-6)
        bench.middle("transparent-layers/blend_12_a0.glb", [1] * 3, "--bounces", bounces, within=1e-6)
    # Leaves that others keep the sun from are black: shadows are not asked for here.
    values, _ = bench.run("transparent-layers/leaves.glb", "--background", "0.5,0.7,1", "--bounces", "8", "--no-shadows")
    dark = int((values.max(axis=2) <= 0).sum())
    bench.line("transparent-layers/leaves.glb", f"{dark} black pixels", "none", dark == 0)
    for scene in ("decal_first_0_at_0", "tilted_first_7.3_same"):
        values, _ = bench.run(f"coplanar-decals/{scene}.glb", "--width", "64", "--height", "64", *BLACK)
        decal = numpy.isclose(values, [1, 0.5, 0.5], atol=1e-5).all(axis=2)
        holes = int(numpy.isclose(values, [0.5, 0, 0], atol=1e-3).all(axis=2).sum())
        bench.line(f"coplanar-decals/{scene}.glb", f"{int(decal.sum())} of decal, {holes} holes",
                   "(1, 0.5, 0.5) without holes", bool(decal.any()) and holes == 0)


def places(bench):
    at, _ = bench.run("georeferenced/at_origin.glb")
    far, _ = bench.run("georeferenced/utm_500km.glb")
    difference = float(numpy.sqrt(((at - far) ** 2).mean()) / at.mean())
    bench.line("georeferenced/utm_500km.glb", f"RMSE / mean {difference:.2g}", "at most 1e-5", difference <= 1e-5)
    bench.middle("clip-planes/near_far.glb", [0, 1, 0])
    for width, height in ((160, 80), (160, 90), (90, 90), (60, 90)):
        values, _ = bench.run("camera-aspect/perspective_2to1.glb", "--width", str(width), "--height", str(height),
                              *BLACK)
        lit = values.max(axis=2) > 0
        corners = [bool(part.any()) for half in numpy.array_split(lit, 2, axis=0)
                   for part in numpy.array_split(half, 2, axis=1)]
        bench.line(f"camera-aspect/perspective_2to1.glb {width}x{height}", f"{sum(corners)} of 4 markers", "4",
                   all(corners))
    shot, said = bench.run("camera-names/shots.glb", "--camera", "Shot B", "--width", "32", "--height", "18")
    bench.line("camera-names/shots.glb", "found" if shot is not None else said.strip(), "found", shot is not None)


def surfaces(bench):
    bench.middle("back-faces/sketchup_front_back.glb", [1, 0, 0], "--eye", "0,0,5", "--look-at", "0,0,0")
    bench.middle("back-faces/sketchup_front_back.glb", [0, 0, 1], "--eye", "0,0,-5", "--look-at", "0,0,0")
    bench.middle("tangents-without-normals/stale_tangent_no_normal.glb", [1] * 3, within=1e-4)
    bench.middle("normal-texture-rotated/rotated_tangent_sunx.glb", [0.5] * 3, within=5e-3)
    bench.middle("vertex-colours/float_out_of_range.glb", [1, 0.5, 0])
    values, said = bench.run("vertex-colours/vec3_plus_vec4.glb")
    bench.line("vertex-colours/vec3_plus_vec4.glb", "loads" if values is not None else said.strip(), "loads",
               values is not None)
    bench.says("sampler-codes/clamp_to_border.glb", "33069")
    bench.says("uris/backslash.gltf", "wood.png")


def looks(bench):
    codes, _ = bench.run("unlit-to-png/a.glb", "--width", "16", "--height", "16", picture="a.png")
    seen = sorted(int(v) for v in codes[..., 0].ravel())
    bench.line("unlit-to-png/a.glb", f"{len(set(seen))} codes", "256", seen == list(range(256)))
    bench.says("photometric-lamps/blender_default.glb", "stops", "-o", bench.folder / "a.png")
    bench.says("photometric-lamps/all_lamps_zero.glb", "intensity 0")
    skies = {}
    for sky in ("rgb.exr", "ao_first.exr", "window.exr", "normal.hdr", "plusy.hdr"):
        skies[sky] = bench.run("environment-files/eyes.glb", "--background", TRIED / "environment-files" / sky,
                               "--camera", "0")[0]
    for first, second in (("ao_first.exr", "rgb.exr"), ("plusy.hdr", "normal.hdr")):
        same = skies[first] is not None and numpy.array_equal(skies[first], skies[second])
        bench.line(f"environment-files/{first}", "the same" if same else "another", f"as {second}", same)
    inside = skies["window.exr"] is not None
    bench.line("environment-files/window.exr", "drawn" if inside else "refused", "the part in its place", inside)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--whittle", type=pathlib.Path, default=ROOT / "build" / "release" / "whittle")
    whittle = parser.parse_args().whittle
    if not TRIED.exists():
        print(f"{TRIED} is not there", file=sys.stderr)
        return 0
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(whittle, pathlib.Path(folder))
        for part in (transparency, places, surfaces, looks):
            part(bench)
    return 1 if bench.failed else 0


if __name__ == "__main__":
    sys.exit(main())
