// The alpha channel: what shows of the background, straight on from the eye, and nothing else.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

/// `count` sheets above nothing, seen from above; around the scene radiance 2.
Scene sheetsOf(const Material& material, int count) {
  Scene scene;
  const std::uint32_t added = addMaterial(scene, material);
  for (int i = 0; i < count; ++i)
    addQuad(scene, added, {-4, 0.05F * static_cast<float>(i), -4}, {0, 0, 8}, {8, 0, 0});
  scene.cameras = {lookingDown()};
  scene.background.radiance = glm::vec3(2);
  return scene;
}

Settings withAlpha(int bounces) {
  Settings settings = wholeSettings(bounces);
  settings.width = settings.height = 8;
  settings.alpha = true;
  return settings;
}

/// In the middle of the picture, whatever the form of the kernels and the samples.
void expectSeen(const Scene& scene, Settings settings, double alpha, const glm::dvec3& radiance) {
  for (const Lanes lanes : {Lanes::Auto, Lanes::One})
    for (const int rays : {1, 5}) {
      settings.lanes = lanes;
      settings.raysPerPixel = rays;
      const RenderResult seen = renderOnDevice(scene, settings);
      ASSERT_EQ(seen.alpha.pixels.size(), 64U);
      EXPECT_NEAR(seen.alpha.pixels[27], alpha, 1e-6) << rays;
      EXPECT_NEAR(glm::length(glm::dvec3(colorOf(seen, 27)) - radiance), 0, 1e-6) << rays;
    }
}

TEST(Alpha, NothingIsClearAndAWallIsNot) {
  expectSeen(sheetsOf(veil(1), 0), withAlpha(3), 0, glm::dvec3(0));
  Material wall = emitter(glm::vec3(0.5F));
  wall.doubleSided = true;
  expectSeen(sheetsOf(wall, 1), withAlpha(3), 1, glm::dvec3(0.5));
}

TEST(Alpha, LayersMultiply) {
  expectSeen(sheetsOf(veil(0.1F), 12), withAlpha(1), 1 - std::pow(0.9, 12), glm::dvec3(0));
  Settings settings = withAlpha(1);
  settings.transparentBounces = 3;
  expectSeen(sheetsOf(veil(0.1F), 12), settings, 1, glm::dvec3(0));
}

/// Whose colours differ: the mean of what is left of them.
TEST(Alpha, ATintedSheetLetsTheMeanOfItsColoursThrough) {
  Material sheet = lambert({0.2F, 0.5F, 0.8F});
  sheet.transmission = 1;
  sheet.roughness = 0;
  sheet.specular = 0;
  sheet.doubleSided = true;
  expectSeen(sheetsOf(sheet, 1), withAlpha(1), 1 - 0.5, glm::dvec3(0));
}

/// Only the eye's own rays see nothing there.
TEST(Alpha, MirrorsShowTheBackground) {
  Material plate = mirror(glm::vec3(0.5F));
  plate.doubleSided = true;
  expectSeen(sheetsOf(plate, 1), withAlpha(2), 1, glm::dvec3(1));
}

/// Twin: laid over the same background the picture is what it is without an alpha channel. All radiance is
/// linear, so the sums of the three channels agree even behind tinted sheets.
TEST(Alpha, LaidOverTheBackgroundItIsTheWholePicture) {
  for (const char* name : {"anti_aliasing", "height_field", "nested_glass", "textured"}) {
    Scene scene = ownScene(name);
    scene.background = {};
    scene.background.radiance = glm::vec3(1);
    Settings settings = wholeSettings(4);
    settings.raysPerPixel = 3;
    const RenderResult whole = renderOnDevice(scene, settings);
    settings.alpha = true;
    const RenderResult cut = renderOnDevice(scene, settings);
    ASSERT_TRUE(whole.alpha.pixels.empty());
    for (std::size_t p = 0; p < cut.alpha.pixels.size(); ++p) {
      const glm::dvec3 expected(colorOf(whole, p)), seen(colorOf(cut, p));
      const double sum = expected.x + expected.y + expected.z;
      ASSERT_NEAR(seen.x + seen.y + seen.z + 3 * (1 - static_cast<double>(cut.alpha.pixels[p])), sum,
                  1e-6 * (1 + sum))
          << name << " pixel " << p;
    }
  }
}

TEST(Alpha, AgreesWithTheReference) {
  for (const char* name : {"anti_aliasing", "nested_glass"}) {
    Settings settings = smallSettings(4);
    settings.alpha = true;
    const Agreement agreement = compareWithReference(ownScene(name), settings);
    expectAgreement(agreement, name, 4);
    const auto& kernel = agreement.kernel.alpha.pixels;
    const auto& reference = agreement.reference.alpha.pixels;
    ASSERT_EQ(kernel.size(), reference.size());
    std::size_t apart = 0, clear = 0;
    for (std::size_t p = 0; p < kernel.size(); ++p) {
      apart += std::abs(kernel[p] - reference[p]) > 1e-5F ? 1 : 0;
      clear += reference[p] < 1 ? 1 : 0;
    }
    EXPECT_LE(apart, agreement.outliers + 1) << name;
    EXPECT_GT(clear, kernel.size() / 5) << name;
  }
}

TEST(Alpha, IsNotCompiledUnlessAskedFor) {
  const Scene scene = sheetsOf(veil(0.5F), 1);
  Settings settings = withAlpha(2);
  settings.keepAllFeatures = false;
  EXPECT_TRUE(uses(renderOnDevice(scene, settings).stats, "alpha channel"));
  settings.alpha = false;
  settings.keepAllFeatures = true;
  EXPECT_FALSE(uses(renderOnDevice(scene, settings).stats, "alpha channel"))
      << "a setting decides, as --keep-all-features leaves it";
  settings.keepAllFeatures = false;
  const std::vector<float> plain = renderOnDevice(scene, settings).radiance.pixels;
  settings.keepFeatures = bitOf(Feature::COVERAGE);
  EXPECT_EQ(renderOnDevice(scene, settings).radiance.pixels, plain)
      << "kept, but not asked for: the background shows";
}

}  // namespace
}  // namespace whittle::test
