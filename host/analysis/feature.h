// The features of kernels/shared/features.h by name, and those that belong to light types.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/shared/features.h"
#include "scene/scene.h"

namespace whittle {

/// The bit numbers of kernels/shared/features.h.
enum class Feature : int {
#define WHITTLE_ENUM(name, bit, text) name = bit,
  WHITTLE_FEATURES(WHITTLE_ENUM)
#undef WHITTLE_ENUM
};

/// WHITTLE_LIST OTHERS is {A, B} for a list (A, B) of kernels/shared/scene_tables.h.
#define WHITTLE_LIST(...) \
  { __VA_ARGS__ }

/// What a person calls it.
const char* featureText(Feature feature);
/// In the order of their bits.
const std::vector<Feature>& allFeatures();

constexpr std::uint64_t bitOf(Feature feature) { return std::uint64_t{1} << static_cast<int>(feature); }

/// That some light is of this kind.
Feature featureOf(LightKind kind);

}  // namespace whittle
