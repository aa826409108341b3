// Whitted's ambient term: what it adds to each kind of surface, in kernels and reference, and that it is
// nowhere unless asked for.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "analysis/ambient.h"
#include "scene/input_error.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

Settings withAmbient(std::optional<float> ambient) {
  Settings settings = smallSettings(3);
  settings.width = settings.height = 8;
  settings.ambient = ambient;
  return settings;
}

/// A floor of `material` in the dark, seen from above.
Scene floorOf(const Material& material) {
  Scene scene;
  addFloor(scene, material, 0, true, 4);
  scene.cameras = {lookingDown()};
  return scene;
}

glm::vec3 seenWith(const Scene& scene, float ambient, Lanes lanes) {
  Settings settings = withAmbient(ambient);
  settings.lanes = lanes;
  settings.keepAllFeatures = true;
  return colorOf(renderOnDevice(scene, settings), 27);
}

void expectColor(const glm::vec3& seen, const glm::dvec3& expected, const char* what) {
  EXPECT_NEAR(glm::length(glm::dvec3(seen) - expected), 0, 1e-6) << what << ": " << seen.x;
}

TEST(Ambient, EachKindOfSurfaceReturnsItsShare) {
  const glm::vec3 c(0.5F, 0.25F, 0.125F);
  const float X = 3;
  Material matte = lambert(c), metal = lambert(c), clear = lambert(c), thin = lambert(c), flat = lambert(c);
  metal.metallic = 0.75F;
  clear.transmission = 0.25F;
  thin.alphaMode = AlphaMode::Blend;
  thin.baseColor.a = 0.5F;
  flat.unlit = true;
  const Material shiny = mirror(c);
  Material coated = lambert(c);  // F0 = 0.04
  coated.roughness = 0;
  coated.specular = 1;
  for (const Lanes lanes : {Lanes::Auto, Lanes::One}) {
    expectColor(seenWith(floorOf(matte), X, lanes), glm::dvec3(c) * 3.0, "matte");
    expectColor(seenWith(floorOf(metal), X, lanes), glm::dvec3(c) * 3.0, "half metal, rough: all of it");
    expectColor(seenWith(floorOf(clear), X, lanes), glm::dvec3(c) * 3.0 * 0.75,
                "transmits a quarter into the dark");
    expectColor(seenWith(floorOf(thin), X, lanes), glm::dvec3(c) * 3.0 * 0.5, "half there");
    expectColor(seenWith(floorOf(flat), X, lanes), glm::dvec3(c), "unlit");
    expectColor(seenWith(floorOf(coated), X, lanes), glm::dvec3(c) * 3.0 * 0.96,
                "a coat that reflects the dark");
    expectColor(seenWith(floorOf(shiny), X, lanes), glm::dvec3(0), "a mirror shows what it reflects");
  }
}

TEST(Ambient, IsSeenInMirrorsAndThroughWhatAbsorbs) {
  Scene scene = floorOf(mirror(glm::vec3(0.5F)));
  addFloor(scene, lambert(glm::vec3(0.5F)), 2, false, 4);
  expectColor(seenWith(scene, 1, Lanes::Auto), glm::dvec3(0.25), "half of a half");
}

/// The bound on what is missing knows of it, and knows that mirrors do not glow.
TEST(Ambient, LeavesABound) {
  Scene scene = floorOf(mirror(glm::vec3(0.5F)));
  addFloor(scene, lambert(glm::vec3(0.5F)), 2, false, 4);
  Settings settings = withAmbient(3);
  settings.bounces = 1;
  const Stats stats = renderOnDevice(scene, settings).stats;
  EXPECT_NEAR(stats.biasBound, 1.5, 1e-3) << "all of what the matte floor sends back";
}

TEST(Ambient, IsNotCompiledUnlessAskedForAndOfUse) {
  const auto isUsed = [](const Scene& scene, float ambient) {
    return uses(renderOnDevice(scene, withAmbient(ambient)).stats, "ambient light");
  };
  const Scene matte = floorOf(lambert(glm::vec3(0.5F)));
  EXPECT_FALSE(isUsed(matte, 0));
  EXPECT_TRUE(isUsed(matte, 1));
  Material flat = lambert(glm::vec3(0.5F));
  flat.unlit = true;
  EXPECT_FALSE(isUsed(floorOf(flat), 1));
}

TEST(Ambient, AgreesWithTheReference) {
  for (const char* name : {"cornell_box", "textured", "nested_glass"}) {
    Settings settings = wholeSettings(4);
    settings.ambient = 0.7F;
    expectAgreement(compareWithReference(ownScene(name), settings), name, 4);
  }
}

TEST(Ambient, AutoIsATenthOfWhatAWhiteSurfaceWouldSendBack) {
  Scene scene;  // its box has the diagonal 4 · sqrt(2)
  addFloor(scene, lambert(glm::vec3(1)), 0, true, 2);
  EXPECT_EQ(automaticAmbient(scene), 0);
  scene.lights = {pointLight({0, 0, 0}, 1)};
  scene.lights[0].kind = LightKind::Directional;
  scene.lights[0].intensity = {1, 2, 4};
  EXPECT_NEAR(automaticAmbient(scene), 0.1 * 4 / std::numbers::pi, 1e-6);
  scene.lights = {pointLight({0, 10, 0}, 100)};
  EXPECT_NEAR(automaticAmbient(scene), 0.1 * 1 / std::numbers::pi, 1e-6);
  scene.lights = {pointLight({0, 0.01F, 0}, 8)};  // inside: as though at the half diagonal, sqrt(8)
  EXPECT_NEAR(automaticAmbient(scene), 0.1 * 1 / std::numbers::pi, 1e-6);
  scene.lights[0].range = 1;
  EXPECT_EQ(automaticAmbient(scene), 0);
  scene.background.radiance = {0.5F, 2, 1};
  EXPECT_NEAR(automaticAmbient(scene), 0.2, 1e-6);
  // A map of two rows: both cover half the sphere.
  scene.background.width = 1;
  scene.background.height = 2;
  scene.background.map = {1, 0, 0, 3, 0, 0};
  EXPECT_NEAR(automaticAmbient(scene), 0.1 * 0.5 * 2, 1e-6);
}

TEST(Ambient, OutsideItsRangeIsRefused) {
  for (const float ambient : {-1.0F, NAN, INFINITY})
    EXPECT_THROW(renderOnDevice(floorOf(lambert(glm::vec3(1))), withAmbient(ambient)), InputError) << ambient;
}

}  // namespace
}  // namespace whittle::test
