"""E8: which stage takes the time, in which scenes, at which bounce, and how near is each to the speed of memory?

Held constant: picture, all threads, the program's own choices; scenes in turn within each run, every kernel compiled
beforehand. Bytes are those of the queue planes that a launch reads and writes, as the statistics estimate them; they
are compared with what a STREAM triad moves on as many threads (host/measure/ceilings.h).
Writes e8_stages.tsv (each run; bounce 0: the whole frame, -1: outside the bounces), e8_ceilings.tsv;
figures e8_profile, e8_bounces, e8_rates.
"""
import functools

from e8_stages import figures
from lib import ceilings, measure as repeat, stages
from lib.context import ROOT, size

OWN = ["cornell_box", "mirror_box", "nested_glass", "refraction", "textured"]
SHARED = {"Sponza": "bench/crytek-sponza/crytek-sponza.glb", "coffee maker": "bench/coffee/coffee.glb",
          "kitchen": "bench/kitchen/kitchen.glb", "teapot": "bench/teapot-full/teapot-full.glb"}
COLUMNS = ["scene", "triangles", "rays", "run", "render_s", "bounce", "stage", "program", "launches", "seconds",
           "items", "bytes"]


def scenes(context):
    """{name: file}: our own, generated ones, and those beside the project that are there."""
    found = {name.replace("_", " "): ROOT / "scenes" / f"{name}.glb" for name in OWN}
    found["frame"] = context.generated("frame", "--frame")
    found["height field"] = context.heightField(context.pick(128, 512))
    for name, path in context.pick({}, SHARED).items():
        file = context.shared(path)
        if file:
            found[name] = file
        else:
            context.note(f"e8: {name} is not there and is left out")
    return found


def measure(context):
    ceilings.record(context, "e8_ceilings", sorted({1, context.threads}), context.pick(2, 7))
    out = context.table("e8_stages", COLUMNS)
    found, runs = scenes(context), context.pick(1, 5)
    progress = context.progress("e8", len(found) * runs)
    picture = context.pick(size(320, 180), size(1280, 720))
    variants = {name: functools.partial(context.render, file, *picture) for name, file in found.items()}
    for name, run, stats in repeat.interleaved(variants, runs):
        key = dict(scene=name, triangles=stats["scene"]["triangles"], rays=stats["rays"]["total"], run=run,
                   render_s=stats["time"]["render"])
        writeStages(out, {**key, "bounce": stages.WHOLE}, stages.grouped(stats["stages"]))
        for bounce, sums in stages.byBounce(stats).items():
            writeStages(out, {**key, "bounce": bounce or stages.OUTSIDE}, sums)
        progress.step(name)


def writeStages(out, key, sums):
    for stage, s in sums.items():
        out.row(**key, stage=stage, **s)


def plot(folder):
    figures.draw(folder)
