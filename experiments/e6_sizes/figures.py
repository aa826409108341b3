"""Figures of E6 (e6_sizes.py): times by work-group and wavefront, memory of queues, cost of a launch, lanes."""
import math
import statistics

import numpy

from lib import dots, fit, measure as repeat, stages, style, table

SHARE = 0.03  # stages below this share of the frame are not drawn: their times are too short to say anything


def draw(folder):
    frames, byStage = (table.read(folder, f"e6_{name}") for name in ("frames", "stages"))
    threads = table.readMachine(folder, "e6_frames")["cpu"]["threads"]
    scenes = list(dict.fromkeys(r["scene"] for r in frames))
    sweep(frames, byStage, scenes, "workGroup", f"work items of a group ({threads} threads)", folder, "e6_work_groups")
    sweep(frames, byStage, scenes, "wavefront", f"rays of a wavefront ({threads} threads)", folder, "e6_wavefronts")
    launchesAndLanes(frames, scenes, folder)


def sizeText(n):
    """65536 -> "64 k"; the sizes are powers of two."""
    return style.bytesText(n).replace("iB", "").replace("K", "k").replace(" B", "")


def median(rows, column, **chosen):
    values = [r[column] for r in rows if all(r[k] == v for k, v in chosen.items())]
    return statistics.median(values) if values else None


def curves(frames, byStage, scene, name):
    """{stage or "whole frame": ([sizes], [times of the default's time])}; stages that take a share worth drawing. The
    default is a point too, at the size that it stands for."""
    key = dict(sweep=name, scene=scene)
    usual = median(frames, "chosen", **key, size="default")
    sizes = sorted({r["size"] for r in frames if r["sweep"] == name and r["size"] != "default"} | {usual})

    def ratios(rows, column, **which):
        default = median(rows, column, **key, **which, size="default")
        times = [median(rows, column, **key, **which, size=n) for n in sizes]
        return sizes, [1.0 if n == usual else time / default for n, time in zip(sizes, times)]

    frame = median(frames, "render_s", **key, size="default")
    drawn = [s for s in stages.order(byStage)[:-1]
             if (median(byStage, "seconds", **key, stage=s, size="default") or 0) >= SHARE * frame]
    return {"whole frame": ratios(frames, "render_s"), **{s: ratios(byStage, "seconds", stage=s) for s in drawn}}


def sweep(frames, byStage, scenes, name, label, folder, file):
    memory = name == "wavefront"
    figure, axes = style.figure(len(scenes) + memory, 1, height=3.0 * (len(scenes) + memory * 0.75), squeeze=False)
    every = []
    for axis, scene in zip(axes.flat, scenes):
        every.append(timesOfDefault(axis, curves(frames, byStage, scene, name)))
        usual = median(frames, "chosen", sweep=name, scene=scene, size="default")
        axis.axvline(usual, color=style.GREY, linewidth=0.9)
        axis.text(usual, 1.0, f" default {sizeText(usual)}", transform=axis.get_xaxis_transform(), fontsize=8,
                  color=style.GREY, va="top")
        ms = 1e3 * median(frames, "render_s", sweep=name, scene=scene, size="default")
        axis.set_title(f"{scene}: {ms:.0f} ms a frame with the default", fontsize=10)
    if memory:
        every.append(queueMemory(axes[-1][0], frames, scenes))
    sizes = sorted({r["size"] for r in frames if r["sweep"] == name and r["size"] != "default"})
    for axis, labels in zip(axes.flat, every):
        axis.set_xscale("log", base=2)
        axis.set_xticks(sizes, [sizeText(n) for n in sizes])
        axis.minorticks_off()
        axis.set_xlim(axes[0][0].get_xlim())  # the memory of the default is not drawn, its time is
    axes[-1][0].set_xlabel(label)
    style.placeAll(every, size=8.5)
    style.save(figure, folder, file)


def roomyTicks(low, high, least=0.065):
    """Of these, the more important first, as many as have `least` of a logarithmic axis between them."""
    kept = []
    for tick in (1, 2, 0.5, 5, 0.2, 10, 20, 50, 3, 1.5, 1.2, 0.8, 0.7, 0.9, 1.1):
        if low <= tick <= high and all(abs(math.log(tick / k)) >= least * math.log(high / low) for k in kept):
            kept.append(tick)
    return sorted(kept)


def timesOfDefault(axis, lines):
    """Lines with their best size filled black; returns the labels."""
    labels = style.EndLabels(axis)
    for i, (stage, (sizes, ratios)) in enumerate(lines.items()):
        width = 2.6 if stage == "whole frame" else 1.4
        style.draw(axis, i, sizes, ratios, linewidth=width)
        best = int(numpy.argmin(ratios))
        axis.plot(sizes[best], ratios[best], marker="*", color=style.look(i)["color"], markersize=13,
                  markeredgecolor="white", zorder=4)
        labels.add(sizes[-1], ratios[-1], f"{stage}: best {ratios[best]:.2f}", style.look(i)["color"])
    axis.axhline(1, color=style.GREY, linestyle=":", linewidth=1)
    axis.set_yscale("log")
    axis.margins(y=0.15)
    ticks = roomyTicks(*axis.get_ylim())
    axis.set_yticks(ticks, [f"{t:g}" for t in ticks])
    axis.minorticks_off()
    axis.set_ylabel("time, of the default's\n(★: best size)")
    return labels


def queueMemory(axis, frames, scenes):
    labels = style.EndLabels(axis)
    for i, scene in enumerate(scenes):
        rows = [r for r in frames if r["sweep"] == "wavefront" and r["scene"] == scene and r["size"] != "default"]
        sizes, values, _, _ = repeat.curve(rows, "size", "queues_bytes")
        style.draw(axis, i, sizes, [v / 2**20 for v in values])
        labels.add(sizes[-1], values[-1] / 2**20, scene, style.look(i)["color"])
    axis.set_yscale("log")
    if max(values) < 1000 * min(values):
        style.plainLog(axis.yaxis)
    axis.set_ylabel("memory of queues, MiB")
    return labels


def launchesAndLanes(frames, scenes, folder):
    figure, (left, right) = style.figure(1, 2, height=4.6, width_ratios=[1.3, 1])
    costOfLaunch(left, frames, scenes)
    lanes(right, frames, scenes)
    style.save(figure, folder, "e6_launches")


def costOfLaunch(axis, frames, scenes):
    """Time above that of the fewest launches, so that scenes share an axis; fits of frame and of kernels alone."""
    labels = style.EndLabels(axis)
    for i, scene in enumerate(scenes):
        rows = [r for r in frames if r["sweep"] == "launch" and r["scene"] == scene]
        counts, wall, low, high = repeat.curve(rows, "launches", "render_s")
        device = repeat.curve(rows, "launches", "device_s")[1]
        both = fit.linear(counts, wall), fit.linear(counts, device)
        base = both[0].values[0]
        x = numpy.linspace(0, max(counts), 2)
        axis.plot(x, 1e3 * (both[0].curve(x) - base), color=style.look(i)["color"], linewidth=1)
        style.draw(axis, i, counts, *([1e3 * (v - base) for v in values] for values in (wall, low, high)),
                   linestyle="none")
        inside = max(both[1].values[1], 0)
        slope = fit.shown(1e6 * both[0].values[1], 1e6 * both[0].half[1], 0)
        labels.add(counts[-1], 1e3 * (wall[-1] - base), f"{scene}\n{slope} µs a launch\n"
                   f"({1e6 * inside:.0f} µs within the kernel)", style.look(i)["color"])
    axis.set_xlabel("launches of a frame (640×360, 1 thread)")
    axis.set_ylabel("time of a frame less the fit's at 0 launches, ms")
    labels.place(size=8)


def lanes(axis, frames, scenes):
    looks = {scene: i for i, scene in enumerate(scenes)}
    usual = {s: median(frames, "render_s", sweep="lanes", scene=s, size="default") for s in scenes}
    sizes = sorted({r["size"] for r in frames if r["sweep"] == "lanes" and r["size"] != "default"})
    rows = [f"{n} ray{'s' if n > 1 else ''}" for n in sizes]
    values = {s: {row: median(frames, "render_s", sweep="lanes", scene=s, size=n) / usual[s]
                  for row, n in zip(rows, sizes)}
              for s in scenes}
    dots.draw(axis, rows, values, looks, spread=0.07)
    axis.axvline(1, color=style.GREY, linestyle=":", linewidth=1)
    axis.set_xlim(0, 1.1 * max(v for of in values.values() for v in of.values()))
    axis.set_xlabel("frame, of the default's time,\nwith so many rays for each work item")
    dots.names(axis, {s: v[rows[0]] for s, v in values.items()}, len(rows), looks, spread=0.07)
