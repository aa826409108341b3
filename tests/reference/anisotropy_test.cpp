// Anisotropy: the lobe's shape and direction, and that glossy impulses follow it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/sampler.h"
#include "support/probe.h"

namespace whittle::test {
namespace {

/// Brushed along x.
reference::Surfel brushed(double roughness, double strength) {
  reference::Surfel s = whiteMetalAt({0, 1, 0}, roughness);
  s.grain = {1, 0, 0};
  s.stretch = strength * strength;
  return s;
}

Vec3 aslant(double x, double z) { return glm::normalize(Vec3(x, 1, z)); }

TEST(Anisotropy, OfNoStrengthIsTheRoundLobe) {
  const Vec3 w_o = aslant(0.5, 0.2), w_i = aslant(-0.3, 0.4);
  const double round = reference::spreadingBsdf(whiteMetalAt({0, 1, 0}, 0.4), w_i, w_o).x;
  EXPECT_NEAR(reference::spreadingBsdf(brushed(0.4, 0), w_i, w_o).x, round, 1e-12 * round);
}

/// At the normal the lobe is 1/(4 π α_t α_b); across the grain it falls off as GGX of α_b does, along it as
/// of α_t, as seen from above: with tangent t of the angle of h, D = 1/(π α_t α_b (cos² (1 + t²/α²))²).
TEST(Anisotropy, IsWiderAlongItsGrain) {
  const reference::Surfel s = brushed(0.5, 0.6);
  const double across = 0.25, along = 0.25 + 0.75 * 0.36;
  const Vec3 up(0, 1, 0);
  EXPECT_NEAR(reference::spreadingBsdf(s, up, up).x, 1 / (4 * reference::kPi * along * across), 1e-12);
  const auto expected = [&](double alpha, double angle) {
    const double t = std::tan(angle / 2), c2 = 1 / (1 + t * t);
    const double D = 1 / (reference::kPi * along * across * std::pow(c2 * (1 + t * t / (alpha * alpha)), 2));
    const double no = 1, ni = std::cos(angle);
    const double V = 0.5 / (ni * 1 + no * std::sqrt(alpha * alpha * (1 - ni * ni) + ni * ni));
    return D * V;
  };
  for (const double angle : {0.3, 0.8}) {
    const Vec3 alongGrain(std::sin(angle), std::cos(angle), 0),
        acrossGrain(0, std::cos(angle), std::sin(angle));
    EXPECT_NEAR(reference::spreadingBsdf(s, alongGrain, up).x, expected(along, angle), 1e-12);
    EXPECT_NEAR(reference::spreadingBsdf(s, acrossGrain, up).x, expected(across, angle), 1e-12);
  }
}

/// The direction out of a material's numbers: tangent x, normal y, so that the bitangent is −z.
TEST(Anisotropy, TurnsCounterClockwiseFromTheTangent) {
  Scene scene;
  Material m = mirror(glm::vec3(1));
  m.roughness = 0.5F;
  m.anisotropy = 0.5F;
  addFloor(scene, m, 0);
  scene.normals.assign(4, {0, 1, 0});
  scene.tangents.assign(4, {1, 0, 0, 1});
  for (const double angle : {0.0, 0.5, 2.0}) {
    scene.materials[0].anisotropyRotation = static_cast<float>(angle);
    Probe probe(scene);
    for (const double side : {1.0, -1.0}) {  // the grain lies in the surface, whoever looks
      const auto s = probe.surfelAlong({{0, side, 0}, {0, -side, 0}});
      ASSERT_TRUE(s);
      EXPECT_NEAR(glm::distance(s->grain, Vec3(std::cos(angle), 0, -std::sin(angle))), 0, 1e-7) << angle;
      EXPECT_NEAR(s->stretch, 0.25, 1e-12);
    }
  }
  // A texture turns it further and scales the strength: half a turn of its own is red 0.
  scene.images.push_back({"", 1, 1, {0, 128, 51, 255}});
  scene.uv0.assign(4, glm::vec2(0.5F));
  scene.materials[0].anisotropyTexture.image = 0;
  Probe probe(scene);
  const auto s = probe.surfelAlong({{0, 1, 0}, {0, -1, 0}});
  EXPECT_NEAR(glm::distance(s->grain, Vec3(-std::cos(2.0), 0, std::sin(2.0))), 0,
              0.005);  // code 128 is not 0
  EXPECT_NEAR(s->stretch, 0.01, 1e-9);
}

TEST(Anisotropy, HasNoDirectionWithoutTangents) {
  Scene scene;
  Material m = mirror(glm::vec3(1));
  m.anisotropy = 1;
  addFloor(scene, m, 0);
  Probe probe(scene);
  EXPECT_EQ(probe.surfelAlong({{0, 1, 0}, {0, -1, 0}})->grain, Vec3(0));
}

/// Quarter by quarter of the directions about the normal.
TEST(Anisotropy, GlossyImpulsesIntegrateTheLobe) {
  constexpr int kSteps = 800;
  constexpr std::uint32_t kSamples = 200000;
  const reference::Surfel s = brushed(0.5, 0.7);
  const Vec3 w_o = aslant(0.8, 0.5);
  std::array<double, 4> lobe{}, sums{}, squares{};
  const auto quarter = [](const Vec3& w) { return (w.x > 0 ? 0U : 1U) + (w.z > 0 ? 0U : 2U); };
  for (int a = 0; a < kSteps; ++a)
    for (int b = 0; b < kSteps; ++b) {
      const double c = (a + 0.5) / kSteps, angle = 2 * reference::kPi * (b + 0.5) / kSteps;
      const double sine = std::sqrt(1 - c * c);
      const Vec3 w_i(sine * std::cos(angle), c, sine * std::sin(angle));
      lobe[quarter(w_i)] +=
          reference::spreadingBsdf(s, w_i, w_o).x * c * 2 * reference::kPi / (kSteps * kSteps);
    }
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const Vec2 at(reference::unit(reference::hash(i, 0, 0, 9)), reference::unit(reference::hash(i, 0, 1, 9)));
    for (const auto& impulse : reference::impulsesOf(s, w_o, at).all()) {
      const double brought = impulse.magnitude.x / kSamples;
      sums[quarter(impulse.w_i)] += brought, squares[quarter(impulse.w_i)] += brought * impulse.magnitude.x;
    }
  }
  for (std::size_t q = 0; q < 4; ++q)
    EXPECT_NEAR(sums[q], lobe[q], 5 * std::sqrt((squares[q] - sums[q] * sums[q]) / kSamples) + 2e-4) << q;
}

}  // namespace
}  // namespace whittle::test
