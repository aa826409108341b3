"""What E9 reads off its runs, on runs whose law is known. Skipped (status 77) where numpy is missing."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "experiments"))
try:
    import numpy
except ImportError:
    print("skipped: python3-numpy is not installed")
    sys.exit(77)

from e9_error import analysis as e9  # noqa: E402

MEAN = 0.5


def run(variant, seed, asked, law, estimate=1.0):
    """Looks of one run: 1, 2, 4, ... rays, a millisecond each, RMSE by the law, which the estimate is a multiple of."""
    return [dict(scene="room", variant=variant, asked=asked, seed=seed, rays_per_pixel=n, seconds=n * 1e-3, mean=MEAN,
                 rmse=MEAN * law(n), estimate=MEAN * law(n) * estimate) for n in 2 ** numpy.arange(asked.bit_length())]


def data(curves):
    return dict(looks=e9.looks(curves), final=[], precision=[dict(scene="room", arithmetic=a, rmse=MEAN * e, mean=MEAN)
                for a, e in (("strict", 1e-7), ("relaxed", 2e-7))], scenes=["room"])


class Analysis(unittest.TestCase):
    def test_slopes_and_floors_are_those_of_the_law(self):
        curves = []
        for seed in (1, 2, 3):
            curves += run("sobol", seed, 64, lambda n: (1 + 0.01 * seed) * n**-0.75)
            curves += run("depth 2", seed, 64, lambda n: numpy.sqrt(0.2**2 + n**-1.5))
        found = data(curves)
        found["slopes"] = e9.slopes(found)
        rows = {(r["variant"], r["measure"]): r for r in found["slopes"]}
        self.assertAlmostEqual(rows["sobol", "rmse"]["slope"], -0.75, places=9)
        self.assertLess(rows["sobol", "rmse"]["half"], 1e-9)
        floors = {r["cause"]: r["rmse"] for r in e9.floors(found)}
        self.assertAlmostEqual(floors["depth 2"], 0.2, places=6)
        self.assertAlmostEqual(floors["64 Sobol rays"], 1.02 * 64**-0.75, places=9)
        self.assertAlmostEqual(floors["relaxed single precision"], 2e-7, places=12)

    def test_shorter_runs_do_not_count_twice(self):
        curves = run("random", 1, 64, lambda n: n**-0.5) + run("random", 1, 4, lambda n: 9 * n**-0.5)
        self.assertEqual(len(e9.looks(curves)), 7)
        self.assertEqual([p[0] for p in e9.curve(data(curves), "room", "random")], [1, 2, 4, 8, 16, 32, 64])

    def test_the_pareto_front_leaves_out_what_is_beaten_or_hardly_better(self):
        points = [(1, 0.9), (2, 0.5), (2.5, 0.6), (3, 0.49), (4, 0.3)]
        self.assertEqual(e9.paretoFront(points, lambda p: p), [(1, 0.9), (2, 0.5), (4, 0.3)])

    def test_calibration_is_true_over_estimated(self):
        rows = e9.calibration(data(run("sobol", 1, 64, lambda n: n**-0.75, estimate=2.0)))
        self.assertEqual([(r["scene"], r["median"], r["looks"]) for r in rows], [("all", 0.5, 7), ("room", 0.5, 7)])


if __name__ == "__main__":
    unittest.main()
