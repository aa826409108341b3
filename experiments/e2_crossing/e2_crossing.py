"""E2: From how many triangles on does the tree beat the array?

Height fields of exactly 1 to 1000 triangles over the same square of ground, several shapes of hills (seeds) of each
count, 640×360. Held constant: camera, lights, picture, device. Varied: triangles, seed, search, threads. Array and
tree take turns. Compared: the whole frame, and the two search stages alone. A run with --search auto says what the
program chooses.

Writes e2_crossing.tsv (a row for each run); figure e2_crossing. The crossing is where the monotone regression of the
median log ratios passes 0; its interval comes from drawing repetitions and seeds anew (bootstrap, 95 %).
"""
import math
import statistics

import numpy

from e2_crossing import strip
from lib import stages, style, table
from lib.context import SCENES, RunFailed, size
from lib.measure import interleaved

COLUMNS = ["triangles", "seed", "search", "threads", "repetition", "render", "searches", "usedTree"]
FULL = [1, 2, 3, 4, 6, 8, 10, 12, 14, 16, 20, 24, 32, 48, 64, 96, 128, 192, 256, 512, 1000]
QUICK = [1, 4, 8, 12, 16, 32, 128, 1000]
MEASURES = [("render", "the whole frame"), ("searches", "its searches alone")]


def variants(context, scene):
    def one(search, threads):
        return lambda: context.render(scene, "--search", search, "--threads", threads, *size(640, 360))
    return {(s, t): one(s, t) for t in sorted({1, context.threads}) for s in ("array", "tree")}


def measureCount(context, triangles, seed, out):
    scene = strip.write(context.folder / "strip.glb", SCENES / "height_field.glb", triangles, seed)
    found = context.render(scene, *size(64, 36))
    if found["scene"]["triangles"] != triangles:
        raise RunFailed(f"strip of {triangles} triangles: {found['scene']['triangles']} were loaded")
    runs = [(("auto", context.threads), 0, found)]
    runs += interleaved(variants(context, scene), context.pick(2, 4))
    for (search, threads), repetition, s in runs:
        timed = {} if search == "auto" else {"render": s["time"]["render"],
                                             "searches": stages.searchSeconds(s)}
        out.row(triangles=triangles, seed=seed, search=search, threads=threads, repetition=repetition,
                usedTree=int("tree search" in s["features"]["used"]), **timed)


def measure(context):
    out = context.table("e2_crossing", COLUMNS)
    counts, seeds = context.pick(QUICK, FULL), range(context.pick(1, 3))
    progress = context.progress("e2", len(counts) * len(seeds))
    for seed in seeds:
        for triangles in counts:
            measureCount(context, triangles, seed, out)
            progress.step(f"{triangles} triangles, seed {seed}")


def monotone(y):
    """The rising sequence nearest to y in least squares: neighbours that fall are pooled (Ayer et al. 1955)."""
    blocks = []
    for value in y:
        blocks.append([value, 1])
        while len(blocks) > 1 and blocks[-2][0] > blocks[-1][0]:
            (b, m), (a, n) = blocks.pop(), blocks.pop()
            blocks.append([(a * n + b * m) / (n + m), n + m])
    return numpy.concatenate([[value] * n for value, n in blocks])


def crossing(x, ratios):
    """Where the monotone regression of log ratios passes 0; the first or last x where it never does."""
    rising = monotone(ratios)
    above = numpy.flatnonzero(rising > 0)
    if len(above) == 0 or above[0] == 0:
        return float(x[-1] if len(above) == 0 else x[0])
    i = above[0]
    share = -rising[i - 1] / (rising[i] - rising[i - 1])
    return float(numpy.exp(numpy.log(x[i - 1]) + share * (numpy.log(x[i]) - numpy.log(x[i - 1]))))


class Ratios:
    """Array over tree, of one column and one number of threads: samples[search][triangles][seed] = [seconds, ...]."""

    def __init__(self, rows, column, threads):
        self.samples = {"array": {}, "tree": {}}
        for r in rows:
            if r["search"] in self.samples and r["threads"] == threads:
                seeds = self.samples[r["search"]].setdefault(r["triangles"], {})
                seeds.setdefault(r["seed"], []).append(r[column])
        self.x = sorted(set(self.samples["array"]) & set(self.samples["tree"]))

    def bySeed(self, n, draw=lambda values: values):
        """Log ratio of the medians of each seed."""
        both = (self.samples["array"][n], self.samples["tree"][n])
        seeds = draw([s for s in both[0] if s in both[1]])
        return [math.log(statistics.median(draw(both[0][s])) / statistics.median(draw(both[1][s]))) for s in seeds]

    def medians(self, draw=lambda values: values):
        return numpy.array([statistics.median(self.bySeed(n, draw)) for n in self.x])

    def interval(self, times=300):
        """2.5 % and 97.5 % points of the crossing; None from one shape of hills, which says nothing of others."""
        if min(len(seeds) for seeds in self.samples["array"].values()) < 2:
            return None
        random = numpy.random.default_rng(1)

        def draw(values):
            return [values[i] for i in random.integers(0, len(values), len(values))]
        found = [crossing(self.x, self.medians(draw)) for _ in range(times)]
        return numpy.percentile(found, [2.5, 97.5])


def autoThreshold(rows):
    """The fewest triangles for which --search auto took the tree."""
    return min((r["triangles"] for r in rows if r["search"] == "auto" and r["usedTree"]), default=None)


def crossingText(at, interval, x):
    """In words; beyond the counts that were measured nothing is known."""
    if at <= x[0]:
        return f"the tree wins from {x[0]} on"
    if at >= x[-1]:
        return f"the array wins up to {x[-1]}"
    if interval is None:
        return f"crosses at about {at:.2g}"
    return "crosses at {:.0f} [{:.0f}, {:.0f}]".format(at, *interval)


def markCrossing(axis, i, at, low, high):
    """Its interval as a bar along the foot of the panel, one for each measure."""
    look = style.look(i)
    foot = {"transform": axis.get_xaxis_transform(), "color": look["color"], "clip_on": False}
    axis.plot([low, high], [0.04 + 0.06 * i] * 2, linewidth=5, alpha=0.4, solid_capstyle="butt", **foot)
    axis.plot([at], [0.04 + 0.06 * i], marker=look["marker"], markersize=5, **foot)


def plotPanel(axis, rows, threads, automatic):
    """One number of threads; returns its labels, to be placed when the whole figure is laid out."""
    labels, results = style.EndLabels(axis), {}
    for i, (column, words) in enumerate(MEASURES):
        ratios = Ratios(rows, column, threads)
        y = numpy.exp(ratios.medians())
        spread = [numpy.exp([min(v), max(v)]) for v in (ratios.bySeed(n) for n in ratios.x)]
        style.draw(axis, i, ratios.x, y, *zip(*spread))
        results[column], interval = crossing(ratios.x, ratios.medians()), ratios.interval()
        if interval is not None:
            markCrossing(axis, i, results[column], *interval)
        text = f"{words}\n{crossingText(results[column], interval, ratios.x)}"
        labels.add(ratios.x[-1], y[-1], text, style.look(i)["color"])
    foot = "one shape of hills: no intervals" if interval is None else "bars at the foot: where they cross, 95 %"
    axis.text(0.99, 0.07, foot, transform=axis.transAxes, ha="right", va="center",
              fontsize=8.5, color=style.GREY)
    axis.axhline(1, color=style.BLACK, linewidth=0.8)
    if automatic:
        axis.axvline(automatic, color=style.GREY, linewidth=1, linestyle=":")
        axis.annotate(f"--search auto takes\nthe tree from {automatic}", (automatic, 0.97), (4, 0), va="top",
                      fontsize=8.5, xycoords=("data", "axes fraction"), textcoords="offset points", color=style.GREY)
    axis.set(xscale="log", yscale="log", ylabel="time with the array /\ntime with the tree")
    style.plainLog(axis.xaxis)
    style.plainLog(axis.yaxis)
    low, high = axis.get_ylim()
    axis.set_ylim(low / (high / low)**0.15, high)  # room for the bars
    axis.set_title(f"{threads} thread{'s' if threads > 1 else ''}: the tree wins the frame from "
                   f"about {numpy.ceil(results['render']):.0f} triangles on")
    return labels


def plot(folder):
    rows = table.read(folder, "e2_crossing")
    threads = sorted({r["threads"] for r in rows if r["search"] != "auto"})
    figure, axes = style.figure(rows=len(threads), height=3.4 * len(threads), sharex=True, squeeze=False)
    labels = [plotPanel(axis, rows, number, autoThreshold(rows)) for axis, number in zip(axes[:, 0], threads)]
    axes[-1, 0].set_xlabel("triangles")
    style.placeAll(labels)
    style.save(figure, folder, "e2_crossing")
