"""Stand-in for the harness."""
import argparse, json, os, pathlib, subprocess, sys, tempfile, time
ROOT = pathlib.Path(__file__).resolve().parents[2]


class Context:
    def __init__(self):
        p = argparse.ArgumentParser()
        p.add_argument("--quick", action="store_true")
        p.add_argument("--plot", action="store_true")
        p.add_argument("--out", type=pathlib.Path, default=ROOT / "experiments")
        p.add_argument("--whittle", type=pathlib.Path, default=ROOT / "build/release/whittle")
        a = p.parse_args()
        self.quick, self.plotOnly, self.whittle, self.root = a.quick, a.plot, a.whittle, ROOT
        self.data, self.figures = a.out / "data", a.out / "figures"
        self.data.mkdir(exist_ok=True, parents=True)
        self.figures.mkdir(exist_ok=True, parents=True)
        self.runs = 3 if a.quick else 7
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.env = dict(os.environ, POCL_CACHE_DIR="/tmp/e-kernels")

    def call(self, *command):
        done = subprocess.run(list(map(str, command)), env=self.env, capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr)
        return done.stdout

    def render(self, scene, *options):
        return json.loads(self.call(self.whittle, "render", scene, "--quiet", "--stats", "-", *options))

    def bench(self, scene, *options):
        return json.loads(self.call(self.whittle, "bench", scene, "--quiet", "--json", *options))

    def scene(self, name):
        """path, or None"""
        own = ROOT / "scenes" / f"{name}.glb"
        if own.exists():
            return own
        if name == "frame" or name.startswith("height_field_"):
            file = self.folder / f"{name}.glb"
            if not file.exists():
                self.call(self.whittle.parent / "make_scenes", *(["--frame"] if name == "frame" else ["--heightfield", name.split("_")[-1]]), file)
            return file
        found = list((ROOT.parent / "shared" / "scenes").rglob(f"{name}.glb"))
        return found[0] if found else None


def main(measure, plot):
    c = Context()
    begin = time.time()
    if not c.plotOnly:
        measure(c)
        print(f"measured in {time.time() - begin:.0f} s", file=sys.stderr)
    plot(c)
