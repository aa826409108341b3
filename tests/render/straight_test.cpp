// What goes straight on: blended layers and clear sheets cost no bounce, and nothing between them is lost.
#include <fmt/format.h>

#include <cmath>

#include "kernels/shared/layout.h"
#include "scene/input_error.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

/// A wall of radiance 1 at y = 0 and `count` veils above it, from `height` upwards `apart` from each other.
Scene veils(int count, float alpha, float height, float apart) {
  Scene scene;
  addFloor(scene, emitter(glm::vec3(1)), 0, true, 4);
  const std::uint32_t material = addMaterial(scene, veil(alpha));
  for (int i = 0; i < count; ++i)
    addQuad(scene, material, {-4, height + apart * static_cast<float>(i), -4}, {0, 0, 8}, {8, 0, 0});
  return scene;
}

struct Form {
  Search search;
  Lanes lanes;
};
constexpr Form kForms[]{{Search::Tree, Lanes::Auto},
                        {Search::Tree, Lanes::One},
                        {Search::Array, Lanes::Auto},
                        {Search::Array, Lanes::One}};

RenderResult lookDown(Scene scene, double height, const Form& form, Settings settings) {
  Camera camera = lookingDown();
  camera.position = {0.1F, static_cast<float>(height), 0.2F};
  scene.cameras = {camera};
  settings.width = settings.height = 8;
  settings.keepAllFeatures = true;
  settings.search = form.search;
  settings.lanes = form.lanes;
  return renderOnDevice(scene, settings);
}

TEST(StraightOn, LayersMultiplyWhateverTheBounces) {
  for (const Form& form : kForms)
    for (const int bounces : {1, 8})
      for (const int count : {1, 12, 40})
        for (const float alpha : {0.0F, 0.1F}) {
          Settings settings;
          settings.bounces = bounces;
          const RenderResult result = lookDown(veils(count, alpha, 1, 0.01F), 5, form, settings);
          const double expected = std::pow(1 - static_cast<double>(alpha), count);
          for (const float v : result.radiance.pixels)
            ASSERT_NEAR(v, expected, 1e-6) << count << " " << alpha;
          EXPECT_EQ(result.stats.rays.impulse, 64U * static_cast<unsigned>(count));
        }
}

/// Floats at 1 km are 61 µm apart: six layers each lie in the same place.
TEST(StraightOn, NothingIsLostBetweenLayersCloserThanRounding) {
  for (const Form& form : kForms) {
    const RenderResult result = lookDown(veils(12, 0.1F, 1000, 1e-5F), 1001, form, {});
    for (const float v : result.radiance.pixels) ASSERT_NEAR(v, std::pow(0.9, 12), 1e-6);
    const RenderResult far = lookDown(veils(12, 0.1F, 1, 1e-5F), 1001, form, {});
    for (const float v : far.radiance.pixels) ASSERT_NEAR(v, std::pow(0.9, 12), 1e-6);
  }
}

TEST(StraightOn, HasALimitOfItsOwn) {
  for (const int limit : {0, 11, 12}) {
    Settings settings;
    settings.transparentBounces = limit;
    const RenderResult result = lookDown(veils(12, 0.1F, 1, 0.01F), 5, kForms[0], settings);
    for (const float v : result.radiance.pixels)
      EXPECT_NEAR(v, limit < 12 ? 0 : std::pow(0.9, 12), 1e-6) << limit;
  }
  Settings settings;
  settings.transparentBounces = -1;
  EXPECT_THROW(lookDown(veils(1, 0.1F, 1, 1), 5, kForms[0], settings), InputError);
}

/// A wall of radiance 1 with a decal in its plane, alpha 0.5, glowing (1, 0, 0); seen at an angle.
struct Decal {
  const char* name;
  bool first;   ///< in the scene's order
  bool larger;  ///< or of the same corners
  glm::vec3 u, v;
  float away;
};

Scene decalOn(const Decal& d) {
  Scene scene;
  Material decal = veil(0.5F);
  decal.unlit = false;
  decal.emission = {1, 0, 0};
  const std::uint32_t wall = addMaterial(scene, emitter(glm::vec3(1))), own = addMaterial(scene, decal);
  const glm::vec3 corner = glm::vec3(d.away) - 0.5F * (d.u + d.v);
  const auto addDecal = [&] {
    if (d.larger)
      addQuad(scene, own, corner - 0.125F * d.u - 0.25F * d.v, 1.25F * d.u, 1.5F * d.v);
    else
      addQuad(scene, own, corner, d.u, d.v);
  };
  if (d.first) addDecal();
  addQuad(scene, wall, corner, d.u, d.v);
  if (!d.first) addDecal();
  return scene;
}

class CoplanarDecal : public ::testing::TestWithParam<Decal> {};
void PrintTo(const Decal& d, std::ostream* out) { *out << d.name; }

TEST_P(CoplanarDecal, ShowsEverywhereBeforeTheWall) {
  const Decal& d = GetParam();
  Scene scene = decalOn(d);
  Camera camera;
  const glm::vec3 n = glm::normalize(glm::cross(d.u, d.v));
  camera.position = glm::vec3(d.away) + 3.0F * n + 0.4F * d.u;
  camera.yfov = 0.12F;  // nothing but the wall
  aim(camera, glm::dvec3(glm::vec3(d.away) - camera.position));
  scene.cameras = {camera};
  for (const Form& form : kForms) {
    Settings settings;
    settings.width = settings.height = 64;
    settings.search = form.search;
    settings.lanes = form.lanes;
    const RenderResult result = renderOnDevice(scene, settings);
    for (std::size_t i = 0; i < 64U * 64; ++i) {
      ASSERT_NEAR(colorOf(result, i).x, 1, 1e-6);
      ASSERT_NEAR(colorOf(result, i).y, 0.5, 1e-6) << "a hole, or a wall before the decal";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Decals, CoplanarDecal,
    ::testing::Values(Decal{"upright", true, false, {2, 0, 0}, {0, 2, 0}, 0},
                      Decal{"uprightLast", false, false, {2, 0, 0}, {0, 2, 0}, 7.3F},
                      Decal{"uprightLarger", false, true, {2, 0, 0}, {0, 2, 0}, 7.3F},
                      Decal{"tilted", true, false, {1.9F, 0.3F, -0.2F}, {0.1F, 1.7F, 0.6F}, 7.3F},
                      Decal{"tiltedLast", false, false, {1.9F, 0.3F, -0.2F}, {0.1F, 1.7F, 0.6F}, 7.3F},
                      Decal{"tiltedLarger", false, true, {1.9F, 0.3F, -0.2F}, {0.1F, 1.7F, 0.6F}, 0}),
    [](const auto& decal) { return decal.param.name; });

/// Panes that reflect and let through, a tinted volume that bends nothing, a leaf, and a mirror behind all.
Scene showcase() {
  Scene scene;
  addFloor(scene, mirror({0.9F, 0.8F, 0.7F}), 0, true, 4);
  const std::uint32_t pane = addMaterial(scene, glass(1.5F, false));
  Material tinted = glass(1, true);
  tinted.sigma_a = {0.5F, 1, 2};
  const std::uint32_t volume = addMaterial(scene, tinted);
  Material leaf = lambert({0.2F, 0.7F, 0.1F});
  leaf.alphaMode = AlphaMode::Blend;
  leaf.baseColor.a = 0.3F;
  leaf.doubleSided = true;
  const std::uint32_t green = addMaterial(scene, leaf);
  for (int i = 0; i < 4; ++i)
    addQuad(scene, pane, {-2, 0.5F + 0.05F * static_cast<float>(i), -2}, {0, 0, 4}, {4, 0, 0});
  addQuad(scene, volume, {-1.5F, 1.5F, -1.5F}, {0, 0, 3}, {3, 0, 0});
  addQuad(scene, green, {-1.2F, 1.3F, -1}, {0, 0.1F, 2}, {2.2F, 0.1F, 0});  // inside
  addQuad(scene, volume, {-1.5F, 1, -1.5F}, {3, 0, 0}, {0, 0, 3});
  scene.lights = {pointLight({1, 4, 2}, 40)};
  scene.background.radiance = {0.3F, 0.4F, 0.6F};
  Camera camera;
  camera.position = {0.3F, 3, 4};
  aim(camera, {0, -0.7, -1});
  scene.cameras = {camera};
  return scene;
}

TEST(StraightOn, AgreesWithTheReference) {
  for (const int bounces : {1, 3, 8}) {
    const Agreement agreement = compareWithReference(showcase(), wholeSettings(bounces));
    expectAgreement(agreement, fmt::format("panes, {} bounces", bounces), 12);
  }
}

TEST(StraightOn, HasTheSameBitsHoweverItIsTraced) {
  const Scene scene = showcase();
  const RenderResult base = renderOnDevice(scene, smallSettings());
  const auto expectSame = [&](const Settings& s, const char* what) {
    const RenderResult other = renderOnDevice(scene, s);
    EXPECT_EQ(differingPixels(base.radiance, other.radiance), 0U) << what;
    EXPECT_EQ(base.stats.rays.total(), other.stats.rays.total()) << what;
    EXPECT_EQ(other.stats.dropped, 0U) << what;
  };
  for (const Form& form : kForms) {
    Settings s = wholeSettings();
    s.search = form.search;
    s.lanes = form.lanes;
    expectSame(s, "another search");
  }
  Settings s = wholeSettings();
  expectSame(s, "all features");
  s.wavefront = 512;
  expectSame(s, "small wavefronts");
}

/// One bounce ends at a volume that bends, also where a leaf beside it lets rays straight on. (The features
/// of impulses were once left out for one bounce: the volume let them straight on as well.)
TEST(StraightOn, LeavesTheBendingOfVolumesAlone) {
  for (const int bounces : {1, 2}) {
    Scene scene = ownScene("nested_glass");
    Material leaf = veil(0.3F);
    const Camera& eye = scene.cameras[0];
    addQuad(scene, addMaterial(scene, leaf),
            eye.position + 0.5F * eye.forward - 2.0F * eye.right - 0.1F * eye.up, 4.0F * eye.right,
            0.1F * eye.up);
    Settings settings = smallSettings(bounces);
    expectAgreement(compareWithReference(scene, settings), fmt::format("leaf and glass, {} bounces", bounces),
                    4);
    // The same of a feature that is kept and goes straight on.
    const Scene glassAlone = ownScene("nested_glass");
    const RenderResult plain = renderOnDevice(glassAlone, settings);
    settings.keepFeatures = bitOf(Feature::NEAR_PLANE);
    const RenderResult kept = renderOnDevice(glassAlone, settings);
    EXPECT_EQ(differingPixels(plain.radiance, kept.radiance), 0U) << bounces;
    EXPECT_EQ(plain.stats.rays.total(), kept.stats.rays.total()) << bounces;
  }
}

/// Each pane makes two rays of one; without a limit thirty of them would make millions.
TEST(StraightOn, AStackOfPanesStaysBounded) {
  Scene scene;
  addFloor(scene, emitter(glm::vec3(1)), 0, true, 4);
  const std::uint32_t pane = addMaterial(scene, glass(1.5F, false));
  for (int i = 1; i <= 30; ++i)
    addQuad(scene, pane, {-4, 0.1F * static_cast<float>(i), -4}, {0, 0, 8}, {8, 0, 0});
  const RenderResult result = lookDown(scene, 5, kForms[0], {});
  // 2^7 as if each passage were a bounce, what still carries an eighth, and the panes that each
  // of those passes.
  EXPECT_LT(result.stats.rays.impulse, 64U * 40 * (128 + 8));
  EXPECT_GT(colorOf(result).x, std::pow(0.96, 30) * 0.99);
}

TEST(BackFaces, AreSeenOnlyWhereTwoSidesAreAskedForOrLightPasses) {
  const auto seen = [](const Material& material, BackFaces backFaces) {
    Scene scene;
    addFloor(scene, emitter(glm::vec3(1)), 0, true, 4);
    addFloor(scene, material, 1, false, 4);  // its back is up
    Settings settings;
    settings.backFaces = backFaces;
    std::vector<float> values;
    for (const Form& form : kForms) values.push_back(colorOf(lookDown(scene, 5, form, settings)).x);
    for (const float v : values) EXPECT_EQ(v, values[0]);
    return values[0];
  };
  Material wall = lambert(glm::vec3(0));
  EXPECT_EQ(seen(wall, BackFaces::Cull), 1);
  EXPECT_EQ(seen(wall, BackFaces::Show), 0);
  wall.doubleSided = true;
  EXPECT_EQ(seen(wall, BackFaces::Cull), 0);
  Material pane = glass(1.5F, false);
  EXPECT_LT(seen(pane, BackFaces::Cull), 0.97F);
  pane.volume = true;
  pane.baseColor = {0.5F, 0.5F, 0.5F, 1};
  EXPECT_LT(seen(pane, BackFaces::Cull), 0.6F);
}

/// Red to +Y, blue to −Y, in the same place: the one that faces the ray is seen.
TEST(BackFaces, OfCoincidentFacesTheOneThatFacesTheRayIsSeen) {
  Scene scene;
  Material red = emitter({1, 0, 0}), blue = emitter({0, 0, 1});
  red.doubleSided = blue.doubleSided = false;
  addFloor(scene, blue, 0, false, 4);
  addFloor(scene, red, 0, true, 4);
  EXPECT_EQ(shot(scene, {0.1, 2, 0.2}, {0, -1, 0}, 2), glm::vec3(1, 0, 0));
  EXPECT_EQ(shot(scene, {0.1, -2, 0.2}, {0, 1, 0}, 2), glm::vec3(0, 0, 1));
}

TEST(BackFaces, StillCastShadows) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, 4);
  scene.lights = {pointLight({0, 3, 0}, 10)};
  EXPECT_GT(shot(scene, {0.1, 2.5, 0.2}, {0, -1, 0}, 2).x, 0);
  addFloor(scene, lambert(glm::vec3(0.5F)), 2, false, 4);  // its back to the lamp
  EXPECT_EQ(shot(scene, {0.1, 1.5, 0.2}, {0, -1, 0}, 2).x, 0);
}

/// A red wall before the near plane, a green one within, a blue one beyond the far plane.
Scene walls(float znear, float zfar) {
  Scene scene;
  addFloor(scene, emitter({1, 0, 0}), 4, true, 0.3F);
  addFloor(scene, emitter({0, 1, 0}), 2, true, 0.8F);
  addFloor(scene, emitter({0, 0, 1}), 0, true, 4);
  Camera camera = lookingDown();
  camera.orthographic = false;
  camera.position = {0.05F, 5, 0.02F};
  camera.znear = znear;
  camera.zfar = zfar;
  scene.cameras = {camera};
  return scene;
}

TEST(CameraPlanes, CutWhatLiesBeforeAndOnDemandBeyond) {
  const auto middle = [](float znear, float zfar, bool clipFar, const Form& form) {
    Settings settings = wholeSettings();
    settings.width = settings.height = 9;
    settings.search = form.search;
    settings.lanes = form.lanes;
    settings.clipFar = clipFar;
    return colorOf(renderOnDevice(walls(znear, zfar), settings), 40);
  };
  for (const Form& form : kForms) {
    EXPECT_EQ(middle(0.5F, 100, false, form), glm::vec3(1, 0, 0));
    EXPECT_EQ(middle(1.5F, 100, false, form), glm::vec3(0, 1, 0));
    EXPECT_EQ(middle(3.5F, 4, false, form), glm::vec3(0, 0, 1)) << "zfar alone cuts nothing";
    EXPECT_EQ(middle(3.5F, 4, true, form), glm::vec3(0));
    EXPECT_EQ(middle(0.5F, 4, true, form), glm::vec3(1, 0, 0));
  }
  for (const bool clipFar : {false, true}) {
    Settings settings = wholeSettings();
    settings.clipFar = clipFar;
    expectAgreement(compareWithReference(walls(1.5F, 4.5F), settings), "planes", 8);
  }
  Settings plain;
  EXPECT_FALSE(SceneFeatures::analyse(walls(0.5F, 100), plain, {true}).has(Feature::NEAR_PLANE));
  EXPECT_TRUE(SceneFeatures::analyse(walls(1.5F, 100), plain, {true}).has(Feature::NEAR_PLANE));
}

}  // namespace
}  // namespace whittle::test
