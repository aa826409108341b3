// Texture lookups against values worked out by hand.
#include "reference/texture.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace whittle::test {
namespace {

using reference::Encoding;
using reference::Vec2;
using reference::Vec3;
using reference::Vec4;

/// 4 × 2 texels, red = 10·x + 100·y in 255ths, alpha 255.
Scene ramp() {
  Scene scene;
  Image image{"", 4, 2, {}};
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) {
      const auto red = static_cast<std::uint8_t>(10 * x + 100 * y);
      image.texels.insert(image.texels.end(), {red, 0, 0, 255});
    }
  }
  scene.images.push_back(image);
  return scene;
}

double red(const Scene& scene, const TextureSlot& slot, double u, double v) {
  return 255 * reference::sampleTexture(scene, slot, {u, v}, Encoding::Linear).r;
}

TextureSlot wrapped(Wrap wrap, Filter filter = Filter::Linear) {
  TextureSlot slot;
  slot.image = 0;
  slot.wrapS = slot.wrapT = wrap;
  slot.filter = filter;
  return slot;
}

constexpr double kRounding = 1e-12;

TEST(Texture, LinearSlotsReadSixteenBitsWhereTheyAreThere) {
  Scene scene;
  scene.images = {{"", 2, 1, {128, 0, 0, 255, 128, 0, 0, 255}, {32800, 0, 0, 65535, 32900, 0, 0, 65535}}};
  const TextureSlot slot = wrapped(Wrap::Repeat);
  const auto at = [&](double u, Encoding encoding) {
    return reference::sampleTexture(scene, slot, {u, 0.5}, encoding);
  };
  EXPECT_NEAR(at(0.25, Encoding::Linear).r, 32800 / 65535.0, kRounding);
  EXPECT_NEAR(at(0.5, Encoding::Linear).r, 32850 / 65535.0, kRounding) << "half way";
  EXPECT_EQ(at(0.25, Encoding::Linear).a, 1);
  EXPECT_NEAR(at(0.25, Encoding::Srgb).r, reference::srgbToLinear(128 / 255.0), kRounding);
}

TEST(Texture, BilinearBetweenTexelCentres) {
  const Scene scene = ramp();
  const TextureSlot slot = wrapped(Wrap::Repeat);
  EXPECT_NEAR(red(scene, slot, 0.125, 0.25), 0, kRounding);       // centre of (0, 0)
  EXPECT_NEAR(red(scene, slot, 0.625, 0.75), 120, kRounding);     // centre of (2, 1)
  EXPECT_NEAR(red(scene, slot, 0.25, 0.25), 5, kRounding);        // half way from 0 to 1
  EXPECT_NEAR(red(scene, slot, 0.4375, 0.375), 37.5, kRounding);  // x = 1.25, y = 0.25: 12.5 + 25
}

TEST(Texture, EdgesFollowTheWrapMode) {
  const Scene scene = ramp();
  // At u = 0 half of texel −1 is seen: the last one, or the first again.
  EXPECT_NEAR(red(scene, wrapped(Wrap::Repeat), 0, 0.25), 15, kRounding);
  EXPECT_NEAR(red(scene, wrapped(Wrap::Clamp), 0, 0.25), 0, kRounding);
  EXPECT_NEAR(red(scene, wrapped(Wrap::Mirror), 0, 0.25), 0, kRounding);
  EXPECT_NEAR(red(scene, wrapped(Wrap::Repeat), 0.125, 0), 50, kRounding);
  EXPECT_NEAR(red(scene, wrapped(Wrap::Clamp), 0.125, 0), 0, kRounding);
}

TEST(Texture, CoordinatesOutsideFollowTheWrapMode) {
  const Scene scene = ramp();
  const double inside = 0.375;  // centre of texel 1
  EXPECT_NEAR(red(scene, wrapped(Wrap::Repeat), inside + 3, 0.25), 10, kRounding);
  EXPECT_NEAR(red(scene, wrapped(Wrap::Repeat), inside - 2, 0.25), 10, kRounding);
  EXPECT_NEAR(red(scene, wrapped(Wrap::Clamp), 7, 0.25), 30, kRounding);
  EXPECT_NEAR(red(scene, wrapped(Wrap::Clamp), -7, 0.25), 0, kRounding);
  EXPECT_NEAR(red(scene, wrapped(Wrap::Mirror), -inside, 0.25), 10, kRounding);
  EXPECT_NEAR(red(scene, wrapped(Wrap::Mirror), 1 + inside, 0.25), 20, kRounding);
  EXPECT_NEAR(red(scene, wrapped(Wrap::Mirror), 2 + inside, 0.25), 10, kRounding);
}

TEST(Texture, NearestTakesOneTexel) {
  const Scene scene = ramp();
  const TextureSlot slot = wrapped(Wrap::Repeat, Filter::Nearest);
  EXPECT_NEAR(red(scene, slot, 0.249, 0.499), 0, kRounding);
  EXPECT_NEAR(red(scene, slot, 0.251, 0.501), 110, kRounding);
  EXPECT_NEAR(red(scene, slot, -1e-30, 0.25), 0, kRounding) << "u − floor(u) rounds to 1: the first texel";
  EXPECT_NEAR(red(scene, wrapped(Wrap::Clamp, Filter::Nearest), 1, 0.25), 30, kRounding);
  EXPECT_NEAR(red(scene, wrapped(Wrap::Mirror, Filter::Nearest), 1, 1), 130, kRounding);
}

TEST(Texture, TheSlotTransformsTheCoordinates) {
  TextureSlot slot = wrapped(Wrap::Repeat);
  slot.transform = {0, 1, 0.25F, 1, 0, 0.5F};  // u' = v + ¼, v' = u + ½
  EXPECT_NEAR(red(ramp(), slot, 0.25, 0.375), 120, kRounding);
}

TEST(Texture, CoordinatesThatAreNotNumbersReadTheFirstTexel) {
  Scene scene = ramp();
  scene.images[0].texels[0] = 77;
  EXPECT_NEAR(red(scene, wrapped(Wrap::Repeat), std::numeric_limits<double>::quiet_NaN(), 0.7), 77,
              kRounding);
  EXPECT_NEAR(red(scene, wrapped(Wrap::Repeat), 0.6, std::numeric_limits<double>::infinity()), 77, kRounding);
}

TEST(Texture, AnEmptySlotIsWhite) {
  EXPECT_EQ(reference::sampleTexture(ramp(), TextureSlot{}, Vec2(0.3), Encoding::Srgb), Vec4(1));
}

TEST(Texture, SrgbIsDecodedBeforeFiltering) {
  // IEC 61966-2-1: 188/255 is nearly half the light; 0.04045 is where the curve begins.
  EXPECT_EQ(reference::srgbToLinear(0), 0);
  EXPECT_NEAR(reference::srgbToLinear(1), 1, 1e-15);
  EXPECT_NEAR(reference::srgbToLinear(0.5), 0.21404114, 5e-9);
  EXPECT_NEAR(reference::srgbToLinear(0.04), 0.04 / 12.92, 1e-17);
  Scene scene;
  scene.images.push_back({"", 2, 1, {0, 0, 0, 0, 255, 255, 255, 255}});
  const Vec4 between = reference::sampleTexture(scene, wrapped(Wrap::Clamp), {0.5, 0.5}, Encoding::Srgb);
  EXPECT_NEAR(between.r, 0.5, 1e-15) << "the mean of the light, not of the code";
  EXPECT_NEAR(between.a, 0.5, 1e-15);
  scene.images[0] = {"", 1, 1, {128, 128, 128, 128}};
  const Vec4 grey = reference::sampleTexture(scene, wrapped(Wrap::Clamp), {0.5, 0.5}, Encoding::Srgb);
  EXPECT_NEAR(grey.g, 0.2158605, 5e-8);
  EXPECT_NEAR(grey.a, 128 / 255.0, 1e-15) << "alpha is linear";
}

TEST(Background, TheMapSurroundsTheScene) {
  Background background;
  background.radiance = glm::vec3(2);
  EXPECT_EQ(reference::backgroundRadiance(background, Vec3(0, 1, 0)), Vec3(2));
  background.width = 4;
  background.height = 2;
  background.map.assign(4 * 2 * 3, 0);
  for (int i = 0; i < 8; ++i) background.map[3 * i] = static_cast<float>(i);
  // Forward (−z) is u = ½, between texels 1 and 2; the horizon is between the rows. 2 · (1 + 2 + 5 + 6)/4.
  EXPECT_NEAR(reference::backgroundRadiance(background, Vec3(0, 0, -1)).r, 7, 1e-12);
  // +x is u = ¾, between texels 2 and 3; 45° up is the centre of the upper row.
  const double s = std::numbers::sqrt2 / 2;
  EXPECT_NEAR(reference::backgroundRadiance(background, Vec3(s, s, 0)).r, 5, 1e-12);
  // Backwards u wraps: texels 3 and 0.
  EXPECT_NEAR(reference::backgroundRadiance(background, Vec3(0, s, s)).r, 3, 1e-12);
  EXPECT_NEAR(reference::backgroundRadiance(background, Vec3(0, 1, 0)).r, 3, 1e-12)
      << "u = ½ + atan2(0, −0)/2π";
}

/// Counter-clockwise seen from above: what lies to the right of the view comes to its middle first.
TEST(Background, TurnsAboutTheVertical) {
  Background background;
  background.radiance = glm::vec3(1);
  background.width = 4;
  background.height = 1;
  for (int i = 0; i < 4; ++i) background.map.insert(background.map.end(), 3, static_cast<float>(i));
  const auto ahead = [&](double degrees) {
    background.rotation = degrees;
    return reference::backgroundRadiance(background, Vec3(0, 0, -1)).r;
  };
  // Texel centres lie at u = 1/8, 3/8, 5/8, 7/8; straight ahead is u = 1/2, +x is 3/4.
  EXPECT_NEAR(ahead(0), 1.5, 1e-12);
  EXPECT_NEAR(ahead(45), 2, 1e-12);
  EXPECT_NEAR(ahead(90), 2.5, 1e-12) << "what was at +x";
  EXPECT_NEAR(ahead(135), 3, 1e-12);
  EXPECT_NEAR(ahead(180), 1.5, 1e-12) << "texels 3 and 0";
  EXPECT_NEAR(ahead(-45), 1, 1e-12);
  EXPECT_NEAR(ahead(225), 0, 1e-12);
  EXPECT_NEAR(ahead(360e6 + 45), 2, 1e-6);
  EXPECT_TRUE(std::isfinite(ahead(1e300)));
}

}  // namespace
}  // namespace whittle::test
