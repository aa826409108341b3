// The factors of a material one by one, as kernels/shared/scene_tables.h lists them.
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <span>

#include "scene/scene.h"

namespace whittle {

struct MaterialFactor {
  const char* name;
  float least, most;  ///< what each of its numbers may be
  bool isUnlit;       ///< an unlit surface shows it
};

/// Calls visit(factor, numbers) for each; `numbers` is a span into the material, const where that is.
template <typename AnyMaterial, typename Visit>
void eachFactor(AnyMaterial& m, const Visit& visit) {
#define WHITTLE_VECTOR(name, size, least, most, isUnlit) \
  visit(MaterialFactor{#name, least, most, isUnlit != 0}, std::span(&m.name[0], size));
#define WHITTLE_SCALAR(name, least, most, isUnlit) \
  visit(MaterialFactor{#name, least, most, isUnlit != 0}, std::span(&m.name, 1));
  WHITTLE_MATERIAL_FACTORS(WHITTLE_VECTOR, WHITTLE_SCALAR)
#undef WHITTLE_VECTOR
#undef WHITTLE_SCALAR
}

/// Whether every number of it is what glTF allows; false for NaN.
inline bool isInRange(const Material& m) {
  bool inRange = true;
  eachFactor(m, [&](const MaterialFactor& factor, std::span<const float> numbers) {
    inRange = inRange && std::all_of(numbers.begin(), numbers.end(),
                                     [&](float v) { return v >= factor.least && v <= factor.most; });
  });
  return inRange;
}

}  // namespace whittle
