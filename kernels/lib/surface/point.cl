// A point of a triangle: where it lies, its texture coordinates, its base colour. What shading asks of every hit, and
// searches where a surface may be missing or see-through. Conventions: host/reference/README.md.
#include "lib/corners.cl"
#include "lib/surface/texture.cl"

/// Where in its triangle a hit lies. Low parts: what b1 and b2 lost to rounding, 0 where nobody asked.
typedef struct {
  Real b0, b1, b2;
  Real low1, low2;
} Barycentrics;

INLINE Barycentrics barycentrics(Real b1, Real b2) {
  const Barycentrics b = {1.0f - b1 - b2, b1, b2, (Real)(0.0f), (Real)(0.0f)};
  return b;
}

/// A point of a triangle with all that lookups there need.
typedef struct {
  Real3 p0, p1, p2;  // corners of the triangle
  Records material;
  Natural corner[3];
  Real b0, b1, b2;  // for what vertices carry
  Uv uv;            // for textures
} TrianglePoint;

#define MATERIAL(at, field) FIELD(&(at)->material, DeviceMaterial, field)
#define MATERIAL_BITS(at, field) AS_NATURAL(MATERIAL(at, field))
#define MATERIAL3(at, field) materialWords3(at, WORD_OF(DeviceMaterial, field))
INLINE Real3 materialWords3(const TrianglePoint* at, uint word) {
  return real3(wordOf(&at->material, word), wordOf(&at->material, word + 1), wordOf(&at->material, word + 2));
}

/// Texture coordinate of a hit, and what its rounding lost. Coordinates may count many repeats of a picture.
INLINE Real interpolateUv(Real a, Real b, Real c, const Barycentrics* at, Real* low) {
  const Real e1 = b - a, e2 = c - a;
  const Real part1 = at->b1 * e1, part2 = at->b2 * e2;
  const Real with1 = a + part1, sum = with1 + part2;
  *low = sumError(a, part1, with1) + sumError(with1, part2, sum) + fma(at->b1, e1, -part1) + fma(at->b2, e2, -part2) +
         at->b1 * sumError(b, -a, e1) + at->b2 * sumError(c, -a, e2) + at->low1 * e1 + at->low2 * e2;
  return sum;
}

INLINE void interpolateUvSet(__global const float* values, const Natural* corner, const Barycentrics* at, uint set,
                             Uv* uv) {
  const Natural a = corner[0] * 2u, b = corner[1] * 2u, c = corner[2] * 2u;
  uv->u[set] = interpolateUv(gather(values, a), gather(values, b), gather(values, c), at, &uv->uLow[set]);
  uv->v[set] = interpolateUv(gather(values + 1, a), gather(values + 1, b), gather(values + 1, c), at, &uv->vLow[set]);
}

#ifdef TEXTURE_FOOTPRINTS
/// How the coordinates change along two axes, along which b1 and b2 change so.
INLINE void acrossUvSet(__global const float* values, const Natural* corner, const Real* b1, const Real* b2, uint set,
                        Uv* uv) {
  const Natural a = corner[0] * 2u, b = corner[1] * 2u, c = corner[2] * 2u;
  for (uint n = 0; n < 2; ++n) {
    const Real origin = gather(values + n, a);
    const Real e1 = gather(values + n, b) - origin, e2 = gather(values + n, c) - origin;
    for (uint axis = 0; axis < 2; ++axis) uv->across[set][2 * axis + n] = b1[axis] * e1 + b2[axis] * e2;
  }
}
#endif

/// Both sets of texture coordinates; 0 for a set that the scene has not.
INLINE Uv uvAt(const SceneView* scene, const Natural* corner, const Barycentrics* at) {
  Uv uv;
  for (uint set = 0; set < 2; ++set) uv.u[set] = uv.v[set] = uv.uLow[set] = uv.vLow[set] = (Real)(0.0f);
#ifdef TEXTURE_FOOTPRINTS
  for (uint n = 0; n < 4; ++n) uv.across[0][n] = uv.across[1][n] = (Real)(0.0f);
  uv.probes = 1;
#endif
#if HAS(UV0)
  if (scene->uv0) interpolateUvSet(scene->uv0, corner, at, 0, &uv);
#endif
#if HAS(UV1)
  if (scene->uv1) interpolateUvSet(scene->uv1, corner, at, 1, &uv);
#endif
  return uv;
}

#if HAS(TEXTURES)
/// RGBA of a texture slot of each lane's material; 1 where it has none.
INLINE Rgba textureAt(const SceneView* scene, const TrianglePoint* at, Natural slots, int srgb) {
  const Mask used = slots < 0x80000000u;
  Rgba none;
  for (uint n = 0; n < 4; ++n) none.c[n] = (Real)(1.0f);
  if (!some(used)) return none;
  return chooseRgba(used, sampleTexture(scene, used ? slots : (Natural)(0), &at->uv, srgb), none);
}
/// The same by the slot's name, its colours stored as scene_tables.h says.
#define TEXTURE_AT(scene, at, slot) textureAt(scene, at, MATERIAL_BITS(at, slot), slot##Encoding)
#endif

#if HAS(VERTEX_NORMALS) || HAS(VERTEX_COLORS) || HAS(TEXTURES)
/// Vertices of the triangle's corners. Of narrow ones two words hold three, from their first half on or their second.
INLINE void cornersOf(const SceneView* scene, Natural triangleIndex, Natural* corner) {
  const Natural first = triangleIndex * 3u;
  if (scene->corners) {
    const Natural one = gatherWords(scene->corners, first >> 1), two = gatherWords(scene->corners + 1, first >> 1);
    const Mask halfway = (first & 1u) != 0;
    corner[0] = halfway ? one >> 16 : one & 0xffffu;
    corner[1] = halfway ? two & 0xffffu : one >> 16;
    corner[2] = halfway ? two >> 16 : two & 0xffffu;
    return;
  }
  for (uint k = 0; k < 3; ++k) corner[k] = gatherWords(scene->indices32 + k, first);
}
#endif

/// All but the texture coordinates. Lanes that hit nothing must name a triangle that is there.
INLINE TrianglePoint trianglePoint(const SceneView* scene, Natural triangleIndex, const Barycentrics* b) {
  TrianglePoint at;
  const CornerPlace place = cornerPlace(scene, triangleIndex);
  at.p0 = cornerAt(scene, &place, 0);
  at.p1 = cornerAt(scene, &place, 1);
  at.p2 = cornerAt(scene, &place, 2);
  __global const uint* materials = (__global const uint*)scene->triangles + WORD_OF(DeviceTriangle, material);
  at.material = recordsAt(scene->materials, gatherWords(materials, triangleIndex * WORDS_OF(DeviceTriangle)),
                          WORDS_OF(DeviceMaterial));
  at.b0 = b->b0;
  at.b1 = b->b1;
  at.b2 = b->b2;
#if HAS(VERTEX_NORMALS) || HAS(VERTEX_COLORS) || HAS(TEXTURES)
  cornersOf(scene, triangleIndex, at.corner);
#else
  for (uint k = 0; k < 3; ++k) at.corner[k] = (Natural)(0);  // nothing is interpolated, and the buffer is not there
#endif
  return at;
}

/// Base colour and alpha: factor, texture, vertex colour.
INLINE Rgba baseColorAt(const SceneView* scene, const TrianglePoint* at) {
  const uint word = WORD_OF(DeviceMaterial, baseColor);
  Rgba color;
  for (uint n = 0; n < 4; ++n) color.c[n] = wordOf(&at->material, word + n);
#if HAS(TEXTURES) && HAS(BASE_COLOR_TEXTURE)
  const Rgba texel = TEXTURE_AT(scene, at, baseColorTexture);
  for (uint n = 0; n < 4; ++n) color.c[n] *= texel.c[n];
#endif
#if HAS(VERTEX_COLORS)
  if (scene->colors) {
    for (uint n = 0; n < 4; ++n)
      color.c[n] *= at->b0 * gather(scene->colors + n, at->corner[0] * 4u) +
                    at->b1 * gather(scene->colors + n, at->corner[1] * 4u) +
                    at->b2 * gather(scene->colors + n, at->corner[2] * 4u);
  }
#endif
  return color;
}
