"""E5: how does a frame speed up with threads, from one to four for each processor, and what eats the rest?

Held constant: scene, picture, bounces, wavefront, work-group; only --threads changes (PoCL's and TBB's alike), thread
counts in turn within each run, every kernel compiled beforehand. Speed-up is held against what the machine itself gives
to as many threads (host/measure/ceilings.h): a virtual processor may be half a core, and memory is shared.
The tree is built by `whittle bench`, where nothing is compiled beside it.
Writes e5_ceilings.tsv (rates), e5_frames.tsv (seconds of each run), e5_stages.tsv (by stage),
e5_launches.tsv (each launch, medians, one thread against as many as processors), e5_build.tsv; figures e5_speedup,
e5_model, e5_losses.
"""
import functools
import json
import statistics

from e5_threads import analysis, figures
from lib import ceilings, measure as repeat, stages
from lib.context import ROOT, size

# (name in the tables and figures, how to come by it); Sponza is left out where it is not there
SCENES = [("Cornell box", lambda c: ROOT / "scenes" / "cornell_box.glb"),
          ("height field", lambda c: c.heightField(c.pick(128, 512))),
          ("frame", lambda c: c.generated("frame", "--frame")),
          ("Sponza", lambda c: c.shared("bench/crytek-sponza/crytek-sponza.glb"))]


def threadCounts(processors):
    """1, 2, 3, 4, 6, 8, 12 … up to four for each processor."""
    counts = {1, processors, 2 * processors, 4 * processors}
    power = 1
    while power <= 4 * processors:
        counts |= {power, power * 3 // 2}
        power *= 2
    return sorted(n for n in counts if 1 <= n <= 4 * processors)


def measure(context):
    counts, runs = threadCounts(context.threads), context.pick(2, 5)
    ceilings.record(context, "e5_ceilings", counts, runs)
    measureFrames(context, counts, runs)
    measureBuild(context, context.pick(counts[:2], counts), context.pick(1, 3))


def scenes(context):
    for name, find in context.pick(SCENES[:3], SCENES):
        file = find(context)
        if file:
            yield name, file
        else:
            context.note(f"e5: {name} is not there and is left out")


def traced(context, file, threads):
    """Statistics of a frame with its launches."""
    trace = context.folder / "e5_trace.json"
    picture = context.pick(size(640, 360), size(1280, 720))
    stats = context.render(file, *picture, "--threads", threads, "--trace", trace)
    return stats, stages.launches(json.loads(trace.read_text()))


def measureFrames(context, counts, runs):
    frames = context.table("e5_frames", ["scene", "triangles", "width", "height", "threads", "run", "load_s",
                                         "render_s", "device_s"])
    byStage = context.table("e5_stages", ["scene", "threads", "run", "stage", "launches", "seconds"])
    launches = context.table("e5_launches", ["scene", "stage", "program", "bounce", "items", "groups",
                                             "one_thread_s", "all_processors_s"])
    progress = context.progress("e5", len(context.pick(SCENES[:3], SCENES)) * len(counts) * runs)
    for name, file in scenes(context):
        single = {1: [], context.threads: []}  # launches, run by run
        variants = {n: functools.partial(traced, context, file, n) for n in counts}
        for threads, run, (stats, records) in repeat.interleaved(variants, runs):
            s, t = stats["settings"], stats["time"]
            frames.row(scene=name, triangles=stats["scene"]["triangles"], width=s["width"], height=s["height"],
                       threads=threads, run=run, load_s=t["load"], render_s=t["render"],
                       device_s=stages.deviceSeconds(stats))
            for stage, sums in stages.grouped(stats["stages"]).items():
                byStage.row(scene=name, threads=threads, run=run, stage=stage, launches=sums["launches"],
                            seconds=sums["seconds"])
            if threads in single:
                single[threads].append(records)
            progress.step(f"{name}, {threads} threads")
        writeLaunches(launches, name, stats, single[1], single[context.threads])


def writeLaunches(out, scene, stats, one, every):
    """The same launches in every run, whatever the number of threads: medians over the runs."""
    groups, facts = stages.WorkGroups(stats), {s["name"]: s for s in stats["stages"]}
    for i, (kernel, bounce, items, _) in enumerate(one[0]):
        seconds = [statistics.median(run[i][3] for run in runs) for runs in (one, every)]
        out.row(scene=scene, stage=stages.jobOf(facts[kernel]), program=stages.programOf(facts[kernel]), bounce=bounce,
                items=items, groups=groups.count(kernel, items), one_thread_s=seconds[0], all_processors_s=seconds[1])


def measureBuild(context, counts, runs):
    out = context.table("e5_build", ["scene", "triangles", "threads", "run", "build_s"])
    for name, file in scenes(context):
        if name == "Cornell box" or (context.quick and name != "frame"):
            continue  # that box's tree takes no time
        bench = functools.partial(context.bench, file, "--rays", 1000, "--runs", 1)
        for threads, run, r in repeat.interleaved({n: functools.partial(bench, "--threads", n) for n in counts}, runs):
            out.row(scene=name, triangles=r["triangles"], threads=threads, run=run, build_s=r["build"]["seconds"])


def plot(folder):
    figures.draw(analysis.Measured(folder), folder)
