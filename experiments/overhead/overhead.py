"""What does looking cost: how much slower is a frame with --profile or --trace than with nothing timed?

Held constant: scene, picture, all threads, one process (frame_cost.cpp), kernels on disk. Short frames take turns, many
times and each round in another order, as what is looked for is smaller than the noise of one frame: the answer is the
median of the ratios within rounds, with an interval of 95 % by resampling. Once with the program's own wavefront, once
with wavefronts so small that a frame has thousands of launches, each of which is timed and a trace records.

Writes overhead.tsv, a row for each frame; figure overhead.
"""
import statistics
import subprocess

from lib import style, table
from lib.context import SCENES, RunFailed, Skipped
from lib.measure import medianInterval

COLUMNS = ["case", "variant", "round", "render_s", "after_s", "launches"]
CASES = {"own wavefront": (640, 360, 2, 1 << 18), "wavefronts of 1024": (320, 180, 2, 1024)}
ROUNDS = 200
PLAIN = "off"
SHOWN = ["off again", "--profile", "--trace"]


def frames(context, case, rounds):
    """A row for each frame, as they come."""
    program = context.whittle.parent / "frame_cost"
    if not program.exists():
        raise Skipped(f"there is no frame_cost beside {context.whittle}: build that target")
    command = [str(a) for a in (program, SCENES / "cornell_box.glb", *CASES[case], rounds)]
    with subprocess.Popen(command, env=context.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True) as running:
        for line in running.stdout:
            variant, number, render, after, launches = line.rstrip("\n").split("\t")
            yield {"case": case, "variant": variant, "round": int(number), "render_s": float(render),
                   "after_s": float(after), "launches": int(launches)}
        problem = running.stderr.read().strip()
    if running.returncode != 0:
        raise RunFailed(problem.split("\n")[-1] or f"frame_cost ended with status {running.returncode}")


def measure(context):
    rounds = context.pick(10, ROUNDS)
    out = context.table("overhead", COLUMNS)
    progress = context.progress("overhead", len(CASES) * rounds)
    for case in CASES:
        done = 0
        for row in frames(context, case, rounds):
            out.row(**row)
            done += 1
            if done % (1 + len(SHOWN)) == 0:
                progress.step(f"{case}, round {row['round'] + 1}")


def ratios(rows, case, variant):
    """Of each frame to the plain one of its round."""
    seconds = {(r["variant"], r["round"]): r["render_s"] for r in rows if r["case"] == case}
    return [s / seconds[PLAIN, run] for (v, run), s in seconds.items() if v == variant]


def afterwards(rows, case, variant):
    """Median milliseconds that the table or the timeline takes once the frame is done."""
    return 1e3 * statistics.median(r["after_s"] for r in rows if (r["case"], r["variant"]) == (case, variant))


def plotCase(axis, rows, case):
    mine = [r for r in rows if r["case"] == case]
    frame = 1e3 * statistics.median(r["render_s"] for r in mine if r["variant"] == PLAIN)
    launches = statistics.median(r["launches"] for r in mine)
    axis.set(title=f"{case}: {frame:.0f} ms, {style.countText(launches)} launches",
             xlabel="time of a frame over one with nothing timed")
    axis.axvline(1.0, color=style.GREY, linewidth=1)
    for y, variant in enumerate(SHOWN[::-1]):
        middle, low, high = medianInterval(ratios(rows, case, variant))
        axis.plot([low, high], [y, y], color=style.BLUE, linewidth=4, alpha=0.4, solid_capstyle="butt")
        axis.plot([middle], [y], "o", color=style.BLUE)
        after = afterwards(rows, case, variant)
        text = f"{middle:.3f} [{low:.3f}, {high:.3f}]" + (f"; then {after:.2g} ms" if after > 0 else "")
        axis.annotate(text, (middle, y), (0, 8), textcoords="offset points", ha="center", fontsize=8.5,
                      bbox={"facecolor": "white", "edgecolor": "none", "pad": 1})


def plot(folder):
    rows = table.read(folder, "overhead")
    figure, axes = style.figure(1, len(CASES), 2.4, sharey=True)
    for axis, case in zip(axes, CASES):
        plotCase(axis, rows, case)
        axis.set_ylim(-0.5, len(SHOWN) - 0.3)
        axis.margins(x=0.4)
    axes[0].set_yticks(range(len(SHOWN)), SHOWN[::-1])
    style.save(figure, folder, "overhead")
