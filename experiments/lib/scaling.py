"""Two models of speed-up against threads, fitted with confidence intervals.

Amdahl 1967: S(n) = c / (1 + s (c - 1)): a share s of the work is serial.
Gunther's Universal Scalability Law (Guerrilla Capacity Planning, 2007): S(n) = c / (1 + s (c - 1) + k n (n - 1)): in addition
each pair of threads costs k.
n threads have c processors to run on: c = min(n, processors), less where the machine itself gives less (machine.py). For
n up to the number of processors of a perfect machine these are the textbook forms. Threads beyond the processors add no c
and nothing to s, but they do add pairs, so they tell k from s even where there are only two processors.
"""
import numpy

SAMPLES = 1000  # of the bootstrap


def speedUp(n, c, s, k=0.0):
    return c / (1 + s * (c - 1) + k * n * (n - 1))


def leastSquares(n, c, speed, crosstalk):
    """(s, k), neither below 0. c / S is linear in both, but weights by S² / c keep the residuals those of S."""
    n, c, speed = (numpy.asarray(v, float) for v in (n, c, speed))
    columns = [c - 1, n * (n - 1)] if crosstalk else [c - 1]
    weight = speed ** 2 / c
    matrix, right = numpy.stack(columns, 1) * weight[:, None], (c / speed - 1) * weight
    solution = numpy.linalg.lstsq(matrix, right, rcond=None)[0]
    if solution.min() < 0 and crosstalk:  # the constrained least squares lie on an edge: one term alone is the best of two
        alone = [max(0.0, float(m @ right) / float(m @ m)) for m in matrix.T]
        edges = [(alone[0], 0.0), (0.0, alone[1])]
        return min(edges, key=lambda e: float(((matrix @ numpy.array(e) - right) ** 2).sum()))
    s, k = (*numpy.maximum(solution, 0), 0.0)[:2]
    return float(s), float(k)


def fit(times, processors, crosstalk, seed=1):
    """{s, k, low, high}: of {threads: seconds of each run}, medians; 95 % intervals by drawing runs anew with replacement.
    Amdahl (crosstalk false) sees the thread counts up to the processors only."""
    counts = [n for n in sorted(times) if crosstalk or n <= processors[max(processors)] + 0.5]
    c = [processors[n] for n in counts]

    def once(draw):
        medians = {n: numpy.median(draw(times[n])) for n in {1, *counts}}
        return leastSquares(counts, c, [medians[1] / medians[n] for n in counts], crosstalk)

    random = numpy.random.default_rng(seed)
    drawn = numpy.array([once(lambda runs: random.choice(runs, len(runs))) for _ in range(SAMPLES)])
    low, high = numpy.percentile(drawn, [2.5, 97.5], axis=0)
    s, k = once(numpy.asarray)
    return {"s": s, "k": k, "s_low": low[0], "s_high": high[0], "k_low": low[1], "k_high": high[1]}


def line(x, y, seed=1):
    """(intercept, slope, low, high of the slope): least squares, residuals drawn anew for the 95 % interval."""
    x, y = numpy.asarray(x, float), numpy.asarray(y, float)
    slope, intercept = numpy.polyfit(x, y, 1)
    rest, random = y - intercept - slope * x, numpy.random.default_rng(seed)
    drawn = [numpy.polyfit(x, y - rest + random.choice(rest, len(rest)), 1)[0] for _ in range(SAMPLES)]
    low, high = numpy.percentile(drawn, [2.5, 97.5])
    return float(intercept), float(slope), float(low), float(high)
