// What settings ask for, and the smallest and strangest pictures.
#include <cmath>
#include <numeric>

#include "scene/camera.h"
#include "scene/input_error.h"
#include "support/single_rays.h"
#include "wavefront/camera_to_device.h"

namespace whittle::test {
namespace {

bool allFinite(const FloatImage& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(), [](float v) { return std::isfinite(v); });
}

TEST(Settings, ACamerasNameGoesBeforeItsIndex) {
  Scene scene;
  scene.cameras.resize(3);
  scene.cameras[0].name = "first";
  scene.cameras[2].name = "0";
  for (const auto& [asked, index] : {std::pair<const char*, std::size_t>{"first", 0}, {"0", 2}, {"1", 1}}) {
    EXPECT_EQ(findCamera(scene, asked), index) << asked;
  }
  EXPECT_THROW(findCamera(scene, "3"), InputError);
}

TEST(Settings, OneBounceSendsOutNoImpulses) {
  const RenderResult result = renderOnDevice(ownScene("cornell_box"), smallSettings(1));
  EXPECT_EQ(result.stats.rays.impulse, 0U);
  EXPECT_EQ(result.stats.rays.primary, 96U * 54);
  EXPECT_EQ(stageOf(result.stats, "intersect").launches, 1U);
  EXPECT_EQ(stageOf(result.stats, "compact_impulse").launches, 0U);
  for (const auto& b : result.stats.buffers) EXPECT_NE(b.name, "impulses");
}

TEST(Settings, NoShadowsNoShadowRays) {
  Settings settings = smallSettings(4);
  const Scene scene = ownScene("cornell_box");
  const RenderResult with = renderOnDevice(scene, settings);
  settings.shadows = false;
  const RenderResult without = renderOnDevice(scene, settings);
  EXPECT_GT(with.stats.rays.shadow, 1000U);
  EXPECT_EQ(without.stats.rays.shadow, 0U);
  EXPECT_EQ(stageOf(without.stats, "occlude").launches, 0U);
  for (const auto& b : without.stats.buffers) EXPECT_NE(b.name, "shadows");
  for (std::size_t i = 0; i < with.radiance.pixels.size(); ++i)
    ASSERT_GE(without.radiance.pixels[i], with.radiance.pixels[i] * 0.99999F)
        << "a shadow only takes light away";
}

TEST(Settings, ShadowsOfOneLightAlone) {
  // A light that casts a shadow and one that does not: a roof takes away the first only.
  Scene scene;
  addFloor(scene, lambert(glm::vec3(1)), 0, true, 4);
  addFloor(scene, lambert(glm::vec3(1)), 1, false, 4);
  scene.lights = {pointLight({0, 2, 0}, 4), pointLight({0, 2, 0}, 1)};
  scene.lights[1].castsShadows = false;
  const RenderResult result = shoot(scene, {0, 0.5, 0}, {0, -1, 0}, 1);
  EXPECT_NEAR(colorOf(result).x, 1.0 / 4 / M_PI, 1e-7);  // I/d²/π of the second
  EXPECT_EQ(result.stats.rays.shadow, 1U);
}

TEST(Settings, AovsOfAFloorAndNothing) {
  Scene scene;
  addQuad(scene, addMaterial(scene, emitter(glm::vec3(9))), {20, 0, 0}, {0, 0, 1},
          {1, 0, 0});  // unseen: the first two indices
  addQuad(scene, addMaterial(scene, lambert({0.25F, 0.5F, 0.75F})), {0, 0, -4}, {0, 0, 8}, {4, 0, 0});
  Camera camera;
  camera.orthographic = true;
  camera.ymag = 1;
  camera.position = {0, 3, 0};
  aim(camera, {0, -1, 0});
  scene.cameras = {camera};
  Settings settings;
  settings.width = settings.height = 2;
  settings.aovs = true;
  const RenderResult result = renderOnDevice(scene, settings);
  const auto& aovs = result.aovs;
  ASSERT_EQ(aovs.at("depth").pixels.size(), 4U);
  for (const std::size_t right : {1U, 3U}) {
    EXPECT_NEAR(aovs.at("depth").pixels[right], 3, 1e-6);
    const float primitive = aovs.at("primitive").pixels[right];
    EXPECT_TRUE(primitive == 2 || primitive == 3) << primitive;
    const float* n = &aovs.at("normal").pixels[3 * right];
    EXPECT_NEAR(n[0], 0, 1e-7);
    EXPECT_NEAR(n[1], 1, 1e-7);
    EXPECT_NEAR(n[2], 0, 1e-7);
    EXPECT_EQ(aovs.at("albedo").pixels[3 * right + 2], 0.75F);
  }
  for (const std::size_t left : {0U, 2U}) {
    EXPECT_EQ(aovs.at("depth").pixels[left], INFINITY);
    EXPECT_EQ(aovs.at("primitive").pixels[left], -1);
    EXPECT_EQ(aovs.at("normal").pixels[3 * left + 1], 0);
    EXPECT_EQ(aovs.at("albedo").pixels[3 * left], 0);
  }
  settings.aovs = false;
  EXPECT_TRUE(renderOnDevice(scene, settings).aovs.empty());
}

TEST(Settings, ATimeLimitStopsEarlyWithAWholePicture) {
  Settings settings = smallSettings(2);
  const Scene scene = ownScene("anti_aliasing");
  settings.raysPerPixel = 1 << 20;
  settings.timeLimit = 0.05;
  const RenderResult limited = renderOnDevice(scene, settings);
  EXPECT_EQ(limited.stats.settings.raysPerPixel, 1 << 20) << "what was asked for";
  EXPECT_LT(limited.stats.samples.most, 1U << 20);
  settings.raysPerPixel = static_cast<int>(limited.stats.samples.most);
  settings.timeLimit = 0;
  // Random samples do not know how many there will be.
  EXPECT_EQ(differingPixels(limited.radiance, renderOnDevice(scene, settings).radiance), 0U);
}

double meanOf(const FloatImage& image) {
  return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) /
         static_cast<double>(image.pixels.size());
}

/// Its estimate with n rays for each pixel, without a target.
ErrorPoint plainError(const Scene& scene, Settings settings, std::uint32_t n, FloatImage& picture) {
  settings.raysPerPixel = static_cast<int>(n);
  settings.targetError = settings.targetErrorRelative = 0.0;
  RenderResult result = renderOnDevice(scene, settings);
  picture = std::move(result.radiance);
  return result.stats.error.back();
}

/// Not four fifths of the rays would have been enough, and the picture is that of as many without a target.
void expectJustEnough(const Scene& scene, const Settings& settings, const RenderResult& enough) {
  const std::uint32_t n = enough.stats.samples.most;
  EXPECT_EQ(enough.stats.samples.least, n);
  EXPECT_EQ(enough.stats.settings.raysPerPixel, settings.raysPerPixel) << "what was asked for";
  EXPECT_TRUE(meetsTarget(settings, enough.stats.error.back())) << enough.stats.error.back().estimate;
  FloatImage same, fewer;
  EXPECT_EQ(plainError(scene, settings, n, same).estimate, enough.stats.error.back().estimate);
  EXPECT_EQ(differingPixels(same, enough.radiance), 0U);
  EXPECT_FALSE(meetsTarget(settings, plainError(scene, settings, n * 4 / 5, fewer))) << n << " rays";
}

TEST(Settings, ATargetErrorStopsOnceItIsReached) {
  Settings settings = smallSettings(2);
  const Scene scene = ownScene("anti_aliasing");
  FloatImage four;
  // About 20 rays at one over the root, which doubling would make 32.
  settings.targetError = plainError(scene, settings, 4, four).estimate / std::sqrt(5.0);
  settings.raysPerPixel = 256;
  expectJustEnough(scene, settings, renderOnDevice(scene, settings));
}

TEST(Settings, ATargetErrorCanBeAShareOfTheMean) {
  Settings settings = smallSettings(2);
  const Scene scene = ownScene("anti_aliasing");
  FloatImage four;
  const double estimate = plainError(scene, settings, 4, four).estimate;
  settings.targetErrorRelative = estimate / meanOf(four) / std::sqrt(5.0);
  settings.targetError = 1e30;  // loses against the share
  settings.raysPerPixel = 256;
  const RenderResult uniform = renderOnDevice(scene, settings);
  // Sums of 15,552 numbers of 24 bits in another order.
  EXPECT_NEAR(uniform.stats.error.back().mean, meanOf(uniform.radiance), 1e-6 * meanOf(uniform.radiance));
  expectJustEnough(scene, settings, uniform);
  settings.adaptive = true;
  settings.targetErrorRelative /= 2;
  const ErrorPoint adaptive = renderOnDevice(scene, settings).stats.error.back();
  EXPECT_LE(adaptive.estimate, settings.targetErrorRelative * adaptive.mean);
  EXPECT_LT(adaptive.raysPerPixel, 80.0) << "what equal samples would need";
}

/// No share of nothing can be fallen short of; and it must not take 65,536 rays to see that.
TEST(Settings, ABlackPictureMeetsAnyShareOfItsMean) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(1)), 0, true, 4);
  scene.cameras.resize(1);
  Settings settings;
  settings.width = settings.height = 8;
  settings.raysPerPixel = 1 << 16;
  settings.targetErrorRelative = 0.01;
  for (const bool adaptive : {false, true}) {
    settings.adaptive = adaptive;
    const RenderResult black = renderOnDevice(scene, settings);
    EXPECT_EQ(black.stats.samples.most, 2U);
    EXPECT_EQ(black.stats.error.back().mean, 0.0);
    EXPECT_TRUE(meetsTarget(settings, black.stats.error.back()));
  }
}

TEST(Strange, NoTriangles) {
  Scene scene;
  scene.background.radiance = {0.25F, 0.5F, 1};
  for (const Search search : {Search::Auto, Search::Tree}) {
    scene.cameras.resize(1);
    Settings settings;
    settings.width = 5;
    settings.height = 3;
    settings.search = search;
    settings.aovs = true;
    const RenderResult result = renderOnDevice(scene, settings);
    for (std::size_t i = 0; i < 15; ++i) EXPECT_EQ(colorOf(result, i), glm::vec3(0.25F, 0.5F, 1));
    EXPECT_EQ(result.aovs.at("depth").pixels[7], INFINITY);
  }
  scene.lights.push_back(pointLight({0, 1, 0}, 3));
  EXPECT_EQ(shot(scene, {0, 0, 0}, {0, 0, -1}, 8), glm::vec3(0.25F, 0.5F, 1));
}

TEST(Strange, OnePixelAndFieldsOfViewFromNothingToAll) {
  Scene scene = ownScene("cornell_box");
  const double degree = std::acos(-1.0) / 180;
  for (const double fov : {1e-3, 42.0, 179.9}) {
    scene.cameras[0].yfov = static_cast<float>(fov * degree);
    for (const int size : {1, 16}) {
      Settings settings = smallSettings(4);
      settings.width = settings.height = size;
      const RenderResult result = renderOnDevice(scene, settings);
      EXPECT_TRUE(allFinite(result.radiance)) << fov;
      EXPECT_EQ(result.stats.nonFinite, 0U) << fov;
      EXPECT_EQ(result.stats.rays.primary, static_cast<std::uint64_t>(size) * size);
      // The corner of a picture of 179.9 degrees looks past the box, whose backs are not seen.
      if (size == 1 || fov < 179) {
        EXPECT_GT(colorOf(result).x + colorOf(result).y, 0) << "a closed room is lit everywhere; fov " << fov;
      }
    }
  }
}

TEST(Strange, ACameraOnATriangle) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, 4);
  scene.background.radiance = glm::vec3(0.125F);
  scene.lights.push_back(pointLight({0, 2, 0}, 4));
  for (const glm::dvec3& w :
       {glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(1, -0.1, 0.3)}) {
    const RenderResult result = shoot(scene, {0.3, 0, 0.2}, w, 4);
    EXPECT_TRUE(allFinite(result.radiance));
    // t > 0: what the eye sits on is not seen.
    EXPECT_EQ(colorOf(result), glm::vec3(0.125F)) << w.x << " " << w.y;
  }
}

}  // namespace
}  // namespace whittle::test
