"""The machine's own ceilings, measured as `whittle scale` does: arithmetic and memory on N threads."""
import os
import pathlib
import subprocess

from lib import measure
from lib.context import ROOT, RunFailed, Skipped

SOURCE = pathlib.Path(__file__).with_suffix(".cpp")
HOST = ROOT / "host"
COLUMNS = ["kind", "threads", "run", "rate"]


def compiled(folder):
    program, compiler = folder / "ceilings", os.environ.get("CXX", "g++")
    command = [compiler, "-std=c++20", "-O3", "-march=native", "-pthread", "-I", HOST, "-o", program, SOURCE,
               HOST / "measure" / "ceilings.cpp"]
    try:
        done = subprocess.run(command, capture_output=True, text=True)
    except FileNotFoundError:
        raise Skipped(f"{compiler}: no such compiler; set CXX to one that knows C++20") from None
    if done.returncode != 0:
        raise RunFailed(f"{compiler} cannot compile {SOURCE.name}: {done.stderr.strip().splitlines()[-1]}")
    return program


def record(context, name, threads, runs):
    """Table `name`: rates on each of these thread counts, which take turns."""
    program = compiled(context.folder)
    # STREAM asks for arrays of four times the last cache.
    seconds, megabytes = context.pick((0.05, 64), (0.5, 256))
    table = context.table(name, COLUMNS)
    for run in range(runs):
        command = [program, ",".join(map(str, threads)), str(seconds), str(megabytes)]
        for line in subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines():
            kind, count, rate = line.split("\t")
            table.row(kind=kind, threads=int(count), run=run, rate=float(rate))


def medians(rows, kind):
    """{threads: rate}"""
    threads, rates, _, _ = measure.curve(rows, "threads", "rate", kind=kind)
    return dict(zip(threads, rates))


def siblings(cpu):
    """What the record of the machine says of its processors. A virtual machine may be told anything."""
    each = cpu.get("threadsPerCore") or "?"
    return f"{cpu['threads']} processors, {each} thread{'s' if each != '1' else ''} for each core"
