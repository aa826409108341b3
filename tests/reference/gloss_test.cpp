// Glossy impulses: the distribution of their directions, and what they bring of a white sky, against
// quadrature of the microfacet lobe that lights meet.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reference/bsdf.h"
#include "reference/sampler.h"
#include "support/probe.h"

namespace whittle::test {
namespace {

/// Its normal is tilted off every axis.
reference::Surfel whiteMetal(double roughness) {
  return whiteMetalAt(glm::normalize(Vec3(0.3, 0.8, -0.5)), roughness);
}

/// A direction at that angle to the surfel's normal, turned about it.
Vec3 direction(const reference::Surfel& s, double cosine, double angle) {
  const auto [right, up] = reference::basisAbout(s.n);
  const double sine = std::sqrt(1 - cosine * cosine);
  return cosine * s.n + sine * (std::cos(angle) * right + std::sin(angle) * up);
}

Vec2 random(std::uint32_t i) {
  return {reference::unit(reference::hash(i, 0, 0, 7)), reference::unit(reference::hash(i, 0, 1, 7))};
}

/// ∫ f cosθ dω over the cells [cos][angle] of the hemisphere, of channel x.
std::vector<double> lobeOfCells(const reference::Surfel& s, const Vec3& w_o, int cells, int steps) {
  std::vector<double> sums(static_cast<std::size_t>(cells * cells), 0.0);
  const int n = cells * steps;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const double cosine = (a + 0.5) / n;
      const Vec3 w_i = direction(s, cosine, 2 * reference::kPi * (b + 0.5) / n);
      sums[static_cast<std::size_t>(a / steps * cells + b / steps)] +=
          reference::spreadingBsdf(s, w_i, w_o).x * cosine * 2 * reference::kPi / n / n;
    }
  return sums;
}

/// What impulses bring from each cell is what the lobe integrates to there: directions and magnitudes
/// together.
TEST(Gloss, ImpulsesIntegrateTheLobe) {
  constexpr int kCells = 6;
  constexpr std::uint32_t kSamples = 400000;
  for (const double roughness : {0.4, 0.7, 1.0})
    for (const double cosine : {0.95, 0.5, 0.15}) {
      const reference::Surfel s = whiteMetal(roughness);
      const Vec3 w_o = direction(s, cosine, 0.7);
      const auto expected = lobeOfCells(s, w_o, kCells, 120);
      std::vector<double> sums(expected.size(), 0.0), squares(expected.size(), 0.0);
      const auto [right, up] = reference::basisAbout(s.n);
      for (std::uint32_t i = 0; i < kSamples; ++i) {
        for (const auto& impulse : reference::impulsesOf(s, w_o, random(i)).all()) {
          const double c = glm::dot(impulse.w_i, s.n);
          double angle = std::atan2(glm::dot(impulse.w_i, up), glm::dot(impulse.w_i, right));
          if (angle < 0) angle += 2 * reference::kPi;
          const auto cell = static_cast<std::size_t>(
              std::min(kCells - 1, static_cast<int>(c * kCells)) * kCells +
              std::min(kCells - 1, static_cast<int>(angle / (2 * reference::kPi) * kCells)));
          sums[cell] += impulse.magnitude.x, squares[cell] += impulse.magnitude.x * impulse.magnitude.x;
        }
      }
      double chi = 0;
      int counted = 0;
      for (std::size_t i = 0; i < sums.size(); ++i) {
        const double mean = sums[i] / kSamples;
        const double variance = std::max(squares[i] / kSamples - mean * mean, 1e-12) / kSamples;
        if (expected[i] < 1e-4) continue;
        chi += (mean - expected[i]) * (mean - expected[i]) / variance;
        ++counted;
      }
      // χ² of `counted` degrees: mean `counted`, deviation sqrt(2 counted); five deviations.
      EXPECT_LT(chi, counted + 5 * std::sqrt(2.0 * counted))
          << "roughness " << roughness << " cosine " << cosine;
      EXPECT_GT(counted, 5);
    }
}

/// What a lossless GGX mirror of that α sends back of a white sky when light is scattered once:
/// ∫ D(m) G2 (w_o·m) / cosθ_o dω_m, with the heights of masking and shadowing correlated (Heitz 2014,
/// equations 15 and 99). In u, φ where D(m) (n·m) dω_m is du dφ / 2π; shares no code with the renderer.
double albedoByNormals(double alpha, double cosine) {
  constexpr int kSteps = 1000;
  const auto lambda = [&](double c) {
    return (std::sqrt(1 + alpha * alpha * (1 - c * c) / (c * c)) - 1) / 2;
  };
  const Vec3 w_o(std::sqrt(1 - cosine * cosine), 0, cosine);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double u = (i + 0.5) / kSteps, phi = reference::kPi * (j + 0.5) / kSteps;
      const double slope = alpha * std::sqrt(u / (1 - u));
      const Vec3 m = glm::normalize(Vec3(slope * std::cos(phi), slope * std::sin(phi), 1));
      const double facing = glm::dot(w_o, m), back = 2 * facing * m.z - cosine;
      if (facing > 0 && back > 0) sum += facing / m.z / (1 + lambda(cosine) + lambda(back));
    }
  return sum / cosine / kSteps / kSteps;
}

/// What comes back is what single scattering leaves, never more than there is.
TEST(Gloss, AWhiteSkyComesBackAsSingleScatteringLeavesIt) {
  constexpr int kSamples = 20000;
  for (const double roughness : {0.25, 0.5, 1.0})
    for (const double cosine : {1.0, 0.6, 0.05}) {
      const reference::Surfel s = whiteMetal(roughness);
      const Vec3 w_o = direction(s, cosine, 2);
      double sum = 0, squares = 0;
      for (std::uint32_t i = 0; i < kSamples; ++i)
        for (const auto& impulse : reference::impulsesOf(s, w_o, random(i)).all()) {
          ASSERT_LE(impulse.magnitude.x, 1 + 1e-12);
          sum += impulse.magnitude.x, squares += impulse.magnitude.x * impulse.magnitude.x;
        }
      const double mean = sum / kSamples;
      EXPECT_LE(mean, 1);
      // Five standard errors, and what the midpoints of the quadrature are off.
      const double error = std::sqrt(std::max(squares / kSamples - mean * mean, 0.0) / kSamples);
      EXPECT_NEAR(mean, albedoByNormals(roughness * roughness, cosine), 5 * error + 1e-4)
          << "roughness " << roughness << " cosine " << cosine;
    }
}

/// Light that goes the way back meets the same lobe.
TEST(Gloss, TheLobeIsReciprocal) {
  const reference::Surfel s = whiteMetal(0.5);
  const Vec3 a = direction(s, 0.9, 1), b = direction(s, 0.3, 4);
  EXPECT_NEAR(reference::spreadingBsdf(s, a, b).x, reference::spreadingBsdf(s, b, a).x, 1e-12);
}

}  // namespace
}  // namespace whittle::test
