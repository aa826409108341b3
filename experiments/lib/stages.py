"""Stages of a frame as the figures show them: kernels that do one job together, and the host's part of the frame."""
import collections
import pathlib
import re

# Kernels as `--stats` and `--trace` name them; a kernel that is not listed is a stage of its own.
KERNELS = {"raygen": ["raygen"], "intersect": ["intersect"], "shade": ["shade", "shade_light"],
           "compact": ["compact_count", "scan_chunks", "compact_shadow", "compact_impulse", "find_long_runs"],
           "occlude": ["occlude"], "accumulate": ["accumulate"], "film": ["film"]}
STAGE_OF = {kernel: stage for stage, kernels in KERNELS.items() for kernel in kernels}
ORDER = [*KERNELS, "host"]
SEARCHES = ("intersect", "occlude")


def stageOf(kernel):
    return STAGE_OF.get(kernel, kernel)


def grouped(stages):
    """{stage: {launches, seconds, items, bytes}} of a list as the statistics have it. Items are those of the kernels
    that do the stage's work on each entry; the parts of the compaction walk the same entries, so the most counts."""
    sums = collections.OrderedDict()
    for kernel in stages:
        total = sums.setdefault(stageOf(kernel["name"]), {"launches": 0, "seconds": 0.0, "items": 0, "bytes": 0})
        for key in ("launches", "seconds", "bytes"):
            total[key] += kernel.get(key, 0)
        both = max if stageOf(kernel["name"]) == "compact" else sum
        total["items"] = both((total["items"], kernel["items"]))
    return sums


def deviceSeconds(stats):
    return sum(stage["seconds"] for stage in stats["stages"])


def launches(trace):
    """Kernel launches of a `--trace` file in their order: (kernel, bounce, items, seconds)."""
    events = [e for e in trace["traceEvents"] if e.get("cat") == "kernel"]
    events.sort(key=lambda e: e["ts"])
    return [(e["name"], e["args"]["bounce"], e["args"]["items"], e["dur"] * 1e-6) for e in events]


def byBounce(stats):
    """{bounce: stages as grouped() has them}. Bounce 1: what the eye sees; 0: what belongs to none, raygen and film."""
    return {b["bounce"]: grouped(b["stages"]) for b in stats.get("bounces", [])}


class WorkGroups:
    """How many work-groups a launch has: its items, by how many of them a work item handles."""

    def __init__(self, root, stats):
        text = (pathlib.Path(root) / "kernels" / "shared" / "features.h").read_text()
        number = {name: int(value) for name, value in re.findall(r"#define (\w+) (\d+)", text)}
        packets = "packets of sixteen rays" in stats["features"]["used"]
        lane, packet = (number["ENTRY_LANES"], number["PACKET_RAYS"]) if packets else (1, 1)
        chunk = number["COMPACT_CHUNK"]
        self.size = stats["settings"]["workGroup"]
        self.perWorkItem = {"intersect": packet, "occlude": packet, "raygen": lane, "shade": lane, "shade_light": lane,
                            "film": lane, "compact_count": chunk, "compact_shadow": chunk, "compact_impulse": chunk}

    def count(self, kernel, items):
        workItems = -(-items // self.perWorkItem.get(kernel, 1))
        return -(-workItems // self.size)
