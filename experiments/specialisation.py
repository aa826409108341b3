#!/usr/bin/python3
"""What leaving out saves: each scene with only what it needs against everything compiled in, and what each feature costs.

For each scene, in turn: renders as they are and with --keep-all-features, interleaved; medians of the frame's time, of the
time to compile with nothing on disk, bytes of buffers, and the pixels in which the pictures differ (there must be none).
Then the plainest scene with one feature more, for each feature that it does without, interleaved with the scene as it is.

writes: data/specialisation.tsv and specialisation_features.tsv, figures/specialisation.svg and .png, in this folder or
        that of --out
usage: experiments/specialisation.py [--quick] [--runs N] [--whittle FILE] [--out FOLDER] [--plot] [SCENE.glb ...]
       without scenes: our own, the generated frame, and shared ones where they are; --plot: draws the data again
needs: Debian's python3-matplotlib; /usr/bin/python3
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared" / "scenes"
SHARED_SCENES = ["gltf/SpecularTest/glTF-Binary/SpecularTest.glb", "bench/cornell-mcguire/CornellBox-Original.glb",
                 "bench/teapot-full/teapot-full.glb", "bench/crytek-sponza/crytek-sponza.glb"]
PLAINEST = ROOT / "scenes" / "height_field.glb"
EVERYTHING = ["--keep-all-features"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true", help="fewer runs, small pictures")
    parser.add_argument("--runs", type=int, help="interleaved runs of each")
    parser.add_argument("--cold", type=int, default=1, help="compilations with nothing on disk")
    parser.add_argument("--whittle", type=pathlib.Path, default=ROOT / "build" / "release" / "whittle")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent)
    parser.add_argument("--plot", action="store_true", help="measure nothing")
    a = parser.parse_args()
    a.runs = a.runs or (3 if a.quick else 5)
    a.size = ["--width", "320", "--height", "180"] if a.quick else ["--width", "640", "--height", "360", "--rays-per-pixel", "4"]
    return a


class Renders:
    """Runs of the program; one folder of compiled kernels for all that are not to be cold."""

    def __init__(self, a, folder):
        self.a, self.folder = a, pathlib.Path(folder)

    def run(self, scene, options, kernels):
        command = [self.a.whittle, "render", scene, "--quiet", "--stats", "-", *options]
        environment = dict(os.environ, POCL_CACHE_DIR=str(kernels))
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{scene.name}: {done.stderr.strip()}")
        return json.loads(done.stdout)

    def warm(self, scene, options=()):
        return self.run(scene, [*self.a.size, *options], self.folder / "kernels")

    def compileSeconds(self, scene, options=()):
        """With nothing on disk."""
        with tempfile.TemporaryDirectory(dir=self.folder) as empty:
            return self.run(scene, ["--width", "32", "--height", "18", *options], empty)["time"]["compile"]

    def differingPixels(self, scene):
        pictures = [self.folder / "special.exr", self.folder / "everything.exr"]
        for picture, options in zip(pictures, ([], EVERYTHING)):
            self.warm(scene, ["-o", picture, *options])
        text = subprocess.run([self.a.whittle, "compare", *pictures, "--json"], capture_output=True, text=True).stdout
        return json.loads(text)["differingPixels"]

    def interleaved(self, scene, variants):
        """Median frame seconds of each variant, and the last statistics of each."""
        seconds, last = [[] for _ in variants], [None] * len(variants)
        for options in variants:
            self.warm(scene, options)  # compiled, and the file in memory
        for _ in range(self.a.runs):
            for i, options in enumerate(variants):
                last[i] = self.warm(scene, options)
                seconds[i].append(last[i]["time"]["render"])
        return seconds, last


def megabytes(stats, groups):
    return sum(stats["memory"].get(group, 0) for group in groups) / 1e6


def spread(values):
    """Half of the middle half, relative."""
    q = statistics.quantiles(values, n=4) if len(values) > 1 else [values[0]] * 3
    return (q[2] - q[0]) / 2 / q[1]


def measureScenes(renders, scenes, out):
    names = ("scene triangles features frame_s frame_everything_s frame_ratio spread compile_s compile_everything_s "
             "compile_ratio queues_scene_MB queues_scene_everything_MB memory_ratio differing_pixels").split()
    out.write("\t".join(names) + "\n")
    for scene in scenes:
        seconds, (special, whole) = renders.interleaved(scene, [[], EVERYTHING])
        frame, frameAll = (statistics.median(s) for s in seconds)
        cold = [statistics.median(renders.compileSeconds(scene, o) for _ in range(renders.a.cold))
                for o in ([], EVERYTHING)]
        groups = ["tree", "triangles", "textures", "queues"]
        memory = [megabytes(s, groups) for s in (special, whole)]
        row = [scene.stem, special["scene"]["triangles"], len(special["features"]["used"]), f"{frame:.4f}", f"{frameAll:.4f}",
               f"{frameAll / frame:.3f}", f"{max(map(spread, seconds)):.3f}", f"{cold[0]:.2f}", f"{cold[1]:.2f}",
               f"{cold[1] / cold[0]:.2f}", f"{memory[0]:.1f}", f"{memory[1]:.1f}", f"{memory[0] / memory[1]:.3f}",
               renders.differingPixels(scene)]
        out.write("\t".join(map(str, row)) + "\n")
        out.flush()
        print(f"{row[0]:24} frame {row[5]}x  compile {row[9]}x  memory {row[12]}  differing pixels {row[13]}", file=sys.stderr)


def measureFeatures(renders, out):
    out.write("feature\tframe_ratio\tspread\tcompile_more_s\tmemory_more_MB\n")
    plain = renders.warm(PLAINEST)
    bare = renders.compileSeconds(PLAINEST)
    for feature in [f["name"] for f in plain["features"]["leftOut"]]:
        kept = ["--keep-features", feature]
        seconds, (without, more) = renders.interleaved(PLAINEST, [[], kept])
        ratio = statistics.median(seconds[1]) / statistics.median(seconds[0])
        groups = ["tree", "triangles", "textures", "queues", "film"]
        row = [feature, f"{ratio:.3f}", f"{max(map(spread, seconds)):.3f}", f"{renders.compileSeconds(PLAINEST, kept) - bare:.2f}",
               f"{megabytes(more, groups) - megabytes(without, groups):.2f}"]
        out.write("\t".join(row) + "\n")
        out.flush()
        print(f"{feature:36} frame {row[1]}x  compile {float(row[3]):+.2f} s  memory {float(row[4]):+.1f} MB", file=sys.stderr)


def table(file):
    lines = file.read_text().splitlines()
    names = lines[0].split("\t")
    return [dict(zip(names, line.split("\t"))) for line in lines[1:]]


def plot(folder):
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "svg.hashsalt": "whittle"})
    import matplotlib.pyplot as plt

    rows = sorted(table(folder / "data" / "specialisation.tsv"), key=lambda r: float(r["frame_ratio"]))
    features = sorted(table(folder / "data" / "specialisation_features.tsv"), key=lambda r: float(r["frame_ratio"]))
    figure, axes = plt.subplots(1, 4, figsize=(14, 0.24 * max(len(rows), len(features)) + 1.3), layout="constrained",
                                width_ratios=[1, 1, 1, 1.1])
    panels = [("frame_ratio", "frame: times faster\nthan with everything", 1.0), ("compile_ratio", "compile, nothing on disk:\ntimes faster", 1.0),
              ("memory_ratio", "queues and scene:\nshare of everything's bytes", 1.0)]
    for axis, (key, label, mark) in zip(axes, panels):
        values = [float(r[key]) for r in rows]
        axis.barh(range(len(rows)), values, color="#0072b2", height=0.7)
        axis.axvline(mark, color="black", linewidth=0.8)
        for i, value in enumerate(values):
            axis.text(value, i, f" {value:.2f}", va="center", fontsize=7.5)
        axis.set_xlabel(label)
        axis.set_xlim(0, max(values) * 1.18)
        axis.set_ylim(-0.6, len(rows) - 0.4)
        axis.set_yticks(range(len(rows)), [f"{r['scene']} ({r['features']})" for r in rows] if axis is axes[0] else [])
    axes[0].set_title("scene (features it needs)", loc="left", fontsize=9)
    last = axes[3]
    change = [(float(r["frame_ratio"]) - 1) * 100 for r in features]
    error = [float(r["spread"]) * 100 for r in features]
    last.barh(range(len(features)), change, xerr=error, color="#d55e00", height=0.7, error_kw={"linewidth": 0.7})
    last.axvline(0, color="black", linewidth=0.8)
    last.set_yticks(range(len(features)), [r["feature"] for r in features], fontsize=7.5)
    last.set_ylim(-0.6, len(features) - 0.4)
    last.set_xlabel(f"{PLAINEST.stem} with one feature more:\nframe slower by, % (half of the middle half)")
    for kind in ("svg", "png"):
        figure.savefig(folder / "figures" / f"specialisation.{kind}", dpi=130, metadata={"Date": None} if kind == "svg" else None)


def main():
    a = arguments()
    data = a.out / "data"
    for part in (data, a.out / "figures"):
        part.mkdir(parents=True, exist_ok=True)
    if not a.plot:
        with tempfile.TemporaryDirectory() as folder:
            scenes = a.scenes
            if not scenes:
                generated = {"frame": ["--frame"]}
                for name, options in generated.items():
                    subprocess.run([a.whittle.parent / "make_scenes", *options, f"{folder}/{name}.glb"], check=True,
                                   stdout=subprocess.DEVNULL)
                scenes = sorted((ROOT / "scenes").glob("*.glb")) + [pathlib.Path(folder) / f"{n}.glb" for n in generated]
                there = [SHARED / s for s in SHARED_SCENES if (SHARED / s).exists()]
                if len(there) < len(SHARED_SCENES):
                    print(f"{len(SHARED_SCENES) - len(there)} shared scenes are not there and are left out", file=sys.stderr)
                scenes += there
            renders = Renders(a, folder)
            with open(data / "specialisation.tsv", "w") as out:
                measureScenes(renders, scenes, out)
            with open(data / "specialisation_features.tsv", "w") as out:
                measureFeatures(renders, out)
    plot(a.out)


if __name__ == "__main__":
    main()
