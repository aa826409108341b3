"""Runs each renderer on a scene, and tells the time that it says its rays took from the rest of its process.

Every run gives {"render_s", "process_s", "rays"}; rays counts eye and impulse rays, and is empty where a renderer
counts none.
- Whittle: time.render of its statistics, from the first launch to the finished film.
- POV-Ray: its "Trace Time".
- Cycles: "Rendered N samples in ... seconds", the path tracing alone, without synchronising, its BVH or denoising.
"""
import pathlib
import re
import shutil
import subprocess
import time

from lib.context import RunFailed
from peers import cycles, povray

TRACE_TIME = re.compile(rb"Trace Time:.*\(([0-9.]+) seconds\)")
POVRAY_RAYS = re.compile(rb"^Rays: +([0-9]+)", re.MULTILINE)
SAMPLES_TIME = re.compile(rb"path_trace.*Rendered [0-9]+ samples in ([0-9.e+-]+) seconds")


def missing():
    """Names of the peers that are not installed."""
    return [name for name in ("povray", "blender") if not shutil.which(name)]


def timed(command, environment=None):
    """Output (both streams) and seconds of a process; its own last line where it fails."""
    start = time.monotonic()
    done = subprocess.run(list(map(str, command)), env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    seconds = time.monotonic() - start
    if done.returncode != 0:
        last = (done.stdout.decode(errors="replace").strip().split("\n") or [""])[-1]
        raise RunFailed(f"{command[0]} ended with status {done.returncode}: {last}")
    return done.stdout, seconds


def found(pattern, output, tool):
    matches = pattern.findall(output)
    if not matches:
        raise RunFailed(f"{tool} did not say what was looked for ({pattern.pattern.decode()}); another version?")
    return float(matches[-1])


def wrote(out, tool):
    if not pathlib.Path(out).exists():
        raise RunFailed(f"{tool} wrote no {pathlib.Path(out).name}")


def whittle(context, file, out, job, *options):
    start = time.monotonic()
    stats = context.render(file, "-o", out, "--width", job["width"], "--height", job["height"], "--bounces",
                           job["bounces"], "--threads", job["threads"], *options)
    return {"process_s": time.monotonic() - start, "render_s": stats["time"]["render"],
            "rays": stats["rays"]["primary"] + stats["rays"]["impulse"]}


def povRay(file, out, job):
    pathlib.Path(out).unlink(missing_ok=True)
    output, seconds = timed(povray.command(file, out, job["width"], job["height"], job["threads"], job["bounces"]))
    wrote(out, "povray")
    return {"process_s": seconds, "render_s": found(TRACE_TIME, output, "povray"),
            "rays": int(found(POVRAY_RAYS, output, "povray"))}


def cyclesOf(file, out, job, samples):
    pathlib.Path(out).unlink(missing_ok=True)
    options = (job["width"], job["height"], job["threads"], job["bounces"], samples)
    output, seconds = timed(cycles.command(file, out, *options))
    wrote(out, "blender")
    return {"process_s": seconds, "render_s": found(SAMPLES_TIME, output, "blender"), "rays": ""}
