// A point of a triangle: where it lies, its texture coordinates, its base colour, and what of the light it lets through:
// what searches ask where a surface may be missing or see-through. Conventions: host/reference/README.md.
#include "lib/fresnel.cl"
#include "lib/texture.cl"

#if HAS(ALPHA_MASK) || HAS(FILTERED_SHADOWS)
/// Where in its triangle a hit lies. Low parts: what b1 and b2 lost to rounding, 0 where nobody asked.
typedef struct {
  float b0, b1, b2;
  float low1, low2;
} Barycentrics;

INLINE Barycentrics barycentrics(float b1, float b2) {
  const Barycentrics b = {1.0f - b1 - b2, b1, b2, 0.0f, 0.0f};
  return b;
}

/// Texture coordinate of a hit, and what its rounding lost. Coordinates may count many repeats of a picture.
INLINE float interpolateUv(float a, float b, float c, const Barycentrics* at, float* low) {
  const float e1 = b - a, e2 = c - a;
  const float part1 = at->b1 * e1, part2 = at->b2 * e2;
  const float with1 = a + part1, sum = with1 + part2;
  *low = sumError(a, part1, with1) + sumError(with1, part2, sum) + fma(at->b1, e1, -part1) + fma(at->b2, e2, -part2) +
         at->b1 * sumError(b, -a, e1) + at->b2 * sumError(c, -a, e2) + at->low1 * e1 + at->low2 * e2;
  return sum;
}

INLINE void interpolateUvSet(__global const float* values, const uint* corner, const Barycentrics* at, float2* uv, float2* uvLow) {
  const float2 a = vload2(corner[0], values), b = vload2(corner[1], values), c = vload2(corner[2], values);
  float lowU, lowV;
  const float u = interpolateUv(a.x, b.x, c.x, at, &lowU);
  const float v = interpolateUv(a.y, b.y, c.y, at, &lowV);
  *uv = (float2)(u, v);
  *uvLow = (float2)(lowU, lowV);
}

/// Both sets of texture coordinates at a hit; 0 for a set that the scene has not.
INLINE Uv uvAt(const SceneView* scene, const uint* corner, const Barycentrics* b) {
  Uv uv = {(float2)(0.0f), (float2)(0.0f), (float2)(0.0f), (float2)(0.0f)};
#if HAS(UV0)
  if (scene->uv0) interpolateUvSet(scene->uv0, corner, b, &uv.first, &uv.firstLow);
#endif
#if HAS(UV1)
  if (scene->uv1) interpolateUvSet(scene->uv1, corner, b, &uv.second, &uv.secondLow);
#endif
  return uv;
}

INLINE void loadCorners(const SceneView* scene, uint triangleIndex, uint* corner) {
#if HAS(VERTEX_NORMALS) || HAS(VERTEX_COLORS) || HAS(TEXTURES)
  const size_t first = (size_t)triangleIndex * 3;
  for (uint k = 0; k < 3; ++k) {
    const size_t at = first + k;
    corner[k] = scene->corners ? scene->corners[at >> 1] >> (16 * (uint)(at & 1)) & 0xffffu : scene->indices32[at];
  }
#else
  corner[0] = corner[1] = corner[2] = 0;  // nothing is interpolated, and the buffer is not there
#endif
}

/// A point of a triangle with all that lookups there need; `b` for what vertices carry, `uv` for textures.
typedef struct {
  __global const DeviceTriangle* triangle;
  __global const DeviceMaterial* material;
  uint corner[3];
  Barycentrics b;
  Uv uv;
} TrianglePoint;

INLINE TrianglePoint trianglePoint(const SceneView* scene, uint triangleIndex, Barycentrics b, const Barycentrics* forTextures) {
  TrianglePoint p;
  p.triangle = scene->triangles + triangleIndex;
  p.material = scene->materials + p.triangle->material;
  loadCorners(scene, triangleIndex, p.corner);
  p.b = b;
  p.uv = uvAt(scene, p.corner, forTextures);
  return p;
}

/// Base colour and alpha: factor, texture, vertex colour.
INLINE float4 baseColorAt(const SceneView* scene, const TrianglePoint* p) {
  __global const DeviceMaterial* m = p->material;
  float4 c = (float4)(m->baseColor[0], m->baseColor[1], m->baseColor[2], m->baseColor[3]);
#if HAS(TEXTURES) && HAS(BASE_COLOR_TEXTURE)
  if (m->baseColorTexture >= 0) c *= sampleTexture(scene, m->baseColorTexture, &p->uv, baseColorTextureEncoding);
#endif
#if HAS(VERTEX_COLORS)
  if (scene->colors) {
    const float4 v0 = vload4(p->corner[0], scene->colors);
    const float4 v1 = vload4(p->corner[1], scene->colors);
    const float4 v2 = vload4(p->corner[2], scene->colors);
    c *= p->b.b0 * v0 + p->b.b1 * v1 + p->b.b2 * v2;
  }
#endif
  return c;
}

/// How much of the light a surface lets straight through to a shadow ray; README "Direct light".
/// For a masked triangle: 1 below the cutoff, else 0 (the hit counts).
INLINE float3 shadowTransmittance(const SceneView* scene, uint triangleIndex, float b1, float b2, float3 d) {
  const Barycentrics b = barycentrics(b1, b2);
  const TrianglePoint p = trianglePoint(scene, triangleIndex, b, &b);
  __global const DeviceMaterial* m = p.material;
  const float4 c = baseColorAt(scene, &p);
  float alpha = 1.0f;
#if HAS(ALPHA_MASK)
  if ((m->flags & MATERIAL_MASK) && c.w < m->alphaCutoff) return (float3)(1.0f, 1.0f, 1.0f);
#endif
#if HAS(ALPHA_BLEND)
  if (m->flags & MATERIAL_BLEND) alpha = c.w > 0.0f ? (c.w < 1.0f ? c.w : 1.0f) : 0.0f;
#endif
  float3 through = (float3)(1.0f - alpha);
#if HAS(TRANSMISSION)
  float transmission = m->transmission;
  float metallic = m->metallic;
#if HAS(TEXTURES) && HAS(TRANSMISSION_TEXTURE)
  if (m->transmissionTexture >= 0)
    transmission *= sampleTexture(scene, m->transmissionTexture, &p.uv, transmissionTextureEncoding).x;
#endif
#if HAS(TEXTURES) && HAS(METALLIC_ROUGHNESS_TEXTURE)
  if (m->metallicRoughnessTexture >= 0)
    metallic *= sampleTexture(scene, m->metallicRoughnessTexture, &p.uv, metallicRoughnessTextureEncoding).z;
#endif
  metallic = clamp(metallic, 0.0f, 1.0f);
  if (transmission > 0.0f && !(m->flags & MATERIAL_UNLIT)) {
    const float3 p0 = load3(p.triangle->v[0]);
    const float3 n_g = normalize3(cross3(load3(p.triangle->v[1]) - p0, load3(p.triangle->v[2]) - p0));
    float cosT;
    const float reflected = m->ior == 0.0f ? 1.0f : fresnelDielectric(fmin(fabs(dot3(n_g, d)), 1.0f), m->ior, &cosT);
    through += alpha * transmission * (1.0f - metallic) * (1.0f - reflected) * c.xyz;
  }
#endif
  return clamp(through, 0.0f, 1.0f);  // vertex colours may exceed 1
}

/// 1 if a masked triangle is really there at these barycentrics.
INLINE int passesAlphaMask(const SceneView* scene, uint triangleIndex, float b1, float b2) {
  const Barycentrics b = barycentrics(b1, b2);
  const TrianglePoint p = trianglePoint(scene, triangleIndex, b, &b);
  return baseColorAt(scene, &p).w >= p.material->alphaCutoff;
}
#endif
