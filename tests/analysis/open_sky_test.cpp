// How much of the sky reaches what a camera sees: in the open, before a wall, in a room with and without a
// window.
#include "analysis/open_sky.h"

#include <gtest/gtest.h>

#include "support/probe.h"

namespace whittle::test {
namespace {

constexpr float kFar = 1000;

/// From (0, 2, 5) along -z, 90° high and wide.
Camera eyeOfTheRoom() {
  Camera camera;
  camera.position = {0, 2, 5};
  camera.yfov = 1.5708F;
  return camera;
}

/// A floor of 20 m, walls of 5 m and a ceiling with a hole in its middle that is `open` m wide; none: closed.
Scene room(float open) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, 10);
  const float h = 5, s = 10, w = open / 2;
  addQuad(scene, 0, {-s, 0, -s}, {2 * s, 0, 0}, {0, h, 0});
  addQuad(scene, 0, {-s, 0, s}, {2 * s, 0, 0}, {0, h, 0});
  addQuad(scene, 0, {-s, 0, -s}, {0, 0, 2 * s}, {0, h, 0});
  addQuad(scene, 0, {s, 0, -s}, {0, 0, 2 * s}, {0, h, 0});
  addQuad(scene, 0, {-s, h, -s}, {s - w, 0, 0}, {0, 0, 2 * s});
  addQuad(scene, 0, {w, h, -s}, {s - w, 0, 0}, {0, 0, 2 * s});
  addQuad(scene, 0, {-w, h, -s}, {2 * w, 0, 0}, {0, 0, s - w});
  addQuad(scene, 0, {-w, h, w}, {2 * w, 0, 0}, {0, 0, s - w});
  return scene;
}

TEST(OpenSky, IsWholeInTheOpen) {
  Scene scene;
  EXPECT_EQ(openSky(scene, eyeOfTheRoom(), 1), 1) << "nothing but sky";
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, kFar);
  EXPECT_EQ(openSky(scene, eyeOfTheRoom(), 1), 1);
  addQuad(scene, 0, {-kFar, 0, 0}, {2 * kFar, 0, 0}, {0, kFar, 0});
  EXPECT_NEAR(openSky(scene, eyeOfTheRoom(), 1), 1, 2.0 / 8) << "a wall sees half; a ray more or less";
}

TEST(OpenSky, IsAsSmallAsTheWindow) {
  EXPECT_EQ(openSky(room(0), eyeOfTheRoom(), 1), 0);
  const double some = openSky(room(6), eyeOfTheRoom(), 1);
  EXPECT_LE(some, 0.5) << "from 5 m below, a hole of 6 m is a fifth of the sky at most";
  EXPECT_GT(openSky(room(19), eyeOfTheRoom(), 1), some);
}

TEST(OpenSky, GlassLetsItThrough) {
  Scene scene = room(0);
  Material pane = lambert(glm::vec3(1));
  pane.transmission = 1;
  for (std::size_t i = scene.triangles.size() - 8; i < scene.triangles.size(); ++i)
    scene.triangles[i].material = 1;
  scene.materials.push_back(pane);
  EXPECT_GT(openSky(scene, eyeOfTheRoom(), 1), 0.5) << "a roof of glass";
}

}  // namespace
}  // namespace whittle::test
