"""Stages of a frame as the figures show them: kernels that do one job together, and the host's part of the frame.

The statistics say what a kernel's job is, which program it is in and how many items a work item takes: keys `job`,
`program` and `perWorkItem` of each entry of `stages` (host/wavefront/stages.h).
"""
import collections

# For statistics and tables of older runs alone, which have no such keys. Not to be added to.
FORMERLY = {"raygen": ("raygen", "queues"), "intersect": ("intersect", "searches"), "shade": ("shade", "shading"),
            "compact_count": ("compact", "queues"), "scan_chunks": ("compact", "queues"),
            "compact_shadow": ("compact", "queues"), "compact": ("compact", "queues"),
            "occlude": ("occlude", "searches"), "shade_light": ("shade", "shading"),
            "compact_impulse": ("compact", "queues"), "accumulate": ("accumulate", "queues"),
            "find_long_runs": ("compact", "queues"), "film": ("film", "queues")}

WHOLE, OUTSIDE = 0, -1  # in a column `bounce`: the whole frame; what belongs to no bounce
HOST = "host"           # the frame without its launches


def jobOf(kernel):
    """Of an entry of the statistics."""
    return kernel.get("job") or FORMERLY.get(kernel["name"], (kernel["name"], ""))[0]


def programOf(kernel):
    return kernel.get("program") or FORMERLY.get(kernel["name"], ("", ""))[1]


def isSearch(row):
    """Whether a row of a table (columns stage and program) is of rays through the tree."""
    return (row.get("program") or FORMERLY.get(row["stage"], ("", ""))[1]) == "searches"


def order(rows):
    """The jobs of a table from the eye to the film, and the host's part. A table has them in the order of their first
    launches, which is another where a batch ends early; a job that FORMERLY lacks stands behind the one it follows."""
    there = list(dict.fromkeys(row["stage"] for row in rows))
    found = [job for job in dict.fromkeys(job for job, _ in FORMERLY.values()) if job in there]
    for before, job in zip([None, *there], there):
        if job not in found:
            found.insert(found.index(before) + 1 if before else 0, job)
    return [*found, HOST]


def grouped(kernels):
    """{job: {program, launches, seconds, items, bytes}} of a list as the statistics have it. Items are those of the
    kernels that do the job on each entry; the parts of the compaction walk the same entries, so the most counts."""
    sums = collections.OrderedDict()
    for kernel in kernels:
        job = jobOf(kernel)
        total = sums.setdefault(job, {"program": programOf(kernel), "launches": 0, "seconds": 0.0, "items": 0,
                                      "bytes": 0})
        for key in ("launches", "seconds", "bytes"):
            total[key] += kernel.get(key, 0)
        both = max if job == "compact" else sum
        total["items"] = both((total["items"], kernel["items"]))
    return sums


def deviceSeconds(stats):
    return sum(kernel["seconds"] for kernel in stats["stages"])


def searchSeconds(stats):
    return sum(kernel["seconds"] for kernel in stats["stages"] if programOf(kernel) == "searches")


def launches(trace):
    """Kernel launches of a `--trace` file in their order: (kernel, bounce, items, seconds)."""
    events = [e for e in trace["traceEvents"] if e.get("cat") == "kernel"]
    events.sort(key=lambda e: e["ts"])
    return [(e["name"], e["args"]["bounce"], e["args"]["items"], e["dur"] * 1e-6) for e in events]


def byBounce(stats):
    """{bounce: jobs as grouped() has them}. Bounce 1: what the eye sees; 0: what belongs to none, raygen and film. The
    facts of a kernel stand in the list of the whole frame."""
    facts = {kernel["name"]: kernel for kernel in stats["stages"]}
    known = {name: {key: k[key] for key in ("job", "program") if key in k} for name, k in facts.items()}
    return {b["bounce"]: grouped([{**known.get(k["name"], {}), **k} for k in b["stages"]])
            for b in stats.get("bounces", [])}


class WorkGroups:
    """How many work-groups a launch has: its items, by how many of them a work item handles (`perWorkItem`)."""

    def __init__(self, stats):
        self.size = stats["settings"]["workGroup"]
        self.perWorkItem = {kernel["name"]: kernel["perWorkItem"] for kernel in stats["stages"]}

    def count(self, kernel, items):
        workItems = -(-items // self.perWorkItem[kernel])
        return -(-workItems // self.size)
