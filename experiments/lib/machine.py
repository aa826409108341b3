"""The record of the machine and the program that a measurement was taken with.

Written beside each table as NAME.machine.json; read again by plots that mark cache sizes or count threads.
"""
import datetime
import json
import os
import pathlib
import platform
import subprocess


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


def record(whittle):
    """Everything that a reader needs to judge or repeat a measurement."""
    devices = json.loads(output(whittle, "devices", "--json") or '{"devices": []}')["devices"]
    return {"date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
            "whittle": output(whittle, "--version"),
            "revision": output("git", "-C", str(pathlib.Path(__file__).parent), "describe", "--always", "--dirty"),
            "cpu": cpu(), "memoryBytes": memoryBytes(), "os": osName(), "kernel": platform.release(),
            "compiler": compiler(whittle), "devices": devices}
