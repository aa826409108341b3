"""Figures of E9: error against time for each sampler, what cheaper rays cost, and whether the estimate is honest."""
import math

from lib import fit, style
from lib.measure import grouped, quartiles

LINES = ["random", "sobol", "random, adaptive", "sobol, adaptive"]
STRATA = "stratified"


def panels(scenes, height, **options):
    """A grid of axes, one for each scene, two in a row; those left over are taken away."""
    rows = (len(scenes) + 1) // 2
    figure, axes = style.figure(rows, 2, height * rows, squeeze=False, **options)
    for axis in axes.flat[len(scenes):]:
        axis.remove()
    return figure, dict(zip(scenes, axes.flat))


def strata(final, scene):
    """Stratified runs, one for each number of rays: seconds and RMSE over the mean, medians over the seeds."""
    chosen = [r for r in final if r["scene"] == scene and r["variant"].startswith(STRATA)]
    points = [(quartiles([r["seconds"] for r in g])[1], quartiles([r["rmse"] / r["mean"] for r in g])[1],
               g[0]["rays_per_pixel"]) for g in grouped(chosen, ["variant"], lambda r: r).values()]
    return [list(column) for column in zip(*points)] if points else [[], [], []]


def slope(rays, error):
    """Of log error against log rays, from two rays on, as text."""
    kept = [(n, e) for n, e in zip(rays, error) if n >= 2 and e > 0]
    if len(kept) < 3:
        return ""
    return f" ∝ N^{fit.shown(*fit.power(*zip(*kept))[1])}"


def drawSamplers(folder, curves, final, curveOf):
    scenes = list(dict.fromkeys(r["scene"] for r in curves))
    figure, axes = panels(scenes, 3.3)
    for scene, axis in axes.items():
        axis.set(xscale="log", yscale="log", title=scene.replace("_", " "), xlabel="seconds of rendering",
                 ylabel="RMSE over the mean")
        labels = style.EndLabels(axis)
        for i, variant in enumerate(LINES):
            seconds, error = curveOf(curves, scene, variant, "seconds", "rmse")
            rays, _ = curveOf(curves, scene, variant, "rays_per_pixel", "rmse")
            style.draw(axis, i, seconds, error)
            labels.add(seconds[-1], error[-1], variant + slope(rays, error), style.look(i)["color"])
        seconds, error, rays = strata(final, scene)
        if seconds:
            style.draw(axis, len(LINES), seconds, error)
            labels.add(seconds[-1], error[-1], STRATA + slope(rays, error), style.look(len(LINES))["color"])
        labels.place(size=7.5)
    style.save(figure, folder, "e9_samplers")


def front(points):
    """Those that no other beats in both time and error."""
    best, kept = math.inf, []
    for point in sorted(points):
        if point[1] < best:
            best = point[1]
            kept.append(point)
    return kept


def drawChoices(folder, curves, curveOf):
    scenes = [s for s in dict.fromkeys(r["scene"] for r in curves)
              if any(r["scene"] == s and r["variant"] == "one impulse" for r in curves)]
    figure, axes = panels(scenes, 3.3)
    for scene, axis in axes.items():
        axis.set(xscale="log", yscale="log", title=scene.replace("_", " "), xlabel="seconds of rendering",
                 ylabel="RMSE over the mean")
        names = [v for v in dict.fromkeys(r["variant"] for r in curves if r["scene"] == scene)
                 if v == "sobol" or v.startswith(("depth", "one", "cut"))]
        labels, points = style.EndLabels(axis), []
        for i, variant in enumerate(names):
            seconds, error = curveOf(curves, scene, variant, "seconds", "rmse")
            style.draw(axis, i, seconds, error)
            points += zip(seconds, error)
            labels.add(seconds[-1], error[-1], "all of it" if variant == "sobol" else variant, style.look(i)["color"])
        best = front(points)
        axis.plot([p[0] for p in best], [p[1] for p in best], color=style.GREY, linewidth=6, alpha=0.2,
                  drawstyle="steps-post", zorder=0)
        labels.place(size=7.5)
    style.save(figure, folder, "e9_choices")


def honest(rows, variant):
    """(estimate, true RMSE), over the mean, of each look of each run."""
    return [(r["estimate"] / r["mean"], r["rmse"] / r["mean"]) for r in rows
            if r["variant"] == variant and r["estimate"] not in ("", 0) and r["rmse"] > 0]


def drawCalibration(folder, curves):
    figure, (left, right) = style.figure(1, 2, 4.4, width_ratios=[1, 1])
    left.set(xscale="log", yscale="log", xlabel="estimated RMSE over the mean", ylabel="true RMSE over the mean",
             title="Each look of each run")
    right.set(xscale="log", xlabel="true RMSE over the estimated one", title="Their ratio: median, half, nine tenths")
    everything = [point for v in LINES for point in honest(curves, v)]
    ends = [min(map(min, everything)), max(map(max, everything))]
    left.plot(ends, ends, color=style.GREY, linewidth=1)
    for i, variant in enumerate(LINES):
        points = honest(curves, variant)
        left.plot(*zip(*points), **{**style.look(i), "linestyle": "none"}, markersize=4, markerfacecolor="none")
        ratios = sorted(true / estimated for estimated, true in points)
        low, middle, high = quartiles(ratios)
        tenth = ratios[len(ratios) // 20], ratios[-1 - len(ratios) // 20]
        row, look = len(LINES) - 1 - i, style.look(i)
        right.plot(tenth, [row, row], color=look["color"], linewidth=1.2)
        right.plot([low, high], [row, row], color=look["color"], linewidth=5, alpha=0.5)
        right.plot([middle], [row], **{**look, "linestyle": "none"}, markersize=8)
        right.annotate(f"{middle:.2f}", (middle, row), (0, 9), textcoords="offset points", ha="center", fontsize=8.5)
    right.set_yticks(range(len(LINES)), LINES[::-1])
    right.set_ylim(-0.6, len(LINES) - 0.4)
    right.axvline(1.0, color=style.GREY, linewidth=1)
    style.save(figure, folder, "e9_calibration")


def draw(folder, curves, final, curveOf):
    drawSamplers(folder, curves, final, curveOf)
    drawChoices(folder, curves, curveOf)
    drawCalibration(folder, curves)
