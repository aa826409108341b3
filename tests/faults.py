"""Makes every fault that a render may meet, and counts what survives it.

usage: faults.py WHITTLE [--full] [FAULT…]
One line for each kind of fault: how often it was tried, how often the run survived it, how often it lost something.
A run survives if it ends in time, with status 0 and the right picture, or with another status, one line that begins
with `whittle: `, and no picture but whole ones. Everything else is lost: a picture that differs or is cut off, a file
without its name, status 0 without a picture, a signal that nobody sent, silence, a hang. Each loss is told in a line of
its own, and the exit status is then 1. Without --full a few of each kind run, about a minute in all.
"""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENE = ROOT / "scenes/mirror_box.glb"
SIZE = ["--width", "96", "--height", "72", "--bounces", "3"]
LONGEST = 90  # seconds, with nothing compiled yet
NAMESPACE = ["unshare", "-Urm"]


class Bench:
    """Runs, and what became of them."""

    def __init__(self, whittle, full):
        self.whittle, self.full = whittle, full
        self.rows, self.losses = {}, []
        self.refuge = tempfile.TemporaryDirectory()  # of kernels that cannot be kept; compiled once
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "a.exr"
            subprocess.run([whittle, "render", SCENE, *SIZE, "--quiet", "-o", picture], check=True)
            self.right = self.texels(picture)

    def few(self, values, some=2):
        """All of them, or some spread over them."""
        values = list(values)
        if self.full or len(values) <= some:
            return values
        return [values[round((i + 0.5) * (len(values) - 1) / some)] for i in range(some)]

    @staticmethod
    def texels(picture):
        """The end of an .exr: its header has times in it, and what is cut off ends otherwise."""
        return picture.read_bytes()[-6000:]

    def command(self, *more):
        return [str(self.whittle), "render", str(SCENE), *SIZE, "--quiet", "-o", "a.exr", *more]

    def judge(self, kind, what, folder, status, said, killed=False, quiet=False, pictures=("a.exr",)):
        """Counts one run. `killed`: we sent a signal that ends it without a word; `quiet`: nobody hears it."""
        row = self.rows.setdefault(kind, [0, 0, 0])
        row[0] += 1
        problem = self.problem(folder, status, said, killed, quiet, pictures)
        row[2 if problem else 1] += 1
        if problem:
            self.losses.append(f"{kind}, {what}: {problem}; said {said[-200:]!r}")

    def problem(self, folder, status, said, killed, quiet, pictures):
        there = [p for p in folder.rglob("*") if p.is_file() and not p.is_symlink()]
        for file in there:
            if file.name.startswith(".whittle"):
                return f"{file.name} was left"
            if file.suffix == ".exr" and self.texels(file) != self.right:
                return f"{file.name} is another picture"
        if status == 127 and "error while loading shared libraries" in said:
            return ""  # the system's loader refuses, before anything of the program runs
        ours = [line for line in said.splitlines() if line.startswith("whittle: ") and "Assertion" not in line]
        if status is None:
            return f"still running after {LONGEST} s"
        if status == 0:
            missing = [name for name in pictures if not (folder / name).is_file()]
            return f"status 0 without {missing[0]}" if missing else ""
        if status < 0 and not killed:
            return f"signal {-status} ended it"
        if killed or quiet:
            return ""
        return "" if len(ours) == 1 else f"status {status} and {len(ours)} lines of ours"

    def shell(self, kind, what, script, env=None, **how):
        """`script` with $RUN, the render, in a folder of its own."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            run = " ".join(f"'{word}'" for word in self.command(*how.pop("more", ())))
            process = subprocess.Popen(["bash", "-c", script.replace("$RUN", run)], cwd=folder, text=True,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True,
                                       env={**os.environ, **(env or {})})
            try:
                _, said = process.communicate(timeout=LONGEST)
                status = process.returncode
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                _, said = process.communicate()
                status = None
            self.judge(kind, what, folder, status, said, **how)

    def table(self):
        print(f"{'fault':<34} {'tried':>6} {'survived':>9} {'lost':>5}")
        for kind, row in self.rows.items():
            print(f"{kind:<34} {row[0]:>6} {row[1]:>9} {row[2]:>5}")
        total = [sum(row[i] for row in self.rows.values()) for i in range(3)]
        print(f"{'all':<34} {total[0]:>6} {total[1]:>9} {total[2]:>5}")
        for loss in self.losses:
            print(f"lost: {loss}")


def streams(b):
    for end in ["2>/dev/full", "2>&-", ">/dev/full", ">&-", "<&- >&- 2>&-", "2> >(:)", "> >(:)"]:
        b.shell("streams closed, full, unread", end, f"exec $RUN {end}", quiet=True)


def addresses(b):
    for megabytes in b.few(range(100, 1500, 25), 5):
        b.shell("limit of addresses", f"{megabytes} MB", f"ulimit -v {megabytes * 1024}; exec $RUN")
    for megabytes in b.few(range(700, 1500, 50), 2):
        with tempfile.TemporaryDirectory() as cache:
            b.shell("limit of addresses, cold", f"{megabytes} MB", f"ulimit -v {megabytes * 1024}; exec $RUN",
                    env={"POCL_CACHE_DIR": cache})


def otherLimits(b):
    for kilobytes in b.few([64, 128, 256, 512, 1024, 4096, 65536]):
        b.shell("limit of the stack", f"{kilobytes} kB", f"ulimit -s {kilobytes}; exec $RUN")
    for files in b.few(range(3, 40)):
        b.shell("limit of open files", str(files), f"ulimit -n {files}; exec $RUN")
    for blocks in b.few([0, 1, 2, 8, 32, 128, 512]):
        b.shell("limit of a file's size", f"{blocks} kB", f"ulimit -f {blocks}; exec $RUN")
    for seconds in b.few([1, 2, 3], 1):
        b.shell("limit of processor time", f"{seconds} s", f"ulimit -t {seconds}; exec $RUN",
                more=["--rays-per-pixel", "1000000"])


def fullDisks(b):
    if subprocess.run([*NAMESPACE, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True).returncode != 0:
        print("full disks: skipped, users may not make namespaces here")
        return
    for kilobytes in b.few([4, 8, 16, 24, 32, 40, 48, 64, 128, 512]):
        script = (f"exec {' '.join(NAMESPACE)} bash -c \"mkdir full && mount -t tmpfs -o size={kilobytes}k none full && "
                  "cd full && exec $RUN\"")
        b.shell("full disk", f"{kilobytes} kB", script, pictures=())
    for kilobytes in b.few([4, 64, 1024, 4096, 20480], 2):
        script = (f"exec {' '.join(NAMESPACE)} bash -c \"mkdir full && mount -t tmpfs -o size={kilobytes}k none full && "
                  "POCL_CACHE_DIR=$PWD/full exec $RUN\"")
        b.shell("full cache folder", f"{kilobytes} kB", script, env={"TMPDIR": b.refuge.name})


def folders(b):
    for ms in b.few(range(0, 1000, 50)):
        script = f"mkdir out; (sleep {ms / 1000}; rm -rf out) & $RUN -o out/b.exr; s=$?; wait; exit $s"
        b.shell("vanishing folder", f"after {ms} ms", script, more=["--rays-per-pixel", "1"])
    for cache in ["/proc/none", "/dev/null", "/dev/null/below", "relative", "x" * 300, "/tmp/" + "/".join(["y" * 200] * 5)]:
        b.shell("cache folder that is none", cache[:40], "exec $RUN",
                env={"POCL_CACHE_DIR": cache, "TMPDIR": b.refuge.name})


def signals(b):
    for number in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
        for ms in b.few(range(0, 1500, 60)):
            script = f"set -m; $RUN & sleep {ms / 1000}; kill -{number.value} $! 2>/dev/null; wait $!; exit $?"
            b.shell("signals", f"{number.name} after {ms} ms", script, killed=True, pictures=())
    for ms in b.few(range(0, 1500, 30)):
        script = f"$RUN -o b.exr & sleep {ms / 1000}; kill -9 $! 2>/dev/null; wait $!; exit $?"
        b.shell("kill -9 of the guard", f"after {ms} ms", script, killed=True, quiet=True, pictures=())
    for ms in b.few(range(100, 1500, 50)):
        script = f"$RUN & g=$!; sleep {ms / 1000}; pkill -9 -P $g; wait $g; exit $?"
        b.shell("kill -9 of the worker", f"after {ms} ms", script)


def inputs(b):
    for option in ["--background", "--reference"]:
        for what in ["pipe.exr", "link.exr", "/dev/zero", "/dev/full", "folder", "/proc/self/mem"]:
            b.shell("inputs that are no files", f"{option} {what}",
                    f"mkfifo pipe.exr; ln -s pipe.exr link.exr; mkdir folder; exec $RUN {option} {what}")


def groups(b):
    for items in b.few([1, 16, 256, 1024, 4096, 8192], 3):
        b.shell("work-groups", str(items), f"exec $RUN --work-group {items}")


def crowds(b):
    with tempfile.TemporaryDirectory() as cache:
        script = ("for i in $(seq 12); do mkdir d$i; (cd d$i; exec $RUN) & p=\"$p $!\"; done; "
                  "s=0; for i in $p; do wait $i || s=$?; done; exit $s")
        pictures = [f"d{i}/a.exr" for i in range(1, 13)]
        b.shell("twelve at once, cold", "", script, env={"POCL_CACHE_DIR": cache}, pictures=pictures)


FAULTS = [streams, addresses, otherLimits, fullDisks, folders, signals, inputs, groups, crowds]


def main(arguments):
    if not arguments or arguments[0].startswith("-"):
        sys.exit(__doc__)
    names = [a for a in arguments[1:] if a != "--full"]
    known = {f.__name__ for f in FAULTS}
    if not set(names) <= known:
        sys.exit(f"{', '.join(sorted(set(names) - known))}: no such fault; there are {', '.join(sorted(known))}")
    bench = Bench(pathlib.Path(arguments[0]).resolve(), "--full" in arguments)
    start = time.monotonic()
    for fault in FAULTS:
        if not names or fault.__name__ in names:
            fault(bench)
    bench.table()
    print(f"{time.monotonic() - start:.0f} s")
    return 1 if bench.losses else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
