#!/usr/bin/python3
"""What does the window cost, and how soon does it answer? `whittle view` on a display without a screen, driven by
scripts, beside `whittle render`; the two take turns. As a table, a row for each figure: what, scene, the median of the
window and of `render`, their ratio, and how many times. CPU seconds are those of the whole process, so they hardly
depend on what else the machine does; wall seconds do.

  refine           from a request to all samples: wall seconds, beside time.render of as many rays
  refine cpu       the same in CPU seconds, beside what `render` takes for as many rays (from two numbers of rays)
  first picture    from the last move of a drag to the first picture, coarse or not, wall seconds (wanted: 0.1)
  full first       from there to one sample for each pixel, beside time.render of one ray for each (wanted: 1.3)
  edit             from an edit of a lamp to its first picture, wall seconds
  frame, frame cpu one frame while nothing is rendered, wall and CPU seconds (wanted: 0.016)
  idle             of a core, while nothing happens (wanted: 0.01)

usage: experiments/run window [-- [--pairs N] [--size WxH] [SCENE.glb ...]]
needs: Xvfb; a build with a window
"""
import argparse
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPONZA = ROOT.parent / "shared/scenes/bench/crytek-sponza/crytek-sponza.glb"
TICK = os.sysconf("SC_CLK_TCK")
FRAMES = 40  # drawn for the cost of one
IDLE = 4.0   # seconds


class Display:
    """An X server of its own, without a screen."""

    def __enter__(self):
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x720x24", "-nolisten",
                                        "tcp"], pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as name:
            self.environment = dict(os.environ, DISPLAY=f":{name.readline().strip()}", LIBGL_ALWAYS_SOFTWARE="1")
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()


def cpuSeconds(process):
    """Of a process and its child: the first looks after the second, which works."""
    children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
    ticks = 0
    for pid in (process.pid, *children):
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
        ticks += int(fields[11]) + int(fields[12])
    return ticks / TICK


def view(display, whittle, scene, lines, *options):
    """Plays a script. A list for each `print`: what was printed, when, and the CPU seconds up to then."""
    with tempfile.NamedTemporaryFile("w", suffix=".script") as script:
        script.write("\n".join(lines) + "\nquit\n")
        script.flush()
        command = [str(whittle), "view", str(scene), "--script", script.name, *options]
        with subprocess.Popen(command, env=display.environment, stdout=subprocess.PIPE, text=True) as running:
            marks = [(float(line.rpartition("=")[2]), time.monotonic(), cpuSeconds(running))
                     for line in running.stdout if " = " in line]
    if running.returncode:
        sys.exit(f"window: the script ended with status {running.returncode}: {' '.join(command)}")
    return marks


def render(whittle, scene, rays, seed, size):
    """time.render, and the CPU seconds of the whole process."""
    before = os.times()
    done = subprocess.run([str(whittle), "render", str(scene), "--stats", "-", "--quiet", "--seed", str(seed),
                           "--rays-per-pixel", str(rays), *size], stdout=subprocess.PIPE, check=True)
    after = os.times()
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    return json.loads(done.stdout)["time"]["render"], cpu


class Bench:
    def __init__(self, display, options):
        self.display, self.whittle, self.pairs = display, options.whittle, options.pairs
        width, height = options.size.split("x")
        self.size = ["--width", width, "--height", height]
        print("what", "scene", "window", "render", "ratio", "times", sep="\t")

    def row(self, what, scene, window, offline=None):
        ratio = [a / b for a, b in zip(window, offline)] if offline else []
        middle = [f"{statistics.median(v):.4f}" if v else "" for v in (window, offline or [], ratio)]
        print(what, scene.stem, *middle, len(window), sep="\t", flush=True)

    def view(self, scene, lines, *options):
        return view(self.display, self.whittle, scene, lines, *self.size, *options)

    def refine(self, scene, rays):
        wall, cpu, offline, offlineCpu = [], [], [], []
        for seed in range(1, self.pairs + 1):
            marks = self.view(scene, ["wait refined", "print window.frames", f"set seed {seed}", "wait refined",
                                      "print view.refinedSeconds"], "--rays-per-pixel", str(rays), "--seed", "99")
            wall.append(marks[1][0])
            cpu.append(marks[1][2] - marks[0][2])
            one, many = (render(self.whittle, scene, n, seed, self.size) for n in (1, rays))
            offline.append(many[0])
            offlineCpu.append((many[1] - one[1]) * rays / (rays - 1))
        self.row(f"refine {rays}", scene, wall, offline)
        self.row(f"refine {rays} cpu", scene, cpu, offlineCpu)

    def firstPicture(self, scene):
        first, full, offline = [], [], []
        for seed in range(1, self.pairs + 1):
            marks = self.view(scene, ["wait refined", "drag 100 100 104 101 left", "wait refined",
                                      "print view.firstSeconds", "print view.fullSeconds"],
                              "--rays-per-pixel", "4", "--seed", str(seed))
            first.append(marks[0][0])
            full.append(marks[1][0])
            offline.append(render(self.whittle, scene, 1, seed, self.size)[0])
        self.row("first picture", scene, first)
        self.row("full first", scene, full, offline)

    def edit(self, scene):
        lines = ["wait refined"]
        for k in range(self.pairs):
            lines += [f"set light.0.intensity {k + 2}", "wait refined", "print view.firstSeconds"]
        self.row("edit", scene, [m[0] for m in self.view(scene, lines, "--rays-per-pixel", "1")])

    def frame(self, scene, window):
        lines = ["wait refined", f"resize {window.replace('x', ' ')}", "wait 1", "print window.frames"]
        for k in range(FRAMES):
            lines += ["wheel 3 3 0 window", "print window.frameSeconds"]
        marks = self.view(scene, [*lines, "print window.frames"], "--rays-per-pixel", "1")
        frames = marks[-1][0] - marks[0][0]
        self.row(f"frame {window}", scene, [m[0] for m in marks[1:-1]])
        self.row(f"frame {window} cpu", scene, [(marks[-1][2] - marks[0][2]) / frames])

    def idle(self, scene):
        command = [str(self.whittle), "view", str(scene), "--rays-per-pixel", "1", *self.size]
        with subprocess.Popen(command, env=self.display.environment, stderr=subprocess.DEVNULL) as running:
            time.sleep(IDLE + 4)
            before = cpuSeconds(running)
            time.sleep(IDLE)
            self.row("idle", scene, [(cpuSeconds(running) - before) / IDLE])
            running.terminate()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--whittle", type=pathlib.Path, default=ROOT / "build/release/whittle")
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("--size", default="640x360", metavar="WxH")
    parser.add_argument("--rays", type=int, action="append", help="for each pixel; may be repeated [16, 64]")
    parser.add_argument("--only", help="refine, first, edit, frame or idle")
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    if not shutil.which("Xvfb"):
        sys.exit("window: there is no Xvfb")
    scenes = options.scenes or [ROOT / "scenes/cornell_box.glb", *([SPONZA] if SPONZA.exists() else [])]

    def wanted(what):
        return options.only in (None, what)

    with Display() as display:
        bench = Bench(display, options)
        for scene in scenes:
            render(bench.whittle, scene, 1, 0, bench.size)  # compiles
            for rays in (options.rays or [16, 64]) if wanted("refine") else []:
                bench.refine(scene, rays)
            if wanted("first"):
                bench.firstPicture(scene)
            if wanted("edit"):
                bench.edit(scene)
        for window in ("640x360", "1280x720") if wanted("frame") else []:
            bench.frame(scenes[0], window)
        if wanted("idle"):
            bench.idle(scenes[0])


if __name__ == "__main__":
    main()
