"""experiments/speed: which rows it calls slower, on times that are known. Skipped (status 77) where matplotlib is
missing."""
import pathlib
import sys
import unittest

EXPERIMENTS = pathlib.Path(__file__).resolve().parents[2] / "experiments"
sys.path.insert(0, str(EXPERIMENTS))
try:
    import matplotlib  # noqa: F401
    import numpy  # noqa: F401
except ImportError:
    print("skipped: python3-matplotlib or python3-numpy is not installed")
    sys.exit(77)

from speed import speed  # noqa: E402


def rows(what, factor, cpuFactor, turns=9):
    """Turns on a machine whose speed wanders by half: both programs alike, as they take turns."""
    for turn in range(turns):
        load = 1 + 0.5 * (turn % 3) / 2
        for program, f, c in ((speed.OLD, 1.0, 1.0), (speed.NEW, factor, cpuFactor)):
            yield {"kind": "whole process", "what": what, "program": program, "turn": turn,
                   "seconds": 2 * load * f, "cpu_s": 1.5 * c, "faults": 1}


class Slower(unittest.TestCase):
    def said(self, *all_):
        return list(speed.slower([row for part in all_ for row in part]))

    def test_what_is_as_fast_or_faster_is_not_named(self):
        self.assertEqual(self.said(rows("same", 1.0, 1.0), rows("fast", 0.5, 0.4), rows("hardly", 1.04, 1.04)), [])

    def test_what_takes_longer_is_named_though_the_machine_wanders(self):
        said = self.said(rows("same", 1.0, 1.0), rows("slow", 1.25, 1.0))
        self.assertEqual(len(said), 1)
        self.assertIn("slow: time × 1.25", said[0])

    def test_so_is_what_hides_on_another_processor(self):
        said = self.said(rows("busy", 1.0, 1.5))
        self.assertEqual(len(said), 1)
        self.assertIn("busy: processors' time × 1.50", said[0])

    def test_rows_without_their_other_half_do_not_count(self):
        lonely = [r for r in rows("slow", 2.0, 2.0) if r["program"] == speed.NEW]
        self.assertEqual(self.said(lonely), [])


class RaySeconds(unittest.TestCase):
    def test_rates_add_up_as_times(self):
        self.assertEqual(speed.raySeconds('{"rows": [{"mraysPerSecond": 2.0}, {"mraysPerSecond": 4.0}]}'), 0.75)


if __name__ == "__main__":
    unittest.main()
