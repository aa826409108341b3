"""Least-squares fits with 95 % confidence intervals: straight lines, power laws, a bend, Amdahl and Gunther.

Intervals are Student's t times the standard error (Draper & Smith, Applied Regression Analysis). They speak of the
scatter about the model; where the model is wrong they are too narrow, so look at the residuals as well.
"""
import dataclasses
import math

import numpy


def studentCdf(t, freedom):
    """P(|T| < t) for a whole number of degrees of freedom (Abramowitz & Stegun 26.7.3 and 26.7.4)."""
    theta = math.atan(t / math.sqrt(freedom))
    sine, cosine = math.sin(theta), math.cos(theta)
    odd = freedom % 2
    term = cosine if odd else 1.0
    total = term if freedom > 1 else 0.0
    for k in range(3 if odd else 2, freedom - 1, 2):
        term *= cosine * cosine * (k - 1) / k
        total += term
    return (theta + sine * total) * 2 / math.pi if odd else sine * total


def student(freedom, confidence=0.95):
    """The t with that probability between -t and t."""
    low, high = 0.0, 1e4
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if studentCdf(middle, freedom) < confidence else (low, middle)
    return low


@dataclasses.dataclass
class Fit:
    """Values of the parameters, half-widths of their 95 % intervals (infinite without spare points), and the curve."""
    values: numpy.ndarray
    half: numpy.ndarray
    residual: float  # root mean square, in the units in which was fitted
    curve: object    # a function of x

    def __getitem__(self, i):
        return self.values[i], self.half[i]


def halfWidths(jacobian, residuals):
    freedom = len(residuals) - jacobian.shape[1]
    if freedom < 1:
        return numpy.full(jacobian.shape[1], numpy.inf)
    variance = residuals @ residuals / freedom
    # Columns of length 1: parameters of very different sizes would make the matrix look singular.
    length = numpy.maximum(numpy.linalg.norm(jacobian, axis=0), 1e-300)
    unit = jacobian / length
    return student(freedom) * numpy.sqrt(variance * numpy.diag(numpy.linalg.pinv(unit.T @ unit))) / length


def solve(design, y):
    """Values, half-widths, root mean square residual of an ordinary least-squares problem."""
    values = numpy.linalg.lstsq(design, y, rcond=None)[0]
    residuals = y - design @ values
    return values, halfWidths(design, residuals), float(numpy.sqrt(numpy.mean(residuals**2)))


def linear(x, y, relative=False):
    """y = values[0] + values[1] x; relative: the errors are proportional to y, as those of times are."""
    x, y = numpy.asarray(x, float), numpy.asarray(y, float)
    weight = 1 / y if relative else numpy.ones_like(y)
    a, half, residual = solve(numpy.stack([weight, weight * x], axis=1), weight * y)
    return Fit(a, half, residual, lambda at: a[0] + a[1] * numpy.asarray(at, float))


def power(x, y):
    """y = values[0] x^values[1], straight in log-log; residual in natural logarithms, that is relative."""
    u, v = numpy.log(numpy.asarray(x, float)), numpy.log(numpy.asarray(y, float))
    centre = u.mean()
    a, half, residual = solve(numpy.stack([numpy.ones_like(u), u - centre], axis=1), v)
    factor = math.exp(a[0] - a[1] * centre)
    return Fit(numpy.array([factor, a[1]]), numpy.array([factor * half[0], half[1]]), residual,
               lambda at: factor * numpy.asarray(at, float)**a[1])


def floor(n, squared, power=1.0):
    """b and s of the mean squared error b² + s² n^-power: what no n removes, and what n = 1 adds to it. Relative
    errors, as each square scatters in proportion to its own size; a floor below what the scatter lets see comes out
    as 0."""
    line = linear(numpy.asarray(n, float) ** -power, squared, relative=True)
    return math.sqrt(max(line.values[0], 0)), math.sqrt(max(line.values[1], 0))


def across(values):
    """Mean of independent values and the half-width of its 95 % interval: for numbers found once for each seed."""
    values = numpy.asarray(values, float)
    if len(values) < 2:
        return float(values[0]), math.inf
    return float(values.mean()), student(len(values) - 1) * float(values.std(ddof=1)) / math.sqrt(len(values))


def straightEnd(x, y, tolerance=0.1, least=4):
    """Index from which on log y is straight in log x: leftwards from the last `least` points as long as the next one
    lies within the tolerance (relative) of the power law through those taken."""
    first = max(len(x) - least, 0)
    while first > 0:
        law = power(x[first:], y[first:])
        if abs(math.log(y[first - 1] / float(law.curve(x[first - 1])))) > tolerance:
            break
        first -= 1
    return first


@dataclasses.dataclass
class Bend:
    """Two straight lines that meet at `at`; low and high bound it (profile likelihood, 95 %)."""
    at: float
    low: float
    high: float
    before: tuple  # slope, half-width
    after: tuple
    gain: float    # Bayes' information criterion of one line minus that of two: above about 10 the bend is real
    curve: object


def bend(x, y):
    """y continuous and piecewise linear in x with one break, found on a fine grid; None for fewer than six points."""
    x, y = numpy.asarray(x, float), numpy.asarray(y, float)
    if len(x) < 6:
        return None
    order = numpy.sort(x)
    grid = numpy.linspace(order[1], order[-2], 400)

    def design(b):  # slopes before and after as parameters
        return numpy.stack([numpy.ones_like(x), numpy.minimum(x - b, 0), numpy.maximum(x - b, 0)], axis=1)

    squares = numpy.array([len(x) * solve(design(b), y)[2]**2 for b in grid])
    best = int(squares.argmin())
    a, half, _ = solve(design(grid[best]), y)
    inside = grid[squares <= squares[best] * (1 + student(len(x) - 4)**2 / (len(x) - 4))]
    one = len(x) * solve(numpy.stack([numpy.ones_like(x), x], axis=1), y)[2]**2
    gain = len(x) * math.log(max(one, 1e-300) / max(squares[best], 1e-300)) - 2 * math.log(len(x))
    at = float(grid[best])
    return Bend(at, float(inside.min()), float(inside.max()), (a[1], half[1]), (a[2], half[2]), gain,
                lambda to: a[0] + a[1] * numpy.minimum(to - at, 0) + a[2] * numpy.maximum(to - at, 0))


def gaussNewton(model, start, x, y, steps=100):
    """Least squares of relative errors, no parameter below 0; numeric derivatives, steps halved until they help."""
    values = numpy.asarray(start, float)

    def residuals(v):
        return (y - model(v, x)) / y

    def jacobian(v):
        columns = []
        for i in range(len(v)):
            h = 1e-6 * max(abs(v[i]), 1e-3)
            columns.append((residuals(v) - residuals(v + h * numpy.eye(len(v))[i])) / h)
        return numpy.stack(columns, axis=1)

    for _ in range(steps):
        r = residuals(values)
        step = numpy.linalg.lstsq(jacobian(values), r, rcond=None)[0]
        scale = 1.0
        while scale > 1e-6 and (trial := residuals(numpy.maximum(values + scale * step, 0))) @ trial > r @ r:
            scale /= 2
        moved = numpy.maximum(values + scale * step, 0)
        if scale <= 1e-6 or numpy.allclose(moved, values, rtol=1e-10, atol=1e-14):
            break
        values = moved
    r = residuals(values)
    residual = float(numpy.sqrt(numpy.mean(r**2)))
    return Fit(values, halfWidths(jacobian(values), r), residual, lambda at: model(values, at))


def usl(threads, throughput):
    """Gunther's universal scalability law, X(N) = X1 N / (1 + sigma (N-1) + kappa N (N-1)); values X1, sigma, kappa.

    sigma: the share that is serial or waits its turn; kappa: the cost of keeping threads coherent with each other.
    (Gunther, Guerrilla Capacity Planning, 2007.)
    """
    n, x = numpy.asarray(threads, float), numpy.asarray(throughput, float)
    # N/X is linear in the three unknowns: a starting point.
    a = solve(numpy.stack([numpy.ones_like(n), n - 1, n * (n - 1)], axis=1), n / x)[0]
    start = numpy.maximum([1 / max(a[0], 1e-300), a[1] / a[0], a[2] / a[0]], 0)
    return gaussNewton(lambda v, at: v[0] * at / (1 + v[1] * (at - 1) + v[2] * at * (at - 1)), start, n, x)


def amdahl(threads, throughput):
    """X(N) = X1 N / (1 + sigma (N-1)): usl without kappa; values X1, sigma."""
    n, x = numpy.asarray(threads, float), numpy.asarray(throughput, float)
    a = solve(numpy.stack([numpy.ones_like(n), n - 1], axis=1), n / x)[0]
    start = numpy.maximum([1 / max(a[0], 1e-300), a[1] / a[0]], 0)
    return gaussNewton(lambda v, at: v[0] * at / (1 + v[1] * (at - 1)), start, n, x)


def uslShared(threads, processors, throughput):
    """usl for more threads than processors: X = X1 c / (1 + sigma (c-1) + kappa N (N-1)); values X1, sigma, kappa.

    N threads run on c processors at a time (as many as the machine really gives them). Up to the number of processors
    it is the law itself. Threads beyond it add no c, but pairs all the same, so they tell kappa from sigma even where
    two processors alone leave three unknowns to two points.
    """
    n, c, x = (numpy.asarray(v, float) for v in (threads, processors, throughput))
    a = solve(numpy.stack([numpy.ones_like(n), c - 1, n * (n - 1)], axis=1), c / x)[0]
    start = numpy.maximum([1 / max(a[0], 1e-300), a[1] / a[0], a[2] / a[0]], 0)

    def model(v, at):
        return v[0] * at[1] / (1 + v[1] * (at[1] - 1) + v[2] * at[0] * (at[0] - 1))

    return gaussNewton(model, start, numpy.stack([n, c]), x)


def shown(value, half, digits=2):
    """"1.02 ± 0.03", with as many decimals as the half-width deserves."""
    if not math.isfinite(half) or half <= 0:
        return f"{value:.{digits}f}"
    decimals = min(max(digits, -math.floor(math.log10(half))), 6) if half < 1 else 0
    return f"{value:.{decimals}f} ± {half:.{decimals}f}"
