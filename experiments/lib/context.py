"""What an experiment is handed: how to run the program, where to write, and how much to do.

An experiment is a module NAME/NAME.py with measure(context), which writes context.table(...) row by row, and
plot(folder), which reads the tables of FOLDER and draws figures into it. It raises Skipped where it lacks something.
"""
import copy
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from lib import machine
from lib.progress import Progress
from lib.table import Table

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SCENES = ROOT / "scenes"
SHARED = ROOT.parent / "shared" / "scenes"  # scenes that nobody here wrote; not everywhere


class Skipped(Exception):
    """The experiment cannot run here; the text says what it lacks."""


class RunFailed(Exception):
    """A run of the program ended with an error; the text is its own line."""


class Context:
    """out: the folder of tables and figures; given: the program was named by hand, it need not be this tree's."""

    def __init__(self, whittle, out, quick, temporary, given=False):
        self.whittle, self.out, self.quick = pathlib.Path(whittle), pathlib.Path(out), quick
        self.folder = pathlib.Path(temporary)  # for generated scenes; removed at the end
        self.threads = machine.threadsHere()
        self.record = machine.record(self.whittle, given)
        # Without general programs, on which a scene would start: its own are what is measured.
        self.environment = dict(os.environ, POCL_CACHE_DIR=str(self.folder / "kernels"),
                                WHITTLE_CACHE_DIR=str(self.folder / "programs"))

    def inside(self, name, arguments=()):
        """The same for one experiment: OUT/NAME is its folder; arguments: those of its own."""
        own = copy.copy(self)
        own.out, own.own = self.out / name, list(arguments)
        return own

    def pick(self, quick, full):
        return quick if self.quick else full

    def table(self, name, columns):
        return Table(self.out, name, columns, self.record)

    def progress(self, name, weight):
        return Progress(name, weight)

    def json(self, command, *arguments, kernels=None):
        """What a run of the program prints as JSON; kernels: a folder of compiled kernels, not the common one."""
        line = [str(a) for a in (self.whittle, command, *arguments)]
        environment = dict(self.environment, POCL_CACHE_DIR=str(kernels)) if kernels else self.environment
        done = subprocess.run(line, env=environment, capture_output=True, text=True)
        if done.returncode != 0:
            raise RunFailed(done.stderr.strip().split("\n")[-1] or f"{command} ended with status {done.returncode}")
        return json.loads(done.stdout)

    def render(self, scene, *options):
        """Statistics of one frame, in a process of its own; no picture is written unless options ask for one."""
        return self.json("render", scene, "--quiet", "--stats", "-", *options)

    def renderCold(self, scene, *options):
        """As render, with no compiled kernels on disk."""
        with tempfile.TemporaryDirectory(dir=self.folder) as empty:
            return self.json("render", scene, "--quiet", "--stats", "-", *options, kernels=empty)

    def bench(self, scene, *options):
        """Rays per second of the searches."""
        return self.json("bench", scene, "--json", "--quiet", *options)

    def generated(self, name, *options):
        """A scene by make_scenes, once."""
        file = self.folder / f"{name}.glb"
        if not file.exists():
            maker = self.whittle.parent / "make_scenes"
            if not maker.exists():
                raise Skipped(f"there is no make_scenes beside {self.whittle}: build that target")
            done = subprocess.run([maker, *map(str, options), file], capture_output=True, text=True)
            if done.returncode != 0:
                raise RunFailed(done.stderr.strip())
        return file

    def heightField(self, squares):
        """Hills of 2 squares² triangles; always the same hills and the same part of the picture."""
        return self.generated(f"height_field_{squares}", "--heightfield", squares)

    def shared(self, path):
        """A scene of the folder beside the project, or None."""
        file = SHARED / path
        return file if file.exists() else None

    def note(self, text):
        print(text, file=sys.stderr, flush=True)


def size(width, height):
    return ["--width", width, "--height", height]
