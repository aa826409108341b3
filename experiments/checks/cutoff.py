#!/usr/bin/python3
"""What a cut-off saves and what it costs: a scene with several cut-offs, in turn, as tab-separated values.

One line for each cut-off: rays, seconds of rendering (the least of --runs interleaved ones; one more of each before
them is not counted), the bias (mean difference over the picture from the first cut-off's, worst channel, W/(m² sr)),
the bound that the statistics give for it, and the RMSE against the first. The first is the truth: 0, or, where nobody
can wait for that, one so small that its own bound is small enough.

usage: experiments/run cutoff [-- SCENE.glb [--cutoffs 0,1e-4,...] [--runs N] [RENDER OPTIONS]]
       (default: the three of DEFAULT)
needs: Debian's python3-numpy and python3-openimageio; /usr/bin/python3
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import numpy
import OpenImageIO

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Scene, cut-offs, runs, options. Without a cut-off nobody can wait for glass 32 deep.
DEFAULT = [("mirror_box", "0,1e-4,1e-3,1e-2", 5, ["--bounces", "32"]),
           ("nested_glass", "0,1e-4,1e-3,1e-2", 5, ["--bounces", "14", "--width", "160", "--height", "90"]),
           ("nested_glass", "1e-7,1e-4,1e-3,1e-2", 3, ["--bounces", "32", "--width", "160", "--height", "90"])]


def pixels(file):
    image = OpenImageIO.ImageInput.open(str(file))
    values = numpy.asarray(image.read_image(OpenImageIO.FLOAT), dtype=numpy.float64)
    image.close()
    return values.reshape(-1, values.shape[-1])


def render(whittle, scene, options, cutoff, picture):
    command = [whittle, "render", scene, "--cutoff", cutoff, "--quiet", "-o", picture, "--stats", "-",
               *options]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def measure(whittle, scene, cutoffs, runs, options):
    """One scene, a line for each cut-off."""
    seconds, stats, pictures = {c: [] for c in cutoffs}, {}, {}
    with tempfile.TemporaryDirectory() as folder:
        for run in range(runs + 1):
            for c in cutoffs:
                picture = str(pathlib.Path(folder) / "picture.exr")
                stats[c] = render(whittle, scene, options, c, picture)
                pictures[c] = pixels(picture)
                if run > 0:
                    seconds[c].append(stats[c]["time"]["render"])
    for c in cutoffs:
        difference = pictures[cutoffs[0]] - pictures[c]
        print(pathlib.Path(scene).stem, c, stats[c]["rays"]["total"], f"{min(seconds[c]):.3f}",
              f"{abs(difference.mean(axis=0)).max():.2e}", f"{stats[c]['biasBound']:.2e}",
              f"{numpy.sqrt((difference**2).mean()):.2e}", sep="\t", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="?")
    parser.add_argument("--whittle", default=str(ROOT / "build/release/whittle"))
    parser.add_argument("--cutoffs", default="0,1e-4,1e-3,1e-2")
    parser.add_argument("--runs", type=int, default=5)
    args, options = parser.parse_known_args()
    print("scene\tcutoff\trays\tseconds\tbias\tbound\trmse")
    if args.scene:
        measure(args.whittle, args.scene, args.cutoffs.split(","), args.runs, options)
        return
    for name, cutoffs, runs, own in DEFAULT:
        measure(args.whittle, str(ROOT / "scenes" / f"{name}.glb"), cutoffs.split(","), runs, own)


if __name__ == "__main__":
    main()
