"""Is anything slower than before: whole processes, opening scenes, frames, rays, beside an older revision?

`experiments/run speed -- REVISION` builds that revision in a worktree of its own (kept in build/speed, so that the next
run need not), or takes the program that is named; without one, the commit before this tree's. Both programs take
turns, each with a folder of compiled kernels of its own. Held constant: scenes (those of this tree), machine, pictures'
sizes. The answer for each row is the median of the ratios within turns, with an interval of 95 % by resampling, of the
time that passed and of the processors' time, which other work on the machine disturbs less.

Writes speed.tsv, a row for each run; figure speed.
"""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time

from lib import style, table
from lib.context import ROOT, SCENES, RunFailed, size
from lib.measure import grouped, interleaved, medianInterval

COLUMNS = ["kind", "what", "program", "turn", "seconds", "cpu_s", "faults"]
NEW, OLD = "new", "old"
NOTABLE = 1.05          # ratios whose interval lies above are said aloud

WHOLE = [("cornell_box", SCENES / "cornell_box.glb", ()), ("textured", SCENES / "textured.glb", ()),
         ("Sponza", "bench/crytek-sponza/crytek-sponza.glb", size(640, 400)),
         ("kitchen", "bench/kitchen/kitchen.glb", size(1280, 720)),
         ("FlightHelmet", "gltf/FlightHelmet/glTF-bevy-downscaled/FlightHelmet.gltf", size(640, 400))]
FRAMES = ["cornell_box", "mirror_box", "nested_glass", "textured"]
COLD = ["cornell_box", "textured"]
BENCHED = ["height_field"]


def run(program, kernels, arguments):
    """Seconds that passed, processors' seconds, page faults, standard output of one run."""
    environment = dict(os.environ, POCL_CACHE_DIR=str(kernels), WHITTLE_CACHE_DIR=str(pathlib.Path(kernels) / "programs"))
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        start = time.monotonic()
        running = subprocess.Popen([str(a) for a in (program, *arguments)], env=environment, stdout=out, stderr=err)
        _, status, used = os.wait4(running.pid, 0)
        seconds = time.monotonic() - start
        running.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        err.seek(0)
        if running.returncode != 0:
            raise RunFailed(err.read().decode().strip().split("\n")[-1] or f"{program} ended with {running.returncode}")
        return seconds, used.ru_utime + used.ru_stime, used.ru_minflt, out.read().decode()


def git(*arguments):
    done = subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise RunFailed(f"git {arguments[0]}: {done.stderr.strip().splitlines()[-1]}")
    return done.stdout.strip()


def built(revision, note):
    """The program of a revision."""
    commit = git("rev-parse", "--verify", f"{revision}^{{commit}}")
    kept = ROOT / "build" / "speed" / commit
    if (kept / "whittle").exists():
        return kept / "whittle"
    note(f"speed: building {revision} ({commit[:10]}), once")
    with tempfile.TemporaryDirectory(prefix="whittle-speed-") as folder:
        tree = pathlib.Path(folder) / "tree"
        git("worktree", "add", "--detach", str(tree), commit)
        try:
            for line in (["cmake", "--preset", "release", "-DWHITTLE_BUILD_TESTS=OFF"],
                         ["cmake", "--build", "build/release", "--target", "whittle"]):
                done = subprocess.run(line, cwd=tree, capture_output=True, text=True)
                if done.returncode != 0:
                    raise RunFailed(f"{revision} cannot be built: {(done.stderr or done.stdout).strip()[-300:]}")
            kept.mkdir(parents=True, exist_ok=True)
            for file in (*(tree / "build" / "release").glob("*.so"), tree / "build" / "release" / "whittle"):
                shutil.copy2(file, kept)  # the program last: where it is, all of it is
        finally:
            git("worktree", "remove", "--force", str(tree))
    return kept / "whittle"


def older(context):
    """The program to compare with, and what it is called."""
    if len(context.own) > 1:
        raise RunFailed("speed takes one revision or one program")
    asked = context.own[0] if context.own else "HEAD~1"
    file = pathlib.Path(asked)
    if file.is_file() and os.access(file, os.X_OK):
        return file.resolve(), asked
    return built(asked, context.note), asked


class Turns:
    """Runs both programs in turns, and writes a row for each run."""

    def __init__(self, context, programs):
        self.context, self.programs = context, programs
        self.kernels = {name: context.folder / f"kernels-{name}" for name in programs}
        self.out = context.table("speed", COLUMNS)

    def take(self, kind, what, turns, arguments, value=None, cold=False):
        """value: seconds out of the standard output, in the place of the whole run's; cold: no compiled kernels."""
        def once(name):
            def go():
                if not cold:
                    return run(self.programs[name], self.kernels[name], arguments)
                with tempfile.TemporaryDirectory(dir=self.context.folder) as empty:
                    return run(self.programs[name], empty, arguments)
            return go
        variants = {name: once(name) for name in self.programs}
        for name, turn, (seconds, cpu, faults, said) in interleaved(variants, turns, longRun=1e9):
            self.out.row(kind=kind, what=what, program=name, turn=turn, seconds=value(said) if value else seconds,
                         cpu_s="" if value else cpu, faults="" if value else faults)


def scenesHere(context, scenes):
    for name, file, options in scenes:
        found = file if isinstance(file, pathlib.Path) else context.shared(file)
        if found:
            yield name, found, options
        else:
            context.note(f"speed: without {name}, which is not here")


def renderSeconds(said):
    return json.loads(said)["time"]["render"]


def raySeconds(said):
    """Seconds for a million rays of every kind and search."""
    return sum(1 / row["mraysPerSecond"] for row in json.loads(said)["rows"])


def measure(context):
    program, name = older(context)
    context.record["olderProgram"] = name
    turns = Turns(context, {OLD: program, NEW: context.whittle})
    picture = context.folder / "picture.png"
    small = size(32, 18) if context.quick else ()
    whole = list(scenesHere(context, context.pick(WHOLE[:1], WHOLE)))
    frames, cold, benched = context.pick((FRAMES[:1], [], []), (FRAMES, COLD, BENCHED))
    progress = context.progress("speed", 2 + len(whole) + len(frames) + len(cold) + len(benched) + (not context.quick))
    many = context.pick(3, 9)
    for what, arguments in (("start", ["--version"]), ("start with the driver", ["devices"])):
        turns.take("floor", what, many, arguments)
        progress.step(what)
    for what, file, options in whole:
        turns.take("whole process", what, many, ["render", file, "--quiet", "-o", picture, *(small or options)])
        progress.step(what)
    if not context.quick:
        turns.take("whole process", "2 M triangles", many,
                   ["render", context.heightField(1000), "--quiet", "-o", picture, *size(640, 400)])
        progress.step("2 M triangles")
    for what in frames:
        turns.take("frame", what, many, ["render", SCENES / f"{what}.glb", "--quiet", "--stats", "-", *small],
                   value=renderSeconds)
        progress.step(f"frame of {what}")
    for what in cold:
        turns.take("nothing compiled", what, 3, ["render", SCENES / f"{what}.glb", "--quiet", "-o", picture], cold=True)
        progress.step(f"{what}, nothing compiled")
    for what in benched:
        turns.take("rays", what, 5, ["bench", SCENES / f"{what}.glb", "--json", "--quiet", "--runs", 1],
                   value=raySeconds)
        progress.step(f"rays in {what}")
    for line in slower(table.read(context.out, "speed")):
        context.note(line)


def ratios(rows, column):
    """{(kind, what): ratios of new to old within turns}, of rows that have the column."""
    found = {}
    for key, mine in grouped(rows, ["kind", "what"], lambda r: r).items():
        by = {(r["program"], r["turn"]): r[column] for r in mine if r[column] != ""}
        pairs = [by[NEW, t] / by[OLD, t] for p, t in by if p == NEW and by.get((OLD, t), 0) > 0]
        if pairs:
            found[key] = pairs
    return found


def slower(rows):
    """A line for each row that takes more time, or more of the processors, than before."""
    for column, words in (("seconds", "time"), ("cpu_s", "processors' time")):
        for (kind, what), pairs in ratios(rows, column).items():
            middle, low, high = medianInterval(pairs)
            if low > NOTABLE:
                yield f"speed: slower: {kind}, {what}: {words} × {middle:.2f} [{low:.2f}, {high:.2f}]"


def plot(folder):
    rows = table.read(folder, "speed")
    time_, cpu = ratios(rows, "seconds"), ratios(rows, "cpu_s")
    figure, axis = style.figure(height=1.2 + 0.42 * len(time_))
    axis.axvline(1.0, color=style.GREY, linewidth=1)
    names = list(time_)[::-1]
    for y, key in enumerate(names):
        for i, (found, lift) in enumerate(((time_, 0.13), (cpu, -0.13))):
            if key not in found:
                continue
            middle, low, high = medianInterval(found[key])
            look = style.look(i)
            axis.plot([low, high], [y + lift] * 2, color=look["color"], linewidth=4, alpha=0.35, solid_capstyle="butt")
            axis.plot([middle], [y + lift], look["marker"], color=look["color"],
                      label=("time that passed", "processors' time")[i] if y == len(names) - 1 else None)
        seconds = [medianInterval([r["seconds"] for r in rows if (r["kind"], r["what"], r["program"]) == (*key, p)])[0]
                   for p in (OLD, NEW)]
        axis.annotate(f"{seconds[0]:.3g} → {seconds[1]:.3g} s", (1.0, y), xycoords=("axes fraction", "data"),
                      xytext=(4, 0), textcoords="offset points", va="center", fontsize=8.5)
    axis.set_yticks(range(len(names)), [f"{kind}: {what}" for kind, what in names])
    axis.set(xlabel="new over old, median of turns with its 95 % interval",
             ylim=(-0.6, len(names) - 0.4))
    style.legendAbove(figure, *axis.get_legend_handles_labels(), ncols=2)
    style.save(figure, folder, "speed")
