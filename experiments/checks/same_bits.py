#!/usr/bin/python3
"""Does leaving out what a scene does not need change a picture? Every scene there is, ours and shared ones, as it is
against everything compiled in: pixels in which the two differ (there must be none).

usage: experiments/run same_bits [-- SCENE ...]   exit status: 1 where any pixel differs, or a scene is refused
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHARED = ROOT.parent / "shared" / "scenes"
PICTURE = ["--width", "96", "--height", "54", "--bounces", "6", "--quiet"]


def scenes():
    found = sorted((ROOT / "scenes").glob("*.glb"))
    for folder in ("gltf", "bench"):
        found += sorted(f for kind in ("*.glb", "*.gltf") for f in (SHARED / folder).rglob(kind))
    return found


def pixelsThatDiffer(whittle, scene, folder):
    """A count, or the program's own line where it refuses the scene."""
    pictures = [folder / "special.exr", folder / "everything.exr"]
    for picture, options in zip(pictures, ([], ["--keep-all-features"])):
        done = subprocess.run([whittle, "render", scene, "-o", picture, *PICTURE, *options], capture_output=True,
                              text=True)
        if done.returncode != 0:
            return done.stderr.strip().split("\n")[-1]
    compared = subprocess.run([whittle, "compare", *pictures, "--json"], capture_output=True, text=True)
    return json.loads(compared.stdout)["differingPixels"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    parser.add_argument("--whittle", type=pathlib.Path, default=ROOT / "build" / "release" / "whittle")
    a = parser.parse_args()
    different = 0
    print("scene", "differing_pixels", sep="\t")
    with tempfile.TemporaryDirectory() as folder:
        for scene in a.scenes or scenes():
            count = pixelsThatDiffer(a.whittle, scene, pathlib.Path(folder))
            different += count != 0
            print(scene.name, count, sep="\t", flush=True)
            print(f"{scene.name:48} {count}", file=sys.stderr)
    if different:
        sys.exit(f"same_bits: {different} scenes differ or are refused")


if __name__ == "__main__":
    main()
