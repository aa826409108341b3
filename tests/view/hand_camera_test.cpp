// What a hand does to a camera: lengths, angles and places that stay.
#include "view/hand_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/focus.h"
#include "support/random_scenes.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

using view::HandCamera;

Camera cameraAtFive() {
  Camera camera;
  camera.position = {0, 1, 5};
  return camera;
}

void expectFrame(const Camera& c) {
  EXPECT_NEAR(glm::length(c.forward), 1, 1e-6);
  EXPECT_NEAR(glm::length(c.up), 1, 1e-6);
  EXPECT_NEAR(glm::dot(c.forward, c.up), 0, 1e-6);
  EXPECT_NEAR(glm::length(glm::cross(c.forward, c.up) - c.right), 0, 1e-6);
}

TEST(HandCamera, OrbitKeepsTheDistanceAndTheHorizon) {
  HandCamera hand(cameraAtFive(), {0, 1, 0});
  for (int i = 0; i < 1000; ++i) hand.orbit(0.01 * (i % 7), 0.003 * (i % 5 - 2));
  expectFrame(hand.camera());
  EXPECT_NEAR(glm::length(glm::dvec3(hand.camera().position) - hand.pivot()), 5, 1e-4);
  EXPECT_NEAR(hand.camera().right.y, 0, 1e-5) << "no roll";
  // The pivot stays in the middle.
  EXPECT_NEAR(glm::length(glm::dvec3(hand.camera().position) + 5.0 * glm::dvec3(hand.camera().forward) -
                          hand.pivot()),
              0, 1e-3);
}

TEST(HandCamera, OrbitEndsAtThePoles) {
  HandCamera hand(cameraAtFive(), {0, 1, 0});
  for (int i = 0; i < 100; ++i) hand.orbit(0, 0.2);
  expectFrame(hand.camera());
  EXPECT_GT(std::abs(hand.camera().forward.y), 0.999F);
  EXPECT_GT(hand.camera().up.z * hand.camera().forward.y, 0) << "not over the pole";
  for (int i = 0; i < 300; ++i) hand.orbit(0, -0.2);
  expectFrame(hand.camera());
}

TEST(HandCamera, PanMovesWhatLiesAtThePivotAlongWithTheHand) {
  for (const bool orthographic : {false, true}) {
    Camera camera = cameraAtFive();
    camera.orthographic = orthographic;
    camera.ymag = 2;
    HandCamera hand(camera, {0, 1, 0});
    hand.pan(0.25, 0);
    const double height = orthographic ? 4 : 2 * std::tan(static_cast<double>(camera.yfov) / 2) * 5;
    EXPECT_NEAR(hand.camera().position.x, -0.25 * height, 1e-5);
  }
}

TEST(HandCamera, ZoomDividesTheDistance) {
  HandCamera hand(cameraAtFive(), {0, 1, 0});
  hand.zoom(2);
  EXPECT_NEAR(glm::length(glm::dvec3(hand.camera().position) - hand.pivot()), 2.5, 1e-6);
  hand.zoom(0);
  hand.zoom(-1);
  EXPECT_NEAR(glm::length(glm::dvec3(hand.camera().position) - hand.pivot()), 2.5, 1e-6);
}

TEST(HandCamera, OrthographicShowsTheSameHeightAtThePivotAndBack) {
  HandCamera hand(cameraAtFive(), {0, 1, 0});
  hand.switchOrthographic();
  EXPECT_TRUE(hand.camera().orthographic);
  EXPECT_NEAR(hand.camera().ymag, 5 * std::tan(0.45), 1e-5);
  hand.switchOrthographic();
  EXPECT_NEAR(glm::length(hand.camera().position - glm::vec3(0, 1, 5)), 0, 1e-5);
}

TEST(HandCamera, LookTurnsOnTheSpot) {
  HandCamera hand(cameraAtFive(), {0, 1, 0});
  hand.look(std::numbers::pi / 2, 0);
  EXPECT_NEAR(hand.camera().forward.x, 1, 1e-6);
  EXPECT_EQ(hand.camera().position, glm::vec3(0, 1, 5));
}

TEST(PointUnder, IsOnTheNearestSurfaceOrAsFarAsBefore) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, 4);
  addFloor(scene, lambert(glm::vec3(0.5F)), 1, true, 1);
  Camera camera;
  camera.position = {0, 5, 0};
  aim(camera, {0, -1, 0});
  EXPECT_NEAR(pointUnder(scene, camera, 1, 0.5, 0.5, {0, 0, 0}).y, 1, 1e-6);
  const glm::dvec3 corner = pointUnder(scene, camera, 1, 0.05, 0.5, {0, 0, 0});
  EXPECT_NEAR(corner.y, 0, 1e-6) << "beside the upper one";
  EXPECT_NEAR(glm::length(corner), 5 * std::tan(0.45) * 0.9, 1e-4);
  aim(camera, {0, 1, 0});
  EXPECT_NEAR(pointUnder(scene, camera, 1, 0.5, 0.5, {0, 8, 0}).y, 8, 1e-6) << "nothing there";
}

}  // namespace
}  // namespace whittle::test
