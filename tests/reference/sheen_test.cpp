// Sheen: the albedo of the fibres, and that they and what lies below give off no more than they receive.
#include "reference/sheen.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/probe.h"

namespace whittle::test {
namespace {

constexpr int kSteps = 300;

/// ∫ f cosθ dω; finer towards grazing directions, where fibres scatter most.
double albedoOf(const reference::Surfel& s, double cosine) {
  const Vec3 w_o(std::sqrt(1 - cosine * cosine), cosine, 0);
  double sum = 0;
  for (int a = 0; a < kSteps; ++a)
    for (int b = 0; b < kSteps; ++b) {
      const double root = (a + 0.5) / kSteps, c = root * root, sine = std::sqrt(1 - c * c);
      const double angle = reference::kPi * (b + 0.5) / kSteps;
      const Vec3 w_i(sine * std::cos(angle), c, sine * std::sin(angle));
      sum += reference::spreadingBsdf(s, w_i, w_o).x * c * root * 4 * reference::kPi / (kSteps * kSteps);
    }
  return sum;
}

/// White cloth, or fibres alone over black.
reference::Surfel cloth(double below, double sheen, double roughness) {
  reference::Surfel s = whiteMetalAt({0, 1, 0}, 1);
  s.metallic = 0, s.glossy = false, s.baseColor = Vec3(below), s.fresnel = {1.5, 0, Vec3(1)};
  s.sheen = {Vec3(sheen), roughness};
  return s;
}

TEST(Sheen, TheTableIsTheLobesIntegral) {
  for (const double roughness : {0.2, 0.4, 0.6, 1.0})  // rows of it
    for (const int column : {1, 4, 9, 15}) {
      const double cosine = column * column / 225.0;
      const double albedo = albedoOf(cloth(0, 1, roughness), cosine);
      const double expected = std::min(1.0, reference::fibreAlbedo(roughness, cosine));
      EXPECT_NEAR(albedo, expected, 2e-3 * expected + 1e-5) << roughness << ' ' << cosine;
    }
}

/// Where the table is interpolated it may be off by a hundredth or two.
TEST(Sheen, GivesOffNoMoreThanItReceives) {
  for (const double roughness : {0.0, 0.15, 0.3, 0.5, 0.75, 1.0})
    for (const double cosine : {0.02, 0.1, 0.4, 0.8, 1.0}) {
      const double albedo = albedoOf(cloth(1, 1, roughness), cosine);
      EXPECT_LT(albedo, 1.02) << roughness << ' ' << cosine;
      EXPECT_GT(albedo, 0.5) << roughness << ' ' << cosine;  // most of what is below still shows
    }
}

TEST(Sheen, DimsWhatLiesBelow) {
  const Vec3 w_o = glm::normalize(Vec3(0.5, 0.4, 0)), w_i = glm::normalize(Vec3(-0.2, 0.9, 0.3));
  for (const double roughness : {0.3, 0.9}) {
    const double dim =
        std::max(reference::fibreAlbedo(roughness, w_o.y), reference::fibreAlbedo(roughness, w_i.y));
    const Vec3 fibres = reference::spreadingBsdf(cloth(0, 0.5, roughness), w_i, w_o);
    const Vec3 plain = reference::spreadingBsdf(cloth(0.8, 0, roughness), w_i, w_o);
    const Vec3 both = reference::spreadingBsdf(cloth(0.8, 0.5, roughness), w_i, w_o);
    EXPECT_NEAR(both.x, fibres.x + (1 - 0.5 * dim) * plain.x, 1e-12);
    EXPECT_GT(dim, 1e-3);
  }
}

/// A mirror below: what it sends back of a white sky, and what fibres take of it.
TEST(Sheen, DimsImpulses) {
  Scene scene;
  Material m = mirror(glm::vec3(1));
  m.sheenColor = {0.8F, 0, 0};
  m.sheenRoughness = 0.5F;
  addFloor(scene, m, 0);
  scene.background.radiance = glm::vec3(1);
  Probe probe(scene);
  const Vec3 d = glm::normalize(Vec3(1, -0.5, 0));
  EXPECT_NEAR(probe.Li(-d, d).y, 1 - static_cast<double>(0.8F) * reference::fibreAlbedo(0.5, -d.y), 1e-9);
}

}  // namespace
}  // namespace whittle::test
