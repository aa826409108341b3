"""The record of the machine and the program that a measurement was taken with.

Written beside each table as NAME.machine.json; read again by plots that mark cache sizes or count threads.
"""
import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
# What experiments write themselves says nothing about the program that they measure.
WRITTEN = ["*.tsv", "*.machine.json", "*.svg", "*.png", "stability.md", "searches.txt"]


def output(*command):
    """Standard output of a command, stripped; empty where it is missing or fails."""
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def threadsHere():
    """Threads that this process may run on."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()


def cpu():
    """Model, cores and the data caches in bytes (one: an instance; all: of every core together)."""
    fields = {f["field"].rstrip(":"): f["data"] for f in json.loads(output("lscpu", "-J") or '{"lscpu": []}')["lscpu"]}
    text = output("lscpu", "-C=NAME,ONE-SIZE,ALL-SIZE,TYPE", "--bytes", "-J") or '{"caches": []}'
    caches = {c["name"]: {"one": int(c["one-size"]), "all": int(c["all-size"])}
              for c in json.loads(text)["caches"] if c["type"] != "Instruction"}
    return {"model": fields.get("Model name", platform.processor()), "threads": threadsHere(),
            "coresPerSocket": fields.get("Core(s) per socket"), "sockets": fields.get("Socket(s)"),
            "threadsPerCore": fields.get("Thread(s) per core"), "flags": fields.get("Flags", ""), "caches": caches}


def memoryBytes():
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def osName():
    release = pathlib.Path("/etc/os-release")
    if release.exists():
        for line in release.read_text().splitlines():
            if line.startswith("PRETTY_NAME="):
                return line.split("=", 1)[1].strip('"')
    return platform.system()


def compiler(whittle):
    """What built the program, as its build folder says."""
    cache = whittle.parent / "CMakeCache.txt"
    if not cache.exists():
        return {}
    entries = dict(line.split("=", 1) for line in cache.read_text().splitlines() if ":" in line and "=" in line)
    name = entries.get("CMAKE_CXX_COMPILER:FILEPATH") or entries.get("CMAKE_CXX_COMPILER:STRING") or "c++"
    return {"version": output(name, "--version").split("\n")[0], "build": entries.get("CMAKE_BUILD_TYPE:STRING", "")}


def changedFiles():
    """Files of the tree that differ from its last commit or are in none; None where no git can tell."""
    if not output("git", "-C", HERE, "rev-parse", "HEAD"):
        return None
    leftOut = [f":(exclude,top,glob)experiments/**/{pattern}" for pattern in WRITTEN]
    return output("git", "-C", HERE, "status", "--porcelain", "--", ":(top)", *leftOut).splitlines()


def tree():
    """The revision, "-dirty" where files are changed, and whether it was clean: true, false or null (nobody knows)."""
    changed = changedFiles()
    revision = output("git", "-C", HERE, "describe", "--always")
    return {"revision": revision + ("-dirty" if changed else ""), "cleanTree": None if changed is None else not changed,
            "changedFiles": [line.strip() for line in changed or []][:20]}


def sayWhetherClean(record_):
    """A line on standard error where a later reader could not come by the same program."""
    if record_["cleanTree"] is None:
        print("experiments/run: no git here: the records cannot name a revision", file=sys.stderr)
    elif not record_["cleanTree"]:
        files = ", ".join(line.split()[-1] for line in record_["changedFiles"][:3])
        print(f"experiments/run: the tree is not clean ({files}, ...): the records say so", file=sys.stderr)


def record(whittle, given=False):
    """Everything that a reader needs to judge or repeat a measurement. given: the program was named by hand, and may
    be of another tree than the scripts."""
    devices = json.loads(output(whittle, "devices", "--json") or '{"devices": []}')["devices"]
    return {"date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
            "whittle": output(whittle, "--version"),
            **tree(), "program": "named by --whittle" if given else "built from this tree",
            "cpu": cpu(), "memoryBytes": memoryBytes(), "os": osName(), "kernel": platform.release(),
            "compiler": compiler(whittle), "devices": devices}
