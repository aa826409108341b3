// Texture lookups of one hit, for searches: level 0, bilinear or nearest, wrap modes, sRGB decoded for each texel before
// filtering.
#include "lib/scene.cl"

#if HAS(ALPHA_MASK) || HAS(FILTERED_SHADOWS)
/// Texture coordinates of both sets, each with what its rounding lost: beside a count of many repeats a float's last
/// bit is a good part of a texel.
typedef struct {
  float2 first, firstLow, second, secondLow;
} Uv;

/// Reduces u + low to [0, 1] by its wrap mode; to within the size of low.
INLINE float wrapCoordinate(float u, float low, uint mode) {
  if (mode == WRAP_REPEAT) return (u - floor(u)) + low;
  if (mode == WRAP_CLAMP) return u > 0.0f ? (u < 1.0f ? u + low : 1.0f) : 0.0f;
  const float m = (u - 2.0f * floor(u * 0.5f)) + low;
  return m > 1.0f ? 2.0f - m : m;
}

/// One row of a texture transform, and what its rounding lost.
INLINE float transformCoordinate(__global const float* row, float2 uv, float2 uvLow, float* low) {
  const float part0 = row[0] * uv.x, part1 = row[1] * uv.y;
  const float both = part0 + part1, sum = both + row[2];
  *low = fma(row[0], uv.x, -part0) + fma(row[1], uv.y, -part1) + sumError(part0, part1, both) +
         sumError(both, row[2], sum) + row[0] * uvLow.x + row[1] * uvLow.y;
  return sum;
}

/// Texel index after wrapping; one step outside is all that filtering asks for. Clamped, so that no load is outside.
INLINE int wrapTexel(int i, int size, uint mode) {
  if (i < 0) i = mode == WRAP_REPEAT ? size - 1 : 0;
  if (i >= size) i = mode == WRAP_REPEAT ? i - size : size - 1;
  return i < 0 ? 0 : (i >= size ? size - 1 : i);
}

INLINE float4 fetchTexel(const SceneView* scene, __global const DeviceTexture* texture, int x, int y, int srgb) {
  const uint word = scene->texels[texture->firstTexel + (uint)y * (uint)texture->width + (uint)x];
  const uint4 c = (uint4)(word & 255u, (word >> 8) & 255u, (word >> 16) & 255u, word >> 24);
  const float a = c.w == 255u ? 1.0f : (float)c.w / 255.0f;  // a division may be off by an ulp: opaque is opaque
  if (srgb)
    return (float4)(scene->linearFromSrgb[c.x], scene->linearFromSrgb[c.y], scene->linearFromSrgb[c.z], a);
  return (float4)((float)c.x / 255.0f, (float)c.y / 255.0f, (float)c.z / 255.0f, a);
}

/// RGBA of a texture slot at the transformed coordinate; colours are linear.
INLINE float4 sampleTexture(const SceneView* scene, int slot, const Uv* uv, int srgb) {
  __global const DeviceTexture* texture = scene->textures + slot;
  const float2 at = texture->uvSet == 0 ? uv->first : uv->second;
  const float2 atLow = texture->uvSet == 0 ? uv->firstLow : uv->secondLow;
  float uLow, vLow;
  float u = transformCoordinate(texture->transform, at, atLow, &uLow);
  float v = transformCoordinate(texture->transform + 3, at, atLow, &vLow);
  if (!isfinite(u + uLow) || !isfinite(v + vLow)) return fetchTexel(scene, texture, 0, 0, srgb);
  u = wrapCoordinate(u, uLow, texture->wrapS) * (float)texture->width;
  v = wrapCoordinate(v, vLow, texture->wrapT) * (float)texture->height;
#if HAS(NEAREST_FILTER)
  if (texture->nearest)
    return fetchTexel(scene, texture, wrapTexel((int)floor(u), texture->width, texture->wrapS),
                      wrapTexel((int)floor(v), texture->height, texture->wrapT), srgb);
#endif
  const float x = u - 0.5f, y = v - 0.5f;
  const float fx = floor(x), fy = floor(y);
  const float wx = x - fx, wy = y - fy;
  const int x0 = wrapTexel((int)fx, texture->width, texture->wrapS);
  const int x1 = wrapTexel((int)fx + 1, texture->width, texture->wrapS);
  const int y0 = wrapTexel((int)fy, texture->height, texture->wrapT);
  const int y1 = wrapTexel((int)fy + 1, texture->height, texture->wrapT);
  const float4 top = fetchTexel(scene, texture, x0, y0, srgb) * (1.0f - wx) + fetchTexel(scene, texture, x1, y0, srgb) * wx;
  const float4 low = fetchTexel(scene, texture, x0, y1, srgb) * (1.0f - wx) + fetchTexel(scene, texture, x1, y1, srgb) * wx;
  return top * (1.0f - wy) + low * wy;
}
#endif
