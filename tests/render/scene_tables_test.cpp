// Every row of kernels/shared/scene_tables.h at work: the kernels and the reference, which reads no table,
// draw the same. A new row is tested here without a line more.
#include "analysis/material_use.h"
#include "analysis/scene_features.h"
#include "scene/material_factors.h"
#include "support/agreement.h"
#include "support/pictures.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

/// A floor seen aslant, with a sheet above a part of it.
Scene floorAndSheet(const Material& floor) {
  Scene scene;
  addFloor(scene, floor, 0, true, 4);
  addQuad(scene, addMaterial(scene, lambert(glm::vec3(0.5F))), {-1, 1, -1}, {0, 0, 1.5F}, {1.5F, 0, 0});
  Camera camera;
  camera.position = {0.3F, 3, 4};
  aim(camera, {0, -0.6, -1});
  scene.cameras = {camera};
  return scene;
}

TEST(LightTypes, EachAgreesWithTheReference) {
  for (const LightType& type : kLightTypes) {
    SCOPED_TRACE(type.word);
    Light light = pointLight({1, 3, 0.5F}, 20);
    light.kind = type.kind;
    light.direction = glm::normalize(glm::vec3(-0.3F, -1, -0.1F));
    light.range = type.isPlaced ? 6 : light.range;
    light.innerConeAngle = 0.3F;
    light.outerConeAngle = 0.9F;
    Scene scene = floorAndSheet(lambert({0.5F, 0.25F, 0.75F}));
    addQuad(scene, addMaterial(scene, emitter({3, 2, 1})), {2, 1, -2}, {0, 1, 0},
            {0, 0, 1});                     // of a surface light
    scene.background.radiance = {1, 2, 3};  // of a sky
    scene.lights = {light};
    const Agreement lit = compareWithReference(scene, smallSettings(1));
    expectAgreement(lit, type.word, 4);
    EXPECT_GT(lit.mean, 0);
    EXPECT_TRUE(SceneFeatures::analyse(scene, smallSettings(1), {true}).has(featureOf(type.kind)));
    EXPECT_EQ(&typeOf(type.kind), &type);
  }
}

/// Everything at once, so that each texture shows in something.
Material busyMaterial() {
  Material m;
  m.baseColor = {0.8F, 0.6F, 0.9F, 1};
  m.metallic = 0.4F;
  m.roughness = 0.6F;
  m.emission = {0.2F, 0.1F, 0.3F};
  m.specularColor = {0.9F, 0.6F, 0.4F};
  m.transmission = 0.5F;
  // A factor of 0 would leave its texture unread.
  eachFactor(m, [](const MaterialFactor&, std::span<float> numbers) {
    for (float& v : numbers)
      if (v == 0.0F) v = 0.4F;
  });
  return m;
}

Scene texturedFloor(const Material& material) {
  Scene scene = floorAndSheet(material);
  scene.images.push_back(
      {"", 2, 2, {250, 60, 130, 90, 40, 200, 80, 255, 90, 110, 240, 30, 160, 20, 60, 180}});
  scene.uv0.assign(scene.positions.size(), glm::vec2(0));
  scene.uv0[1] = {0, 1}, scene.uv0[2] = {1, 1}, scene.uv0[3] = {1, 0};
  scene.normals.assign(scene.positions.size(), glm::vec3(0, 1, 0));
  scene.tangents.assign(scene.positions.size(), glm::vec4(1, 0, 0, 1));
  scene.lights = {pointLight({1, 3, 0.5F}, 20), pointLight({-1, -2, 0.5F}, 20)};  // one behind the floor
  scene.background.radiance = glm::vec3(0.3F);
  return scene;
}

TEST(TextureSlots, EachIsReadAndAgreesWithTheReference) {
  const Settings plain = smallSettings(2);
  Settings settings = plain;
  settings.aovs = true;  // as compareWithReference
#define WHITTLE_KEEP(slot, FEATURE, encoding, factor, OTHERS) \
  settings.keepFeatures |= bitOf(Feature::FEATURE);
  WHITTLE_TEXTURE_SLOTS(WHITTLE_KEEP)  // one program for all of them: most of the time is its compilation
#undef WHITTLE_KEEP
  const RenderResult without = renderOnDevice(texturedFloor(busyMaterial()), settings);
  const auto compare = [&](TextureSlot Material::*slot, Feature feature, const char* name) {
    Material material = busyMaterial();
    (material.*slot).image = 0;
    const Scene scene = texturedFloor(material);
    const Agreement with = compareWithReference(scene, settings);
    expectAgreement(with, name, 4);
    EXPECT_GT(differingPixels(with.kernel.radiance, without.radiance), 1000U) << name;
    EXPECT_TRUE(SceneFeatures::analyse(scene, plain, {true}).has(feature)) << name;
  };
#define WHITTLE_COMPARE(slot, FEATURE, encoding, factor, OTHERS) \
  compare(&Material::slot, Feature::FEATURE, #slot);
  WHITTLE_TEXTURE_SLOTS(WHITTLE_COMPARE)
#undef WHITTLE_COMPARE
}

/// All textures, a mask that cuts holes out, and an inside that absorbs.
Material textured(Material m) {
  for (const auto slot : kTextureSlots) (m.*slot).image = 0;
  m.alphaMode = AlphaMode::Mask;
  m.volume = true;
  return m;
}

/// A slab, so that its inside shows: through the holes of its top one sees the back of its bottom.
Scene slab(const Material& material) {
  Scene scene = texturedFloor(material);
  addQuad(scene, 0, {-4, -0.5F, -4}, {8, 0, 0}, {0, 0, 8});
  scene.uv0.resize(scene.positions.size(), {0.75F, 0.25F});  // no hole
  scene.normals.resize(scene.positions.size(), glm::vec3(0, -1, 0));
  scene.tangents.resize(scene.positions.size(), glm::vec4(1, 0, 0, 1));
  return scene;
}

/// For each factor: a material with its numbers changed, still in range.
std::map<std::string, Material> changedOnce(const Material& m) {
  std::map<std::string, Material> changed;
  eachFactor(m, [&](const MaterialFactor& factor, std::span<const float>) {
    Material& other = changed[factor.name] = m;
    eachFactor(other, [&](const MaterialFactor& ofOther, std::span<float> numbers) {
      if (std::string_view(ofOther.name) != factor.name) return;
      for (float& v : numbers) v *= 0.8F;
    });
  });
  return changed;
}

/// Where a film is denser than what it lies on, half a wave is lost elsewhere: a jump of the extension's
/// model, on either side of which rounding may put a pixel. Textures sweep all indices of the base across it:
/// of 300 000 values of a channel some two are within 1e-6 of the film's.
constexpr std::size_t kAtTheFilmsJump = 4;

TEST(MaterialFactors, EachIsReadAndAgreesWithTheReference) {
  const Material material = textured(busyMaterial());
  Settings settings = smallSettings(2);
  settings.aovs = true;  // as compareWithReference
  const RenderResult without = renderOnDevice(slab(material), settings);
  for (const auto& [name, changed] : changedOnce(material)) {
    const Agreement with = compareWithReference(slab(changed), settings);
    expectAgreement(with, name, 4, kAtTheFilmsJump);
    EXPECT_GT(differingPixels(with.kernel.radiance, without.radiance), 100U) << name;
  }
}

/// Two unlit materials are one on the device where the reference draws them alike, and only there.
TEST(MaterialFactors, AnUnlitSurfaceKeepsThoseThatItShows) {
  const Settings settings = smallSettings(2);
  const auto isShown = [&](const Material& a, const Material& b) {
    const auto pictureOf = [&](const Material& m) { return renderReference(slab(m), settings).radiance; };
    return differingPixels(pictureOf(a), pictureOf(b)) > 0;
  };
  const auto isKept = [&](const Material& a, const Material& b) {
    return bitsOf(asRead(a, settings)) != bitsOf(asRead(b, settings));
  };
  Material unlit = textured(busyMaterial());
  unlit.unlit = true;
  std::map<std::string, Material> changed = changedOnce(unlit);
#define WHITTLE_EMPTIED(slot, FEATURE, encoding, factor, OTHERS) (changed[#slot] = unlit).slot = {};
  WHITTLE_TEXTURE_SLOTS(WHITTLE_EMPTIED)
#undef WHITTLE_EMPTIED
  for (const auto& [name, other] : changed) EXPECT_EQ(isKept(unlit, other), isShown(unlit, other)) << name;
  expectAgreement(compareWithReference(slab(unlit), settings), "unlit", 4);
}

}  // namespace
}  // namespace whittle::test
