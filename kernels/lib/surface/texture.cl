// Texture lookups: level 0, bilinear or nearest, wrap modes, sRGB decoded for each texel before filtering. Slots of
// linear values may have 16 bits for each channel. The loads of all lanes are under way at once.
#include "lib/lanes.cl"
#include "lib/scene.cl"

/// Texture coordinates of both sets, each with what its rounding lost: beside a count of many repeats a float's last
/// bit is a good part of a texel.
typedef struct {
  Real u[2], v[2], uLow[2], vLow[2];
} Uv;

/// Reduces u + low to [0, 1] by its wrap mode; to within the size of low.
INLINE Real wrapCoordinate(Real u, Real low, Natural mode) {
  const Real one = (Real)(1.0f), zero = (Real)(0.0f);
  const Real clamped = u > 0.0f ? (u < 1.0f ? u + low : one) : zero;
  const Real m = (u - 2.0f * floor(u * 0.5f)) + low;
  const Real mirrored = m > 1.0f ? 2.0f - m : m;
  return mode == WRAP_REPEAT ? (u - floor(u)) + low : (mode == WRAP_CLAMP ? clamped : mirrored);
}

/// One row of the textures' transforms, from word `row`, and what its rounding lost.
INLINE Real transformCoordinate(const Records* texture, uint row, Real u, Real v, Real uLow, Real vLow, Real* low) {
  const Real m0 = wordOf(texture, row), m1 = wordOf(texture, row + 1), m2 = wordOf(texture, row + 2);
  const Real part0 = m0 * u, part1 = m1 * v;
  const Real both = part0 + part1, sum = both + m2;
  *low = fma(m0, u, -part0) + fma(m1, v, -part1) + sumError(part0, part1, both) + sumError(both, m2, sum) + m0 * uLow +
         m1 * vLow;
  return sum;
}

/// Texel index after wrapping; one step outside is all that filtering asks for. Clamped, so that no load is outside.
INLINE Mask wrapTexel(Mask i, Mask size, Natural mode) {
  const Mask repeats = mode == WRAP_REPEAT, zero = (Mask)(0);
  i = i < 0 ? (repeats ? size - 1 : zero) : i;
  i = i >= size ? (repeats ? i - size : size - 1) : i;
  return i < 0 ? zero : (i >= size ? size - 1 : i);
}

/// Linear colour and alpha.
typedef struct {
  Real c[4];
} Rgba;

#if HAS(DEEP_TEXTURES)
/// `t` with the channels of a texel of two words, first RG, then BA, where the texture is deep.
INLINE Rgba chooseDeep(Mask deep, Natural rg, Natural ba, Rgba t) {
  for (uint n = 0; n < 4; ++n) {
    const Natural value = ((n < 2 ? rg : ba) >> (16 * (n & 1))) & 65535u;
    const Real channel = value == 65535u ? (Real)(1.0f) : TO_REAL(value) / 65535.0f;
    t.c[n] = deep ? channel : t.c[n];
  }
  return t;
}
#endif

INLINE Rgba fetchTexel(const SceneView* scene, const Records* texture, Mask x, Mask y, int srgb) {
  const Natural first = FIELD_BITS(texture, DeviceTexture, firstTexel),
                width = FIELD_BITS(texture, DeviceTexture, width);
#if HAS(DEEP_TEXTURES)
  const Mask deep = (FIELD_BITS(texture, DeviceTexture, flags) & TEXTURE_DEEP) != 0;
  const Natural texel = AS_NATURAL(y) * width + AS_NATURAL(x), at = first + (deep ? texel * 2u : texel);
#else
  const Natural at = first + AS_NATURAL(y) * width + AS_NATURAL(x);
#endif
  const Natural word = gatherWords(scene->texels, at);
  Rgba t;
  for (uint n = 0; n < 4; ++n) {
    const Natural byte = (word >> (8 * n)) & 255u;
    t.c[n] = srgb && n < 3 ? gather(scene->linearFromSrgb, byte) : TO_REAL(byte) / 255.0f;
    // A division may be off by an ulp: opaque is opaque.
    if (n == 3) t.c[n] = byte == 255u ? (Real)(1.0f) : t.c[n];
  }
#if HAS(DEEP_TEXTURES)
  if (!srgb && some(deep)) t = chooseDeep(deep, word, gatherWords(scene->texels, deep ? at + 1u : at), t);
#endif
  return t;
}

INLINE Rgba chooseRgba(Mask m, Rgba a, Rgba b) {
  for (uint n = 0; n < 4; ++n) a.c[n] = m ? a.c[n] : b.c[n];
  return a;
}

/// The four texels around (u, v), which counts texels.
INLINE Rgba blendTexels(const SceneView* scene, const Records* texture, Real u, Real v, Mask width, Mask height,
                        Natural wrapS, Natural wrapT, int srgb) {
  const Real x = u - 0.5f, y = v - 0.5f;
  const Real fx = floor(x), fy = floor(y);
  const Real wx = x - fx, wy = y - fy;
  const Mask x0 = wrapTexel(TO_WHOLE(fx), width, wrapS), x1 = wrapTexel(TO_WHOLE(fx) + 1, width, wrapS);
  const Mask y0 = wrapTexel(TO_WHOLE(fy), height, wrapT), y1 = wrapTexel(TO_WHOLE(fy) + 1, height, wrapT);
  const Rgba t00 = fetchTexel(scene, texture, x0, y0, srgb), t10 = fetchTexel(scene, texture, x1, y0, srgb);
  const Rgba t01 = fetchTexel(scene, texture, x0, y1, srgb), t11 = fetchTexel(scene, texture, x1, y1, srgb);
  Rgba result;
  for (uint n = 0; n < 4; ++n) {
    const Real top = t00.c[n] * (1.0f - wx) + t10.c[n] * wx;
    const Real low = t01.c[n] * (1.0f - wx) + t11.c[n] * wx;
    result.c[n] = top * (1.0f - wy) + low * wy;
  }
  return result;
}

// Shading looks up each slot: calls cost it less than a tenth of shade, where copies cost two thirds of the time
// to compile. Searches look up one or two, mostly for alpha alone: in line the colours fall away (search/one_lane.cl).
#ifndef TEXTURE_LOOKUP
#define TEXTURE_LOOKUP
#endif

#if HAS(TEXTURES)
/// RGBA of a texture slot at the transformed coordinate.
TEXTURE_LOOKUP Rgba sampleTexture(const SceneView* scene, Natural slots, const Uv* uv, int srgb) {
  const Records texture = recordsAt(scene->textures, slots, WORDS_OF(DeviceTexture));
  const Mask isFirst = FIELD_BITS(&texture, DeviceTexture, uvSet) == 0;
  const Real s = isFirst ? uv->u[0] : uv->u[1], sLow = isFirst ? uv->uLow[0] : uv->uLow[1];
  const Real t = isFirst ? uv->v[0] : uv->v[1], tLow = isFirst ? uv->vLow[0] : uv->vLow[1];
  const uint rows = WORD_OF(DeviceTexture, transform);
  const Mask width = TO_SIGNED(FIELD_BITS(&texture, DeviceTexture, width));
  const Mask height = TO_SIGNED(FIELD_BITS(&texture, DeviceTexture, height));
  const Natural wrapS = FIELD_BITS(&texture, DeviceTexture, wrapS), wrapT = FIELD_BITS(&texture, DeviceTexture, wrapT);
  Real uLow, vLow;
  Real u = transformCoordinate(&texture, rows, s, t, sLow, tLow, &uLow);
  Real v = transformCoordinate(&texture, rows + 3, s, t, sLow, tLow, &vLow);
  const Mask lost = !(isfinite(u + uLow) & isfinite(v + vLow)), zero = (Mask)(0);
  u = lost ? (Real)(0.0f) : wrapCoordinate(u, uLow, wrapS) * TO_REAL(width);
  v = lost ? (Real)(0.0f) : wrapCoordinate(v, vLow, wrapT) * TO_REAL(height);
  Rgba result = {{(Real)(0.0f), (Real)(0.0f), (Real)(0.0f), (Real)(0.0f)}};
#if HAS(NEAREST_FILTER)
  const Mask nearest = (FIELD_BITS(&texture, DeviceTexture, flags) & TEXTURE_NEAREST) != 0;
  if (some(!nearest)) result = blendTexels(scene, &texture, u, v, width, height, wrapS, wrapT, srgb);
  if (some(nearest)) {
    const Mask nx = wrapTexel(TO_WHOLE(floor(u)), width, wrapS), ny = wrapTexel(TO_WHOLE(floor(v)), height, wrapT);
    result = chooseRgba(nearest, fetchTexel(scene, &texture, nx, ny, srgb), result);
  }
#else
  result = blendTexels(scene, &texture, u, v, width, height, wrapS, wrapT, srgb);
#endif
  if (some(lost)) result = chooseRgba(lost, fetchTexel(scene, &texture, zero, zero, srgb), result);
  return result;
}
#endif
