// The sky around a scene: the map as the reference sees it, turned or not.
#include <fmt/format.h>

#include <cmath>

#include "support/agreement.h"
#include "support/random_scenes.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

/// A row of texels 0, 1, 2, 3, centres at u = 1/8, 3/8, 5/8, 7/8; straight ahead (-Z) is u = 1/2, +X is 3/4.
Scene fourTexels() {
  Scene scene;
  scene.background = {glm::vec3(1), 4, 1, {}};
  for (int i = 0; i < 4; ++i)
    scene.background.map.insert(scene.background.map.end(), 3, static_cast<float>(i));
  return scene;
}

float ahead(Scene scene, double degrees) {
  scene.background.rotation = degrees;
  return shot(scene, {0, 0, 0}, {0, 0, -1}, 1).x;
}

TEST(Background, TurnsCounterClockwiseSeenFromAbove) {
  const Scene scene = fourTexels();
  // Single precision: 1e-7 of a turn is 4e-7 texels.
  EXPECT_NEAR(ahead(scene, 0), 1.5, 2e-6);
  EXPECT_NEAR(ahead(scene, 45), 2, 2e-6) << "what was to the right";
  EXPECT_NEAR(ahead(scene, 90), 2.5, 2e-6) << "what was at +X";
  EXPECT_NEAR(ahead(scene, 135), 3, 2e-6);
  EXPECT_NEAR(ahead(scene, 180), 1.5, 2e-6) << "texels 3 and 0";
  EXPECT_NEAR(ahead(scene, -180), 1.5, 2e-6);
  EXPECT_NEAR(ahead(scene, 225), 0, 2e-6);
  EXPECT_NEAR(ahead(scene, -45), 1, 2e-6);
  EXPECT_NEAR(ahead(scene, 3600045), 2, 2e-6) << "whole turns change nothing";
}

/// Every direction, seen directly and in a mirror, with texels as different as they come.
Scene mirrorUnderASky() {
  Scene scene;
  addFloor(scene, mirror({0.9F, 0.8F, 0.7F}), 0, true, 4);
  scene.background = {glm::vec3(1, 0.5F, 2), 7, 5, {}};
  Rng rng(3);
  for (int i = 0; i < 7 * 5 * 3; ++i) scene.background.map.push_back(rng.between(0.5F, 1.5F));
  Camera camera;
  camera.position = {0.3F, 1, 2};
  camera.yfov = 2.2F;
  aim(camera, {0.2, -0.3, -1});
  scene.cameras = {camera};
  return scene;
}

TEST(Background, ATurnedMapAgreesWithTheReference) {
  for (const double degrees : {0.0, 30.0, -137.5, 180.0, 1000.0}) {
    Scene scene = mirrorUnderASky();
    scene.background.rotation = degrees;
    expectAgreement(compareWithReference(scene, wholeSettings(3)), fmt::format("turned by {}", degrees), 2);
  }
}

TEST(Background, WholeTurnsKeepEveryBit) {
  Scene scene = mirrorUnderASky();
  const RenderResult base = renderOnDevice(scene, wholeSettings(3));
  scene.background.rotation = -720;
  EXPECT_EQ(differingPixels(base.radiance, renderOnDevice(scene, wholeSettings(3)).radiance), 0U);
  scene.background.rotation = 1;
  EXPECT_GT(differingPixels(base.radiance, renderOnDevice(scene, wholeSettings(3)).radiance), 0U);
}

}  // namespace
}  // namespace whittle::test
