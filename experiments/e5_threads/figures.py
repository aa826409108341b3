"""Figures of E5 (e5_threads.py): speed-up by threads, models of it, and where the rest goes."""
import numpy

from e5_threads import analysis as e5
from lib import ceilings, dots, fit, stages, style


def draw(measured, folder):
    looks = {scene: i for i, scene in enumerate(measured.scenes)}
    speedUp(measured, looks, folder)
    models(measured, looks, folder)
    losses(measured, looks, folder)


def threadsAxis(axis, measured):
    counts, processors = measured.counts, measured.processors
    axis.set_xscale("log", base=2)
    axis.set_xticks(counts, [str(n) for n in counts])
    axis.minorticks_off()
    axis.axvline(processors, color=style.GREY, linewidth=0.8)
    axis.text(processors, 0.02, f" {processors} processors", transform=axis.get_xaxis_transform(), fontsize=8,
              color=style.GREY, ha="left")
    axis.set_xlabel("threads")


def speedUp(measured, looks, folder):
    figure, axes = style.figure(2, 2, height=8.2)
    frames(axes[0][0], measured, looks)
    efficiency(axes[0][1], measured, looks)
    byStage(axes[1][0], measured, looks)
    hostSide(axes[1][1], measured, looks)
    style.save(figure, folder, "e5_speedup")


def drawScene(axis, labels, i, text, threads, *values):
    """A line with its spread and its label; values: medians, first and third quartiles."""
    style.draw(axis, i, threads, *values)
    labels.add(threads[-1], values[0][-1], text, style.look(i)["color"])


def finish(axis, measured, labels, yLabel, title):
    axis.set_ylim(0)
    axis.set_ylabel(yLabel)
    axis.set_title(title, fontsize=10)
    threadsAxis(axis, measured)
    labels.place(size=8.5)


def frames(axis, measured, looks):
    labels = style.EndLabels(axis)
    for kind, text in (("fma", "machine: arithmetic"), ("triad", "machine: memory")):
        ceiling = measured.ceiling(kind)
        axis.plot(list(ceiling), list(ceiling.values()), color=style.GREY, linestyle=":", linewidth=1.2)
        labels.add(max(ceiling), ceiling[max(ceiling)], text, style.GREY)
    best = 0.0
    for scene, i in looks.items():
        threads, *speeds = e5.speedUps(measured.frames, "render_s", scene=scene)
        drawScene(axis, labels, i, scene, threads, *speeds)
        best = max(best, *speeds[0])
    finish(axis, measured, labels, "speed-up over one thread",
           f"Frame, {measured.picture()}: at most {best:.2f} times")


def efficiency(axis, measured, looks):
    running = measured.running()
    labels = style.EndLabels(axis)
    at = []
    for scene, i in looks.items():
        threads, *speeds = e5.speedUps(measured.frames, "render_s", scene=scene)
        share = [[100 * v / running[n] for n, v in zip(threads, values)] for values in speeds]
        drawScene(axis, labels, i, scene, threads, *share)
        at.append(share[0][threads.index(measured.processors)])
    axis.axhline(100, color=style.GREY, linestyle=":", linewidth=1.2)
    finish(axis, measured, labels, "speed-up as share of the machine's, %",
           f"{min(at):.0f} to {max(at):.0f} % of the machine's on {measured.processors} threads")


def byStage(axis, measured, looks):
    values, jobs = {}, stages.order(measured.byStage)[:-1]
    for scene in looks:
        values[scene] = {"whole frame": on(measured, measured.frames, "render_s", scene=scene)}
        for stage in jobs:
            if any(r["stage"] == stage and r["scene"] == scene for r in measured.byStage):
                values[scene][stage] = on(measured, measured.byStage, "seconds", scene=scene, stage=stage)
    rows = ["whole frame", *jobs]
    dots.draw(axis, rows, values, looks)
    marks = {"1": 1.0, "memory": measured.ceiling("triad")[measured.processors],
             "arithmetic": measured.ceiling("fma")[measured.processors]}
    for value in marks.values():
        axis.axvline(value, color=style.GREY, linestyle=":", linewidth=1.2)
    axis.set_xlim(0)
    axis.set_xlabel(f"speed-up on {measured.processors} threads\n(dotted: 1; machine's memory {marks['memory']:.2f}, "
                    f"arithmetic {marks['arithmetic']:.2f})")
    dots.names(axis, {s: v["whole frame"] for s, v in values.items()}, len(rows), looks)


def on(measured, rows, column, **chosen):
    """Speed-up on as many threads as processors."""
    threads, speed, _, _ = e5.speedUps(rows, column, **chosen)
    return speed[threads.index(measured.processors)]


def hostSide(axis, measured, looks):
    labels = style.EndLabels(axis)
    for scene, i in looks.items():
        if any(r["scene"] == scene for r in measured.build):
            drawScene(axis, labels, i, f"tree, {scene}", *e5.speedUps(measured.build, "build_s", scene=scene))
    largest = max(measured.frames, key=lambda r: r["load_s"])["scene"]
    threads, speed, low, high = e5.speedUps(measured.frames, "load_s", scene=largest)
    axis.plot(threads, speed, color=style.GREY, marker=".")
    labels.add(threads[-1], speed[-1], f"load, {largest}", style.GREY)
    finish(axis, measured, labels, "speed-up over one thread", "Before the frame: load, build the tree")


def models(measured, looks, folder):
    fits = e5.fits(measured)
    columns = min(2, len(fits))
    rows = -(-len(fits) // columns)
    figure, axes = style.figure(rows, columns, height=3.6 * rows, squeeze=False, sharey=True)
    for axis in axes.flat[len(fits):]:
        axis.set_visible(False)
    every = [model(axis, measured, scene, looks[scene], *both) for axis, (scene, both) in zip(axes.flat, fits.items())]
    style.placeAll(every, size=8.5)
    style.save(figure, folder, "e5_model")


def model(axis, measured, scene, i, amdahl, usl):
    """Beyond the machine's processors c goes on as it began: what so many of them would give. Returns the labels."""
    p, c = measured.processors, measured.running()
    n = numpy.geomspace(1, 16 * p, 200)
    more = numpy.maximum(1, 1 + (n - 1) * (c[p] - 1) / max(p - 1, 1))
    labels = style.EndLabels(axis)
    for curve, line, name in ((amdahl.curve(more), "--", "model: Amdahl"), (usl.curve((n, more)), "-.", "model: USL")):
        curve = curve / curve[0]
        axis.plot(n, curve, color=style.GREY, linestyle=line, linewidth=1.3)
        labels.add(n[-1], curve[-1], name, style.GREY)
    axis.plot(n, more, color=style.GREY, linestyle=":", linewidth=1)
    labels.add(n[-1], more[-1], "machine × n", style.GREY)
    drawScene(axis, labels, i, "measured", *e5.speedUps(measured.frames, "render_s", scene=scene))
    axis.set_yscale("log", base=2)
    axis.yaxis.set_major_formatter(lambda v, _: f"{v:g}")
    axis.set_xscale("log", base=2)
    axis.xaxis.set_major_formatter(lambda v, _: f"{v:g}")
    axis.axvspan(1, p, color="#f2f2f2", zorder=0)
    axis.set_xlabel(f"threads (shaded: this machine's {p} processors)")
    axis.set_ylabel("speed-up over one thread")
    axis.set_title(f"{scene}\nAmdahl σ = {fit.shown(*amdahl[1], 3)}\n"
                   f"USL σ = {fit.shown(*usl[1], 3)}, κ = {fit.shown(*usl[2], 4)}",
                   fontsize=9.5, fontweight="normal")
    return labels


def losses(measured, looks, folder):
    figure, (left, right) = style.figure(1, 2, height=4.6, width_ratios=[1, 1.05])
    values = {scene: share(e5.losses(measured, scene)) for scene in looks}
    rows = [text for part, text in e5.PARTS.items() if part != "ideal"]
    dots.draw(left, rows, values, looks)
    left.axvline(0, color=style.BLACK, linewidth=0.8)
    left.set_xlabel(f"share of the frame on {measured.processors} threads, %\n"
                    f"({measured.picture()}; {ceilings.siblings(measured.cpu)})")
    dots.names(left, {s: v[rows[0]] for s, v in values.items()}, len(rows), looks)
    launches(right, measured)
    style.save(figure, folder, "e5_losses")


def share(parts):
    whole = sum(parts.values())
    return {text: 100 * parts[part] / whole for part, text in e5.PARTS.items() if part != "ideal"}


def launches(axis, measured):
    """Each launch: how much faster on all processors, by how many work-groups it has."""
    kinds = {"searches": stages.isSearch, "raygen, shade": lambda r: r["stage"] in ("raygen", "shade"),
             "compact": lambda r: r["stage"] == "compact",
             "accumulate, film": lambda r: r["stage"] in ("accumulate", "film")}
    for i, (name, isOne) in enumerate(kinds.items()):
        rows = [r for r in measured.launches if isOne(r) and r["all_processors_s"] > 0]
        axis.plot([r["groups"] for r in rows], [r["one_thread_s"] / r["all_processors_s"] for r in rows], label=name,
                  **{**style.look(i), "linestyle": "none", "markersize": 4, "alpha": 0.7})
    axis.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2, frameon=False, fontsize=8.5, borderpad=0,
                handletextpad=0.2)
    axis.set_xscale("log")
    axis.set_xlabel("work-groups of a launch")
    axis.set_ylabel(f"speed-up of the launch on {measured.processors} threads")
    ratio = [r["one_thread_s"] / r["all_processors_s"] for r in measured.launches if r["all_processors_s"] > 0]
    axis.set_ylim(0, min(max(ratio), 2 * measured.processors) * 1.1)
