// Eye rays, and which camera they start from.
#include "reference/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/camera.h"
#include "scene/input_error.h"
#include "support/probe.h"

namespace whittle::test {
namespace {

TEST(Camera, PerspectiveRays) {
  Camera camera;
  camera.position = {1, 2, 3};
  camera.yfov = static_cast<float>(std::numbers::pi / 2);  // tan(45°) = 1
  const Ray centre = reference::eyeRay(camera, {200, 100}, 400, 200);
  EXPECT_EQ(centre.origin, Vec3(1, 2, 3));
  EXPECT_NEAR(glm::length(centre.direction - Vec3(0, 0, -1)), 0, 1e-15);
  const Ray corner = reference::eyeRay(camera, {0, 0}, 400, 200);  // upper left
  EXPECT_NEAR(glm::length(corner.direction - glm::normalize(Vec3(-2, 1, -1))), 0, 1e-7) << "π is rounded";
}

TEST(Camera, ExtremeFieldsOfViewAreFinite) {
  Camera camera;
  for (const double degrees : {1e-3, 179.9}) {
    const double half = degrees / 2 * std::numbers::pi / 180;
    camera.yfov = static_cast<float>(2 * half);
    const Ray top = reference::eyeRay(camera, {50, 0}, 100, 100);
    EXPECT_NEAR(glm::length(top.direction), 1, 1e-15);
    EXPECT_NEAR(std::atan2(top.direction.y, -top.direction.z) / half, 1, 1e-7) << "the angle is a float";
  }
}

TEST(Camera, OrthographicRays) {
  Camera camera = lookingDown();
  camera.ymag = 3;
  const Ray corner = reference::eyeRay(camera, {40, 20}, 40, 20);  // lower right
  EXPECT_NEAR(glm::length(corner.origin - Vec3(6, 1, 3)), 0, 1e-14);
  EXPECT_EQ(corner.direction, Vec3(0, -1, 0));
}

/// Corners of the camera's own frame, 2 : 1, in pictures of other shapes (glTF 2.0, 3.10.3).
TEST(Camera, ShowsItsOwnFrameInEveryPicture) {
  for (const bool orthographic : {false, true}) {
    Camera camera = lookingDown();
    camera.orthographic = orthographic;
    camera.aspect = 2;
    camera.yfov = 0.8F;
    const double high = orthographic ? 1 : std::tan(0.5 * static_cast<double>(camera.yfov));
    for (const auto& [width, height] : {std::pair{160, 80}, {160, 90}, {90, 90}, {60, 90}}) {
      // The frame's corner is 2 · high to the right; a picture shows as much or more, the same both ways.
      const Ray corner = reference::eyeRay(camera, {width, 0}, width, height);
      const Vec3 at = orthographic ? corner.origin - Vec3(camera.position)
                                   : corner.direction / glm::dot(corner.direction, Vec3(camera.forward));
      const double x = glm::dot(at, Vec3(camera.right)), y = glm::dot(at, Vec3(camera.up));
      EXPECT_GE(x, 2 * high * (1 - 1e-6));
      EXPECT_GE(y, high * (1 - 1e-6));
      EXPECT_NEAR(x / y, static_cast<double>(width) / height, 1e-9) << "not distorted";
      EXPECT_TRUE(std::abs(x - 2 * high) < 1e-6 || std::abs(y - high) < 1e-6) << "no more than it must";
    }
  }
}

TEST(Camera, IsFoundByNameOrIndex) {
  Scene scene;
  scene.file = "room.glb";
  scene.cameras = {lookingDown("left"), lookingDown("right"), lookingDown("0")};
  scene.cameras[2].node = "right";
  scene.cameras[1].node = "stand";
  EXPECT_EQ(findCamera(scene, "right"), 1U) << "a camera's name goes before its node's";
  EXPECT_EQ(findCamera(scene, "stand"), 1U);
  EXPECT_EQ(findCamera(scene, "1"), 1U);
  EXPECT_EQ(findCamera(scene, "0"), 2U) << "a name goes before an index";
  for (const std::string bad : {"top", "3", "-1", "1x", ""}) {
    Settings settings;
    settings.width = settings.height = 1;
    settings.camera = bad;
    try {
      renderReference(scene, settings);
      FAIL() << bad;
    } catch (const InputError& error) {
      const std::string text = error.what();
      for (const char* part : {"room.glb", "0 'left'", "1 'right' at 'stand'", "2 '0'"}) {
        EXPECT_NE(text.find(part), std::string::npos) << text;
      }
      EXPECT_EQ(text.find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace whittle::test
