// The table of needs follows the conditions of kernels/shade.cl, occlude.cl and kernels/lib, and
// tests/analysis/features_test.cpp holds it against them; what --keep-features keeps is closed under it.
#include "analysis/feature_needs.h"

#include <fmt/format.h>

#include <algorithm>

namespace whittle {
namespace {

std::uint64_t bitsOf(const std::vector<Feature>& features) {
  std::uint64_t bits = 0;
  for (const Feature f : features) bits |= bitOf(f);
  return bits;
}

/// Features that would go against what the settings say, each with the reason.
std::map<Feature, std::string> contradictions(const Settings& s) {
  std::map<Feature, std::string> out;
  if (s.lanes == Lanes::One) out[Feature::PACKETS] = "--lanes is 1";
  if (s.search == Search::Array) out[Feature::TREE] = "--search is array";
  if (!s.smoothTerminator) out[Feature::TERMINATOR] = "--no-smooth-terminator";
  if (!s.shadows) out[Feature::SHADOWS] = "shadows are switched off";
  if (s.backFaces == BackFaces::Show) out[Feature::ONE_SIDED] = "--back-faces is show";
  if (s.textureFilter == TextureFilter::None) out[Feature::TEXTURE_LEVELS] = "--texture-filter is none";
  if (s.impulses == ImpulseMode::All) out[Feature::ONE_IMPULSE] = "--impulses is all";
  return out;
}

/// The contradictions, and what is nothing without them.
std::map<Feature, std::string> barredFeatures(const Settings& s) {
  std::map<Feature, std::string> barred = contradictions(s);
  const auto isBarred = [&](Feature f) { return barred.contains(f); };
  for (std::size_t before = 0; before != barred.size();) {
    before = barred.size();
    for (const FeatureNeed& need : featureNeeds())
      if (!isBarred(need.feature) && std::all_of(need.oneOf.begin(), need.oneOf.end(), isBarred))
        barred[need.feature] =
            fmt::format("it needs '{}', and {}", featureText(need.oneOf.front()), barred[need.oneOf.front()]);
  }
  return barred;
}

/// Light is that of some type, a range that of one with a place.
std::vector<FeatureNeed> needsOfLights() {
  using F = Feature;
  std::vector<F> types, placed;
  for (const LightType& type : kLightTypes) {
    types.push_back(featureOf(type.kind));
    if (type.isPlaced) placed.push_back(featureOf(type.kind));
  }
  std::vector<FeatureNeed> needs{
      {F::SHADOWS, {F::LIGHTS}}, {F::FILTERED_SHADOWS, {F::SHADOWS}}, {F::LIGHTS, types}};
  for (const F type : types) needs.push_back({type, {F::LIGHTS}});
  needs.push_back({F::LIGHT_RANGE, placed});
  return needs;
}

std::vector<FeatureNeed> otherNeeds() {
  using F = Feature;
  return {
      {F::MICROFACET, {F::LIGHTS}},
      {F::VERTEX_NORMALS, {F::LIGHTS, F::IMPULSES}},
      {F::VERTEX_COLORS, {F::LIGHTS, F::IMPULSES, F::UNLIT, F::ALPHA_MASK, F::AMBIENT}},
      // Impulses: where they start, what they are called, how many there are.
      {F::MIRROR, {F::IMPULSES}},
      {F::REFRACTION, {F::TRANSMISSION}},
      {F::ALPHA_BLEND, {F::IMPULSES}},
      {F::ALPHA_BLEND, {F::STRAIGHT}},
      {F::STRAIGHT, {F::IMPULSES}},
      {F::NEAR_PLANE, {F::STRAIGHT}},
      {F::BOTH_BRANCHES, {F::IMPULSES}},
      {F::ONE_IMPULSE, {F::IMPULSES}},
      {F::CUTOFF, {F::IMPULSES}},
      {F::FIXED_RAY_OFFSET, {F::SHADOWS, F::IMPULSES}},
      {F::BACKGROUND_MAP, {F::BACKGROUND}},
      {F::SKY_LIGHTS, {F::BACKGROUND}},
      {F::TERMINATOR, {F::LIGHTS}},
      {F::TERMINATOR, {F::VERTEX_NORMALS}},
  };
}

std::vector<FeatureNeed> needsOfMaterials() {
  using enum Feature;
  std::vector<FeatureNeed> needs;
#define WHITTLE_NEED(FEATURE, isAsked, reason, OTHERS) needs.push_back({FEATURE, WHITTLE_LIST OTHERS});
  WHITTLE_MATERIAL_FEATURES(WHITTLE_NEED)
#undef WHITTLE_NEED
  return needs;
}

/// A texture is read by a slot, at coordinates.
std::vector<FeatureNeed> needsOfTextures() {
  using enum Feature;
#define WHITTLE_FEATURE(slot, FEATURE, encoding, factor, OTHERS) FEATURE,
  std::vector<FeatureNeed> needs{{TEXTURES, {WHITTLE_TEXTURE_SLOTS(WHITTLE_FEATURE)}},
                                 {TEXTURES, {UV0, UV1}},
                                 {UV0, {TEXTURES}},
                                 {UV1, {TEXTURES}},
                                 {NEAREST_FILTER, {TEXTURES}},
                                 {DEEP_TEXTURES, {TEXTURES}},
                                 {TEXTURE_LEVELS, {TEXTURES}}};
#undef WHITTLE_FEATURE
  // Those that belong to something are read where that is there.
#define WHITTLE_NEEDS(slot, FEATURE, encoding, factor, OTHERS) \
  needs.push_back({FEATURE, {TEXTURES}});                      \
  needs.push_back({FEATURE, WHITTLE_LIST OTHERS});
  WHITTLE_OWN_TEXTURE_SLOTS(WHITTLE_NEEDS)
#undef WHITTLE_NEEDS
  return needs;
}

std::vector<FeatureNeed> allNeeds() {
  std::vector<FeatureNeed> needs = needsOfLights();
  for (const auto& more : {otherNeeds(), needsOfMaterials(), needsOfTextures()})
    needs.insert(needs.end(), more.begin(), more.end());
  return needs;
}

}  // namespace

const std::vector<FeatureNeed>& featureNeeds() {
  static const std::vector<FeatureNeed> needs = allNeeds();
  return needs;
}

ForcedFeatures forcedFeatures(const Settings& settings, std::uint64_t used) {
  ForcedFeatures forced;
  const auto barred = barredFeatures(settings);
  for (const Feature f : allFeatures())
    if (!barred.contains(f)) forced.bits |= bitOf(f) & settings.keepFeatures & ~used;
  for (std::uint64_t before = 0; before != forced.bits;) {
    before = forced.bits;
    for (const FeatureNeed& need : featureNeeds()) {
      if (!(forced.bits & bitOf(need.feature)) || ((forced.bits | used) & bitsOf(need.oneOf))) continue;
      const auto first =
          std::find_if(need.oneOf.begin(), need.oneOf.end(), [&](Feature f) { return !barred.contains(f); });
      forced.bits |= bitOf(*first);  // there is one: else the feature would be barred
      forced.neededBy.emplace(*first, need.feature);
    }
  }
  return forced;
}

std::uint64_t barredBits(const Settings& settings) {
  std::uint64_t bits = 0;
  for (const auto& [feature, reason] : barredFeatures(settings)) bits |= bitOf(feature);
  return bits;
}

std::vector<std::string> uselessKeeps(const Settings& settings) {
  std::vector<std::string> lines;
  const auto barred = barredFeatures(settings);
  for (const Feature f : allFeatures()) {
    if (!(settings.keepFeatures & bitOf(f))) continue;
    const auto found = barred.find(f);
    if (found != barred.end())
      lines.push_back(fmt::format("--keep-features: '{}' stays out: {}", featureText(f), found->second));
    else if (f == Feature::SAMPLER_RANDOM)
      lines.push_back(
          fmt::format("--keep-features: '{}' adds nothing: it is there in any case", featureText(f)));
  }
  return lines;
}

}  // namespace whittle
