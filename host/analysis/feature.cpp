// See feature.h: the tables of kernels/shared walked once each.
#include "analysis/feature.h"

namespace whittle {

const char* featureText(Feature feature) {
  switch (feature) {
#define WHITTLE_TEXT(name, bit, words) \
  case Feature::name:                  \
    return words;
    WHITTLE_FEATURES(WHITTLE_TEXT)
#undef WHITTLE_TEXT
  }
  return "";
}

const std::vector<Feature>& allFeatures() {
#define WHITTLE_LISTED(name, bit, words) Feature::name,
  static const std::vector<Feature> all{WHITTLE_FEATURES(WHITTLE_LISTED)};
#undef WHITTLE_LISTED
  return all;
}

Feature featureOf(LightKind kind) {
  switch (kind) {
#define WHITTLE_FEATURE(Kind, NAME, word, unit, isPlaced, isAimed, hasCone) \
  case LightKind::Kind:                                                     \
    return Feature::NAME##_LIGHTS;
    WHITTLE_LIGHT_TYPES(WHITTLE_FEATURE)
#undef WHITTLE_FEATURE
  }
  return Feature::LIGHTS;
}

}  // namespace whittle
