// What the kernels read of a material.
#pragma once

#include <string>

#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// The material with everything that cannot show set to its default: its name, what an unlit surface has no
/// use for, textures that are multiplied by 0, the cutoff of a mode that does not cut.
Material asRead(const Material& material, const Settings& settings);

/// Textures of the material are seen as the file has them, however small they are seen.
void dropLevels(Material& material);

/// Equal for materials that are equal in every bit, and only for them.
std::string bitsOf(const Material& material);

/// Bounds of the alpha of vertex colours.
struct AlphaBounds {
  float least = 1.0F, greatest = 1.0F;
};

/// What alpha is made of besides the material's factor.
struct AlphaSource {
  int leastTexel = 255;   ///< of the base colour texture, 0 to 255; 255 without one
  bool coloured = false;  ///< vertex colours are multiplied in
  AlphaBounds colours;    ///< where they are
};

/// True where no hit can fall below the cutoff of a masked material.
bool maskIsNeedless(const Material& material, const AlphaSource& source);
/// True where a blended material's alpha, as kernels compute it, is exactly 1 at every hit.
bool blendIsNeedless(const Material& material, const AlphaSource& source);

}  // namespace whittle
