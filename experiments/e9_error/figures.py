"""Figures of E9: error against time for each sampler and measure, slopes, what cheaper rays cost, which setting is
first when, and whether the estimate is honest."""
import math

from lib import dots, style, table
from e9_error.analysis import SAMPLERS, curve, over
from lib.measure import grouped, quartiles

BIASED = ("depth", "cut-off")
SAMPLER_NAMES = {v: v.replace("sobol", "Sobol") for v in SAMPLERS}
MEASURES = {"rmse": "RMSE over the mean", "relMse": "relMSE", "flip": "FLIP"}
THEORY = (-0.5, -0.75)  # independent samples; one in each stratum, at edges


def threadsOf(folder):
    return style.threadsText(table.readMachine(folder, "e9_curves")["cpu"]["threads"])


def panels(scenes, height, threads, **options):
    """A grid of axes, one for each scene, two in a row; those left over are taken away."""
    rows = (len(scenes) + 1) // 2
    figure, axes = style.figure(rows, 2, height * rows, squeeze=False, **options)
    for axis in axes.flat[len(scenes):]:
        axis.remove()
    for scene, axis in zip(scenes, axes.flat):
        axis.set(xscale="log", yscale="log", title=style.sceneText(scene), xlabel=f"seconds of rendering ({threads})",
                 ylabel="RMSE over the mean")
        style.plainLog(axis.xaxis, (1, 3))
    return figure, dict(zip(scenes, axes.flat))


def legendBelow(axis, entries, columns=4):
    """Each name once, under the label of the axis."""
    unique = {label: handle for handle, label in zip(*entries) if label}
    down = -0.6 / axis.figure.get_figheight()  # 0.6 inches for numbers and label
    axis.legend(unique.values(), unique.keys(), loc="upper center", bbox_to_anchor=(0.5, down), ncol=columns,
                frameon=False, fontsize=8.5)


def slope(data, scene, variant, measure="rmse"):
    for r in data["slopes"]:
        if (r["scene"], r["variant"], r["measure"]) == (scene, variant, measure):
            return r["slope"], r["half"]
    return None


def drawSamplers(folder, data):
    figure, axes = panels(data["scenes"], 3.3, threadsOf(folder))
    every = [style.EndLabels(axis) for axis in axes.values()]
    for (scene, axis), labels in zip(axes.items(), every):
        for i, variant in enumerate(SAMPLERS):
            _, seconds, error = zip(*curve(data, scene, variant))
            style.draw(axis, i, seconds, error)
            labels.add(seconds[-1], error[-1], SAMPLER_NAMES[variant], style.look(i)["color"])
    style.placeAll(every, size=8)
    style.save(figure, folder, "e9_samplers")


def spread(data, scene, variant, value):
    """Least and most over the seeds of each number of rays: where runs of 1, 4, 16, ... rays end."""
    chosen = [r for r in data["final"] if (r["scene"], r["variant"]) == (scene, variant)]
    groups = grouped(chosen, ["asked"], lambda r: (r["seconds"], over(r, value)))
    points = [groups[key] for key in sorted(groups)]
    middle = [tuple(quartiles(list(column))[1] for column in zip(*g)) for g in points]
    return [m[0] for m in middle], [m[1] for m in middle], [min(v for _, v in g) for g in points], \
        [max(v for _, v in g) for g in points]


def drawMeasures(folder, data):
    """RMSE, relMSE and FLIP of whole pictures over their seconds."""
    scenes = data["scenes"][:4]
    figure, axes = style.figure(len(MEASURES), len(scenes), 7.6, squeeze=False, sharex="col")
    names = ["random", "stratified", "sobol"]
    for row, (value, text) in zip(axes, MEASURES.items()):
        for scene, axis in zip(scenes, row):
            axis.set(xscale="log", yscale="log", title=style.sceneText(scene) if value == "rmse" else "",
                     xlabel="seconds" if value == "flip" else "", ylabel=text if scene == scenes[0] else "")
            for variant in names:
                i = SAMPLERS.index(variant)
                seconds, middle, low, high = spread(data, scene, variant, value)
                style.draw(axis, i, seconds, middle, low, high, label=SAMPLER_NAMES[variant])
            style.plainLog(axis.xaxis, (1, 3))
            if value != "relMse":  # which spans decades
                style.plainLog(axis.yaxis, (1, 3))
            axis.tick_params(labelsize=8)
    axes[0][0].legend(frameon=False, fontsize=8, loc="lower left")
    style.save(figure, folder, "e9_measures")


def drawSlopes(folder, data):
    """A row for each sampler, a dot with its interval for each scene, lines where theory has them. Adaptive pictures
    have no FLIP."""
    figure, axes = style.figure(1, 2, 4.1, sharey=True)
    for axis, value in zip(axes, ("rmse", "flip")):
        for i, scene in enumerate(data["scenes"]):
            for row, variant in enumerate(reversed(SAMPLERS)):
                found = slope(data, scene, variant, value)
                if found is None:
                    continue
                at = row + 0.3 - 0.6 * i / max(len(data["scenes"]) - 1, 1)
                axis.plot([found[0] - min(found[1], 1), found[0] + min(found[1], 1)], [at, at], linewidth=1,
                          color=style.look(i)["color"])
                axis.plot(found[0], at, markersize=5.5, markerfacecolor="white", label=style.sceneText(scene),
                          **{**style.look(i), "linestyle": "none"})
        for at in THEORY:
            axis.axvline(at, color=style.GREY, linewidth=1, linestyle=(0, (4, 3)), zorder=0)
            axis.annotate(f"N^{at:g}", (at, 1), xycoords=("data", "axes fraction"), xytext=(0, 3), fontsize=8,
                          textcoords="offset points", ha="center", color=style.GREY)
        axis.set(xlabel=f"exponent of {MEASURES[value]}", ylim=(-0.5, len(SAMPLERS) - 0.5))
        axis.set_yticks(range(len(SAMPLERS)), [SAMPLER_NAMES[v] for v in SAMPLERS[::-1]])
        axis.set_xlim(-1.5, -0.1)
    for row, variant in enumerate(reversed(SAMPLERS)):
        if all(slope(data, scene, variant, "flip") is None for scene in data["scenes"]):
            axes[1].text(-0.8, row, "not measured", ha="center", va="center", fontsize=8.5, color=style.GREY,
                         bbox={"facecolor": "white", "edgecolor": "none"})
    named = dict(zip(*reversed(axes[0].get_legend_handles_labels())))
    style.legendAbove(figure, named.values(), named.keys(), ncols=len(named))
    style.save(figure, folder, "e9_slopes")


def drawChoices(folder, data):
    names = dict.fromkeys(r["variant"] for r in data["looks"] if r["variant"].startswith((*BIASED, "one")))
    scenes = [s for s in data["scenes"] if curve(data, s, "one impulse")]
    figure, axes = panels(scenes, 3.3, threadsOf(folder))
    every = [style.EndLabels(axis) for axis in axes.values()]
    for (scene, axis), labels in zip(axes.items(), every):
        for i, variant in enumerate(["sobol", *names]):
            points = curve(data, scene, variant)
            if not points:
                continue
            _, seconds, error = zip(*points)
            style.draw(axis, i, seconds, error)
            labels.add(seconds[-1], error[-1], "all of it" if variant == "sobol" else variant, style.look(i)["color"])
        best = [r for r in data["pareto"] if r["scene"] == scene]
        axis.plot([r["seconds"] for r in best], [r["rmse"] for r in best], color=style.GREY, linewidth=6, alpha=0.2,
                  drawstyle="steps-post", zorder=0)
    figure.supxlabel("grey band: the least error that any setting, adaptive ones too, has by that time", fontsize=9)
    style.placeAll(every, size=8)
    style.save(figure, folder, "e9_choices")


def isThere(row):
    """Whether an error is one; of a floor, whether it is told from 0 (with one seed nothing is known of that)."""
    fitted = row["cause"].startswith(BIASED)
    return row["rmse"] > (row["half"] if fitted and math.isfinite(row["half"]) else 0)


def drawFloors(folder, data):
    """What each choice leaves wrong whatever the rays, beside what 64 rays leave and what arithmetic does. Fitted
    floors within their own interval of 0 are none."""
    causes = list(dict.fromkeys(r["cause"] for r in data["floors"]))
    causes.sort(key=lambda c: -max(r["rmse"] for r in data["floors"] if r["cause"] == c))
    figure, axis = style.figure(1, 1, 0.55 * len(causes) + 1.3)
    looks = {scene: i for i, scene in enumerate(data["scenes"])}
    values = {scene: {r["cause"]: r["rmse"] for r in data["floors"]
                      if r["scene"] == scene and isThere(r)}
              for scene in data["scenes"]}
    dots.draw(axis, causes, values, looks)
    axis.set(xscale="log", xlabel="RMSE over the mean")
    for scene, i in looks.items():
        axis.plot([], [], markerfacecolor="white", label=style.sceneText(scene),
                  **{**style.look(i), "linestyle": "none"})
    legendBelow(axis, axis.get_legend_handles_labels())
    style.save(figure, folder, "e9_floors")


def segments(rows, end):
    """Neighbours on the Pareto front of one variant, as [variant, from, to]: first until another has less error."""
    found = []
    for row, following in zip(rows, [*rows[1:], {"seconds": end}]):
        if found and found[-1][0] == row["variant"]:
            found[-1][2] = following["seconds"]
        else:
            found.append([row["variant"], row["seconds"], following["seconds"]])
    return found


# What a segment looks like: colour, hatch, colour of its name. Biased settings share a look; their names stand in them.
SEGMENTS = {"random": (style.BLUE, "", "white"), "stratified": (style.RED, "//", "black"),
            "sobol": (style.GREEN, "\\\\", "black"), "random, adaptive": (style.PURPLE, "xx", "black"),
            "sobol, adaptive": (style.BLACK, "", "white"), "one impulse": (style.ORANGE, "..", "black"),
            "relaxed": (style.SKY, "--", "black")}
OTHERS = ("#cccccc", "", "black")


def drawSegment(axis, row, variant, start, end, decade):
    """One setting's time as the first; named where there is room. decade: its width in points."""
    colour, hatch, ink = SEGMENTS.get(variant, OTHERS)
    axis.barh(row, end - start, left=start, height=0.6, color=colour, hatch=hatch, edgecolor="white", linewidth=1,
              label=SAMPLER_NAMES.get(variant, variant) if variant in SEGMENTS else "biased: depth, cut-off")
    name = SAMPLER_NAMES.get(variant, variant)
    if decade * math.log10(end / start) > 4.1 * len(name) + 4:
        axis.text(math.sqrt(start * end), row, name, ha="center", va="center", fontsize=7.5, color=ink,
                  bbox={"facecolor": colour, "edgecolor": "none", "pad": 0.6} if hatch else None)


def drawPareto(folder, data):
    """Which setting has the least error by which time: a bar for each scene."""
    figure, axis = style.figure(1, 1, 0.55 * len(data["scenes"]) + 1.6)
    low, high = (f(r["seconds"] for r in data["pareto"]) for f in (min, max))
    low, high = 0.9 * low, 1.5 * high
    axis.set(xscale="log", xlim=(low, high),
             xlabel=f"seconds of rendering, {threadsOf(folder)} (below: RMSE over the mean)")
    for row, scene in enumerate(reversed(data["scenes"])):
        rows = [r for r in data["pareto"] if r["scene"] == scene]
        for variant, start, end in segments(rows, rows[-1]["seconds"] * 1.3):
            drawSegment(axis, row, variant, start, end, 560 / math.log10(high / low))
        for r in rows[:: max(len(rows) // 4, 1)]:
            axis.annotate(f"{r['rmse']:.1g}", (r["seconds"], row - 0.3), (0, -1), textcoords="offset points",
                          fontsize=7, va="top", color=style.GREY)
    axis.set_yticks(range(len(data["scenes"])), [style.sceneText(s) for s in reversed(data["scenes"])])
    axis.set_ylim(-0.75, len(data["scenes"]) - 0.6)
    style.plainLog(axis.xaxis)
    legendBelow(axis, axis.get_legend_handles_labels())
    style.save(figure, folder, "e9_pareto")


def honest(rows):
    """(estimate, true RMSE), over the mean, of each look of each run."""
    return [(over(r, "estimate"), over(r, "rmse")) for r in rows if r["estimate"] not in ("", 0) and r["rmse"] > 0]


def drawRatios(axis, data, names):
    """Nine tenths, half and median of all looks by sampler; the medians of the scenes as small dots below."""
    for i, variant in enumerate(names):
        row, look = len(names) - 1 - i, style.look(SAMPLERS.index(variant))
        found = {r["scene"]: r for r in data["calibration"] if r["variant"] == variant}
        everything = found.pop("all")
        axis.plot([everything["p5"], everything["p95"]], [row, row], color=look["color"], linewidth=1.2)
        axis.plot([everything["low"], everything["high"]], [row, row], color=look["color"], linewidth=5, alpha=0.5)
        axis.plot([everything["median"]], [row], **{**look, "linestyle": "none"}, markersize=8)
        axis.annotate(f"{everything['median']:.2f}", (everything["median"], row), (0, 9), textcoords="offset points",
                      ha="center", fontsize=8.5)
        for scene, r in found.items():
            axis.plot(r["median"], row - 0.3, markersize=4, markerfacecolor="white",
                      **{**style.look(data["scenes"].index(scene)), "linestyle": "none", "color": style.GREY},
                      label=style.sceneText(scene) if i == 0 else "")
    axis.set_yticks(range(len(names)), [SAMPLER_NAMES[v] for v in names[::-1]])
    axis.set_ylim(-0.6, len(names) - 0.4)
    axis.axvline(1.0, color=style.GREY, linewidth=1)


def drawCalibration(folder, data):
    names = [v for v in SAMPLERS if v != "stratified"]
    figure, (left, right) = style.figure(1, 2, 4.6, width_ratios=[1, 1])
    left.set(xscale="log", yscale="log", xlabel="estimated RMSE over the mean", ylabel="true RMSE over the mean",
             title="Each look of each run")
    right.set(xscale="log", xlabel="true RMSE over the estimated one", title="Median, half, 9/10; below: scenes")
    chosen = {v: honest([r for r in data["looks"] if r["variant"] == v]) for v in names}
    ends = [f(f(p) for points in chosen.values() for p in points) for f in (min, max)]
    left.plot(ends, ends, color=style.GREY, linewidth=1)
    # Uniform ones last, small, on top of the adaptive ones.
    for variant, points in sorted(chosen.items(), key=lambda of: "adaptive" not in of[0]):
        adaptive = "adaptive" in variant
        look = {**style.look(SAMPLERS.index(variant)), "linestyle": "none"}
        left.plot(*zip(*points), **look, markersize=5 if adaptive else 2.2, label=SAMPLER_NAMES[variant],
                  **({"markerfacecolor": "none", "alpha": 0.6} if adaptive else {}))
    left.legend(loc="upper left", frameon=False, fontsize=8.5, handletextpad=0.2)
    drawRatios(right, data, names)
    style.plainLog(right.xaxis)
    legendBelow(right, right.get_legend_handles_labels(), 3)
    style.save(figure, folder, "e9_calibration")


def draw(folder, data):
    for each in (drawSamplers, drawMeasures, drawSlopes, drawChoices, drawFloors, drawPareto, drawCalibration):
        each(folder, data)
