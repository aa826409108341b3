"""E9: how does the error of a picture fall with the time spent on it, and which settings get there first?

Held constant: picture (128×72), device, all threads; kernels are compiled beforehand, so that seconds are rendering
alone (compiling is in E11). Varied: rays for each pixel with each sampler, adaptive or not; depth, cut-off and one impulse
for two, whose error has a floor that no rays remove. The truth is a picture of 64 times the rays with another seed, Sobol
points and full depth; the runs measure themselves against it with --reference as they go, and say what they estimate.

Writes e9_curves.tsv (a row for each look of each run), e9_final.tsv (each run's picture by `whittle compare`: RMSE,
relMSE, FLIP); figures e9_samplers, e9_choices, e9_calibration.
"""
import json
import subprocess

from lib import measure as repeat
from lib import table
from lib.context import SCENES, RunFailed, size

BOUNCES = 8
# Scenes and their depth; nested glass branches too much for more.
SUBJECTS = {"cornell_box": BOUNCES, "anti_aliasing": BOUNCES, "refraction": BOUNCES, "textured": BOUNCES,
            "mirror_box": BOUNCES, "shadow": 1, "nested_glass": 6}
SAMPLERS = {"random": [], "sobol": ["--sampler", "sobol"], "random, adaptive": ["--adaptive"],
            "sobol, adaptive": ["--sampler", "sobol", "--adaptive"]}
CURVES = ["scene", "variant", "seed", "rays_per_pixel", "seconds", "estimate", "rmse", "mean"]
FINAL = ["scene", "variant", "seed", "rays_per_pixel", "seconds", "rays", "rmse", "relMse", "flip", "mean"]


def choices(depth):
    """What makes a ray cheaper and the picture wrong, or a ray's worth more: name -> options."""
    found = {f"depth {d}": ["--bounces", d] for d in (1, 2, 4) if d < depth}
    if depth > 1:
        found |= {"one impulse": ["--impulses", "one"], "cut-off 0.01": ["--cutoff", "0.01"],
                  "cut-off 0.1": ["--cutoff", "0.1"]}
    return {name: ["--sampler", "sobol", *options] for name, options in found.items()}


def variants(context, depth):
    most = context.pick(16, 64)
    plain = {name: [*options, "--rays-per-pixel", most] for name, options in SAMPLERS.items()}
    # Strata need to know their number beforehand: a run for each.
    strata = {f"stratified {n}": ["--sampler", "stratified", "--rays-per-pixel", n]
              for n in (4, 16, 64) if n <= most}
    return plain | strata | {name: [*o, "--rays-per-pixel", most] for name, o in choices(depth).items()}


def picture(context):
    return context.pick(size(64, 36), size(128, 72))


def truth(context, scene, depth):
    """The converged picture, and its mean radiance."""
    file = context.folder / f"e9_{scene}.exr"
    rays = context.pick(1024, 4096)
    stats = context.render(SCENES / f"{scene}.glb", *picture(context), "--bounces", depth, "--sampler", "sobol", "--seed",
                           1000, "--rays-per-pixel", rays, "-o", file)
    return file, stats["meanRadiance"]


def compared(context, one, two):
    done = subprocess.run([context.whittle, "compare", one, two, "--json"], capture_output=True, text=True)
    if done.returncode != 0:
        raise RunFailed(done.stderr.strip())
    return json.loads(done.stdout)


def measureRun(context, key, options, reference, mean, curves, final):
    scene, variant, seed = key
    file = context.folder / "e9_run.exr"
    depth = [] if "--bounces" in options else ["--bounces", SUBJECTS[scene]]
    stats = context.render(SCENES / f"{scene}.glb", *picture(context), *depth, *options, "--seed", seed, "--reference",
                           reference, "-o", file)
    names = dict(scene=scene, variant=variant, seed=seed)
    for look in stats["error"]:
        curves.row(**names, rays_per_pixel=look["raysPerPixel"], seconds=look["seconds"],
                   estimate=look["estimate"] or "", rmse=look["rmse"], mean=mean)
    found = compared(context, file, reference)
    final.row(**names, rays_per_pixel=stats["samples"]["mean"], seconds=stats["time"]["render"],
              rays=stats["rays"]["total"], mean=mean, **{k: found[k] for k in ("rmse", "relMse", "flip")})


def measure(context):
    curves, final = context.table("e9_curves", CURVES), context.table("e9_final", FINAL)
    seeds = range(1, context.pick(2, 6))
    subjects = dict(list(SUBJECTS.items())[:context.pick(3, None)])
    todo = {scene: variants(context, depth) for scene, depth in subjects.items()}
    progress = context.progress("e9", sum(map(len, todo.values())) * len(seeds))
    for scene, settings in todo.items():
        reference, mean = truth(context, scene, SUBJECTS[scene])
        for options in settings.values():  # compiled, and on disk
            context.render(SCENES / f"{scene}.glb", *size(16, 9), *options[:-1], 2 if "stratified" not in options else 4)
        for seed in seeds:
            for variant, options in settings.items():
                measureRun(context, (scene, variant, seed), options, reference, mean, curves, final)
                progress.step(f"{scene}, {variant}, seed {seed}")


def curveOf(rows, scene, variant, x, value):
    """Medians over the seeds, in the order of rays; relative to the picture's mean."""
    chosen = [r for r in rows if r["scene"] == scene and r["variant"] == variant and r[value] != ""]
    groups = repeat.grouped(chosen, ["look"], lambda r: (r[x], r[value] / r["mean"]))
    points = [tuple(repeat.quartiles(list(column))[1] for column in zip(*group)) for group in groups.values()]
    return [p[0] for p in points], [p[1] for p in points]


def withLooks(rows):
    """The number of each row among the looks of its run: seeds are compared look by look."""
    counts = {}
    for row in rows:
        key = (row["scene"], row["variant"], row["seed"])
        counts[key] = row["look"] = counts.get(key, -1) + 1
    return rows


def plot(folder):
    from lib import e9_figures
    data = folder / "data"
    e9_figures.draw(folder, withLooks(table.read(data, "e9_curves")), table.read(data, "e9_final"), curveOf)
