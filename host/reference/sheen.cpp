// The lobe of fibres and its integral over the hemisphere.
#include "reference/sheen.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace whittle::reference {
namespace {

constexpr double kLeastRoughness = 0.07, kLeastCosine = 1e-4;
constexpr std::size_t kSteps = 15;  // of the table, each way

double alphaOfFibres(double roughness) { return square(std::max(roughness, kLeastRoughness)); }

/// The fit of the paper's table 1 for the roughest and the smoothest fibres, blended.
double fit(double x, double alpha) {
  constexpr std::array kRough{21.5473, 3.82987, 0.19823, -1.97760, -4.32054};
  constexpr std::array kSmooth{25.3245, 3.32435, 0.16801, -1.27393, -4.85967};
  std::array<double, 5> p{};
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = std::lerp(kRough[i], kSmooth[i], square(1 - alpha));
  return p[0] / (1 + p[1] * std::pow(x, p[2])) + p[3] * x + p[4];
}

double lambda(double cosine, double alpha) {
  if (cosine < 0.5) return std::exp(fit(cosine, alpha));
  return std::exp(2 * fit(0.5, alpha) - fit(1 - cosine, alpha));
}

using Table = std::array<std::array<double, kSteps + 1>, kSteps + 1>;

/// [roughness][root of the cosine]
Table albedoTable() {
  Table table{};
  for (std::size_t r = 0; r <= kSteps; ++r)
    for (std::size_t c = 0; c <= kSteps; ++c)
      table[r][c] =
          integratedFibreAlbedo(static_cast<double>(r) / kSteps, square(static_cast<double>(c) / kSteps));
  return table;
}

}  // namespace

double fibreLobe(double roughness, double cosO, double cosI, double cosH) {
  const double alpha = alphaOfFibres(roughness);
  const double o = std::max(cosO, kLeastCosine), i = std::max(cosI, kLeastCosine);
  const double sine = std::sqrt(std::max(0.0, 1 - cosH * cosH));
  const double D = (2 + 1 / alpha) * std::pow(sine, 1 / alpha) / (2 * kPi);
  return D / ((1 + lambda(o, alpha) + lambda(i, alpha)) * 4 * o * i);
}

double integratedFibreAlbedo(double roughness, double cosine) {
  constexpr int kCosines = 160, kAngles = 96;  // within 1e-5, as four times as many show
  const double o = std::max(cosine, kLeastCosine), sinO = std::sqrt(1 - std::min(1.0, o * o));
  double sum = 0;
  for (int i = 0; i < kCosines; ++i) {
    const double root = (i + 0.5) / kCosines, cosI = root * root, sinI = std::sqrt(1 - cosI * cosI);
    for (int j = 0; j < kAngles; ++j) {
      const double angle = kPi * (j + 0.5) / kAngles;
      const Vec3 h = glm::normalize(Vec3(sinO + sinI * std::cos(angle), sinI * std::sin(angle), o + cosI));
      sum += fibreLobe(roughness, o, cosI, h.z) * cosI * root;
    }
  }
  return sum * 4 * kPi / (kCosines * kAngles);
}

double fibreAlbedo(double roughness, double cosine) {
  static const Table kTable = albedoTable();
  const double r = roughness * kSteps, c = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * kSteps;
  const auto row = std::min(static_cast<std::size_t>(r), kSteps - 1);
  const auto column = std::min(static_cast<std::size_t>(c), kSteps - 1);
  const double v = r - static_cast<double>(row), u = c - static_cast<double>(column);
  return std::lerp(std::lerp(kTable[row][column], kTable[row][column + 1], u),
                   std::lerp(kTable[row + 1][column], kTable[row + 1][column + 1], u), v);
}

}  // namespace whittle::reference
