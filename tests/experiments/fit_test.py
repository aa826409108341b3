"""The fits of experiments/lib/fit.py on data whose law is known. Skipped (status 77) where numpy is missing."""
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "experiments"))
try:
    import numpy
except ImportError:
    print("skipped: python3-numpy is not installed")
    sys.exit(77)

from lib import fit  # noqa: E402


class Student(unittest.TestCase):
    def test_quantiles_of_the_tables(self):
        # Abramowitz & Stegun, table 26.10, two-sided 95 %; given to three decimals.
        for freedom, t in ((1, 12.706), (2, 4.303), (3, 3.182), (4, 2.776), (10, 2.228), (30, 2.042), (120, 1.980)):
            self.assertAlmostEqual(fit.student(freedom), t, delta=6e-4)


class Lines(unittest.TestCase):
    def test_power_law_without_noise(self):
        x = numpy.array([1.0, 3, 10, 50, 1000])
        law = fit.power(x, 2.5 * x**-0.75)
        self.assertAlmostEqual(law.values[0], 2.5, places=9)
        self.assertAlmostEqual(law.values[1], -0.75, places=9)

    def test_line_without_noise(self):
        for relative in (False, True):
            line = fit.linear([1, 2, 5, 9], [7, 9, 15, 23], relative)
            numpy.testing.assert_allclose(line.values, [5, 2], atol=1e-9)

    def test_intervals_hold_the_truth_in_95_percent(self):
        random, trials = numpy.random.default_rng(1), 2000
        x = numpy.geomspace(10, 1e5, 7)
        held = 0
        for _ in range(trials):
            value, half = fit.power(x, 3 * x**0.5 * numpy.exp(random.normal(0, 0.1, len(x))))[1]
            held += abs(value - 0.5) <= half
        # Binomial: the share's standard deviation is sqrt(0.95 · 0.05 / 2000) = 0.5 %; four of them.
        self.assertLess(abs(held / trials - 0.95), 0.02)

    def test_straight_end_leaves_out_a_constant(self):
        x = 2.0 ** numpy.arange(16)
        y = 100 + x  # within 10 % of a power law only where x is well above 100
        first = fit.straightEnd(x, y)
        self.assertGreater(x[first], 100)
        self.assertLess(abs(fit.power(x[first:], y[first:]).values[1] - 1), 0.1)
        self.assertEqual(fit.straightEnd(x, 7 * x), 0)


class Errors(unittest.TestCase):
    def test_the_floor_of_an_error_is_found(self):
        random, n = numpy.random.default_rng(5), 2.0 ** numpy.arange(8)
        for power in (1.0, 1.5):
            squares = 0.02**2 + 0.1**2 * n**-power
            numpy.testing.assert_allclose(fit.floor(n, squares, power), [0.02, 0.1], rtol=1e-9)
            found = [fit.floor(n, squares * numpy.exp(random.normal(0, 0.05, len(n))), power) for _ in range(100)]
            # Squares that scatter by 5 % leave the floor to some 5 %; the mean of a hundred to a tenth of that, and
            # least squares of relative errors are low by about the variance of the scatter.
            numpy.testing.assert_allclose(numpy.mean(found, axis=0), [0.02, 0.1], rtol=0.02)

    def test_an_error_without_a_floor_has_none(self):
        n = 2.0 ** numpy.arange(8)
        self.assertLess(fit.floor(n, 0.01 / n)[0], 1e-9)

    def test_the_interval_of_a_mean_holds_it_in_95_percent(self):
        random, trials, held = numpy.random.default_rng(6), 4000, 0
        for _ in range(trials):
            mean, half = fit.across(random.normal(3, 1, 5))
            held += abs(mean - 3) <= half
        # Binomial, as above: 0.34 %; four of them.
        self.assertLess(abs(held / trials - 0.95), 0.014)


class Bends(unittest.TestCase):
    def test_a_bend_is_found_with_its_slopes(self):
        random, x = numpy.random.default_rng(2), numpy.linspace(0, 20, 41)
        y = numpy.where(x < 12, 5 + 1.0 * x, 17 + 4.0 * (x - 12)) + random.normal(0, 0.2, len(x))
        found = fit.bend(x, y)
        self.assertTrue(found.low <= 12 <= found.high, (found.low, found.high))
        self.assertAlmostEqual(found.before[0], 1, delta=2 * found.before[1])
        self.assertAlmostEqual(found.after[0], 4, delta=2 * found.after[1])
        self.assertGreater(found.gain, 10)

    def test_a_straight_line_has_none(self):
        random, x = numpy.random.default_rng(3), numpy.linspace(0, 20, 41)
        self.assertLess(fit.bend(x, 3 + 2 * x + random.normal(0, 0.2, len(x))).gain, 6)


class Scaling(unittest.TestCase):
    threads = numpy.array([1, 2, 3, 4, 6, 8, 12, 16, 24, 32], float)

    def throughput(self, sigma, kappa):
        n = self.threads
        return 1e6 * n / (1 + sigma * (n - 1) + kappa * n * (n - 1))

    def test_parameters_without_noise(self):
        for sigma, kappa in ((0.05, 0.002), (0.3, 0.0), (0.0, 0.01)):
            numpy.testing.assert_allclose(fit.usl(self.threads, self.throughput(sigma, kappa)).values,
                                          [1e6, sigma, kappa], rtol=1e-5, atol=1e-8)
        numpy.testing.assert_allclose(fit.amdahl(self.threads, self.throughput(0.1, 0)).values, [1e6, 0.1], rtol=1e-6)

    def test_parameters_lie_within_their_intervals(self):
        random, trials, held = numpy.random.default_rng(4), 300, numpy.zeros(3)
        for _ in range(trials):
            noisy = self.throughput(0.05, 0.002) * numpy.exp(random.normal(0, 0.01, len(self.threads)))
            found = fit.usl(self.threads, noisy)
            held += abs(found.values - [1e6, 0.05, 0.002]) <= found.half
        # sqrt(0.95 · 0.05 / 300) = 1.3 %; three of them, and the model is not linear.
        self.assertTrue((abs(held / trials - 0.95) < 0.04).all(), held / trials)

    def test_shown_has_the_decimals_of_its_interval(self):
        self.assertEqual(fit.shown(1.0234, 0.031), "1.02 ± 0.03")
        self.assertEqual(fit.shown(0.5, math.inf), "0.50")


if __name__ == "__main__":
    unittest.main()
