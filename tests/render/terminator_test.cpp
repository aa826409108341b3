// Where shadow begins on coarse triangles with smooth normals.
#include <cmath>
#include <numbers>

#include "analysis/radiance_bound.h"
#include "scene/coarse_normals.h"
#include "support/agreement.h"
#include "support/single_rays.h"
#include "support/spheres.h"

namespace whittle::test {
namespace {

Light sunFrom(const glm::vec3& place) {
  Light light;
  light.kind = LightKind::Directional;
  light.direction = -glm::normalize(place);
  light.intensity = glm::vec3(3);
  return light;
}

/// A ball of radius 1 with smooth normals, seen straight on so that it fills the picture's height, lit from
/// the side.
Scene litBall(std::uint32_t rings, std::uint32_t sectors) {
  Scene scene;
  addSphere(scene, addMaterial(scene, lambert(glm::vec3(1))), {0, 0, 0}, 1, rings, sectors, true);
  scene.lights = {sunFrom({1, 0.3F, 0.1F})};
  Camera camera;
  camera.orthographic = true;
  camera.position = {0, 0, 4};
  scene.cameras = {camera};
  return scene;
}

Settings shaded(bool smooth) {
  Settings settings;
  settings.width = settings.height = 96;
  settings.bounces = 1;
  settings.smoothTerminator = smooth;
  return settings;
}

/// Over what both pictures show of the ball: within nine tenths of its radius, as coarse ones are smaller.
template <typename Visit>
void eachOnBall(const RenderResult& a, const RenderResult& b, const Visit& visit) {
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      const double u = (x + 0.5) / 48 - 1, v = (y + 0.5) / 48 - 1;
      const auto i = static_cast<std::size_t>(96 * y + x);
      if (u * u + v * v < 0.81)
        visit(static_cast<double>(colorOf(a, i).x), static_cast<double>(colorOf(b, i).x));
    }
}

double rmse(const RenderResult& a, const RenderResult& b) {
  double squares = 0, count = 0;
  eachOnBall(a, b, [&](double one, double other) { squares += std::pow(one - other, 2), ++count; });
  return std::sqrt(squares / count);
}

/// Pixels that are black though a fine ball is lit there, by as much as light 3° above the horizon at least.
int blackFacets(const RenderResult& coarse, const RenderResult& fine) {
  int count = 0;
  const double least = 3 / std::numbers::pi * std::sin(3 * std::numbers::pi / 180);
  eachOnBall(coarse, fine, [&](double own, double right) { count += own == 0 && right > least; });
  return count;
}

TEST(Terminator, ACoarseBallIsLitAsAFineOne) {
  const RenderResult fine = renderOnDevice(litBall(256, 512), shaded(false));
  for (const auto& [rings, sectors] : {std::pair(8U, 16U), std::pair(16U, 32U)}) {
    const Scene coarse = litBall(rings, sectors);
    const RenderResult faceted = renderOnDevice(coarse, shaded(false));
    const RenderResult smooth = renderOnDevice(coarse, shaded(true));
    EXPECT_GT(blackFacets(faceted, fine), 10) << "what this is about";
    EXPECT_EQ(blackFacets(smooth, fine), 0);
    EXPECT_LT(rmse(smooth, fine), rmse(faceted, fine) / 2) << rings;
  }
}

/// A lamp near the ball: shadow rays from the curved surface end at the lamp, not before or behind it.
TEST(Terminator, ALampNearbyLightsIt) {
  Scene fine = litBall(256, 512), coarse = litBall(8, 16);
  fine.lights = coarse.lights = {pointLight({0.9F, 0.4F, 1}, 1)};
  const RenderResult right = renderOnDevice(fine, shaded(false));
  const RenderResult smooth = renderOnDevice(coarse, shaded(true));
  EXPECT_EQ(blackFacets(smooth, right), 0);
  EXPECT_LT(rmse(smooth, right), rmse(renderOnDevice(coarse, shaded(false)), right));
}

/// On the inside the triangles lie before the surface that they stand for: nothing is lifted, nothing
/// changes.
TEST(Terminator, TheInsideOfABallKeepsEveryBit) {
  Scene scene = litBall(8, 16);
  scene.materials[0].doubleSided = true;
  scene.cameras[0].position = {0, 0, 0};
  scene.lights = {pointLight({0.2F, 0.1F, -0.3F}, 1)};
  const RenderResult smooth = renderOnDevice(scene, shaded(true)),
                     plain = renderOnDevice(scene, shaded(false));
  EXPECT_EQ(differingPixels(smooth.radiance, plain.radiance), 0U);
  EXPECT_TRUE(uses(smooth.stats, "terminator"));
}

TEST(Terminator, WhatIsFlatOrFineOrSharpDoesWithoutIt) {
  Scene floor;
  addFloor(floor, lambert(glm::vec3(1)), 0, true, 2);
  EXPECT_FALSE(hasCoarseNormals(floor));
  floor.normals.assign(floor.positions.size(), {0, 1, 0});
  EXPECT_FALSE(hasCoarseNormals(floor));
  floor.lights = {sunFrom({1, 1, 0})};
  floor.cameras = {lookingDown()};
  const RenderResult smooth = renderOnDevice(floor, shaded(true)),
                     plain = renderOnDevice(floor, shaded(false));
  EXPECT_EQ(differingPixels(smooth.radiance, plain.radiance), 0U);
  EXPECT_FALSE(uses(smooth.stats, "terminator"));
  // Triangles of a ball are off its normals by at most about π / rings.
  EXPECT_FALSE(hasCoarseNormals(litBall(400, 800)));
  EXPECT_TRUE(hasCoarseNormals(litBall(100, 200)));
  for (auto& n : floor.normals) n = glm::normalize(glm::vec3(1, 0.5F, 0));  // 63° off
  EXPECT_FALSE(hasCoarseNormals(floor));
  floor.normals.assign(floor.positions.size(), glm::normalize(glm::vec3(0.3F, 1, 0)));
  floor.normals[0] = glm::vec3(0);  // both triangles have that vertex
  EXPECT_FALSE(hasCoarseNormals(floor));
  floor.normals[0] = floor.normals[1];
  EXPECT_TRUE(hasCoarseNormals(floor));
}

/// A wall of a millimetre whose normals make it a field of cushions: lamps behind it, which the normals would
/// let in, leave it dark. The picture keeps away from its rim, over which a cushion would be lit.
TEST(Terminator, NoLightLeaksThroughAThinWall) {
  constexpr int kCells = 20;
  Scene scene;
  const auto white = addMaterial(scene, lambert(glm::vec3(1)));
  const float step = 2.0F / kCells;
  for (int i = 0; i < kCells * kCells; ++i) {
    const glm::vec3 corner(-1 + step * static_cast<float>(i % kCells),
                           -1 + step * static_cast<float>(i / kCells), 0);
    for (const float side : {1.0F, -1.0F}) {
      const glm::vec3 x(step, 0, 0), y(0, step, 0), back(0, 0, side > 0 ? 0 : 0.001F);
      addQuad(scene, white, corner - back, side > 0 ? x : y, side > 0 ? y : x);
      const glm::vec3 middle = corner + (x + y) / 2.0F;
      for (auto p = scene.positions.end() - 4; p != scene.positions.end(); ++p)
        scene.normals.push_back(
            glm::normalize(glm::vec3(8.0F * (p->x - middle.x), 8.0F * (p->y - middle.y), side)));
    }
  }
  ASSERT_TRUE(hasCoarseNormals(scene));
  Camera camera;
  camera.orthographic = true;
  camera.position = {0, 0, 2};
  camera.ymag = 0.5F;
  scene.cameras = {camera};
  scene.lights = {sunFrom({0.9F, 0.2F, -0.15F}), pointLight({0.8F, 0.2F, -0.1F}, 1)};
  const RenderResult result = renderOnDevice(scene, shaded(true));
  EXPECT_TRUE(uses(result.stats, "terminator"));
  EXPECT_GT(result.stats.rays.shadow, 1000U) << "the normals would let light in";
  for (const float value : result.radiance.pixels) EXPECT_EQ(value, 0);
  for (Light& light : scene.lights) light.castsShadows = false;
  EXPECT_GT(meanRadiance(renderOnDevice(scene, shaded(true)).radiance), 0);
}

/// Lamps with a place and without, of some size, in several materials; glass that shadow rays pass.
TEST(Terminator, AgreesWithTheReference) {
  Scene scene = litBall(8, 16);
  scene.lights.push_back(pointLight({-1, 1.5F, 2}, 4));
  addSphere(scene, addMaterial(scene, glass(1.5F, true)), {0.9F, 0.5F, 0.8F}, 0.4F, 6, 12, true);
  Settings settings = smallSettings(4);
  for (const float radius : {0.0F, 0.2F}) {
    settings.lightRadius = radius;
    expectAgreement(compareWithReference(scene, settings), "balls", 60);
  }
}

}  // namespace
}  // namespace whittle::test
