"""The machine's own ceilings, measured by machine.cpp: arithmetic and memory on N threads, and what its processors are."""
import collections
import os
import pathlib
import re
import statistics
import subprocess
import sys

SOURCE = pathlib.Path(__file__).with_suffix(".cpp")
KINDS = ("integer", "fma", "triad")


def cores():
    """Processors this process may use: hyper-threads where the machine has them (see topology)."""
    return len(os.sched_getaffinity(0))


def topology():
    """(cores, threads of each) as the kernel tells, or None where it does not. A virtual machine may tell anything."""
    siblings = set()
    for file in pathlib.Path("/sys/devices/system/cpu").glob("cpu[0-9]*/topology/thread_siblings_list"):
        siblings.add(file.read_text().strip())
    return (len(siblings), max(len(re.split("[,-]", s)) for s in siblings)) if siblings else None


def compiled(folder):
    program = pathlib.Path(folder) / "machine"
    compiler = os.environ.get("CXX", "g++")
    command = [compiler, "-std=c++20", "-O3", "-march=native", "-pthread", "-o", program, SOURCE]
    try:
        done = subprocess.run(command, capture_output=True, text=True)
    except FileNotFoundError:
        sys.exit(f"{compiler}: no such compiler; set CXX to one that knows C++20")
    if done.returncode != 0:
        sys.exit(f"{SOURCE.name}: {compiler} cannot compile it:\n{done.stderr}")
    return program


def measure(folder, threads, runs, quick):
    """Rows of (kind, threads, run, rate), thread counts in turn within each run."""
    program = compiled(folder)
    seconds, megabytes = ("0.1", "64") if quick else ("0.5", "256")  # STREAM asks for four times the last cache
    rows = []
    for run in range(runs):
        text = subprocess.run([program, ",".join(map(str, threads)), seconds, megabytes], capture_output=True, text=True,
                              check=True).stdout
        rows += [(kind, int(n), run, float(rate)) for kind, n, rate in map(str.split, text.splitlines())]
    return rows


def medians(rows):
    """{kind: {threads: median rate}} of rows with these columns, as measured or as read from a table."""
    rates = collections.defaultdict(lambda: collections.defaultdict(list))
    for kind, threads, _, rate in rows:
        rates[kind][int(threads)].append(float(rate))
    return {kind: {n: statistics.median(r) for n, r in sorted(by.items())} for kind, by in rates.items()}
