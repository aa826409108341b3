// The surfels of the LANES hits of a work item: what shading needs to know of the surface, evaluated from vertices,
// material and textures. Conventions: host/reference/README.md.
#include "lib/lanes.cl"
#include "lib/surfel.cl"

typedef struct {
  Real3 position;   // world, m
  Real3 n_g;        // unit geometric normal, turned to the viewer
  Real3 n;          // unit shading normal, turned likewise
  Real3 baseColor;  // linear
  Real alpha;       // coverage a
  Real metallic;
  Real roughness;
  Real transmission;
  Real3 specularF0;  // dielectric reflectance at normal incidence, and at grazing incidence
  Real specularF90;
  Real3 emission;  // W/(m² sr), already 0 on a side that does not emit
  Real ior;
  Real bump;  // m
  Mask front;
  Natural flags;  // MATERIAL_…
  Real3 sigma_a;
} Surfel;

/// Where the hits lie and what they lie on.
typedef struct {
  __global const float* triangles;  // the scene's, as words
  __global const float* materials;  // likewise
  Natural triangle;                 // each lane's word of these
  Natural material;
  int oneMaterial;  // in all lanes
  Natural corner[3];
  Real b0, b1, b2;
#if HAS(TEXTURES)
  Uv uv[LANES];
#endif
} Places;

#define WORDS_OF(Struct) ((uint)(sizeof(Struct) / 4))
#define WORD_OF(Struct, field) ((uint)((size_t) & ((Struct*)0)->field / 4))

/// A field of each lane's material, by its word. Neighbours mostly share one.
INLINE Real materialWord(const Places* at, uint word) {
  return at->oneMaterial ? (Real)(at->materials[FIRST(at->material) + word]) : gather(at->materials + word, at->material);
}
INLINE Real3 materialWords3(const Places* at, uint word) {
  return real3(materialWord(at, word), materialWord(at, word + 1), materialWord(at, word + 2));
}
#define MATERIAL(at, field) materialWord(at, WORD_OF(DeviceMaterial, field))
#define MATERIAL3(at, field) materialWords3(at, WORD_OF(DeviceMaterial, field))
#define MATERIAL_BITS(at, field) AS_NATURAL(MATERIAL(at, field))

INLINE Real3 blend(const Places* at, Real3 a, Real3 b, Real3 c) {
  return add3(add3(scale3(at->b0, a), scale3(at->b1, b)), scale3(at->b2, c));
}

#if HAS(TEXTURES)
/// Texture coordinates, lane by lane.
INLINE void findUvs(const SceneView* scene, Places* at, Natural triangleIndex, Real3 o, Real3 d, Real t) {
  const Real parts[9] = {o.x, o.y, o.z, d.x, d.y, d.z, t, at->b1, at->b2};
  float own[9][LANES];
  uint triangle[LANES];
  for (int n = 0; n < 9; ++n) STORE(parts[n], own[n]);
  STORE(triangleIndex, triangle);
  for (uint k = 0; k < LANES; ++k) {
    __global const DeviceTriangle* hit = scene->triangles + triangle[k];
    const float3 corners[3] = {load3(hit->v[0]), load3(hit->v[1]), load3(hit->v[2])};
    const Barycentrics b = barycentrics(own[7][k], own[8][k]);
    // For texture coordinates alone: what no texture shows keeps its bits whether this is compiled or not.
    const Barycentrics refined = refinedBarycentrics(corners, (float3)(own[0][k], own[1][k], own[2][k]),
                                                     (float3)(own[3][k], own[4][k], own[5][k]), own[6][k], b);
    uint corner[3];
    loadCorners(scene, triangle[k], corner);
    at->uv[k] = uvAt(scene, corner, &refined);
  }
}

/// RGBA of a texture slot of each lane's material; 1 where it has none.
INLINE void textureAt(const SceneView* scene, const Places* at, Natural slots, int srgb, Real rgba[4]) {
  for (int c = 0; c < 4; ++c) rgba[c] = (Real)(1.0f);
  uint slot[LANES];
  STORE(slots, slot);
  float own[4][LANES];
  uint used = 0;
  for (uint k = 0; k < LANES; ++k) used |= ~slot[k];
  if (used == 0) return;
  for (uint k = 0; k < LANES; ++k) {
    const float4 c = (int)slot[k] >= 0 ? sampleTexture(scene, (int)slot[k], &at->uv[k], srgb) : (float4)(1.0f);
    own[0][k] = c.x, own[1][k] = c.y, own[2][k] = c.z, own[3][k] = c.w;
  }
  for (int c = 0; c < 4; ++c) rgba[c] = LOAD(own[c]);
}
#endif

/// Lanes that hit nothing must name a triangle that is there.
INLINE Places placesOf(const SceneView* scene, Natural triangleIndex, Real3 o, Real3 d, Real t, Real b1, Real b2) {
  Places at;
  at.triangles = (__global const float*)scene->triangles;
  at.materials = (__global const float*)scene->materials;
  at.triangle = triangleIndex * WORDS_OF(DeviceTriangle);
  at.material = AS_NATURAL(gather(at.triangles + WORD_OF(DeviceTriangle, material), at.triangle)) * WORDS_OF(DeviceMaterial);
  at.oneMaterial = !some(at.material != FIRST(at.material));
  at.b0 = 1.0f - b1 - b2;
  at.b1 = b1;
  at.b2 = b2;
#if HAS(VERTEX_NORMALS) || HAS(VERTEX_COLORS) || HAS(TEXTURES)
  for (uint k = 0; k < 3; ++k) at.corner[k] = AS_NATURAL(gather((__global const float*)scene->corners + k, triangleIndex * 3u));
#endif
#if HAS(TEXTURES)
  findUvs(scene, &at, triangleIndex, o, d, t);
#endif
  return at;
}

/// Base colour and alpha: factor, texture, vertex colour.
INLINE Real3 baseColorsAt(const SceneView* scene, const Places* at, Real* alpha) {
  const uint word = WORD_OF(DeviceMaterial, baseColor);
  Real c[4];
  for (uint n = 0; n < 4; ++n) c[n] = materialWord(at, word + n);
#if HAS(BASE_COLOR_TEXTURE)
  Real texel[4];
  textureAt(scene, at, MATERIAL_BITS(at, baseColorTexture), 1, texel);
  for (uint n = 0; n < 4; ++n) c[n] *= texel[n];
#endif
#if HAS(VERTEX_COLORS)
  if (scene->colors) {
    for (uint n = 0; n < 4; ++n)
      c[n] *= at->b0 * gather(scene->colors + n, at->corner[0] * 4u) + at->b1 * gather(scene->colors + n, at->corner[1] * 4u) +
              at->b2 * gather(scene->colors + n, at->corner[2] * 4u);
  }
#endif
  *alpha = c[3];
  return real3(c[0], c[1], c[2]);
}

#if HAS(VERTEX_NORMALS)
/// Interpolated vertex normal, or n_g where a corner has none or the sum is useless.
INLINE Real3 vertexNormalsAt(const SceneView* scene, const Places* at, Real3 n_g) {
  if (!scene->normals) return n_g;
  const Real3 a = gather3(scene->normals, at->corner[0] * 3u), b = gather3(scene->normals, at->corner[1] * 3u),
              c = gather3(scene->normals, at->corner[2] * 3u);
  const Mask missing = (dots(a, a) == 0.0f) | (dots(b, b) == 0.0f) | (dots(c, c) == 0.0f);
  const Real3 n = normalized(blend(at, a, b, c));
  return choose3(!missing & finite3(n), n, n_g);
}
#endif

#if HAS(NORMAL_TEXTURE)
/// n tilted by the normal map; n itself where there is none or no tangent to lay it along.
INLINE Real3 mappedNormals(const SceneView* scene, const Places* at, Real3 n) {
  const Natural slots = MATERIAL_BITS(at, normalTexture);
  const Mask mapped = slots < 0x80000000u;
  if (!scene->tangents || !some(mapped)) return n;
  const Real3 along = blend(at, gather3(scene->tangents, at->corner[0] * 4u), gather3(scene->tangents, at->corner[1] * 4u),
                            gather3(scene->tangents, at->corner[2] * 4u));
  const Real3 tangent = normalized(sub3(along, scale3(dots(n, along), n)));
  const Real3 bitangent = scale3(gather(scene->tangents + 3, at->corner[0] * 4u), crosses(n, tangent));
  Real texel[4];
  textureAt(scene, at, slots, 0, texel);
  const Real scale = MATERIAL(at, normalScale);
  const Real x = (texel[0] * 2.0f - 1.0f) * scale, y = (texel[1] * 2.0f - 1.0f) * scale, z = texel[2] * 2.0f - 1.0f;
  const Real3 tilted = normalized(add3(add3(scale3(x, tangent), scale3(y, bitangent)), scale3(z, n)));
  return choose3(mapped & finite3(tangent) & finite3(tilted), tilted, n);
}
#endif

/// Reflectance at normal and grazing incidence of the dielectric part (KHR_materials_ior, KHR_materials_specular).
INLINE void specularReflectance(const SceneView* scene, const Places* at, Surfel* s) {
  const Real ratio = (s->ior - 1.0f) / (s->ior + 1.0f);
  const Real r0 = s->ior == 0.0f ? (Real)(1.0f) : ratio * ratio;
  s->specularF0 = real3(r0, r0, r0);
  s->specularF90 = (Real)(1.0f);
#if HAS(SPECULAR_EXTENSION)
  Real strength = MATERIAL(at, specular);
  Real3 tint = MATERIAL3(at, specularColor);
  Real texel[4];
#if HAS(SPECULAR_TEXTURE)
  textureAt(scene, at, MATERIAL_BITS(at, specularTexture), 0, texel);
  strength *= texel[3];
#endif
#if HAS(SPECULAR_COLOR_TEXTURE)
  textureAt(scene, at, MATERIAL_BITS(at, specularColorTexture), 1, texel);
  tint = mul3(tint, real3(texel[0], texel[1], texel[2]));
#endif
  const Real3 f0 = scale3(r0, tint), one = same3((float3)(1.0f));
  s->specularF0 = scale3(strength, real3(f0.x < 1.0f ? f0.x : one.x, f0.y < 1.0f ? f0.y : one.y, f0.z < 1.0f ? f0.z : one.z));
  s->specularF90 = strength;
#endif
}

/// What the material says at the hits, textures included.
INLINE void materialAt(const SceneView* scene, const Places* at, Surfel* s) {
  Real texel[4];
  s->flags = MATERIAL_BITS(at, flags);
  Real alpha;
  s->baseColor = baseColorsAt(scene, at, &alpha);
  s->alpha = (Real)(1.0f);
#if HAS(ALPHA_BLEND)
  s->alpha = (s->flags & MATERIAL_BLEND) != 0 ? clampUnit(alpha) : s->alpha;
#endif
  s->metallic = MATERIAL(at, metallic);
  s->roughness = MATERIAL(at, roughness);
#if HAS(METALLIC_ROUGHNESS_TEXTURE)
  textureAt(scene, at, MATERIAL_BITS(at, metallicRoughnessTexture), 0, texel);
  s->metallic *= texel[2];
  s->roughness *= texel[1];
#endif
  s->metallic = clampUnit(s->metallic);
  s->roughness = clampUnit(s->roughness);
  s->transmission = MATERIAL(at, transmission);
#if HAS(TRANSMISSION_TEXTURE)
  textureAt(scene, at, MATERIAL_BITS(at, transmissionTexture), 0, texel);
  s->transmission *= texel[0];
#endif
  s->ior = MATERIAL(at, ior);
  s->sigma_a = MATERIAL3(at, sigma_a);
  specularReflectance(scene, at, s);
  s->emission = same3((float3)(0.0f));
#if HAS(EMISSION)
  Real3 emission = MATERIAL3(at, emission);
#if HAS(EMISSION_TEXTURE)
  textureAt(scene, at, MATERIAL_BITS(at, emissionTexture), 1, texel);
  emission = mul3(emission, real3(texel[0], texel[1], texel[2]));
#endif
  s->emission = choose3(s->front | ((s->flags & MATERIAL_DOUBLE_SIDED) != 0), emission, s->emission);
#endif
}

/// Distance that a ray's origin keeps from the surface.
INLINE Real bumpAt(const RenderConstants* constants, const Places* at, Real3 p0, Real3 p1, Real3 p2) {
#if HAS(FIXED_BUMP)
  if (!(constants->bump < 0.0f)) return (Real)(constants->bump);
#endif
  const Real3 extent = blend(at, real3(fabs(p0.x), fabs(p0.y), fabs(p0.z)), real3(fabs(p1.x), fabs(p1.y), fabs(p1.z)),
                             real3(fabs(p2.x), fabs(p2.y), fabs(p2.z)));
  const Real scaled = largestOf(extent.x, extent.y, extent.z) * 9.5367431640625e-7f;  // 2^-20
  return scaled > 1e-30f ? scaled : (Real)(1e-30f);
}

/// The surfels at the hits (triangle, t, b1, b2) of the rays o + t d.
INLINE Surfel surfelAt(const SceneView* scene, const RenderConstants* constants, Natural triangleIndex, Real3 o, Real3 d, Real t,
                       Real b1, Real b2) {
  Surfel s;
  const Places at = placesOf(scene, triangleIndex, o, d, t, b1, b2);
  const Real3 p0 = gather3(at.triangles, at.triangle), p1 = gather3(at.triangles + 3, at.triangle),
              p2 = gather3(at.triangles + 6, at.triangle);
  s.position = blend(&at, p0, p1, p2);
  s.bump = bumpAt(constants, &at, p0, p1, p2);
  const Real3 n_g = normalized(crosses(sub3(p1, p0), sub3(p2, p0)));
  s.front = dots(n_g, d) < 0.0f;
  Real3 n = n_g;
#if HAS(VERTEX_NORMALS)
  n = vertexNormalsAt(scene, &at, n_g);
#endif
#if HAS(NORMAL_TEXTURE)
  n = mappedNormals(scene, &at, n);
#endif
  s.n_g = choose3(s.front, n_g, minus3(n_g));
  n = choose3(s.front, n, minus3(n));
  s.n = choose3(dots(n, d) < 0.0f, n, s.n_g);
  materialAt(scene, &at, &s);
  return s;
}
