// Texture and background lookups: nearest or bilinear, level 0, no mip maps.
#pragma once

#include "reference/vec.h"
#include "scene/scene.h"

namespace whittle::reference {

enum class Encoding { Linear, Srgb };

/// sRGB-encoded [0,1] to linear [0,1], IEC 61966-2-1.
double srgbToLinear(double encoded);

/// The texture of a slot at (u, v) of its set (before the slot's transform); white if the slot is empty.
/// Alpha is linear in either encoding; colours are decoded before they are filtered.
Vec4 sampleTexture(const Scene& scene, const TextureSlot& slot, const Vec2& uv, Encoding encoding);

/// Radiance seen in `direction` (unit, world) where nothing is hit.
Vec3 backgroundRadiance(const Background& background, const Vec3& direction);

}  // namespace whittle::reference
