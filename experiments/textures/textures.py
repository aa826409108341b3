"""What does filtering textures cost, and how much error does it take away?

Pictures of textured scenes with each `--texture-filter`, against one of many rays without a filter (another seed). A pixel
is inside where 64 eye rays, evenly spread, meet one triangle: what is wrong there is the texture's, and with --no-shadows it
is nothing else's. Texels for each hit come from kernels that write them in the place of the base colour (counting.py). Held
constant: picture, sampler, all threads, kernels on disk; pictures take turns, the times are medians.

Writes textures.tsv, a row for each picture, and textures_times.tsv; figure textures.
"""
import statistics

import numpy

from lib import style, table
from lib.context import SCENES, size
from lib.measure import interleaved
from peers.pictures import pixels
from textures.counting import MOST, countingKernels

COLUMNS = ["scene", "shadows", "filter", "rays", "rmse", "inside_rmse", "inside_share"]
TIMES = ["scene", "filter", "texels", "repetition", "render_s", "shading_s"]
FILTERS = ["none", "mip", "anisotropic"]
SHARED = {"sponza": "bench/crytek-sponza/crytek-sponza.glb"}
SMALL = 160, 90  # of the pictures that are compared: what is far away has many texels in a pixel
ACROSS = 8  # eye rays of a pixel along each side, to see whether it is inside
SHADOWS = {"yes": [], "no": ["--no-shadows"]}


class Pictures:
    """Renders, each into a file of its own: OpenImageIO keeps what it has read."""

    def __init__(self, context, width, height):
        self.context, self.width, self.height, self.count = context, width, height, 0

    def file(self):
        self.count += 1
        return self.context.folder / f"textures_{self.count}.exr"

    def radiance(self, scene, *options):
        file = self.file()
        self.context.render(scene, *size(self.width, self.height), "-o", file, *options)
        return pixels(file)

    def aov(self, scene, name, scale, *options):
        """Of one ray for each pixel, in a picture `scale` times as wide and high."""
        file = self.file()
        self.context.render(scene, *size(scale * self.width, scale * self.height), "--bounces", 1, "--no-shadows", "--aov",
                            f"{name}={file}", *options)
        return pixels(file)

    def inside(self, scene):
        """h x w: one triangle in all of the pixel."""
        tiles = self.aov(scene, "primitive", ACROSS)[..., 0].reshape(self.height, ACROSS, self.width, ACROSS)
        return (tiles.min(axis=(1, 3)) == tiles.max(axis=(1, 3))) & (tiles.min(axis=(1, 3)) >= 0)


def rmse(a, b, where):
    """Over the mean of the right picture, so that scenes can be compared."""
    return float(numpy.sqrt(((a - b)[where] ** 2).mean()) / b.mean())


def errors(context, out, name, scene):
    pictures = Pictures(context, *SMALL)
    inside = pictures.inside(scene)
    for shadows, options in SHADOWS.items():
        right = pictures.radiance(scene, "--texture-filter", "none", "--rays-per-pixel", context.pick(64, 1024), "--sampler",
                                  "sobol", "--seed", 1, *options)
        for rays in context.pick([1], [1, 4]):
            for which in FILTERS:
                seen = pictures.radiance(scene, "--texture-filter", which, "--rays-per-pixel", rays, "--sampler", "sobol",
                                         *options)
                out.row(scene=name, shadows=shadows, filter=which, rays=rays, rmse=rmse(seen, right, numpy.isfinite(right)),
                        inside_rmse=rmse(seen, right, inside), inside_share=float(inside.mean()))


def texels(context, scene, kernels):
    """{filter: mean over textured eye hits of the texels of the base colour}."""
    pictures, found = Pictures(context, *SMALL), {}
    for which in FILTERS:
        counts = pictures.aov(scene, "albedo", 1, "--kernels", kernels, "--texture-filter", which)[..., 0]
        found[which] = float(counts[(counts >= 4) & (counts <= MOST)].mean())
    return found


def times(context, out, name, scene, counts):
    frame = ["--rays-per-pixel", 4, *size(*context.pick((160, 90), (640, 360)))]
    variants = {which: lambda which=which: context.render(scene, "--texture-filter", which, *frame) for which in FILTERS}
    for which, repetition, stats in interleaved(variants, context.pick(1, 5)):
        shading = sum(s["seconds"] for s in stats["stages"] if s["program"] == "shading")
        out.row(scene=name, filter=which, texels=counts[which], repetition=repetition, render_s=stats["time"]["render"],
                shading_s=shading)


def measure(context):
    scenes = {"textured": SCENES / "textured.glb"}
    scenes |= {} if context.quick else {name: context.shared(path) for name, path in SHARED.items() if context.shared(path)}
    out, timed = context.table("textures", COLUMNS), context.table("textures_times", TIMES)
    kernels = countingKernels(context.folder / "counting")
    progress = context.progress("textures", 2 * len(scenes))
    for name, scene in scenes.items():
        errors(context, out, name, scene)
        progress.step(f"{name}, errors")
        times(context, timed, name, scene, texels(context, scene, kernels))
        progress.step(f"{name}, times")


def plot(folder):
    rows, timed = table.read(folder, "textures"), table.read(folder, "textures_times")
    scenes = list(dict.fromkeys(r["scene"] for r in rows))
    figure, axes = style.figure(1, 2, 3.6)
    titles = {"yes": "Whole picture: texels of a hit, and time", "no": "Inside of triangles, without shadows"}
    for axis, (shadows, column) in zip(axes, [("yes", "rmse"), ("no", "inside_rmse")]):
        axis.set(title=titles[shadows], ylabel="error of one ray a pixel over that of none", ylim=(0, 1.15))
        for k, which in enumerate(FILTERS):
            mine = {r["scene"]: r[column] for r in rows if (r["filter"], r["shadows"], r["rays"]) == (which, shadows, 1)}
            base = {r["scene"]: r[column] for r in rows if (r["filter"], r["shadows"], r["rays"]) == ("none", shadows, 1)}
            places = [x + 0.27 * (k - 1) for x in range(len(scenes))]
            bars = axis.bar(places, [mine[s] / base[s] for s in scenes], 0.25, color=style.look(k)["color"])
            whole = shadows == "yes"
            words = [label(timed, s, which) if whole else f"{mine[s] / base[s]:.2f}" for s in scenes]
            axis.bar_label(bars, words, fontsize=7)
        axis.set_xticks(range(len(scenes)), scenes)
    patches = [style.pyplot.Rectangle((0, 0), 1, 1, color=style.look(k)["color"]) for k in range(len(FILTERS))]
    style.legendAbove(figure, patches, FILTERS, ncols=len(FILTERS))
    style.save(figure, folder, "textures")


def label(timed, scene, which):
    """Texels of a hit, and the frame's time over that of none."""
    mine = [r for r in timed if (r["scene"], r["filter"]) == (scene, which)]
    base = [r for r in timed if (r["scene"], r["filter"]) == (scene, "none")]
    ratios = [a["render_s"] / b["render_s"] for a, b in zip(mine, base)]
    return f"{mine[0]['texels']:.1f}\n{statistics.median(ratios):.2f} ×"
