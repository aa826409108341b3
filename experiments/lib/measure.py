"""Interleaved repetitions of several variants, and medians with their spread.

Variants take turns (A B C A B C ...), so that a machine which slows down for a while slows all of them. Each is run
once before, not counted: kernels are then compiled and on disk, and the scene's file is in memory.
"""
import random
import statistics
import time

LONG_RUN = 20.0  # seconds; what takes longer is run once, its warm-up, as start-up no longer matters


def interleaved(variants, repetitions, longRun=LONG_RUN):
    """Yields (name, repetition, result) as they come; variants: name -> function without arguments.

    repetitions: a number, or a function of the warm-up's seconds. Of a variant whose warm-up takes longer than longRun
    seconds that one result is yielded, and no more.
    """
    wanted = {}
    for name, run in variants.items():
        start = time.monotonic()
        result = run()
        seconds = time.monotonic() - start
        wanted[name] = repetitions(seconds) if callable(repetitions) else repetitions
        if seconds > longRun:
            wanted[name] = 0
            yield name, 0, result
    for repetition in range(max(wanted.values(), default=0)):
        for name, run in variants.items():
            if repetition < wanted[name]:
                yield name, repetition, run()


def quartiles(values):
    """First quartile, median, third quartile."""
    if len(values) == 1:
        return (values[0],) * 3
    return tuple(statistics.quantiles(values, n=4, method="inclusive"))


def medianInterval(values, resamples=4000):
    """The median, and where 95 % of the medians of as many values drawn from these lie (bootstrap; Efron 1979)."""
    dice = random.Random(1)
    medians = sorted(statistics.median(dice.choices(values, k=len(values))) for _ in range(resamples))
    return statistics.median(values), medians[resamples // 40], medians[-resamples // 40]


def grouped(rows, keys, value):
    """Values of a column by the columns in keys: {(key, ...): [value, ...]}, in the order of the rows."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[k] for k in keys), []).append(value(row) if callable(value) else row[value])
    return groups


def curve(rows, x, value, **chosen):
    """Points of the rows whose columns equal `chosen`: x, medians, first and third quartiles, sorted by x."""
    picked = [r for r in rows if all(r[k] == v for k, v in chosen.items())]
    groups = sorted(grouped(picked, [x], value).items())
    spread = [quartiles(v) for _, v in groups]
    return [g[0][0] for g in groups], [s[1] for s in spread], [s[0] for s in spread], [s[2] for s in spread]
