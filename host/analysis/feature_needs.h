// What features are nothing without, so that keeping one that a scene does not need compiles and runs it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "analysis/scene_features.h"

namespace whittle {

/// Without one of these, kernels have no code for the feature or never come there.
struct FeatureNeed {
  Feature feature;
  std::vector<Feature> oneOf;  ///< the first is taken where there is none yet
};
const std::vector<FeatureNeed>& featureNeeds();

/// Features that a scene does not need and that are compiled and run all the same.
struct ForcedFeatures {
  std::uint64_t bits = 0;
  std::map<Feature, Feature> neededBy;  ///< those that nobody asked for: the forced feature that needs them
};

/// What settings.keepFeatures adds to `used`, with what those features need. Nothing goes against a setting.
ForcedFeatures forcedFeatures(const Settings& settings, std::uint64_t used);

/// Features that go against a setting, and those that are nothing without them.
std::uint64_t barredBits(const Settings& settings);

/// A line for each of settings.keepFeatures that adds nothing, with the reason.
std::vector<std::string> uselessKeeps(const Settings& settings);

}  // namespace whittle
