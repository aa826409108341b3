"""Figures of E8 (e8_stages.py): shares of the stages by scene and by bounce, and their rates."""
import statistics

from matplotlib.patches import Patch

from lib import ceilings, measure as repeat, stages, style, table

LOOKS = {"raygen": (style.SKY, "//"), "intersect": (style.BLUE, ""), "shade": (style.ORANGE, ".."),
         "compact": (style.BLACK, ""), "occlude": (style.GREEN, "\\\\"), "accumulate": (style.PURPLE, "xx"),
         "film": (style.YELLOW, "--"), "host": ("#dddddd", "")}
OTHER = (style.GREY, "++")  # a stage without a look of its own


def draw(folder):
    rows = table.read(folder, "e8_stages")
    profile(rows, folder)
    bounces(rows, folder)
    rates(rows, folder)


def seconds(rows, scene, bounce):
    """{stage: median seconds}"""
    picked = [r for r in rows if r["scene"] == scene and r["bounce"] == bounce]
    return {stage: statistics.median(v) for (stage,), v in repeat.grouped(picked, ["stage"], "seconds").items()}


def frame(rows, scene):
    return statistics.median(r["render_s"] for r in rows if r["scene"] == scene)


def whole(rows, scene):
    """{stage: seconds}, the host's last: the frame without its launches."""
    spent = seconds(rows, scene, stages.WHOLE)
    return {**spent, "host": max(frame(rows, scene) - sum(spent.values()), 0)}


def scenesBySearch(rows):
    """Scenes by the searches' share, the largest last (on top)."""
    searches = {r["stage"] for r in rows if stages.isSearch(r)}

    def share(scene):
        spent = whole(rows, scene)
        return sum(spent.get(s, 0) for s in searches) / sum(spent.values())
    return sorted(dict.fromkeys(r["scene"] for r in rows), key=share)


def bar(axis, y, jobs, spent, scale, least):
    """One stacked bar of these jobs; a number in each part that has room for it."""
    left, centres = 0.0, {}
    for stage in jobs:
        width = spent.get(stage, 0) * scale
        colour, hatch = LOOKS.get(stage, OTHER)
        axis.barh(y, width, left=left, height=0.72, color=colour, hatch=hatch, edgecolor="white", linewidth=0.5)
        centres[stage] = left + width / 2
        if width >= least:
            axis.text(left + width / 2, y, f"{width:.0f}", ha="center", va="center", fontsize=8,
                      bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8, "alpha": 0.85})
        left += width
    return centres


def nameParts(axis, centres, y, size=8.5):
    """The jobs' names over the bar at y, each joined with its part."""
    names = list(centres)
    axis.figure.canvas.draw()
    pixels = [axis.transData.transform((centres[s], y))[0] for s in names]
    placed = style.spread(pixels, [size * 0.9 * (len(s) + 1) * axis.figure.dpi / 100 for s in names])
    high = axis.get_window_extent().x1
    shift = max(0, pixels[0] - placed[0]) or min(0, high - placed[-1])  # the first name never starts left of its part
    for stage, x in zip(names, placed):
        to = axis.transAxes.inverted().transform((x + shift, 0))[0]
        axis.annotate(stage, xy=(centres[stage], y + 0.36), xytext=(to, 1.04), textcoords="axes fraction", ha="center",
                      fontsize=size, annotation_clip=False, arrowprops={"arrowstyle": "-", "color": style.GREY,
                                                                        "linewidth": 0.6})


def profile(rows, folder):
    scenes = scenesBySearch(rows)
    figure, axis = style.figure(height=0.42 * len(scenes) + 1.5)
    for y, scene in enumerate(scenes):
        spent = whole(rows, scene)
        total = sum(spent.values())
        centres = bar(axis, y, stages.order(rows), spent, 100 / total, 4)
        rays = next(r["rays"] for r in rows if r["scene"] == scene)
        axis.text(101, y, f"{1e3 * total:.0f} ms, {rays / total / 1e6:.1f} Mrays/s", va="center", fontsize=8.5)
    axis.set_yticks(range(len(scenes)), [label(rows, s) for s in scenes])
    axis.set_xlim(0, 122)
    axis.set_xticks(range(0, 101, 20))
    axis.spines["bottom"].set_bounds(0, 100)
    axis.set_ylim(-0.6, len(scenes) - 0.4)
    axis.grid(axis="y", visible=False)
    threads = table.readMachine(folder, "e8_stages")["cpu"]["threads"]
    axis.set_xlabel(f"share of the frame, % ({threads} threads)")
    nameParts(axis, centres, len(scenes) - 1)
    style.save(figure, folder, "e8_profile")


def label(rows, scene):
    triangles = next(r["triangles"] for r in rows if r["scene"] == scene)
    return f"{style.sceneText(scene)} ({style.countText(triangles)} triangles)"


def bounces(rows, folder):
    """Scenes whose rays go on, the deepest first."""
    deepest = {s: max(r["bounce"] for r in rows if r["scene"] == s) for s in scenesBySearch(rows)}
    scenes = [s for s in sorted(deepest, key=deepest.get, reverse=True) if deepest[s] >= 2][:6]
    if not scenes:
        return
    columns = min(2, len(scenes))
    lines = -(-len(scenes) // columns)
    threads = style.threadsText(table.readMachine(folder, "e8_stages")["cpu"]["threads"])
    figure, axes = style.figure(lines, columns, height=2.9 * lines + 0.6, squeeze=False)
    for axis in axes.flat[len(scenes):]:
        axis.set_visible(False)
    for axis, scene in zip(axes.flat, scenes):
        total = frame(rows, scene)
        widest = max(100 / total * sum(seconds(rows, scene, b).values()) for b in range(1, deepest[scene] + 1))
        for bounce in range(1, deepest[scene] + 1):
            spent = seconds(rows, scene, bounce)
            bar(axis, bounce, stages.order(rows), spent, 100 / total, 0.06 * widest)
        axis.set_yticks(range(1, deepest[scene] + 1))
        axis.set_ylim(deepest[scene] + 0.6, 0.4)
        axis.grid(axis="y", visible=False)
        axis.set(xlim=(0, 1.03 * widest), ylabel="bounce", title=f"{style.sceneText(scene)}: {1e3 * total:.0f} ms",
                 xlabel=f"share of the frame, % ({threads})")
    named = [s for s in stages.order(rows) if any(r["stage"] == s and r["bounce"] >= 1 for r in rows)]
    looks = [LOOKS.get(s, OTHER) for s in named]
    patches = [Patch(facecolor=colour, hatch=hatch, edgecolor="white", linewidth=0.5) for colour, hatch in looks]
    style.legendAbove(figure, patches, named, ncols=len(named))
    style.save(figure, folder, "e8_bounces")


def rates(rows, folder):
    entries = [r for r in rows if r["bounce"] == stages.WHOLE and r["seconds"] > 0 and r["items"] > 0]
    moved = [r for r in entries if r["bytes"] > 0]
    threads = table.readMachine(folder, "e8_stages")["cpu"]["threads"]
    figure, axes = style.figure(1, 2 if moved else 1, height=4.4, sharey=True, squeeze=False)
    dotsByStage(axes[0][0], entries, "items", 1e6)
    axes[0][0].set_xlabel("million items of the stage for each second\n"
                          f"(a dot for each scene; {style.threadsText(threads)})")
    if moved:
        axis = axes[0][1]
        dotsByStage(axis, moved, "bytes", 1e9)
        rates_ = table.read(folder, "e8_ceilings")
        triad = ceilings.medians(rates_, "triad")
        most = max(triad)
        axis.axvline(triad[most] / 1e9, color=style.GREY, linewidth=1)
        axis.text(triad[most] / 1e9, 1.01, f"triad {triad[most] / 1e9:.0f} GB/s", transform=axis.get_xaxis_transform(),
                  fontsize=8.5, color=style.GREY, ha="center")
        axis.set_xlabel(f"queue bytes moved for each second, GB/s\n(line: STREAM triad on {most} threads)")
    style.save(figure, folder, "e8_rates")


def dotsByStage(axis, rows, column, unit):
    names = stages.order(rows)[-2::-1]
    for y, stage in enumerate(names):
        by = repeat.grouped([r for r in rows if r["stage"] == stage], ["scene"],
                            lambda r: r[column] / r["seconds"] / unit)
        points = sorted((statistics.median(v), scene) for (scene,), v in by.items())
        axis.plot([p[0] for p in points], [y] * len(points), linestyle="none", marker="o", markersize=6,
                  markerfacecolor="white", markeredgecolor=style.BLUE, markeredgewidth=1.4)
        for (value, scene), up, side in ((points[0], 0.2, "left"), (points[-1], -0.38, "right"))[:len(points)]:
            number = f"{value:.3g}" if value < 1000 else f"{value:.0f}"
            axis.text(value, y + up, f"{style.sceneText(scene)} {number}", ha=side, fontsize=7.5,
                      bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.3, "alpha": 0.8})
    axis.set_xscale("log")
    axis.set_yticks(range(len(names)), names)
    axis.set_ylim(-0.6, len(names) - 0.4)
