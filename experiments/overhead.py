"""What does looking cost: how much slower is a frame with --profile or --trace than without?

Held constant: scene, picture, all threads, kernels on disk. Short frames take turns, many times and each round in another
order, as what is looked for is smaller than the noise of one run: the answer is the median of the ratios within rounds,
with an interval of 95 % by resampling. Once with the program's own wavefront, once with wavefronts so small that a frame has thousands of
launches, each of which a trace records.

Writes data/overhead.tsv, a row for each frame; figures/overhead.
"""
import random
import statistics

from lib import style, table
from lib.context import SCENES, size
from lib.measure import medianInterval

COLUMNS = ["case", "variant", "run", "render_s", "launches"]
CASES = {"own wavefront": [*size(640, 360), "--rays-per-pixel", 2],
         "wavefronts of 1024": [*size(320, 180), "--wavefront", 1024]}
ROUNDS = {"own wavefront": 40, "wavefronts of 1024": 120}
VARIANTS = ["plain", "plain again", "--profile", "--trace"]


def frame(context, case, variant):
    options = {"--profile": ["--profile"], "--trace": ["--trace", context.folder / "trace.json"]}.get(variant, [])
    return context.render(SCENES / "cornell_box.glb", *CASES[case], *options)


def measure(context):
    out = context.table("overhead", COLUMNS)
    dice = random.Random(1)
    rounds = {case: context.pick(4, n) for case, n in ROUNDS.items()}
    progress = context.progress("overhead", sum(rounds.values()))
    for case, number in rounds.items():
        frame(context, case, "plain")  # compiled, and on disk
        for run in range(number):
            for variant in dice.sample(VARIANTS, len(VARIANTS)):
                stats = frame(context, case, variant)
                out.row(case=case, variant=variant, run=run, render_s=stats["time"]["render"],
                        launches=sum(s["launches"] for s in stats["stages"]))
            progress.step(f"{case}, round {run + 1}")


def ratios(rows, case, variant):
    """Of each run to the plain one beside it."""
    seconds = {(r["variant"], r["run"]): r["render_s"] for r in rows if r["case"] == case}
    return [s / seconds["plain", run] for (v, run), s in seconds.items() if v == variant]


def plot(folder):
    rows = table.read(folder / "data", "overhead")
    figure, axes = style.figure(1, len(CASES), 2.4, sharey=True)
    shown = VARIANTS[:0:-1]
    for axis, case in zip(axes, CASES):
        launches = statistics.median(r["launches"] for r in rows if r["case"] == case)
        axis.set(title=f"{case}: {style.countText(launches)} launches", xlabel="time of a frame over a plain one's")
        axis.axvline(1.0, color=style.GREY, linewidth=1)
        for y, variant in enumerate(shown):
            middle, low, high = medianInterval(ratios(rows, case, variant))
            axis.plot([low, high], [y, y], color=style.BLUE, linewidth=4, alpha=0.4, solid_capstyle="butt")
            axis.plot([middle], [y], "o", color=style.BLUE)
            axis.annotate(f"{middle:.3f} [{low:.3f}, {high:.3f}]", (middle, y), (0, 8), textcoords="offset points",
                          ha="center", fontsize=8.5)
        axis.set_ylim(-0.5, len(shown) - 0.3)
        axis.margins(x=0.25)
    axes[0].set_yticks(range(len(shown)), shown)
    style.save(figure, folder, "overhead")
