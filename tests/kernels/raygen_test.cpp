// Eye rays against the reference's double precision: how far a direction is turned, an origin moved.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/camera.h"
#include "support/kernel_bench.h"
#include "support/random_scenes.h"
#include "wavefront/camera_to_device.h"

namespace whittle {
namespace {

using reference::Vec3;

Camera randomCamera(test::Rng& rng) {
  Camera camera;
  const glm::dvec3 forward = glm::normalize(glm::dvec3(rng.direction()));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(rng.direction())));
  camera.position = rng.inBox(100);
  camera.forward = glm::vec3(forward);
  camera.right = glm::vec3(right);
  camera.up = glm::vec3(glm::cross(right, forward));
  camera.yfov = rng.between(0.01F, 2.5F);
  camera.ymag = rng.between(0.01F, 50);
  return camera;
}

struct EyeRays {
  std::vector<float> rays;  ///< [RAY_PLANES_STRAIGHT][count]
  std::uint32_t count;
  Vec3 at(std::uint32_t plane, std::uint32_t i) const {
    return {rays[plane * count + i], rays[(plane + 1) * count + i], rays[(plane + 2) * count + i]};
  }
};

EyeRays eyeRays(test::KernelBench& bench, const Camera& camera, const Settings& settings,
                const std::vector<std::uint32_t>& pixels) {
  const auto count = static_cast<std::uint32_t>(pixels.size());
  const Buffer order = bench.compute.upload("order", pixels);
  const Buffer rays = bench.compute.allocate("rays", RAY_PLANES_STRAIGHT * sizeof(float) * count);
  const device::Batch batch{0, count, 0, 1};
  bench.stages.run(stages::Raygen{.camera = cameraToDevice(camera, settings),
                                  .batch = batch,
                                  .count = count,
                                  .capacity = count,
                                  .pixelOrder = order,
                                  .rays = rays});
  return {bench.read<float>(rays, static_cast<std::size_t>(RAY_PLANES_STRAIGHT) * count), count};
}

std::vector<std::uint32_t> randomPixels(test::Rng& rng, const Settings& s, int count) {
  std::vector<std::uint32_t> pixels;
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<std::uint32_t>(rng.unit() * static_cast<float>(s.width));
    const auto y = static_cast<std::uint32_t>(rng.unit() * static_cast<float>(s.height));
    pixels.push_back(y << 16U | x);
  }
  return pixels;
}

reference::Ray expectedRay(const Camera& camera, const Settings& s, std::uint32_t packed) {
  const reference::Vec2 middle((packed & 0xffffU) + 0.5, (packed >> 16U) + 0.5);
  return reference::eyeRay(camera, middle, s.width, s.height);
}

/// Rounding the three components of a unit vector turns it by up to sqrt(3)/2 · 2^-24 = 5.2e-8, and by the
/// root of the mean of 2 · (2^-25)²/3 · (what the components' own sizes leave: at most 1) = 2.4e-8 on
/// average; the best of four lengths must be below that by a third at least. Sums and quotients in plain
/// single precision miss both several times over.
TEST(RayGen, DirectionsAreTheNearestThatFloatsCanSay) {
  test::KernelBench bench({"raygen.cl"});
  test::Rng rng(51);
  double sum = 0, largest = 0;
  int rays = 0;
  for (const auto& [width, height] : {std::pair{640, 400}, {1, 1}, {7, 3}, {65535, 2}, {1919, 1081}}) {
    for (int c = 0; c < 20; ++c) {
      const Camera camera = randomCamera(rng);
      Settings settings;
      settings.width = width;
      settings.height = height;
      const auto pixels = randomPixels(rng, settings, 200);
      const EyeRays found = eyeRays(bench, camera, settings, pixels);
      for (std::uint32_t i = 0; i < found.count; ++i) {
        const Vec3 expected = expectedRay(camera, settings, pixels[i]).direction, d = found.at(RAY_D, i);
        const double turned = glm::length(glm::cross(d, expected));
        // Two floats' distance to the outermost of four lengths, and eight roundings on the way there.
        ASSERT_NEAR(glm::length(d), 1, 0x1p-22 + 8 * 0x1p-25) << width << " x " << height;
        ASSERT_GT(glm::dot(d, expected), 0);
        ASSERT_EQ(found.at(RAY_O, i), Vec3(camera.position));
        sum += turned * turned;
        largest = std::max(largest, turned);
        ++rays;
      }
    }
  }
  EXPECT_LE(largest, 5.2e-8);
  EXPECT_LE(std::sqrt(sum / rays), 1.6e-8);
}

/// The origin of an orthographic ray is the sum of three vectors, rounded once.
TEST(RayGen, OrthographicOriginsAreRoundedOnce) {
  test::KernelBench bench({"raygen.cl"});
  test::Rng rng(52);
  for (int c = 0; c < 50; ++c) {
    Camera camera = randomCamera(rng);
    camera.orthographic = true;
    Settings settings;
    settings.width = 1 + static_cast<int>(rng.bits() % 3000);
    settings.height = 1 + static_cast<int>(rng.bits() % 3000);
    const auto pixels = randomPixels(rng, settings, 200);
    const EyeRays found = eyeRays(bench, camera, settings, pixels);
    for (std::uint32_t i = 0; i < found.count; ++i) {
      ASSERT_EQ(found.at(RAY_D, i), Vec3(camera.forward));
      const Vec3 expected = expectedRay(camera, settings, pixels[i]).origin, o = found.at(RAY_O, i);
      // Half a unit in the last place, and what the low parts lose.
      for (int a = 0; a < 3; ++a) ASSERT_NEAR(o[a], expected[a], 0x1p-24 * std::abs(expected[a]) + 1e-12);
    }
  }
}

}  // namespace
}  // namespace whittle
