"""E9: how does the error of a picture fall with the time spent on it, and which settings get there first?

Held constant: picture (96×54), device, all threads; kernels are compiled beforehand, so that seconds are rendering
alone (compiling is in E11). Varied: rays for each pixel with each sampler, adaptive or not; relaxed arithmetic; depth,
cut-off and one impulse for two. The truth is a picture of 64 times the rays with another seed, Sobol points, full depth
and strict arithmetic; the runs measure themselves against it with --reference as they go, and say what they estimate.
What single precision alone costs is the difference from `whittle reference` with the very same samples.

Writes e9_curves.tsv (a row for each look of each run), e9_final.tsv (each run's picture by `whittle compare`: RMSE,
relMSE, FLIP), e9_precision.tsv (against double precision), and what analysis.py finds in them: e9_slopes.tsv,
e9_floors.tsv, e9_pareto.tsv, e9_calibration.tsv; figures e9_samplers, e9_measures, e9_slopes, e9_choices, e9_pareto,
e9_floors, e9_calibration.
"""
import json
import subprocess

from e9_error import analysis, figures
from lib.context import SCENES, RunFailed, size

BOUNCES = 8
# Scenes and their depth; nested glass branches too much for more.
SUBJECTS = {"cornell_box": BOUNCES, "anti_aliasing": BOUNCES, "textured": BOUNCES, "mirror_box": BOUNCES, "shadow": 1,
            "nested_glass": 6}
QUICK_SUBJECTS = ("cornell_box", "anti_aliasing")
SOBOL = ["--sampler", "sobol"]
SAMPLERS = {"random": [], "sobol": SOBOL, "random, adaptive": ["--adaptive"],
            "sobol, adaptive": [*SOBOL, "--adaptive"]}
CURVES = ["scene", "variant", "asked", "seed", "rays_per_pixel", "seconds", "estimate", "rmse", "mean"]
FINAL = ["scene", "variant", "asked", "seed", "rays_per_pixel", "seconds", "rays", "rmse", "relMse", "flip", "mean"]
PATTERNS = ("random", "sobol", "stratified")  # their pictures are compared, too, for relMSE and FLIP
PRECISION = ["scene", "arithmetic", "seed", "rays_per_pixel", "rmse", "maxAbs", "differingPixels", "mean"]
PRECISION_RAYS = 4


def choices(context, depth):
    """What makes a ray cheaper and the picture wrong, or a ray's worth more: name -> options."""
    found = {"relaxed": ["--relaxed-arithmetic"]}
    found |= {f"depth {d}": ["--bounces", d] for d in context.pick((2,), (1, 2, 4)) if d < depth}
    if depth > 1:
        found |= {"one impulse": ["--impulses", "one"]}
        found |= {f"cut-off {t}": ["--cutoff", t] for t in context.pick((), (0.01, 0.1))}
    return {name: [*SOBOL, *options] for name, options in found.items()}


def variants(context, scene):
    """(name, rays for each pixel) -> options. Runs of few rays are there for the measures that need a picture, and
    for strata, which have to know their number beforehand."""
    most, fewer = context.pick(64, 128), 64
    found = {(name, most): options for name, options in SAMPLERS.items()}
    found |= {(name, n): SAMPLERS[name] for name in ("random", "sobol") for n in context.pick((4, 16), (1, 4, 16))}
    found |= {("stratified", n): ["--sampler", "stratified"] for n in (4, 16, 64)}
    if context.quick and scene != QUICK_SUBJECTS[0]:  # each choice is a program more to compile
        return found
    return found | {(name, fewer): options for name, options in choices(context, SUBJECTS[scene]).items()}


def picture(context):
    return context.pick(size(48, 27), size(96, 54))


def truth(context, scene, depth):
    """The converged picture, and its mean radiance."""
    file = context.folder / f"e9_{scene}.exr"
    rays = context.pick(4096, 8192)
    stats = context.render(SCENES / f"{scene}.glb", *picture(context), "--bounces", depth, *SOBOL, "--seed", 1000,
                           "--rays-per-pixel", rays, "-o", file)
    return file, stats["meanRadiance"]


def compared(context, one, two):
    done = subprocess.run([context.whittle, "compare", one, two, "--json"], capture_output=True, text=True)
    if done.returncode != 0:
        raise RunFailed(done.stderr.strip())
    return json.loads(done.stdout)


def common(context, scene, options, rays, seed):
    """Arguments that every picture of a scene shares."""
    depth = [] if "--bounces" in options else ["--bounces", SUBJECTS[scene]]
    return [SCENES / f"{scene}.glb", *picture(context), *depth, *options, "--rays-per-pixel", rays, "--seed", seed]


def measureRun(context, key, options, reference, mean, tables):
    scene, variant, rays, seed = key
    curves, final = tables
    file = context.folder / "e9_run.exr"
    output = ["-o", file] if variant in PATTERNS else []
    stats = context.render(*common(context, scene, options, rays, seed), "--reference", reference, *output)
    names = dict(scene=scene, variant=variant, asked=rays, seed=seed)
    for look in stats["error"]:
        curves.row(**names, rays_per_pixel=look["raysPerPixel"], seconds=look["seconds"],
                   estimate=look["estimate"] or "", rmse=look["rmse"], mean=mean)
    if variant not in PATTERNS:
        return
    found = compared(context, file, reference)
    final.row(**names, rays_per_pixel=stats["samples"]["mean"], seconds=stats["time"]["render"],
              rays=stats["rays"]["total"], mean=mean, **{k: found[k] for k in ("rmse", "relMse", "flip")})


def measurePrecision(context, scene, seeds, mean, precision):
    """The same samples in double precision and in both single ones: what arithmetic alone does to a picture."""
    double, single = (context.folder / f"e9_{name}.exr" for name in ("double", "single"))
    for seed in seeds:
        line = common(context, scene, SOBOL, PRECISION_RAYS, seed)
        context.json("reference", *line, "--quiet", "--stats", "-", "-o", double)
        for arithmetic, option in (("strict", []), ("relaxed", ["--relaxed-arithmetic"])):
            context.render(*line, *option, "-o", single)
            found = compared(context, single, double)
            precision.row(scene=scene, arithmetic=arithmetic, seed=seed, rays_per_pixel=PRECISION_RAYS, mean=mean,
                          **{k: found[k] for k in ("rmse", "maxAbs", "differingPixels")})


def measure(context):
    tables = context.table("e9_curves", CURVES), context.table("e9_final", FINAL)
    precision = context.table("e9_precision", PRECISION)
    # What is left out is wrong by about the same with any seed; fewer do.
    seeds, fewer = context.pick((2, 1), (5, 3))
    names = context.pick(QUICK_SUBJECTS, tuple(SUBJECTS))
    todo = {scene: variants(context, scene) for scene in names}
    runs = {scene: [(seed, key) for seed in range(1, seeds + 1) for key in settings
                    if seed <= fewer or key[0] in SAMPLERS or key[0] in PATTERNS] for scene, settings in todo.items()}
    progress = context.progress("e9", sum(map(len, runs.values())))
    for scene, settings in todo.items():
        reference, mean = truth(context, scene, SUBJECTS[scene])
        # Options that share programs are in the table once for each number of rays.
        for options in {tuple(map(str, o)): o for o in settings.values()}.values():  # compiled, and on disk
            context.render(*common(context, scene, options, 4, 0), *size(16, 9))
        for seed, (variant, rays) in runs[scene]:
            measureRun(context, (scene, variant, rays, seed), settings[variant, rays], reference, mean, tables)
            progress.step(f"{scene}, {variant}, {rays} rays, seed {seed}")
        measurePrecision(context, scene, context.pick([1], [1, 2, 3]), mean, precision)


def plot(folder):
    figures.draw(folder, analysis.analyse(folder))
