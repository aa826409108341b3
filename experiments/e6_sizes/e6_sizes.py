"""E6: what do the sizes of work-groups and wavefronts, and lanes of a search, do to each stage and to memory?

Held constant: scene, picture, bounces, all threads; one size changes in each sweep, sizes in turn within each run.
Every size of a work-group is another kernel to PoCL: each is compiled beforehand, in a run that does not count.
What a launch costs is the slope of the frame's time against its launches, in small wavefronts on one thread: work is
the same, and no thread can go without any.
Writes e6_frames.tsv and e6_stages.tsv (each run of each sweep); figures e6_work_groups, e6_wavefronts,
e6_launches.
"""
import functools

from e6_sizes import figures
from lib import measure as repeat, stages
from lib.context import ROOT, size

SCENES = [("Cornell box", lambda c: ROOT / "scenes" / "cornell_box.glb"),
          ("frame", lambda c: c.generated("frame", "--frame")),
          ("Sponza", lambda c: c.shared("bench/crytek-sponza/crytek-sponza.glb")),
          ("textured", lambda c: ROOT / "scenes" / "textured.glb")]
HOW_MANY = 3  # scenes: the first of these that are there
FRAMES = ["sweep", "scene", "size", "threads", "run", "render_s", "device_s", "launches", "queues_bytes", "rays",
          "chosen"]
STAGES = ["sweep", "scene", "size", "run", "stage", "launches", "seconds"]


def sweeps(context):
    """(name, sizes, options for a size). `default` is the program's own choice."""
    picture = context.pick(size(640, 360), [*size(1280, 720), "--rays-per-pixel", 4])
    small = size(640, 360)
    groups = context.pick([1, 64], [1, 2, 4, 8, 16, 64, 256])
    queues = context.pick([2**12, 2**16], [2**i for i in (10, 12, 14, 16, 17, 18, 19, 20, 22)])
    few = context.pick([1024, 2048, 8192], [1024, 1536, 2048, 4096, 8192])
    return [("workGroup", ["default", *groups], lambda n: [*small, "--work-group", n]),
            ("wavefront", ["default", *queues], lambda n: [*picture, "--wavefront", n]),
            ("lanes", ["default", 1, 16], lambda n: [*small, "--lanes", n]),
            ("launch", few, lambda n: [*small, "--threads", 1, "--wavefront", n])]


def options(make, chosen):
    """Those of a size; the program's own choice is no option at all."""
    asked = make(chosen)
    return asked[:-2] if chosen == "default" else asked


def measure(context):
    frames, byStage = context.table("e6_frames", FRAMES), context.table("e6_stages", STAGES)
    there = [(name, file) for name, find in SCENES if (file := find(context))][:context.pick(1, HOW_MANY)]
    runs = context.pick(2, 4)
    every = sweeps(context)
    progress = context.progress("e6", len(there) * runs * sum(len(sizes) for _, sizes, _ in every))
    for scene, file in there:
        for sweep, sizes, make in every:
            variants = {n: functools.partial(context.render, file, *options(make, n)) for n in sizes}
            for n, run, stats in repeat.interleaved(variants, runs):
                writeRun(frames, byStage, dict(sweep=sweep, scene=scene, size=n, run=run), stats)
                progress.step(f"{scene}, {sweep} {n}")


def writeRun(frames, byStage, key, stats):
    settings = stats["settings"]
    frames.row(**key, threads=stats["device"]["threads"], render_s=stats["time"]["render"],
               device_s=stages.deviceSeconds(stats), launches=sum(s["launches"] for s in stats["stages"]),
               queues_bytes=stats["memory"]["queues"], rays=stats["rays"]["total"],
               chosen=settings.get(key["sweep"], ""))
    for stage, sums in stages.grouped(stats["stages"]).items():
        byStage.row(**key, stage=stage, launches=sums["launches"], seconds=sums["seconds"])


def plot(folder):
    figures.draw(folder)
