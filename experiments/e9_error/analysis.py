"""What E9 reads off its runs: slopes, floors, Pareto fronts and how honest the estimate is.

Errors are over the mean radiance of the picture, so that scenes can be put side by side; intervals are Student's over
the seeds, which are independent, where the looks of one run are not.
"""
import math

from lib import fit, table
from lib.measure import grouped, quartiles

SAMPLERS = ["random", "stratified", "sobol", "random, adaptive", "sobol, adaptive"]
ADAPTIVE_FROM = 16  # rays for each pixel; before that adaptive sampling is as any other
FEWEST = 4          # from here on slopes are fitted: one ray is the pixel's centre, two are hardly a pattern


def longest(rows):
    """Of each variant the runs with the most rays: shorter ones repeat their beginning, seed for seed."""
    most = {}
    for r in rows:
        key = (r["scene"], r["variant"])
        most[key] = max(most.get(key, 0), r["asked"])
    return [r for r in rows if r["asked"] == most[r["scene"], r["variant"]]]


def looks(curves):
    """The rows of the longest runs, but of strata, which are worth something at their end alone; each with its number
    among the looks of its run, so that seeds can be compared look by look."""
    kept, counts = [r for r in longest(curves) if r["variant"] != "stratified"], {}
    for r in kept:
        key = (r["scene"], r["variant"], r["seed"])
        counts[key] = r["look"] = counts.get(key, -1) + 1
    return kept


def medians(rows, value):
    """Points (rays, seconds, value over the mean) of one scene and variant: medians over the seeds of each look, or of
    each number of rays where the rows are whole runs."""
    groups = grouped(rows, ["look" if "look" in rows[0] else "asked"],
                     lambda r: (r["rays_per_pixel"], r["seconds"], over(r, value))) if rows else {}
    return [tuple(quartiles(list(column))[1] for column in zip(*groups[key])) for key in sorted(groups)]


def over(row, value):
    """Relative; relMSE and FLIP are so already."""
    return row[value] / row["mean"] if value in ("rmse", "estimate") else row[value]


def curve(data, scene, variant, value="rmse"):
    """medians of a variant: by looks, or by runs where a picture was needed or strata."""
    source = "final" if variant == "stratified" or value in ("relMse", "flip") else "looks"
    return medians([r for r in data[source] if r["scene"] == scene and r["variant"] == variant], value)


def slopeOf(rows, value, least):
    """Mean over the seeds of the slope of log error against log rays, its half-width, the fewest points of a seed."""
    found, points = [], []
    for group in grouped(rows, ["seed"], lambda r: (r["rays_per_pixel"], r[value])).values():
        kept = [(n, e) for n, e in group if n >= least and e > 0]
        if len(kept) >= 3:
            found.append(float(fit.power(*zip(*kept)).values[1]))
            points.append(len(kept))
    return (*fit.across(found), min(points)) if found else None


def slopes(data):
    """RMSE by looks; relMSE and FLIP, which need pictures, by runs of 4, 16, 64 and more rays."""
    rows = []
    for scene in data["scenes"]:
        for variant in [*SAMPLERS, "one impulse"]:
            for value in ("rmse", "relMse", "flip"):
                source = "looks" if value == "rmse" and variant != "stratified" else "final"
                chosen = [r for r in data[source] if r["scene"] == scene and r["variant"] == variant]
                found = slopeOf(chosen, value, ADAPTIVE_FROM if "adaptive" in variant else FEWEST)
                if found:
                    rows.append(dict(scene=scene, variant=variant, measure=value, slope=found[0], half=found[1],
                                     points=found[2]))
    return rows


def floors(data):
    """RMSE over the mean that stays whatever the rays, beside that of 64 rays and of arithmetic itself."""
    rows = []
    powers = {r["scene"]: -2 * r["slope"] for r in data["slopes"] if (r["variant"], r["measure"]) == ("sobol", "rmse")}
    biased = [v for v in dict.fromkeys(r["variant"] for r in data["looks"]) if v.startswith(("depth", "cut-off"))]
    for scene in data["scenes"]:
        for arithmetic in ("strict", "relaxed"):
            values = [over(r, "rmse") for r in data["precision"]
                      if (r["scene"], r["arithmetic"]) == (scene, arithmetic)]
            if values:  # measured last: an interrupted run may lack them
                rows.append(dict(scene=scene, cause=f"{arithmetic} single precision", rmse=quartiles(values)[1],
                                 half=(max(values) - min(values)) / 2))
        sixtyFour = [over(r, "rmse") for r in data["looks"] if r["scene"] == scene and r["variant"] == "sobol"
                     and r["rays_per_pixel"] == 64]
        value, half = fit.across(sixtyFour)
        rows.append(dict(scene=scene, cause="64 Sobol rays", rmse=value, half=half))
        for variant in biased:
            chosen = [r for r in data["looks"] if (r["scene"], r["variant"]) == (scene, variant)]
            seeds = grouped([r for r in chosen if r["rays_per_pixel"] >= FEWEST], ["seed"],
                            lambda r: (r["rays_per_pixel"], over(r, "rmse")**2)).values()
            if seeds:
                value, half = fit.across([fit.floor(*zip(*points), powers[scene])[0] for points in seeds])
                rows.append(dict(scene=scene, cause=variant, rmse=value, half=half))
    return rows


def paretoFront(points, key, gain=0.95):
    """Those that no other beats in both time and error; less than a twentieth off the error is noise and no gain."""
    best, kept = math.inf, []
    for point in sorted(points, key=key):
        if key(point)[1] < best * gain:
            best = key(point)[1]
            kept.append(point)
    return kept


def paretoFronts(data):
    """All variants together, scene by scene: what has the least error by each time."""
    rows = []
    for scene in data["scenes"]:
        names = dict.fromkeys(r["variant"] for r in data["looks"] if r["scene"] == scene)
        found = [dict(scene=scene, seconds=seconds, rmse=error, variant=variant, rays_per_pixel=rays)
                 for variant in [*names, "stratified"]
                 for rays, seconds, error in curve(data, scene, variant)]
        rows += paretoFront(found, lambda p: (p["seconds"], p["rmse"]))
    return rows


def ratios(rows):
    """True RMSE over the estimated one, sorted."""
    return sorted(r["rmse"] / r["estimate"] for r in rows if r["estimate"] not in ("", 0) and r["rmse"] > 0)


def calibration(data):
    """Quantiles of true over estimated error, by sampler; a scene called `all` holds every look of all scenes."""
    rows = []
    for variant in (v for v in SAMPLERS if v != "stratified"):
        for scene in ["all", *data["scenes"]]:
            found = ratios([r for r in data["looks"] if r["variant"] == variant and scene in ("all", r["scene"])])
            if found:
                low, middle, high = quartiles(found)
                tail = len(found) // 20
                rows.append(dict(variant=variant, scene=scene, looks=len(found), p5=found[tail], low=low,
                                 median=middle, high=high, p95=found[-1 - tail]))
    return rows


def write(folder, name, rows):
    out = table.Table(folder, name, rows[0], table.readMachine(folder, "e9_curves"))
    for row in rows:
        out.row(**row)


def analyse(folder):
    """Everything that the figures draw; the tables are written on the way."""
    curves, final = table.read(folder, "e9_curves"), table.read(folder, "e9_final")
    data = dict(looks=looks(curves), final=final, precision=table.read(folder, "e9_precision", mayBeEmpty=True),
                scenes=list(dict.fromkeys(r["scene"] for r in curves)))
    for name, find in (("slopes", slopes), ("floors", floors), ("pareto", paretoFronts), ("calibration", calibration)):
        data[name] = find(data)
        write(folder, f"e9_{name}", data[name])
    return data
