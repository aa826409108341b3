"""experiments/run: what it says where there is no data to draw. Skipped (status 77) where matplotlib is missing."""
import argparse
import contextlib
import importlib.machinery
import importlib.util
import io
import pathlib
import sys
import tempfile
import unittest

EXPERIMENTS = pathlib.Path(__file__).resolve().parents[2] / "experiments"
sys.path.insert(0, str(EXPERIMENTS))
try:
    import matplotlib  # noqa: F401
    import numpy  # noqa: F401
except ImportError:
    print("skipped: python3-matplotlib or python3-numpy is not installed")
    sys.exit(77)

loader = importlib.machinery.SourceFileLoader("run", str(EXPERIMENTS / "run"))
run = importlib.util.module_from_spec(importlib.util.spec_from_loader("run", loader))
loader.exec_module(run)


def plotted(name, out):
    """Exit status and standard error of `run NAME --plot --out OUT`."""
    said = io.StringIO()
    with contextlib.redirect_stderr(said):
        status = run.runOne(name, argparse.Namespace(plot=True, quick=False, out=out), None)
    return status, said.getvalue()


class NothingToDraw(unittest.TestCase):
    def check(self, fill):
        for name in run.modules():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                out = pathlib.Path(folder)
                file = fill(out / run.modules()[name])
                status, said = plotted(name, out)
                self.assertEqual((status, said.count("\n")), (2, 1), said)
                self.assertRegex(said, rf"^{name}: .*{file}.*`experiments/run {name} --out {out}` measures it")

    def test_a_missing_table_is_one_line(self):
        self.check(lambda data: r"there is no .*\.tsv")

    def test_so_is_one_without_rows(self):
        def headers(folder):
            folder.mkdir()
            for file in (EXPERIMENTS / folder.name).glob("*.tsv"):
                (folder / file.name).write_text(file.read_text().split("\n")[0] + "\n")
            return r"\.tsv holds no rows"
        self.check(headers)


if __name__ == "__main__":
    unittest.main()
