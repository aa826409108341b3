// Texture lookups: bilinear or nearest, wrap modes, sRGB decoded for each texel before filtering. Slots of linear
// values may have 16 bits for each channel. The loads of all lanes are under way at once. In programs that know
// footprints (footprint.cl) a lookup is the mean over one: between two levels, and some side by side along it
// (McCormack et al., "Feline", 1999); where no side of it is longer than a texel it has the bits of a lookup without.
#include "lib/lanes.cl"
#include "lib/scene.cl"

/// Texture coordinates of both sets, each with what its rounding lost: beside a count of many repeats a float's last
/// bit is a good part of a texel.
typedef struct {
  Real u[2], v[2], uLow[2], vLow[2];
#ifdef TEXTURE_FOOTPRINTS
  Real across[2][4];  // of each set how u and v change along one axis of the footprint, then along the other
  uint probes;
#endif
} Uv;

/// Reduces u + low to [0, 1] by its wrap mode; to within the size of low.
INLINE Real wrapCoordinate(Real u, Real low, Natural mode) {
  if (!some(mode != WRAP_REPEAT)) return (u - floor(u)) + low;
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

/// The texels of one level, and how they go on beyond its edges.
typedef struct {
  Natural first;  // word
  Mask width, height;
  Natural wrapS, wrapT;
} Level;

/// A texel as it is stored: RGBA of 8 bits, or with DEEP_TEXTURES RG and then BA.
typedef struct {
  Natural word;
#if HAS(DEEP_TEXTURES)
  Natural second;
#endif
} Texel;

/// Loads alone: decoding in between would keep those of further texels waiting for the first one's memory.
INLINE Texel loadTexel(const SceneView* scene, const Level* level, Mask deep, Mask x, Mask y, int srgb) {
  const Natural texel = AS_NATURAL(y) * AS_NATURAL(level->width) + AS_NATURAL(x);
  Texel t;
#if HAS(DEEP_TEXTURES)
  const Natural at = level->first + (deep ? texel * 2u : texel);
  t.word = t.second = gatherWords(scene->texels, at);
  if (!srgb && some(deep)) t.second = gatherWords(scene->texels, deep ? at + 1u : at);
#else
  t.word = gatherWords(scene->texels, level->first + texel);
#endif
  return t;
}

/// Decoded, in [0, 1].
INLINE Rgba colorOf(const SceneView* scene, Mask deep, Texel texel, int srgb) {
  const Natural word = texel.word, alpha = word >> 24;
  const Mask r = TO_SIGNED(word & 255u), g = TO_SIGNED((word >> 8) & 255u), b = TO_SIGNED((word >> 16) & 255u);
  Rgba t;
  if (srgb) {
    t.c[0] = gatherNear(scene->linearFromSrgb, r);
    t.c[1] = gatherNear(scene->linearFromSrgb, g);
    t.c[2] = gatherNear(scene->linearFromSrgb, b);
  } else {
    t.c[0] = TO_REAL(r) / 255.0f;
    t.c[1] = TO_REAL(g) / 255.0f;
    t.c[2] = TO_REAL(b) / 255.0f;
  }
  // A division may be off by an ulp: opaque is opaque.
  t.c[3] = alpha == 255u ? (Real)(1.0f) : TO_REAL(alpha) / 255.0f;
#if HAS(DEEP_TEXTURES)
  if (!srgb && some(deep)) t = chooseDeep(deep, word, texel.second, t);
#endif
  return t;
}

INLINE Mask isDeep(const Records* texture) {
#if HAS(DEEP_TEXTURES)
  return (FIELD_BITS(texture, DeviceTexture, flags) & TEXTURE_DEEP) != 0;
#else
  return (Mask)(0);
#endif
}

INLINE Rgba fetchTexel(const SceneView* scene, const Records* texture, const Level* level, Mask x, Mask y, int srgb) {
  const Mask deep = isDeep(texture);
  return colorOf(scene, deep, loadTexel(scene, level, deep, x, y, srgb), srgb);
}

INLINE Rgba chooseRgba(Mask m, Rgba a, Rgba b) {
  for (uint n = 0; n < 4; ++n) a.c[n] = m ? a.c[n] : b.c[n];
  return a;
}

/// The four texels around a place, and how far from the first of them to the others.
typedef struct {
  Texel t00, t10, t01, t11;
  Real wx, wy;
} Quad;

/// Around (s, t), in [0, 1].
INLINE Quad loadQuad(const SceneView* scene, const Level* level, Mask deep, Real s, Real t, int srgb) {
  const Real x = s * TO_REAL(level->width) - 0.5f, y = t * TO_REAL(level->height) - 0.5f;
  const Real fx = floor(x), fy = floor(y);
  const Mask x0 = wrapTexel(TO_WHOLE(fx), level->width, level->wrapS),
             x1 = wrapTexel(TO_WHOLE(fx) + 1, level->width, level->wrapS);
  const Mask y0 = wrapTexel(TO_WHOLE(fy), level->height, level->wrapT),
             y1 = wrapTexel(TO_WHOLE(fy) + 1, level->height, level->wrapT);
  Quad q;
  q.wx = x - fx, q.wy = y - fy;
  q.t00 = loadTexel(scene, level, deep, x0, y0, srgb), q.t10 = loadTexel(scene, level, deep, x1, y0, srgb);
  q.t01 = loadTexel(scene, level, deep, x0, y1, srgb), q.t11 = loadTexel(scene, level, deep, x1, y1, srgb);
  return q;
}

INLINE Rgba blendQuad(const SceneView* scene, Mask deep, const Quad* q, int srgb) {
  const Rgba t00 = colorOf(scene, deep, q->t00, srgb), t10 = colorOf(scene, deep, q->t10, srgb);
  const Rgba t01 = colorOf(scene, deep, q->t01, srgb), t11 = colorOf(scene, deep, q->t11, srgb);
  Rgba result;
  for (uint n = 0; n < 4; ++n) {
    const Real top = t00.c[n] * (1.0f - q->wx) + t10.c[n] * q->wx;
    const Real low = t01.c[n] * (1.0f - q->wx) + t11.c[n] * q->wx;
    result.c[n] = top * (1.0f - q->wy) + low * q->wy;
  }
  return result;
}

/// The blend of the four texels around (s, t), in [0, 1].
INLINE Rgba blendTexels(const SceneView* scene, const Records* texture, const Level* level, Real s, Real t, int srgb) {
  const Mask deep = isDeep(texture);
  const Quad q = loadQuad(scene, level, deep, s, t, srgb);
  return blendQuad(scene, deep, &q, srgb);
}

#ifdef TEXTURE_FOOTPRINTS
INLINE Natural halved(Natural side) { return side > 1u ? side >> 1 : side; }

/// The level behind `level`, where asked.
INLINE Level nextLevel(const Records* texture, const Level* level, Mask asked) {
  Natural words = AS_NATURAL(level->width) * AS_NATURAL(level->height);
#if HAS(DEEP_TEXTURES)
  words = (FIELD_BITS(texture, DeviceTexture, flags) & TEXTURE_DEEP) != 0 ? words * 2u : words;
#endif
  Level next = *level;
  next.first = asked ? level->first + words : level->first;
  next.width = asked ? TO_SIGNED(halved(AS_NATURAL(level->width))) : level->width;
  next.height = asked ? TO_SIGNED(halved(AS_NATURAL(level->height))) : level->height;
  return next;
}

/// Level k of a texture whose largest is `level`.
INLINE Level levelAt(const Records* texture, Level level, Natural k) {
  for (uint n = 0; some(k > n); ++n) level = nextLevel(texture, &level, k > n);
  return level;
}

/// Where in a texture a footprint lies: level k and, `between` of the way, the next smaller one; so many lookups, one
/// (stepU, stepV) behind the other, in texture coordinates.
typedef struct {
  Natural k, probes;
  Real between, stepU, stepV;
} Strip;

// A lookup blends over two texels, so that a row of them, one and a half apart, leaves nothing out.
#define PROBE_DISTANCE 1.5f

/// Of a footprint by its two axes: u and v along the first, then along the second, in texture coordinates of a texture
/// of so many levels. In texels it is an ellipse; as wide as that is short are the lookups, and as long as it is long
/// is their row (none is smaller than a texel). A level is chosen by that width w: between 2^k and 2^(k+1) texels it is
/// w/2^k - 1 of the way from level k to the next.
INLINE Strip stripOf(const Real* across, uint mostProbes, Natural levels, const Level* level) {
  Strip strip = {(Natural)(0), (Natural)(1), (Real)(0.0f), (Real)(0.0f), (Real)(0.0f)};
  const Real width = TO_REAL(level->width), height = TO_REAL(level->height);
  const Real u1 = across[0] * width, v1 = across[1] * height, u2 = across[2] * width, v2 = across[3] * height;
  const Real uu = u1 * u1 + u2 * u2, vv = v1 * v1 + v2 * v2, uv = u1 * v1 + u2 * v2;
  const Real apart = 0.5f * (uu - vv), root = sqrt(apart * apart + uv * uv);
  const Real longest = sqrt(0.5f * (uu + vv) + root);
  const Mask filtered = (levels > 1u) & (longest > 1.0f);  // not a number: not filtered
  if (!some(filtered)) return strip;
  const Real length = filtered ? (longest < 65536.0f ? longest : (Real)(65536.0f)) : (Real)(1.0f);
  const Real shortest = fabs(u1 * v2 - u2 * v1) / longest;
  const Real least = mostProbes > 1u ? length / (PROBE_DISTANCE * (float)mostProbes) : length;
  Real w = shortest > least ? shortest : least;
  w = w > 1.0f ? w : (Real)(1.0f);
  w = w < length ? w : length;
  // What rounding adds to a whole number is no further one.
  const Real count = length / (PROBE_DISTANCE * w) - 1e-4f;
  for (uint n = 1; n < mostProbes; ++n) strip.probes = count > (float)n ? (Natural)(n + 1) : strip.probes;
  const Real alongU = apart >= 0.0f ? apart + root : uv, alongV = apart >= 0.0f ? uv : root - apart;
  const Real size = sqrt(alongU * alongU + alongV * alongV);
  const Mask isLong = filtered & (size > 0.0f) & (strip.probes > 1u);
  const Real step = (length - w) / (TO_REAL(strip.probes) * size);
  strip.stepU = isLong ? step * alongU / width : (Real)(0.0f);
  strip.stepV = isLong ? step * alongV / height : (Real)(0.0f);
  const Natural bits = AS_NATURAL(w), k = (bits >> 23) - 127u, last = levels - 1u;
  const Mask goesOn = filtered & (k < last);
  strip.k = goesOn ? k : (filtered ? last : (Natural)(0));
  strip.between = goesOn ? AS_REAL((bits & 0x7fffffu) | 0x3f800000u) - 1.0f : (Real)(0.0f);
  return strip;
}

/// The mean over the footprint about the place (u + uLow, v + vLow). Lanes whose footprint no texel is smaller than
/// have one lookup, in the largest level. All lookups between two levels would be twice as many: of several the outer
/// ones are in the smaller level and the inner ones in the larger one, as many as the way between them says, and one
/// pair at most is in both.
INLINE Rgba meanOver(const SceneView* scene, const Records* texture, const Level* level, const Strip* strip, Real u,
                     Real uLow, Real v, Real vLow, Mask lost, int srgb) {
  const Mask deep = isDeep(texture);
  const Level larger = levelAt(texture, *level, strip->k);
  const Level smaller = nextLevel(texture, &larger, strip->between > 0.0f);
  const Real count = TO_REAL(strip->probes), middle = 0.5f * (count - 1.0f), inSmaller = strip->between * count;
  Rgba sum = {{(Real)(0.0f), (Real)(0.0f), (Real)(0.0f), (Real)(0.0f)}};
  for (uint n = 0; some(strip->probes > n); ++n) {
    const Mask asked = (strip->probes > n) & !lost;
    const Real offset = (float)n - middle, du = offset * strip->stepU, dv = offset * strip->stepV;
    const Real atU = u + du, atV = v + dv;
    const Real lowU = uLow + sumError(u, du, atU), lowV = vLow + sumError(v, dv, atV);
    const Real s = asked ? wrapCoordinate(atU, lowU, level->wrapS) : (Real)(0.0f);
    const Real t = asked ? wrapCoordinate(atV, lowV, level->wrapT) : (Real)(0.0f);
    const Real back = count - 1.0f - (float)n, outside = back < (float)n ? back : (Real)((float)n);
    const Real part = clampUnit((inSmaller - 2.0f * outside) * (offset == 0.0f ? (Real)(1.0f) : (Real)(0.5f)));
    const Mask isSmaller = part == 1.0f, isBoth = asked & (part > 0.0f) & !isSmaller;
    const Level one = {isSmaller ? smaller.first : larger.first, isSmaller ? smaller.width : larger.width,
                       isSmaller ? smaller.height : larger.height, level->wrapS, level->wrapT};
    const Quad q = loadQuad(scene, &one, deep, s, t, srgb);
    Quad p = q;
    const int both = some(isBoth);
    if (both) p = loadQuad(scene, &smaller, deep, s, t, srgb);
    Rgba found = blendQuad(scene, deep, &q, srgb);
    if (both) {
      const Rgba other = blendQuad(scene, deep, &p, srgb);
      for (uint c = 0; c < 4; ++c) found.c[c] = isBoth ? found.c[c] * (1.0f - part) + other.c[c] * part : found.c[c];
    }
    for (uint c = 0; c < 4; ++c) sum.c[c] = asked ? sum.c[c] + found.c[c] : sum.c[c];
  }
  for (uint c = 0; c < 4; ++c) sum.c[c] = sum.c[c] / count;
  return sum;
}
#endif

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
  Level level;
  level.first = FIELD_BITS(&texture, DeviceTexture, firstTexel);
  level.width = TO_SIGNED(FIELD_BITS(&texture, DeviceTexture, width));
  level.height = TO_SIGNED(FIELD_BITS(&texture, DeviceTexture, height));
  level.wrapS = FIELD_BITS(&texture, DeviceTexture, wrapS);
  level.wrapT = FIELD_BITS(&texture, DeviceTexture, wrapT);
  Real uLow, vLow;
  const Real u = transformCoordinate(&texture, rows, s, t, sLow, tLow, &uLow);
  const Real v = transformCoordinate(&texture, rows + 3, s, t, sLow, tLow, &vLow);
  const Mask lost = !(isfinite(u + uLow) & isfinite(v + vLow)), zero = (Mask)(0);
  const Real atU = lost ? (Real)(0.0f) : wrapCoordinate(u, uLow, level.wrapS);
  const Real atV = lost ? (Real)(0.0f) : wrapCoordinate(v, vLow, level.wrapT);
  Rgba result = {{(Real)(0.0f), (Real)(0.0f), (Real)(0.0f), (Real)(0.0f)}};
#ifdef TEXTURE_FOOTPRINTS
  Real across[4];
  for (uint n = 0; n < 4; n += 2) {
    const Real du = isFirst ? uv->across[0][n] : uv->across[1][n];
    const Real dv = isFirst ? uv->across[0][n + 1] : uv->across[1][n + 1];
    across[n] = wordOf(&texture, rows) * du + wordOf(&texture, rows + 1) * dv;
    across[n + 1] = wordOf(&texture, rows + 3) * du + wordOf(&texture, rows + 4) * dv;
  }
  const Strip strip = stripOf(across, uv->probes, FIELD_BITS(&texture, DeviceTexture, levels), &level);
#define BLENDED meanOver(scene, &texture, &level, &strip, u, uLow, v, vLow, lost, srgb)
#define MAGNIFIED &((strip.probes == 1u) & (strip.k == 0u) & (strip.between == 0.0f))
#else
#define BLENDED blendTexels(scene, &texture, &level, atU, atV, srgb)
#define MAGNIFIED
#endif
#if HAS(NEAREST_FILTER)
  const Mask nearest = ((FIELD_BITS(&texture, DeviceTexture, flags) & TEXTURE_NEAREST) != 0) MAGNIFIED;
  if (some(!nearest)) result = BLENDED;
  if (some(nearest)) {
    const Mask nx = wrapTexel(TO_WHOLE(floor(atU * TO_REAL(level.width))), level.width, level.wrapS);
    const Mask ny = wrapTexel(TO_WHOLE(floor(atV * TO_REAL(level.height))), level.height, level.wrapT);
    result = chooseRgba(nearest, fetchTexel(scene, &texture, &level, nx, ny, srgb), result);
  }
#else
  result = BLENDED;
#endif
#undef BLENDED
#undef MAGNIFIED
  if (some(lost)) result = chooseRgba(lost, fetchTexel(scene, &texture, &level, zero, zero, srgb), result);
  return result;
}
#endif
