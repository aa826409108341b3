// Glass that splits colours (KHR_materials_dispersion): three ways out of a prism by Snell's law, the same
// from kernels and reference whatever else the surface does, and nothing of it where no glass asks.
#include <cmath>
#include <numbers>

#include "analysis/feature.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

Material splitting(float ior, float dispersion) {
  Material m = glass(ior, true);
  m.dispersion = dispersion;
  return m;
}

/// Both faces of a prism along z, 30° from the upright on either side, their fronts outwards.
void addPrism(Scene& scene, const Material& material) {
  const std::uint32_t m = addMaterial(scene, material);
  const float half = std::numbers::inv_sqrt3_v<float>;
  addQuad(scene, m, {-half, 0, -1}, {0, 0, 2}, {half, 1, 0});
  addQuad(scene, m, {half, 0, 1}, {0, 0, -2}, {-half, 1, 0});
}

/// Snell's law at both faces; the ray comes level, along x. Angle below the horizon behind the prism.
double deviation(double index) {
  const double apex = std::numbers::pi / 3, in = std::numbers::pi / 6;
  const double first = std::asin(std::sin(in) / index), second = apex - first;
  return in + std::asin(index * std::sin(second)) - apex;
}

/// A wall two metres behind the prism that is as bright as it is low: each channel tells where its ray met
/// it.
constexpr float kWall = 2;
Scene prismBeforeScale(const Material& material) {
  Scene scene;
  addPrism(scene, material);
  Material wall = emitter({1, 1, 1});
  wall.emissionTexture.image = 0;
  wall.emissionTexture.wrapS = wall.emissionTexture.wrapT = Wrap::Clamp;
  wall.emissionTexture.hasLevels = false;
  addQuad(scene, addMaterial(scene, wall), {kWall, -6, -1}, {0, 0, 2}, {0, 8, 0});
  scene.images.push_back({"", 1, 2, {255, 255, 255, 255, 0, 0, 0, 255}});
  scene.uv0.assign(scene.positions.size(), glm::vec2(0));
  const std::size_t first = scene.positions.size() - 4;
  for (std::size_t i = 0; i < 4; ++i)  // v from the middle of one texel to that of the other
    scene.uv0[first + i] = {0.5F, scene.positions[first + i].y < -1 ? 0.25F : 0.75F};
  return scene;
}

/// What passes an interface at that angle, unpolarised.
double passing(double cosI, double eta) {
  const double cosT = std::sqrt(1 - (1 - cosI * cosI) / (eta * eta));
  const double s = (cosI - eta * cosT) / (cosI + eta * cosT), p = (eta * cosI - cosT) / (eta * cosI + cosT);
  return 1 - (s * s + p * p) / 2;
}

/// Of the scale, by a level ray half way up the prism: where it meets the second face, x = h (1 - y), and
/// then the wall.
double seenOnScale(double index) {
  const double in = std::numbers::pi / 6, h = std::numbers::inv_sqrt3;
  const double first = std::asin(std::sin(in) / index), slope = std::tan(in - first);
  const double x = h * (0.5 + slope * h / 2) / (1 - slope * h), y = 1 - x / h;
  const double met = y - std::tan(deviation(index)) * (static_cast<double>(kWall) - x);
  return passing(std::cos(in), index) * passing(std::cos(2 * in - first), 1 / index) * (2 - met) / 8;
}

/// Half of (1.5 - 1)/20 between green and the others. The tolerance: blue leaves at 81 degrees, where a
/// rounding of its direction (6e-8) moves it by ten times that over the wall's two metres.
TEST(Dispersion, LeavesAPrismInThreeDirectionsBySnell) {
  const RenderResult split = shoot(prismBeforeScale(splitting(1.5F, 1)), {-2, 0.5, 0}, {1, 0, 0}, 4);
  const glm::vec3 seen = colorOf(split);
  EXPECT_NEAR(seen.x, seenOnScale(1.4875), 4e-6);
  EXPECT_NEAR(seen.y, seenOnScale(1.5), 4e-6);
  EXPECT_NEAR(seen.z, seenOnScale(1.5125), 4e-6);
  EXPECT_GT(std::abs(seen.x - seen.z), 0.02F);
  // A reflection and three colours at the first face; at the second each is reflected and goes out.
  EXPECT_EQ(split.stats.rays.impulse, 4U + 3U * 2U);
}

/// A ball of it over a floor with a lamp and a background, a pane of a mirror beside.
Scene glassStage(const Material& material) {
  Scene scene;
  addFloor(scene, lambert({0.7F, 0.6F, 0.5F}), -1.2F, true, 4);
  const std::uint32_t glassy = addMaterial(scene, material);
  // An octahedron, its fronts outwards.
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (const glm::vec3& p : {glm::vec3(1, 0, 0), glm::vec3(-1, 0.1F, 0), glm::vec3(0, 1, 0),
                             glm::vec3(0, -1, 0), glm::vec3(0.1F, 0, 1), glm::vec3(0, 0, -1)})
    scene.positions.push_back(p);
  for (std::uint32_t side = 0; side < 8; ++side) {
    const std::uint32_t x = first + (side & 1), y = first + 2 + (side >> 1 & 1), z = first + 4 + (side >> 2);
    const bool turned = ((side ^ side >> 1 ^ side >> 2) & 1) != 0;
    scene.triangles.push_back(turned ? Triangle{x, z, y, glassy} : Triangle{x, y, z, glassy});
  }
  addQuad(scene, addMaterial(scene, emitter({1, 2, 3})), {-2, -1, -2}, {1.5F, 0, 0}, {0, 1.5F, 0});
  addQuad(scene, addMaterial(scene, lambert({0.2F, 0.8F, 0.4F})), {0.5F, -1, -2}, {1.5F, 0, 0.5F}, {0, 2, 0});
  scene.lights = {pointLight({1, 3, 0.5F}, 25)};
  scene.background.radiance = {0.4F, 0.5F, 0.6F};
  Camera camera;
  camera.position = {0.3F, 0.8F, 3.5F};
  aim(camera, {-0.05, -0.2, -1});
  scene.cameras = {camera};
  return scene;
}

std::vector<std::pair<const char*, Material>> kindsOfGlass() {
  Material rough = splitting(1.5F, 3), half = splitting(1.5F, 3), veiled = splitting(1.6F, 2),
           coated = splitting(1.4F, 4), tinted = splitting(1.5F, 2);
  rough.roughness = 0.5F;
  half.transmission = 0.5F, half.metallic = 0.2F, half.sigma_a = {0.1F, 0.5F, 0.2F};
  veiled.alphaMode = AlphaMode::Blend, veiled.baseColor.a = 0.6F;
  coated.clearcoat = 0.8F, coated.iridescence = 0.6F;
  tinted.specularColor = {0.5F, 0.9F, 0.7F}, tinted.baseColor = {1, 0, 0.6F, 1};
  return {{"clear", splitting(1.5F, 2)},
          {"dense", splitting(2.4F, 1)},
          {"clamped", splitting(1.2F, 60)},
          {"rough", rough},
          {"partly matte", half},
          {"blended", veiled},
          {"under a coat and a film", coated},
          {"tinted", tinted}};
}

Settings oneProgramOfGlass(Settings settings) {
  settings.keepFeatures = bitOf(Feature::CLEARCOAT) | bitOf(Feature::IRIDESCENCE) | bitOf(Feature::METAL) |
                          bitOf(Feature::ALPHA_BLEND) | bitOf(Feature::SPECULAR_EXTENSION) |
                          bitOf(Feature::ABSORPTION) | bitOf(Feature::MICROFACET);
  return settings;
}

TEST(Dispersion, AgreesWithTheReference) {
  for (const auto& [name, material] : kindsOfGlass()) {
    Settings settings = oneProgramOfGlass(smallSettings(5));
    settings.ambient = 0.1F;
    const Agreement agreement = compareWithReference(glassStage(material), settings);
    expectAgreement(agreement, name, 6);
    EXPECT_TRUE(uses(agreement.kernel.stats, "dispersion")) << name;
  }
}

TEST(Dispersion, AgreesWithTheReferenceWithGlossOneImpulseAndCutoff) {
  for (const bool one : {false, true}) {
    for (const auto& [name, material] : kindsOfGlass()) {
      Settings settings = oneProgramOfGlass(smallSettings(4));
      settings.raysPerPixel = 4;
      settings.glossy = true;
      if (one) settings.impulses = ImpulseMode::One;
      if (!one) settings.cutoff = 0.02F;
      expectAgreement(compareWithReference(glassStage(material), settings), name, 6);
    }
  }
}

TEST(Dispersion, IsLeftOutWhereNoGlassAsks) {
  Material flat = splitting(1.5F, 2), unbent = splitting(1, 2), opaque = splitting(1.5F, 2);
  flat.volume = false;
  opaque.transmission = 0;
  for (const Material& m : {splitting(1.5F, 0), flat, unbent, opaque})
    EXPECT_FALSE(uses(renderOnDevice(glassStage(m), smallSettings(3)).stats, "dispersion"));
  const RenderResult without = renderOnDevice(glassStage(splitting(1.5F, 0)), smallSettings(4));
  Settings kept = smallSettings(4);
  kept.keepFeatures = bitOf(Feature::DISPERSION);
  const RenderResult with = renderOnDevice(glassStage(splitting(1.5F, 0)), kept);
  EXPECT_TRUE(uses(with.stats, "dispersion"));
  EXPECT_EQ(differingPixels(without.radiance, with.radiance), 0U);
  EXPECT_EQ(without.stats.rays.total(), with.stats.rays.total());
}

/// With queues that are cut, and samples of more entries than a slice holds.
TEST(Dispersion, GivesTheSameBitsForEachNumberOfLanesAndEachSizeOfQueues) {
  Settings settings = smallSettings(10);
  const Scene scene = glassStage(splitting(1.8F, 3));
  const RenderResult eight = renderOnDevice(scene, settings);
  EXPECT_EQ(eight.stats.dropped, 0U);
  for (const int wavefront : {1, 1 << 12}) {
    settings.wavefront = wavefront;
    const RenderResult small = renderOnDevice(scene, settings);
    EXPECT_EQ(differingPixels(eight.radiance, small.radiance), 0U) << wavefront;
    EXPECT_EQ(small.stats.dropped, 0U) << wavefront;
  }
  settings.lanes = Lanes::One;
  EXPECT_EQ(differingPixels(eight.radiance, renderOnDevice(scene, settings).radiance), 0U);
}

/// Without loss it is invisible in a white surrounding, each colour by itself.
TEST(Dispersion, IsInvisibleInAWhiteSurrounding) {
  Scene scene;
  addPrism(scene, splitting(1.5F, 2));
  scene.background.radiance = glm::vec3(1);
  const glm::vec3 seen = shot(scene, {-2, 0.5, 0}, {1, 0, 0}, 12);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 1, 1e-5) << c;
}

}  // namespace
}  // namespace whittle::test
