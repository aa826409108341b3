// Texture and background lookups: nearest or bilinear, and the mean over a footprint.
#pragma once

#include "reference/texture_levels.h"
#include "reference/vec.h"
#include "scene/scene.h"

namespace whittle::reference {

/// sRGB-encoded [0,1] to linear [0,1], IEC 61966-2-1.
double srgbToLinear(double encoded);

/// The two axes, in texture coordinates, of what a ray stands for.
struct Footprint {
  Vec2 one{0}, other{0};
};

/// The texture of a slot at (u, v) of its set (before the slot's transform); white if the slot is empty.
/// Alpha is linear in either encoding; colours are decoded before they are filtered.
Vec4 sampleTexture(const Scene& scene, const TextureSlot& slot, const Vec2& uv, Encoding encoding);

/// The mean of the same over a footprint (before the slot's transform, too).
Vec4 filteredTexture(const Scene& scene, const TextureLevels& levels, const TextureSlot& slot, const Vec2& uv,
                     const Footprint& footprint, const Mean& mean);

/// Radiance seen in `direction` (unit, world) where nothing is hit.
Vec3 backgroundRadiance(const Background& background, const Vec3& direction);

}  // namespace whittle::reference
