// Maps of more than 8 bits: normals that step by less than a 255th come out right, and nothing of it is there
// where no map is so fine.
#include <cmath>
#include <numbers>

#include "analysis/scene_features.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

constexpr int kSlopes = 64;
constexpr float kHalf = 16;  // of the floor's side, metres: with lookingDown() a texel for each pixel

std::uint16_t slopeCode(int i) { return static_cast<std::uint16_t>(32768 + 16 * i); }
/// 0 to 0.03: all of them lie within four steps of 8 bits.
double slope(int i) { return slopeCode(i) / 65535.0 * 2 - 1; }

/// A floor seen from above, its normal tilted towards +x by a little more from pixel to pixel; a
/// light from there.
Scene slopes() {
  Scene scene;
  Material material = lambert(glm::vec3(0.5F));
  material.normalTexture.image = 0;
  addFloor(scene, material, 0, true, kHalf);
  for (const glm::vec3& p : scene.positions)
    scene.uv0.emplace_back((p.x + kHalf) / (2 * kHalf), (p.z + kHalf) / (2 * kHalf));
  scene.normals.assign(scene.positions.size(), glm::vec3(0, 1, 0));
  scene.tangents.assign(scene.positions.size(), glm::vec4(1, 0, 0, 1));
  Image image{"slopes", kSlopes, 1, {}};
  for (int i = 0; i < kSlopes; ++i) {
    for (const std::uint16_t code :
         {slopeCode(i), std::uint16_t{32768}, std::uint16_t{65535}, std::uint16_t{65535}}) {
      image.deepTexels.push_back(code);
      image.texels.push_back(static_cast<std::uint8_t>(std::lround(code / 257.0)));
    }
  }
  scene.images = {image};
  Light light;
  light.kind = LightKind::Directional;
  light.direction = glm::normalize(glm::vec3(-1, -1, 0));
  light.castsShadows = false;
  scene.lights = {light};
  scene.cameras = {lookingDown()};
  return scene;
}

Settings rowOfPixels(Lanes lanes = Lanes::Auto) {
  Settings settings;
  settings.width = kSlopes;
  settings.height = 4;
  settings.aovs = true;
  settings.lanes = lanes;
  settings.textureFilter = TextureFilter::None;  // the bytes of texels are counted
  return settings;
}

bool hasDeepTextures(const Scene& scene) {
  return SceneFeatures::analyse(scene, rowOfPixels(), {true}).has(Feature::DEEP_TEXTURES);
}

std::uint64_t texelBytes(const RenderResult& result) {
  for (const BufferStats& b : result.stats.buffers)
    if (b.name == "texels") return b.bytes;
  return 0;
}

TEST(DeepTextures, SlopesFinerThanEightBitsAreTheFiles) {
  const double flat = slope(0);  // of the other axis: no code of 16 bits is exactly level
  for (const Lanes lanes : {Lanes::One, Lanes::Auto}) {
    const RenderResult result = renderOnDevice(slopes(), rowOfPixels(lanes));
    const auto& normal = result.aovs.at("normal").pixels;
    for (int i = 0; i < kSlopes; ++i) {
      const auto pixel = static_cast<std::size_t>(3 * (kSlopes + i));  // of the second row
      // 2 c − 1 of a float c near ½: a few roundings of 6e-8. Neighbours are 4.9e-4 apart.
      EXPECT_NEAR(static_cast<double>(normal[pixel] / normal[pixel + 1]), slope(i), 5e-7) << i;
      // ρ/π E (n·l), l half way between +x and +y.
      const double x = slope(i), length = std::sqrt(1 + x * x + flat * flat);
      const double cosine = (x + 1) / (length * std::numbers::sqrt2);
      EXPECT_NEAR(static_cast<double>(result.radiance.pixels[pixel]), 0.5 / std::numbers::pi * cosine, 2e-7)
          << i;
    }
    EXPECT_EQ(texelBytes(result), kSlopes * 8U);
  }
}

TEST(DeepTextures, AgreeWithTheReference) {
  expectAgreement(compareWithReference(slopes(), rowOfPixels()), "slopes", 0);
  Scene repeated = slopes();
  repeated.materials[0].normalTexture.filter = Filter::Nearest;
  repeated.materials[0].normalTexture.transform = {2, 0, 0.001F, 0, 1, 0};
  expectAgreement(compareWithReference(repeated, rowOfPixels()), "slopes, twice as dense, unfiltered", 0);
  // Colours and normals out of one image: each reads its own form of it.
  Scene both = slopes();
  both.materials[0].baseColorTexture.image = 0;
  const Agreement agreement = compareWithReference(both, rowOfPixels());
  expectAgreement(agreement, "one image for colours and slopes", 0);
  EXPECT_EQ(texelBytes(agreement.kernel), kSlopes * (8U + 4U));
}

TEST(DeepTextures, LanesGiveTheSameBits) {
  const RenderResult one = renderOnDevice(slopes(), rowOfPixels(Lanes::One));
  EXPECT_EQ(differingPixels(one.radiance, renderOnDevice(slopes(), rowOfPixels()).radiance), 0U);
}

TEST(DeepTextures, OnlyMapsOfMoreThanEightBitsNeedThem) {
  EXPECT_TRUE(hasDeepTextures(slopes()));
  Scene coarse = slopes();
  coarse.images[0].deepTexels.clear();
  EXPECT_FALSE(hasDeepTextures(coarse));
  EXPECT_EQ(texelBytes(renderOnDevice(coarse, rowOfPixels())), kSlopes * 4U);
  Scene colours = slopes();
  std::swap(colours.materials[0].normalTexture, colours.materials[0].baseColorTexture);
  EXPECT_FALSE(hasDeepTextures(colours)) << "colours are decoded from 8 bits";
}

TEST(DeepTextures, ThatDifferBelowEightBitsAreNotOneImage) {
  Scene scene = slopes();
  Image other = scene.images[0];
  other.deepTexels[0] += 1;
  scene.images.push_back(other);
  Material second = scene.materials[0];
  second.normalTexture.image = 1;
  addFloor(scene, second, -1, true, kHalf);
  const auto imagesOf = [](const Scene& s) { return pruneScene(s, rowOfPixels()).images.size(); };
  EXPECT_EQ(imagesOf(scene), 2U);
  scene.images[1] = scene.images[0];
  EXPECT_EQ(imagesOf(scene), 1U);
}

}  // namespace
}  // namespace whittle::test
