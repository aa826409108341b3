#!/usr/bin/python3
"""How far the kernels are from the double-precision reference, scene by scene.

Renders each scene with `whittle render` and `whittle reference` and prints one line of tab-separated values for each:
RMSE over the mean radiance for the pixels that see the same triangle, the same without outliers (pixels off by more
than 1e-3 of the mean), their number, the pixels that see another triangle, those of them that see it at another depth
(beyond 1e-4; not so on the edge that two triangles share, or where two surfaces lie in one plane), and both counts of
rays.

usage: experiments/run agreement [-- [--width N] [--height N] [SCENE.glb ...]]   (default: scenes/*.glb)
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


def pixels(file):
    return OpenImageIO.ImageBuf(str(file)).get_pixels(OpenImageIO.FLOAT).astype(float)


def render(whittle, command, scene, size, folder):
    """Radiance [h, w, 3], primitive and depth of the first hit [h, w], ray counts."""
    out = {name: folder / f"{command}-{name}.exr" for name in ("radiance", "primitive", "depth")}
    stats = folder / f"{command}.json"
    subprocess.run([whittle, command, scene, "-o", out["radiance"], "--aov", f"primitive={out['primitive']}",
                    "--aov", f"depth={out['depth']}", "--stats", stats, "--quiet", *size], check=True)
    return (pixels(out["radiance"])[..., :3], pixels(out["primitive"])[..., 0], pixels(out["depth"])[..., 0],
            json.loads(stats.read_text())["rays"])


def compare(kernel, reference):
    (a, a_primitive, a_depth, a_rays), (b, b_primitive, b_depth, b_rays) = kernel, reference
    same = a_primitive == b_primitive
    with numpy.errstate(all="ignore"):
        elsewhere = ~same & ~(abs(a_depth - b_depth) <= 1e-4 * abs(b_depth))
    mean = b.mean()
    outlier = (abs(a - b).max(axis=-1) > 1e-3 * mean) & same

    def rmse(chosen):
        return numpy.sqrt(((a - b)[chosen] ** 2).mean()) / mean

    return (f"{rmse(same):.2e}\t{rmse(same & ~outlier):.2e}\t{outlier.sum()}\t{(~same).sum()}\t{elsewhere.sum()}\t"
            f"{same.size}\t{a_rays['total']}\t{b_rays['total']}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--whittle", default=ROOT / "build/release/whittle")
    parser.add_argument("--width", type=int, default=640)
    parser.add_argument("--height", type=int, default=360)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    size = ["--width", str(options.width), "--height", str(options.height)]
    print("scene", "rmse/mean", "without outliers", "outliers", "other triangle", "other depth", "pixels", "rays",
          "rays of the reference", sep="\t")
    for scene in options.scenes or sorted((ROOT / "scenes").glob("*.glb")):
        with tempfile.TemporaryDirectory() as folder:
            both = [render(options.whittle, c, scene, size, pathlib.Path(folder)) for c in ("render", "reference")]
            print(f"{scene.stem}\t{compare(*both)}", flush=True)


if __name__ == "__main__":
    main()
