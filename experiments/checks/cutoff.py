#!/usr/bin/python3
"""What a cut-off saves and what it costs: a scene with several cut-offs, in turn, as tab-separated values.

One line for each cut-off: rays, seconds of rendering (the least of --runs interleaved ones; one more of each before
them is not counted), the bias (mean difference over the picture from the first cut-off's, worst channel, W/(m² sr)),
the bound that the statistics give for it, and the RMSE against the first. The first is the truth: 0, or, where nobody
can wait for that, one so small that its own bound is small enough.

usage: experiments/cutoff.py SCENE.glb [--whittle FILE] [--cutoffs 0,1e-4,...] [--runs N] [RENDER OPTIONS]
needs: Debian's python3-numpy and python3-openimageio; /usr/bin/python3
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import numpy
import OpenImageIO

ROOT = pathlib.Path(__file__).resolve().parent.parent


def pixels(file):
    image = OpenImageIO.ImageInput.open(str(file))
    values = numpy.asarray(image.read_image(OpenImageIO.FLOAT), dtype=numpy.float64)
    image.close()
    return values.reshape(-1, values.shape[-1])


def render(args, options, cutoff, picture):
    command = [args.whittle, "render", args.scene, "--cutoff", cutoff, "--quiet", "-o", picture, "--stats", "-",
               *options]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--whittle", default=str(ROOT / "build/release/whittle"))
    parser.add_argument("--cutoffs", default="0,1e-4,1e-3,1e-2")
    parser.add_argument("--runs", type=int, default=5)
    args, options = parser.parse_known_args()
    cutoffs = args.cutoffs.split(",")
    seconds, stats, pictures = {c: [] for c in cutoffs}, {}, {}
    with tempfile.TemporaryDirectory() as folder:
        for run in range(args.runs + 1):
            for c in cutoffs:
                picture = str(pathlib.Path(folder) / "picture.exr")
                stats[c] = render(args, options, c, picture)
                pictures[c] = pixels(picture)
                if run > 0:
                    seconds[c].append(stats[c]["time"]["render"])
    print("scene\tcutoff\trays\tseconds\tbias\tbound\trmse")
    for c in cutoffs:
        difference = pictures[cutoffs[0]] - pictures[c]
        print(pathlib.Path(args.scene).stem, c, stats[c]["rays"]["total"], f"{min(seconds[c]):.3f}",
              f"{abs(difference.mean(axis=0)).max():.2e}", f"{stats[c]['biasBound']:.2e}",
              f"{numpy.sqrt((difference**2).mean()):.2e}", sep="\t")


if __name__ == "__main__":
    main()
