// See keyframes.h; symbols as in appendix C of the specification.
#include "gltf/keyframes.h"

#include <algorithm>
#include <cmath>

namespace whittle::gltf {
namespace {

using Values = std::vector<double>;

double dot(const Values& a, const Values& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

Values combined(const Values& a, double ofA, const Values& b, double ofB) {
  Values out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = ofA * a[i] + ofB * b[i];
  return out;
}

Values normalized(Values q) {
  const double length = std::sqrt(dot(q, q));
  if (length > 0.0)
    for (double& c : q) c /= length;
  return q;
}

/// Spherical: along the shorter arc with constant speed. Below this angle its sines are no better than the
/// chord.
Values turned(const Values& from, Values to, double t) {
  constexpr double kStraight = 1e-6;
  double d = dot(from, to);
  if (d < 0.0) {  // q and −q are one turn
    for (double& c : to) c = -c;
    d = -d;
  }
  const double a = std::acos(std::min(d, 1.0));
  if (a < kStraight) return normalized(combined(from, 1 - t, to, t));
  return normalized(combined(from, std::sin(a * (1 - t)) / std::sin(a), to, std::sin(a * t) / std::sin(a)));
}

/// Element `element` of the list of values.
Values valuesOf(const Keyframes& keys, std::size_t element) {
  const auto begin = keys.values.begin() + static_cast<std::ptrdiff_t>(element * keys.width);
  return Values(begin, begin + static_cast<std::ptrdiff_t>(keys.width));
}

enum Part : std::size_t { kInTangent = 0, kValue = 1, kOutTangent = 2 };

/// Of keyframe k.
Values keyOf(const Keyframes& keys, std::size_t k, Part part = kValue) {
  Values values = valuesOf(keys, keys.interpolation == Interpolation::CubicSpline ? 3 * k + part : k);
  return keys.blend == Blend::Turn && part == kValue ? normalized(std::move(values)) : values;
}

/// Cubic Hermite spline; tangents are by the second.
Values splined(const Keyframes& keys, std::size_t k, double t, double t_d) {
  const double t2 = t * t, t3 = t2 * t;
  const Values values = combined(keyOf(keys, k), 2 * t3 - 3 * t2 + 1, keyOf(keys, k + 1), -2 * t3 + 3 * t2);
  const Values slopes = combined(keyOf(keys, k, kOutTangent), t_d * (t3 - 2 * t2 + t),
                                 keyOf(keys, k + 1, kInTangent), t_d * (t3 - t2));
  const Values sum = combined(values, 1, slopes, 1);
  return keys.blend == Blend::Turn ? normalized(sum) : sum;
}

}  // namespace

std::optional<Interpolation> interpolationCalled(std::string_view name) {
  if (name == "STEP") return Interpolation::Step;
  if (name == "LINEAR") return Interpolation::Linear;
  if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
  return std::nullopt;
}

std::vector<double> valueAt(const Keyframes& keys, double seconds) {
  const auto after = std::upper_bound(keys.times.begin(), keys.times.end(), seconds,
                                      [](double at, float time) { return at < static_cast<double>(time); });
  if (after == keys.times.begin()) return keyOf(keys, 0);
  const auto k = static_cast<std::size_t>(after - keys.times.begin()) - 1;
  if (after == keys.times.end() || keys.interpolation == Interpolation::Step) return keyOf(keys, k);
  const auto t_k = static_cast<double>(keys.times[k]);
  const double t_d = static_cast<double>(*after) - t_k, t = (seconds - t_k) / t_d;
  if (keys.interpolation == Interpolation::CubicSpline) return splined(keys, k, t, t_d);
  const Values from = keyOf(keys, k), to = keyOf(keys, k + 1);
  return keys.blend == Blend::Turn ? turned(from, to, t) : combined(from, 1 - t, to, t);
}

}  // namespace whittle::gltf
