// Least squares of relative errors by Gauss and Newton, no parameter below 0; intervals are Student's t times
// the standard error (Draper and Smith, Applied Regression Analysis). They speak of the scatter about the
// law: where the law is wrong they are too narrow, so the residual is given beside.
#include "measure/scaling_laws.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace whittle {
namespace {

constexpr std::size_t kMost = 3;
using Values = std::array<double, kMost>;  // rate, serial, crosstalk
using Matrix = std::array<std::array<double, kMost>, kMost>;

double modelRate(const Values& v, double threads, double processors) {
  return v[0] * processors / (1.0 + v[1] * (processors - 1.0) + v[2] * threads * (threads - 1.0));
}

/// The inverse of the first `count` rows and columns by Gauss and Jordan with pivots; false: singular.
bool invert(Matrix m, std::size_t count, Matrix& inverse) {
  inverse = {};
  for (std::size_t i = 0; i < count; ++i) inverse[i][i] = 1.0;
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i + 1; r < count; ++r)
      if (std::abs(m[r][i]) > std::abs(m[pivot][i])) pivot = r;
    if (!(std::abs(m[pivot][i]) > 1e-12)) return false;
    std::swap(m[i], m[pivot]), std::swap(inverse[i], inverse[pivot]);
    const double scale = 1.0 / m[i][i];
    for (std::size_t c = 0; c < count; ++c) m[i][c] *= scale, inverse[i][c] *= scale;
    for (std::size_t r = 0; r < count; ++r) {
      if (r == i) continue;
      const double factor = m[r][i];
      for (std::size_t c = 0; c < count; ++c) {
        m[r][c] -= factor * m[i][c];
        inverse[r][c] -= factor * inverse[i][c];
      }
    }
  }
  return true;
}

/// Sum of squares of the relative residuals.
double squares(const Values& v, const std::vector<ScalingPoint>& points) {
  double sum = 0.0;
  for (const ScalingPoint& p : points) {
    const double r = 1.0 - modelRate(v, p.threads, p.processors) / p.rate;
    sum += r * r;
  }
  return sum;
}

/// J'J and J'r of the relative residuals, with columns of length 1: parameters of very different sizes would
/// make the matrix look singular. `lengths`: of the columns.
struct Normal {
  Matrix matrix{};
  Values right{}, lengths{};
};

Normal normalEquations(const Values& v, std::size_t count, const std::vector<ScalingPoint>& points) {
  std::vector<Values> rows;
  Normal n;
  for (const ScalingPoint& p : points) {
    // d/dv of rate / measured, in closed form.
    const double model = modelRate(v, p.threads, p.processors) / p.rate;
    const double below = p.processors * v[0] / (model * p.rate);
    const Values row{model / v[0], -model * (p.processors - 1.0) / below,
                     -model * p.threads * (p.threads - 1.0) / below};
    for (std::size_t i = 0; i < count; ++i) n.lengths[i] += row[i] * row[i];
    rows.push_back(row);
  }
  for (std::size_t i = 0; i < count; ++i) n.lengths[i] = std::max(std::sqrt(n.lengths[i]), 1e-300);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double r = 1.0 - modelRate(v, points[k].threads, points[k].processors) / points[k].rate;
    for (std::size_t i = 0; i < count; ++i) {
      n.right[i] += rows[k][i] / n.lengths[i] * r;
      for (std::size_t j = 0; j < count; ++j)
        n.matrix[i][j] += rows[k][i] * rows[k][j] / (n.lengths[i] * n.lengths[j]);
    }
  }
  return n;
}

Values stepped(const Values& v, const Values& step, double scale) {
  Values next = v;
  for (std::size_t i = 0; i < kMost; ++i) next[i] = std::max(v[i] + scale * step[i], i == 0 ? 1e-300 : 0.0);
  return next;
}

ScalingFit fitLaw(const std::vector<ScalingPoint>& points, std::size_t count) {
  std::set<double> different;
  for (const ScalingPoint& p : points) different.insert(p.threads);
  if (different.size() <= count)
    return {{}, fmt::format("{} numbers of threads; it takes {}", different.size(), count + 1)};
  Values v{points.front().rate / points.front().processors, 0.05, count > 2 ? 0.001 : 0.0};
  for (int i = 0; i < 200; ++i) {
    const Normal n = normalEquations(v, count, points);
    Matrix inverse;
    if (!invert(n.matrix, count, inverse)) return {{}, "the numbers of threads do not tell its parts apart"};
    Values step{};
    for (std::size_t r = 0; r < count; ++r) {
      for (std::size_t c = 0; c < count; ++c) step[r] += inverse[r][c] * n.right[c];
      step[r] /= n.lengths[r];
    }
    double scale = 1.0;
    const double before = squares(v, points);
    while (scale > 1e-6 && squares(stepped(v, step, scale), points) > before) scale /= 2.0;
    if (scale <= 1e-6) break;
    v = stepped(v, step, scale);
  }
  const Normal n = normalEquations(v, count, points);
  Matrix inverse;
  if (!invert(n.matrix, count, inverse)) return {{}, "the numbers of threads do not tell its parts apart"};
  const auto freedom = static_cast<int>(points.size() - count);
  const double variance = squares(v, points) / freedom;
  const auto estimate = [&](std::size_t i) {
    return Estimate{v[i], studentT(freedom) * std::sqrt(variance * inverse[i][i]) / n.lengths[i]};
  };
  ScalingLaw law{
      estimate(0), estimate(1), {}, std::sqrt(squares(v, points) / static_cast<double>(points.size()))};
  if (count > 2) law.crosstalk = estimate(2);
  if (!(law.serial.half < 1.0))
    return {{}, fmt::format("the serial share would be {:.2f} ± {:.2f}", law.serial.value, law.serial.half)};
  return {law, ""};
}

/// The chance of |T| < t (Abramowitz and Stegun, 26.7.3 and 26.7.4).
double studentBetween(double t, int freedom) {
  const double theta = std::atan(t / std::sqrt(static_cast<double>(freedom)));
  const double sine = std::sin(theta), cosine = std::cos(theta);
  const bool isOdd = freedom % 2 == 1;
  double term = isOdd ? cosine : 1.0, total = freedom > 1 ? term : 0.0;
  for (int k = isOdd ? 3 : 2; k < freedom - 1; k += 2) {
    term *= cosine * cosine * (k - 1) / k;
    total += term;
  }
  return isOdd ? (theta + sine * total) * 2.0 / std::numbers::pi : sine * total;
}

}  // namespace

double ScalingLaw::at(double threads, double processors) const {
  return modelRate({rate.value, serial.value, crosstalk.value}, threads, processors);
}

ScalingFit fitAmdahl(const std::vector<ScalingPoint>& points) { return fitLaw(points, 2); }
ScalingFit fitUniversal(const std::vector<ScalingPoint>& points) { return fitLaw(points, 3); }

double studentT(int freedom) {
  double low = 0.0, high = 1e4;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2.0;
    (studentBetween(middle, freedom) < 0.95 ? low : high) = middle;
  }
  return low;
}

}  // namespace whittle
