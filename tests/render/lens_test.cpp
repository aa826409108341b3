// The thin lens: circles of confusion against the formula, focus, and the reference.
#include <cmath>
#include <numbers>

#include "analysis/feature.h"
#include "analysis/focus.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

/// Looks along −z from the origin, 90° high and wide.
Camera straightAhead() {
  Camera camera;
  camera.yfov = static_cast<float>(std::numbers::pi / 2);
  return camera;
}

/// A glowing square of half side `half` across the axis at z = −distance.
Scene lamp(float distance, float half) {
  Scene scene;
  const auto material = addMaterial(scene, emitter({1, 1, 1}));
  addQuad(scene, material, {-half, -half, -distance}, {2 * half, 0, 0}, {0, 2 * half, 0});
  scene.cameras = {straightAhead()};
  return scene;
}

/// The middle of a picture of that size, larger than any spot below. The rest is black and need not be
/// traced.
constexpr int kSize = 101;
constexpr Region kMiddle{30, 30, 41, 41};

/// What glows in kMiddle, in units of the picture's half width.
struct Spot {
  double reach = 0;    ///< of the lit pixel farthest from the middle
  double outside = 0;  ///< share of the light farther from the middle than `radius`
};
Spot spotOf(const RenderResult& result, double radius) {
  Spot spot;
  double all = 0;
  for (int y = 0; y < kMiddle.height; ++y)
    for (int x = 0; x < kMiddle.width; ++x) {
      const auto at = static_cast<std::size_t>(y * kMiddle.width + x);
      const double light = static_cast<double>(colorOf(result, at).x);
      const double u = (kMiddle.x + x + 0.5) / kSize * 2 - 1, v = (kMiddle.y + y + 0.5) / kSize * 2 - 1;
      all += light;
      if (std::hypot(u, v) > radius) spot.outside += light;
      if (light > 0) spot.reach = std::max(spot.reach, std::hypot(u, v));
    }
  spot.outside /= all;
  return spot;
}

/// On an image plane one unit ahead a point at distance d is a disk of diameter A |1/f − 1/d| (similar
/// triangles; Potmesil and Chakravarty 1981). Before and behind the focus, for every sampler.
TEST(Lens, ACircleOfConfusionHasTheDiameterOfTheFormula) {
  struct Case {
    double focus, distance;
  };
  for (const Sampler sampler : {Sampler::Random, Sampler::Stratified, Sampler::Sobol})
    for (const auto& [focus, distance] : {Case{2, 4}, Case{4, 2}, Case{3, 100}}) {
      constexpr double kAperture = 0.8;
      Settings settings;
      settings.width = settings.height = kSize;
      settings.crop = kMiddle;
      settings.bounces = 1;
      settings.raysPerPixel = 4096;  // some 600 of which meet the lamp, all pixels together
      settings.sampler = sampler;
      settings.aperture = static_cast<float>(kAperture);
      settings.focusDistance = static_cast<float>(focus);
      const double diameter = kAperture * std::abs(1 / focus - 1 / distance);
      const double half = 0.004 * distance;  // of the lamp: 0.4 of a pixel's width
      const RenderResult result =
          renderOnDevice(lamp(static_cast<float>(distance), static_cast<float>(half)), settings);
      const double pixel = 2.0 / kSize;
      EXPECT_NEAR(spotOf(result, 1).reach, diameter / 2, 1.5 * pixel) << focus << " " << distance;
      EXPECT_LT(spotOf(result, diameter / 2 + pixel).outside, 1e-9) << focus << " " << distance;
      // Evenly over the disk: a quarter of the light within half its radius.
      EXPECT_NEAR(spotOf(result, diameter / 4).outside, 0.75, 0.06) << focus << " " << distance;
    }
}

TEST(Lens, WhatIsInFocusIsSharp) {
  Settings settings;
  settings.width = settings.height = 101;
  settings.bounces = 1;
  settings.raysPerPixel = 64;
  settings.focusDistance = 5.0F;
  const Scene scene = lamp(5, 1);
  const RenderResult pinhole = renderOnDevice(scene, settings);
  settings.aperture = 0.5F;
  const RenderResult lens = renderOnDevice(scene, settings);
  for (std::size_t i = 0; i < pinhole.radiance.pixels.size(); ++i)
    ASSERT_NEAR(lens.radiance.pixels[i], pinhole.radiance.pixels[i], 0.02) << i;
}

TEST(Lens, APinholeIsLeftOutAndKeptChangesNothing) {
  const Scene scene = ownScene("cornell_box");
  Settings settings = smallSettings(2);
  const RenderResult plain = renderOnDevice(scene, settings);
  const auto& used = plain.stats.featuresUsed;
  EXPECT_EQ(std::count(used.begin(), used.end(), "thin lens"), 0);
  settings.keepFeatures = bitOf(Feature::LENS);
  EXPECT_EQ(renderOnDevice(scene, settings).radiance.pixels, plain.radiance.pixels);
}

TEST(Lens, AgreesWithTheReference) {
  for (const bool orthographic : {false, true}) {
    Scene scene = ownScene("cornell_box");
    if (orthographic) {
      scene.cameras[0].orthographic = true;
      scene.cameras[0].ymag = 1;
    }
    Settings settings = wholeSettings(3);
    settings.aperture = 0.1F;
    settings.focusDistance = focusOn(scene, scene.cameras[0], 16.0 / 9);
    settings.raysPerPixel = 4;
    settings.sampler = Sampler::Sobol;
    expectAgreement(compareWithReference(scene, settings), orthographic ? "orthographic" : "perspective",
                    400);
  }
}

TEST(Lens, FocusIsAlongTheAxis) {
  const Scene scene = lamp(5, 4);
  EXPECT_NEAR(focusOn(scene, scene.cameras[0], 1), 5, 1e-5);
  EXPECT_NEAR(focusOn(scene, scene.cameras[0], 1, 0.2, 0.7), 5, 1e-5) << "not along the ray";
  EXPECT_EQ(focusOn(Scene{}, straightAhead(), 1), 1) << "nothing there";
}

}  // namespace
}  // namespace whittle::test
