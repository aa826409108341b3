// The analysis behind SceneFeatures: one line for each feature, with the reason a person is given where it is
// left out.
#include "analysis/scene_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/feature_needs.h"
#include "scene/camera.h"
#include "scene/coarse_normals.h"
#include "scene/light_size.h"
#include "scene/material_predicates.h"
#include "scene/sky_light.h"

namespace whittle {
namespace {

/// The scene seen through the questions that features ask.
class Needs {
 public:
  Needs(const Scene& ofScene, const PrunedScene& ofUse, const Settings& withSettings,
        const DeviceTraits& onDevice)
      : scene(ofScene),
        pruned(ofUse),
        settings(withSettings),
        traits(onDevice),
        nearPlane(camera() && nearPlaneCuts(ofScene, *camera(),
                                            static_cast<double>(withSettings.width) / withSettings.height)) {}

  const Scene& scene;
  const PrunedScene& pruned;  ///< what goes to the device
  const Settings& settings;
  const DeviceTraits& traits;
  const bool nearPlane;  ///< something lies before it; asked once, of every triangle
  /// Impulses are compiled whatever the scene needs: a feature that is kept needs them.
  bool keepsImpulses = false;

  bool anyMaterial(const std::function<bool(const Material&)>& wanted) const {
    return std::any_of(pruned.materials.begin(), pruned.materials.end(), wanted);
  }
  bool anyLight(const std::function<bool(const Light&)>& wanted) const {
    return std::any_of(pruned.lights.begin(), pruned.lights.end(),
                       [&](std::uint32_t i) { return wanted(scene.lights[i]); });
  }
  bool anySlot(const std::function<bool(const TextureSlot&)>& wanted) const {
    return anyMaterial([&](const Material& m) {
      return std::any_of(kTextureSlots.begin(), kTextureSlots.end(),
                         [&](auto slot) { return (m.*slot).used() && wanted(m.*slot); });
    });
  }

  /// Whether a slot of linear values reads an image of more than 8 bits.
  bool deepTextures() const {
    return anyMaterial([&](const Material& m) {
      for (std::size_t i = 0; i < kTextureSlots.size(); ++i) {
        const TextureSlot& slot = m.*kTextureSlots[i];
        if (slot.used() && readsDeepTexels(imageOf(slot), kSlotIsLinear[i])) return true;
      }
      return false;
    });
  }

  /// Whether a texture has smaller levels than the one in the file.
  bool textureLevels() const {
    return settings.textureFilter != TextureFilter::None && anySlot([&](const TextureSlot& slot) {
             const Image& image = imageOf(slot);
             return slot.hasLevels && (image.width > 1 || image.height > 1);
           });
  }

  bool lit() const { return !pruned.lights.empty(); }
  /// A question of material_predicates.h that depends on what counts as a mirror.
  bool anyMaterial(bool (*asked)(const Material&, float)) const {
    return anyMaterial([&](const Material& m) { return asked(m, settings.mirrorRoughness); });
  }
  /// The same of what sends out impulses.
  bool anyReflecting(bool (*asked)(const Material&, float)) const {
    return anyMaterial([&](const Material& m) { return asked(m, reflectingRoughness(settings)); });
  }
  bool bounces() const { return settings.bounces > 1 && anyReflecting(canSendImpulses); }
  bool straight() const { return anyMaterial(goesStraightOn); }
  /// Null in scenes by hand that have none.
  const Camera* camera() const {
    return scene.cameras.empty() ? nullptr : &scene.cameras[findCamera(scene, settings.camera)];
  }
  bool impulses() const { return bounces() || straight() || nearPlane; }
  /// Where there are impulses, all that says where they go has to be there, even for one bounce: a volume
  /// whose refraction were left out would let them straight on.
  bool directsImpulses() const { return impulses() || keepsImpulses; }
  bool shadows() const {
    return settings.shadows && lit() && anyLight([](const Light& l) { return l.castsShadows; });
  }
  bool twoImpulses() const {
    return directsImpulses() && settings.impulses == ImpulseMode::All && anyReflecting(canSendTwoImpulses);
  }
  const Image& imageOf(const TextureSlot& slot) const {
    return scene.images[pruned.images[static_cast<std::size_t>(slot.image)]];
  }
  bool tree() const {
    if (settings.search != Search::Auto) return settings.search == Search::Tree;
    return scene.triangles.size() >= kArrayBelowTriangles;
  }
  bool packets() const {
    return settings.lanes == Lanes::Sixteen || (settings.lanes == Lanes::Auto && traits.packets);
  }
};

struct Question {
  Feature feature;
  bool used;
  std::string reason;
  bool settingDecides = false;  ///< --keep-all-features leaves it as it is
};

std::vector<Question> geometryQuestions(const Needs& n) {
  using F = Feature;
  const bool isFiltered = n.settings.textureFilter != TextureFilter::None;
  return {
      {F::PACKETS, n.packets(), "the device traces one ray for each work item", true},
      {F::TREE, n.tree(), "so few triangles are searched one by one", true},
      {F::VERTEX_NORMALS, !n.scene.normals.empty(), "no mesh has vertex normals"},
      {F::VERTEX_COLORS, !n.scene.colors.empty(), "no mesh has vertex colours"},
      {F::TEXTURES, n.anySlot([](const TextureSlot&) { return true; }), "no material has a texture"},
      {F::UV0, n.anySlot([](const TextureSlot& s) { return s.uvSet == 0; }) && !n.scene.uv0.empty(),
       "no texture reads the first UV set"},
      {F::UV1, n.anySlot([](const TextureSlot& s) { return s.uvSet != 0; }) && !n.scene.uv1.empty(),
       "no texture reads a second UV set"},
      {F::NEAREST_FILTER, n.anySlot([](const TextureSlot& s) { return s.filter == Filter::Nearest; }),
       "every texture is filtered"},
      {F::TEXTURE_LEVELS, n.textureLevels(),
       isFiltered ? "no texture can be seen smaller than it is" : "--texture-filter is none", !isFiltered},
      {F::DEEP_TEXTURES, n.deepTextures(), "no map has more than 8 bits"},
  };
}

/// A question for each thing that only some materials do.
std::vector<Question> materialQuestions(const Needs& n) {
  return {
#define WHITTLE_QUESTION(FEATURE, isAsked, reason, OTHERS) \
  {Feature::FEATURE, n.anyMaterial([](const Material& m) { return isAsked; }), reason},
      WHITTLE_MATERIAL_FEATURES(WHITTLE_QUESTION)
#undef WHITTLE_QUESTION
  };
}

/// A question for each texture slot that has a feature of its own.
std::vector<Question> textureQuestions(const Needs& n) {
  return {
#define WHITTLE_QUESTION(slot, FEATURE, encoding, factor, OTHERS)                    \
  {Feature::FEATURE, n.anyMaterial([](const Material& m) { return m.slot.used(); }), \
   fmt::format("no {}", featureText(Feature::FEATURE))},
      WHITTLE_OWN_TEXTURE_SLOTS(WHITTLE_QUESTION)
#undef WHITTLE_QUESTION
  };
}

/// A question for each light type.
std::vector<Question> lightTypeQuestions(const Needs& n) {
  std::vector<Question> questions;
  questions.reserve(std::size(kLightTypes));
  for (const LightType& type : kLightTypes)
    questions.push_back({featureOf(type.kind),
                         n.anyLight([&](const Light& l) { return l.kind == type.kind; }),
                         fmt::format("no {} light", type.word),
                         standsForOthers(type.kind)});  // a second surfel at each hit: long to compile
  return questions;
}

std::vector<Question> lightQuestions(const Needs& n) {
  using F = Feature;
  const glm::vec3 b = n.scene.background.radiance;
  return {
      {F::LIGHTS, n.lit(),
       n.scene.lights.empty() ? "the scene has no lights" : "no light of the scene reaches anything"},
      {F::SHADOWS, n.shadows(), n.settings.shadows ? "no light casts shadows" : "shadows are switched off",
       !n.settings.shadows},
      {F::FILTERED_SHADOWS, n.shadows() && n.anyMaterial(filters),
       "no surface that casts a shadow lets light through"},
      {F::LIGHT_SIZE, n.anyLight([&](const Light& l) { return hasSize(l, n.settings); }),
       "lights are points and directions", true},
      {F::LIGHT_RANGE, n.anyLight([](const Light& l) { return std::isfinite(l.range); }),
       "no light has a range"},
      {F::MICROFACET, n.lit() && n.anyMaterial(canShowHighlight), "no rough surface shows a highlight"},
      {F::EMISSION, n.anyMaterial(emits), "no material emits"},
      {F::AMBIENT, ambientOf(n.scene, n.settings) > 0.0F && n.anyMaterial(isLit),
       ambientOf(n.scene, n.settings) > 0.0F      ? "no material answers to light"
       : n.settings.ambient.value_or(0.0F) > 0.0F ? "light from the sky takes its place"
                                                  : "no ambient light was asked for"},
      {F::TERMINATOR, n.lit() && n.settings.smoothTerminator && hasCoarseNormals(n.scene),
       n.settings.smoothTerminator ? "vertex normals are those of the triangles, or fine enough"
                                   : "it is switched off",
       !n.settings.smoothTerminator},
      {F::UNLIT, n.anyMaterial([](const Material& m) { return m.unlit; }), "no material is unlit"},
      {F::BACKGROUND, b.r > 0.0F || b.g > 0.0F || b.b > 0.0F, "the background is black"},
      {F::BACKGROUND_MAP, !n.scene.background.map.empty(), "the background is one colour"},
  };
}

std::vector<Question> impulseQuestions(const Needs& n) {
  using F = Feature;
  const bool some = n.directsImpulses();
  const char* const none = n.settings.bounces <= 1 ? "one bounce sends out no impulses"
                                                   : "no material is smooth, transmits or blends";
  return {
      {F::IMPULSES, n.impulses(), none, n.settings.bounces <= 1},
      {F::STRAIGHT, n.straight() || n.nearPlane, "no surface lets light straight on",
       n.settings.bounces <= 1},
      {F::ONE_SIDED, n.settings.backFaces == BackFaces::Cull && n.anyMaterial(showsFrontOnly),
       n.settings.backFaces == BackFaces::Cull ? "every surface has two sides" : "back faces are shown",
       true},
      {F::MIRROR, some && n.anyReflecting(canReflect), some ? "no smooth material reflects" : none},
      {F::GLOSS, some && n.settings.glossy && (n.anyMaterial(canBeRough) || n.anyMaterial(coatCanBeRough)),
       n.settings.glossy ? "no material is rough" : "rough surfaces show highlights alone", true},
      {F::REFRACTION, some && n.anyMaterial(refracts), "no transmitting material bounds a volume"},
      {F::ALPHA_MASK, n.anyMaterial(isMasked),
       n.pruned.pruning.needlessMasks > 0 ? "masks cut nothing out" : "no material is masked"},
      {F::ALPHA_BLEND, n.anyMaterial(blends),
       n.pruned.pruning.needlessBlends > 0 ? "blended materials are opaque" : "no material is blended"},
      {F::BOTH_BRANCHES, n.twoImpulses(),
       n.settings.impulses == ImpulseMode::One ? "one impulse is chosen at random"
                                               : "no surface sends out two impulses",
       n.settings.impulses == ImpulseMode::One},
      {F::CUTOFF, some && n.settings.cutoff > 0.0F,
       n.settings.cutoff > 0.0F ? none : "no cut-off was asked for", true},
      {F::ONE_IMPULSE, some && n.settings.impulses == ImpulseMode::One, "both branches are followed", true},
  };
}

std::vector<Question> cameraQuestions(const Needs& n) {
  using F = Feature;
  const bool many = n.settings.raysPerPixel > 1;
  const auto sampler = [&](Sampler s) { return many && n.settings.sampler == s; };
  const char* const one = many ? "another sampler was chosen" : "one ray goes through the pixel's centre";
  return {
      {F::ORTHOGRAPHIC,
       std::any_of(n.scene.cameras.begin(), n.scene.cameras.end(),
                   [](const Camera& c) { return c.orthographic; }),
       "no camera is orthographic"},
      {F::SAMPLER_RANDOM, sampler(Sampler::Random), one},
      {F::SAMPLER_STRATIFIED, sampler(Sampler::Stratified), one},
      {F::SAMPLER_SOBOL, sampler(Sampler::Sobol), one},
      {F::NEAR_PLANE, n.nearPlane, "nothing lies before the near plane", true},
      {F::FAR_PLANE, n.settings.clipFar && n.camera() && std::isfinite(n.camera()->zfar),
       n.settings.clipFar ? "the camera has no far plane" : "the far plane is not asked for", true},
      {F::LENS, n.settings.aperture > 0.0F, "the camera is a pinhole", true},
      {F::FIXED_RAY_OFFSET, n.settings.rayOffset.has_value(), "the ray offset is derived at each hit"},
      {F::COVERAGE, n.settings.alpha, "no alpha channel was asked for", true},
      {F::AOVS, n.settings.aovs, "no auxiliary output was asked for", true},
      {F::COST, n.settings.costAov, "nobody asks what searches cost", true},
  };
}

std::vector<Question> allQuestions(const Needs& needs) {
  std::vector<Question> questions;
  for (auto part :
       {geometryQuestions(needs), materialQuestions(needs), textureQuestions(needs),
        lightTypeQuestions(needs), lightQuestions(needs), impulseQuestions(needs), cameraQuestions(needs)})
    questions.insert(questions.end(), part.begin(), part.end());
  return questions;
}

/// Bits of what the scene needs, or of all but what the settings decide.
std::uint64_t askedFor(const std::vector<Question>& questions, const Settings& settings) {
  std::uint64_t bits = 0;
  for (const auto& q : questions)
    if (q.used || (settings.keepAllFeatures && !q.settingDecides)) bits |= bitOf(q.feature);
  return bits;
}

}  // namespace

SceneFeatures SceneFeatures::analyse(const Scene& scene, const PrunedScene& pruned, const Settings& settings,
                                     const DeviceTraits& traits) {
  Needs needs(scene, pruned, settings, traits);
  const std::vector<Question> questions = allQuestions(needs);
  const std::uint64_t asked = askedFor(questions, settings);
  ForcedFeatures forced = forcedFeatures(settings, asked);
  if (forced.bits & bitOf(Feature::IMPULSES)) {
    needs.keepsImpulses = true;
    const std::uint64_t directing = askedFor(allQuestions(needs), settings) & ~asked & ~forced.bits;
    for (const auto& q : questions)
      if (directing & bitOf(q.feature)) forced.neededBy.emplace(q.feature, Feature::IMPULSES);
    forced.bits |= directing;
  }
  SceneFeatures features;
  features.bits_ = asked | forced.bits;
  for (const auto& q : questions) {
    const bool used = features.bits_ & bitOf(q.feature);
    const auto neededBy = forced.neededBy.find(q.feature);
    features.lines_.push_back({q.feature, featureText(q.feature), used, used ? "" : q.reason, used && !q.used,
                               neededBy == forced.neededBy.end() ? "" : featureText(neededBy->second)});
  }
  std::sort(features.lines_.begin(), features.lines_.end(), [](const FeatureLine& a, const FeatureLine& b) {
    return static_cast<int>(a.feature) < static_cast<int>(b.feature);
  });
  return features;
}

}  // namespace whittle
