"""The pages that people read: every command on the front page runs, every relative link of every page leads somewhere.

usage: readme_test.py commands WHITTLE | links
`commands` runs in a temporary folder with small pictures: `./run.sh` becomes the built program WHITTLE, scene.glb one of
our scenes, sky.hdr a grey sky. The window opens on an X server without a screen, where there is one (Xvfb). `./test.sh` is not run: it is what runs this.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent
SMALL = {"render": ["--width", "64", "--height", "36"], "reference": ["--width", "64", "--height", "36"],
         "bench": ["--rays", "4096", "--runs", "1"],
         "view": ["--width", "64", "--height", "36", "--script", "script"]}
FENCED = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`([^`\n]+)`")


def commandsOf(page):
    """The commands of a page, in order: lines of its blocks and pieces of code that begin with a program of ours."""
    text = page.read_text()
    pieces = [line for block in FENCED.findall(text) for line in block.splitlines()]
    pieces += CODE.findall(FENCED.sub("", text))
    wanted = re.compile(r"(\./run\.sh|\./test\.sh|experiments/)")
    return [piece.split(" #")[0].strip() for piece in pieces if wanted.match(piece) and "…" not in piece]


class Commands(unittest.TestCase):
    whittle = ""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        shutil.copy(ROOT / "scenes/cornell_box.glb", self.folder / "scene.glb")
        # Radiance HDR, four pixels of 0.5: too narrow for run lengths.
        sky = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n" + bytes([128, 128, 128, 128]) * 4
        (self.folder / "sky.hdr").write_bytes(sky)
        (self.folder / "script").write_text("wait picture\nquit\n")

    def display(self):
        """A display of an X server that ends with the test."""
        if not shutil.which("Xvfb"):
            self.skipTest("no Xvfb for the window")
        server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "1280x720x24", "-nolisten", "tcp"],
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(server.wait)
        self.addCleanup(server.terminate)
        return ":" + server.stdout.readline().strip()

    def test_front_page(self):
        commands = commandsOf(ROOT / "README.md")
        self.assertIn("./run.sh", commands)
        self.assertIn("./test.sh", commands)
        self.assertGreaterEqual(sum(c.startswith("./run.sh ") for c in commands), 10)
        for command in commands:
            with self.subTest(command):
                self.check(shlex.split(command))

    def check(self, words):
        program, arguments = words[0], words[1:]
        if program.startswith("experiments/"):
            return self.checkExperiment(program, arguments)
        self.assertTrue((ROOT / program).stat().st_mode & 0o100, f"{program} cannot be run")
        if program == "./test.sh":
            return
        if not arguments:  # what run.sh does then
            said = 'render "$root/scenes/cornell_box.glb" -o cornell_box.png'
            self.assertIn(said, (ROOT / program).read_text())
            arguments = ["render", str(ROOT / "scenes/cornell_box.glb"), "-o", "cornell_box.png"]
        environment = dict(os.environ)
        if arguments[0] == "view":
            environment["DISPLAY"] = self.display()
        done = subprocess.run([self.whittle, *arguments, *SMALL.get(arguments[0], [])], cwd=self.folder, text=True,
                              env=environment,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)
        self.assertEqual(done.returncode, 0, done.stdout)
        for option, value in zip(arguments, arguments[1:]):
            if option in ("-o", "--stats", "--trace"):
                value = re.sub("#+", lambda number: "0" * len(number[0]), value)  # the first frame of a film
                self.assertGreater((self.folder / value).stat().st_size, 0, value)

    def checkExperiment(self, program, arguments):
        """Experiments take hours: that there is one of this name is enough."""
        self.assertTrue((ROOT / program).is_file(), program)
        if program != "experiments/run" or not arguments:
            return
        done = subprocess.run([sys.executable, "-B", ROOT / program, "list"], text=True, capture_output=True)
        if "ModuleNotFoundError" in done.stderr:
            self.skipTest("experiments/run lacks a Python module")
        names = [line.split()[0] for line in done.stdout.splitlines() if line.strip()]
        self.assertIn(arguments[0], names + ["list"], done.stderr)


def pages():
    """Every page that git knows; where there is no git, every page outside hidden folders and build/."""
    try:
        listed = subprocess.run(["git", "ls-files", "-z", "*.md"], cwd=ROOT, capture_output=True, text=True)
        found = [ROOT / name for name in listed.stdout.split("\0") if name] if listed.returncode == 0 else []
    except FileNotFoundError:
        found = []
    if not found:
        inside = (p.relative_to(ROOT) for p in ROOT.rglob("*.md"))
        found = [ROOT / p for p in inside if p.parts[0] != "build" and not any(x.startswith(".") for x in p.parts)]
    return sorted(p for p in found if p.exists())


def anchorsOf(page):
    """The names that a code host gives to a page's headings: letters, digits, - and _ of the title in lower case."""
    names = set()
    for title in re.findall(r"^#{1,6} +(.+?) *#*$", FENCED.sub("", page.read_text()), re.MULTILINE):
        title = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", title)
        name = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
        again = 1
        unique = name
        while unique in names:
            unique, again = f"{name}-{again}", again + 1
        names.add(unique)
    return names


def linksOf(page):
    text = CODE.sub("", FENCED.sub("", page.read_text()))
    for target in re.findall(r"\]\(\s*<?([^)\s>]+)", text) + re.findall(r"^ *\[[^\]]+\]:\s*(\S+)", text, re.MULTILINE):
        if not re.match(r"[a-z][a-z0-9+.-]*:", target):
            yield target


class Links(unittest.TestCase):
    def test_every_page(self):
        found = pages()
        self.assertIn(ROOT / "README.md", found)
        for page in found:
            for target in linksOf(page):
                with self.subTest(page=str(page.relative_to(ROOT)), link=target):
                    path, _, anchor = urllib.parse.unquote(target).partition("#")
                    file = (page.parent / path).resolve() if path else page
                    self.assertTrue(file.exists(), "no such file")
                    self.assertTrue(file.is_relative_to(ROOT), "leads out of the project")
                    if anchor and file.suffix == ".md":
                        self.assertIn(anchor, anchorsOf(file), "no such heading")

    def test_stages_have_one_name(self):
        """The front page and host/README.md call stages as the profile and the window do."""
        names = set(re.findall(r'Stage stage\{\s*\{"(\w+)"', (ROOT / "host/wavefront/stages.h").read_text()))
        self.assertIn("raygen", names)
        for page, head in ((ROOT / "README.md", "| stage | in words | what"), (ROOT / "host/README.md", "| stage | in words | reads")):
            rows = page.read_text().split(head)[1].split("\n\n")[0].splitlines()[2:]
            told = {name for row in rows for name in re.findall(r"[a-z_]+…?", row.split("|")[1].split("](")[0])}
            whole = {name for name in told if not name.endswith("…")}
            starts = tuple(name[:-1] for name in told - whole)
            self.assertLessEqual(whole, names, page)
            lost = {name for name in names - whole if not name.startswith(starts)}
            self.assertLessEqual(lost, {"find_long_runs"}, page)

    def test_a_lost_link_shows(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            page.write_text("# Some Title: 1 & 2\n[a](other.md#x) `[b](code.md)` [c](https://example.org) ![d](<p.png>)\n")
            self.assertEqual(list(linksOf(page)), ["other.md#x", "p.png"])
            self.assertEqual(anchorsOf(page), {"some-title-1--2"})


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "commands":
        Commands.whittle = sys.argv[2]
    elif sys.argv[1:] != ["links"]:
        sys.exit(__doc__)
    unittest.main(argv=[sys.argv[0], sys.argv[1].capitalize()])
