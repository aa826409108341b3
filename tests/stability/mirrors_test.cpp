// Cases 13, 14, 26, 28 and a tunnel: many reflections in a row.
#include <cmath>

#include "forms.h"

namespace whittle::test {
namespace {

/// Says where it is met: red/green = (x + half) / (2 half). Lies at height y, seen from above or below.
void addRuler(Scene& scene, float y, float half) {
  Material ruler;
  ruler.doubleSided = true;
  ruler.unlit = true;
  const std::uint32_t m = addMaterial(scene, ruler);
  const std::size_t first = scene.positions.size();
  addQuad(scene, m, {-half, y, -half}, {0, 0, 2 * half}, {2 * half, 0, 0});
  scene.colors.resize(scene.positions.size(), glm::vec4(1));
  for (std::size_t v = first; v < scene.positions.size(); ++v)
    scene.colors[v] = {(scene.positions[v].x + half) / (2 * half), 1, 0, 1};
}

double rulerX(const FloatImage& image, double half, std::size_t pixel = 0) {
  return 2 * half * red(image, pixel) / green(image, pixel) - half;
}

TEST(CaseMirrors, ParallelOnesAreAGeometricSeries) {
  constexpr double kEmission = 2;
  for (const float rho : {0.75F, 0.999F, 1.0F}) {
    for (const int reflections : {1, 7, 64, 256}) {
      Material material = mirror(glm::vec3(rho));
      material.emission = glm::vec3(kEmission);
      Scene scene;
      addFloor(scene, material, 0, true);
      addFloor(scene, material, 1, false);
      scene.cameras = {rayCamera({0.1, 0.5, 0.2}, {0, 1, 0})};
      const Settings settings = caseSettings(1, 1, reflections + 1);
      const RenderResult kernel = seen(scene, settings);
      const ReferenceResult reference = renderReference(scene, settings);
      double series = 0;  // summed, not by the formula, which is 0/0 at 1
      for (int k = 0; k <= reflections; ++k) series += kEmission * std::pow(static_cast<double>(rho), k);
      Worst worst;
      worst.relative(red(kernel.radiance), series);
      worst.relative(red(reference.radiance), series);
      record({"14", fmt::format("facing mirrors of {}, emission 2, {} reflections", rho, reflections),
              "E (1 − ρ^(D+1)) / (1 − ρ)", worst.result(), worst.error(), "relative",
              1e-6 * std::max(1, reflections)});
    }
  }
}

/// Down a tunnel of facing mirrors at 45°: one reflection for each metre, and at the end a ruler.
TEST(CaseMirrors, ATunnelOfDepth256) {
  for (const int depth : {16, 64, 256}) {
    const auto length = static_cast<float>(depth);
    Scene scene;
    const std::uint32_t m = addMaterial(scene, mirror(glm::vec3(1)));
    addQuad(scene, m, {0, -1, -1}, {0, 0, 2}, {0, length + 1, 0});
    addQuad(scene, m, {1, -1, -1}, {0, length + 1, 0}, {0, 0, 2});
    addRuler(scene, -1, 4);
    addRuler(scene, length, 4);
    // Leaves the left wall's plane at height −0.5 + x: met at heights k + 0.5 − 0.25, k = 0, 1, …
    scene.cameras = {rayCamera({0.25, -0.5, 0}, {1, 1, 0})};
    const Views views = everyForm(scene, caseSettings(1, 1, depth + 1));
    // The way across, unfolded: x + the height won; folded back between 0 and 1.
    const double across = 0.25 + length + 0.5, folded = std::fmod(across, 2.0);
    const double expected = folded < 1 ? folded : 2 - folded;
    Worst worst;
    worst.absolute(rulerX(views.kernel.radiance, 4), expected);
    // Each hit is moved off its mirror by 2^-20 of its largest coordinate, to the inside: the way to the
    // next is that much shorter, and a ray at 45° climbs that much less. Half of it again for rounding.
    double drift = 1e-6;
    for (int k = 0; k < depth; ++k) drift += 1.5 * 0x1p-20 * std::max(1.0, k + 0.25);
    record({"O7", fmt::format("a tunnel of mirrors, {} reflections at 45°", depth),
            "where the unfolded ray meets the end, within the sum of the ray offsets", worst.result(),
            worst.error(), "m", drift});
    EXPECT_EQ(views.kernel.stats.rays.impulse, static_cast<std::uint64_t>(depth));
  }
}

/// Three mirrors at right angles: whatever comes goes back the way it came, beside itself. Two rulers tell
/// the direction that returns.
TEST(CaseMirrors, ACornerSendsLightBack) {
  const glm::dvec3 from(3, 8, 3.5), towards = glm::normalize(glm::dvec3(-0.7, -1, -0.8));
  // Where the way back, parallel to the way in and reflected in the corner, meets height y.
  const auto expected = [&](double y) { return -from.x + (y + from.y) / -towards.y * -towards.x; };
  double met[2];
  const double heights[] = {9, 19};
  for (int k = 0; k < 2; ++k) {
    Scene scene;
    const std::uint32_t m = addMaterial(scene, mirror(glm::vec3(1)));
    addQuad(scene, m, {0, 0, 0}, {8, 0, 0}, {0, 8, 0});
    addQuad(scene, m, {0, 0, 0}, {0, 8, 0}, {0, 0, 8});
    addQuad(scene, m, {0, 0, 0}, {0, 0, 8}, {8, 0, 0});
    addRuler(scene, static_cast<float>(heights[k]), 32);
    scene.cameras = {rayCamera(from, towards)};
    const Views views = everyForm(scene, caseSettings(1, 1, 64));
    EXPECT_EQ(views.kernel.stats.rays.impulse, 3U);
    met[k] = rulerX(views.kernel.radiance, 32);
    Worst worst;
    worst.absolute(met[k], expected(heights[k]));
    // Three ray offsets of 2^-20 · 8 m at the most, and some roundings of 32 m in the ruler.
    record({"26", fmt::format("three mirrors at right angles, 64 bounces; met {} m up", heights[k]),
            "beside the way in, mirrored in the corner", worst.result(), worst.error(), "m",
            2 * 3 * 8 * 0x1p-20 + 8 * 32 * 0x1p-24});
  }
  const double slope = (met[1] - met[0]) / (heights[1] - heights[0]), exact = towards.x / towards.y;
  record({"26", "the same: direction from both heights", "parallel to the way in",
          fmt::format("{:.8g} for {:.8g}", slope, exact), std::abs(slope / exact - 1), "relative",
          8 * 32 * 0x1p-24 / 10 + 1e-6});
}

/// Mirrors that reflect all, in uniform light: any path brings back exactly that light.
TEST(CaseMirrors, AreInvisibleInUniformLight) {
  constexpr int kDepth = 64;
  Scene scene;
  scene.background.radiance = glm::vec3(1);
  const auto ball = closedSphere({0, 0, 0}, 1, 8, 16);
  const std::uint32_t m = addMaterial(scene, mirror(glm::vec3(1)));
  for (const float x : {-1.1F, 1.1F}) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const glm::vec3& p : ball.positions) scene.positions.push_back(p + glm::vec3(x, 0, 0));
    for (const glm::uvec3& t : ball.triangles)
      scene.triangles.push_back({first + t.x, first + t.y, first + t.z, m});
  }
  scene.cameras = {rayCamera({0, 0.5, 5}, {0, -0.1, -1})};
  const Views views = everyForm(scene, caseSettings(32, 18, kDepth));
  Worst worst;
  for (const float v : views.kernel.radiance.pixels) worst.absolute(v, 1);
  record({"13", "two mirror balls in L = 1, 64 bounces", "1 everywhere", worst.result(), worst.error(),
          "absolute", 2e-6 * kDepth});
}

TEST(CaseMirrors, WhatUnderflowsIsNotTracedOn) {
  Scene scene;
  addFloor(scene, mirror(glm::vec3(1e-3F)), 0, true);
  addFloor(scene, mirror(glm::vec3(1e-3F)), 1, false);
  scene.cameras = {rayCamera({0.1, 0.5, 0.2}, {0, 1, 0})};
  const RenderResult result = seen(scene, caseSettings(1, 1, 64));
  EXPECT_EQ(colorOf(result), glm::vec3(0));
  // 1e-3^15 is the last power above half of the smallest subnormal, 1.4e-45: rays beyond are
  // time for nothing.
  const auto rays = static_cast<double>(result.stats.rays.impulse);
  record({"28", "facing mirrors of 1e-3, depth 64, no emission", "0, and no ray beyond 1e-3^15 (of 63)",
          fmt::format("{:g} rays", rays), std::max(0.0, rays - 15), "rays too many", 0});
}

}  // namespace
}  // namespace whittle::test
