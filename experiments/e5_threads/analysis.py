"""What E5 reads off its tables: speed-ups, the two models fitted to them, and where the rest of the time goes."""
import statistics

from lib import ceilings, fit, measure as repeat, stages, table


class Measured:
    """The tables, and what the machine gives to n threads in multiples of one thread's rate."""

    def __init__(self, folder):
        self.frames, self.byStage, self.launches, self.build, rates = (
            table.read(folder, f"e5_{name}") for name in ("frames", "stages", "launches", "build", "ceilings"))
        self.cpu = table.readMachine(folder, "e5_frames")["cpu"]
        self.processors = self.cpu["threads"]
        self.rates = {kind: ceilings.medians(rates, kind) for kind in ("integer", "fma", "triad")}
        self.counts = sorted(self.rates["fma"])
        self.scenes = list(dict.fromkeys(r["scene"] for r in self.frames))

    def ceiling(self, kind):
        return {n: rate / self.rates[kind][1] for n, rate in self.rates[kind].items()}

    def running(self):
        """c(n) for the models and the losses: arithmetic on whole vectors, as the kernels do, on as many threads as
        there are processors at most; above that c stays."""
        ceiling = self.ceiling("fma")
        return {n: ceiling[min(n, self.processors)] for n in self.counts}

    def picture(self):
        return f"{self.frames[0]['width']}×{self.frames[0]['height']}"


def speedUps(rows, column, **chosen):
    """Threads, speed-ups of medians, and of the quartiles."""
    threads, middle, low, high = repeat.curve(rows, "threads", column, **chosen)
    return threads, *([middle[0] / v for v in values] for values in (middle, high, low))


def fits(measured):
    """{scene: (Amdahl's law on up to as many threads as processors, Gunther's on all)}"""
    c = measured.running()
    result = {}
    for scene in measured.scenes:
        rows = [r for r in measured.frames if r["scene"] == scene]
        few = [r for r in rows if r["threads"] <= measured.processors]
        result[scene] = (fit.amdahl([c[r["threads"]] for r in few], [1 / r["render_s"] for r in few]),
                         fit.uslShared([r["threads"] for r in rows], [c[r["threads"]] for r in rows],
                                       [1 / r["render_s"] for r in rows]))
    return result


PARTS = {"ideal": "one thread's frame, shared evenly", "machine": "the machine's own ceiling", "host": "host, serial",
         "searches": "searches", "packing": "packing the queues", "streams": "other kernels"}


def losses(measured, scene):
    """{part: seconds} of the frame on all processors: what it would take shared evenly, and what comes on top. The
    parts sum up to the frame, but for medians of sums and sums of medians."""
    limit = measured.running()[measured.processors]
    times = repeat.grouped([r for r in measured.frames if r["scene"] == scene], ["threads"], "render_s")
    one, every = (statistics.median(times[(n,)]) for n in (1, measured.processors))
    launches = [r for r in measured.launches if r["scene"] == scene]
    device = [sum(r[column] for r in launches) for column in ("one_thread_s", "all_processors_s")]
    parts = dict.fromkeys(PARTS, 0.0)
    parts["ideal"] = one / measured.processors
    parts["machine"] = device[0] * (1 / limit - 1 / measured.processors)
    parts["host"] = (every - device[1]) - (one - device[0]) / measured.processors
    for r in launches:
        part = "searches" if stages.isSearch(r) else "packing" if r["stage"] == "compact" else "streams"
        parts[part] += r["all_processors_s"] - r["one_thread_s"] / limit
    return parts
