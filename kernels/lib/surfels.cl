// The surfels of the LANES hits of a work item: what shading needs to know of the surface, evaluated from vertices,
// material and textures. Conventions: host/reference/README.md.
#include "lib/fresnel.cl"
#include "lib/textures.cl"

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
  Real3 extent;  // blend of the corners' sizes, axis by axis: what rounding errors of the position are measured by; m
  Mask front;
  Natural flags;  // MATERIAL_…
  Real3 sigma_a;
} Surfel;

/// Where in their triangles hits lie, as Barycentrics.
typedef struct {
  Real b0, b1, b2;
  Real low1, low2;
} Positions;

/// Where the hits lie and what they lie on.
typedef struct {
  Real3 p0, p1, p2;  // corners of the triangles
  Records material;
  Natural corner[3];
  Real b0, b1, b2;
  Uvs uv;
} Places;

#define MATERIAL(at, field) FIELD(&(at)->material, DeviceMaterial, field)
#define MATERIAL_BITS(at, field) AS_NATURAL(MATERIAL(at, field))
#define MATERIAL3(at, field) materialWords3(at, WORD_OF(DeviceMaterial, field))
INLINE Real3 materialWords3(const Places* at, uint word) {
  return real3(wordOf(&at->material, word), wordOf(&at->material, word + 1), wordOf(&at->material, word + 2));
}

INLINE Real3 blend(const Places* at, Real3 a, Real3 b, Real3 c) {
  return add3(add3(scale3(at->b0, a), scale3(at->b1, b)), scale3(at->b2, c));
}

INLINE Real3 fma3(Real s, Real3 v, Real3 plus) { return real3(fma(s, v.x, plus.x), fma(s, v.y, plus.y), fma(s, v.z, plus.z)); }

/// Barycentrics of the hits at distance t of the rays o + t d, found again from where those points lie beside the first
/// corner: a search's own are off by the rounding of distances to the ray's origin, which a texture shows on a far or
/// slanted triangle. Solved once for (b1, b2) and once more for what they leave over; every difference keeps what it
/// lost. An error of t is along d, and changes nothing. Clamped to the triangle; `found` where it is seen from its edge.
INLINE Positions refinedPositions(Real3 p0, Real3 p1, Real3 p2, Real3 o, Real3 d, Real t, Positions found) {
  const Real3 e1 = sub3(p1, p0), e2 = sub3(p2, p0);
  const Real3 from = sub3(o, p0), along = scale3(t, d), beside = add3(from, along);
  const Real3 besideLow = add3(add3(sumErrors(o, minus3(p0), from), fma3(t, d, minus3(along))), sumErrors(from, along, beside));
  const Real3 across1 = crosses(e2, d), across2 = crosses(d, e1);
  const Real inverse = 1.0f / dots(e1, across1);
  const Real free1 = dots(beside, across1) * inverse, free2 = dots(beside, across2) * inverse;
  const Mask seen = isfinite(free1) & isfinite(free2);
  Positions at;
  const Real b1 = clampUnit(free1), room = 1.0f - b1, upper = free2 < room ? free2 : room;
  const Real b2 = free2 > 0.0f ? upper : (Real)(0.0f);
  const Real3 part1 = scale3(b1, e1), part2 = scale3(b2, e2);
  const Real3 rest1 = sub3(beside, part1), rest2 = sub3(rest1, part2);
  const Real3 left = add3(sumErrors(beside, minus3(part1), rest1), sumErrors(rest1, minus3(part2), rest2));
  const Real3 lost1 = add3(fma3(b1, e1, minus3(part1)), scale3(b1, sumErrors(p1, minus3(p0), e1)));
  const Real3 lost2 = add3(fma3(b2, e2, minus3(part2)), scale3(b2, sumErrors(p2, minus3(p0), e2)));
  const Real3 rest = add3(rest2, add3(besideLow, sub3(sub3(left, lost1), lost2)));
  const Mask inside = seen & (b1 == free1) & (b2 == free2);
  at.b0 = seen ? 1.0f - b1 - b2 : found.b0;
  at.b1 = seen ? b1 : found.b1;
  at.b2 = seen ? b2 : found.b2;
  at.low1 = inside ? dots(rest, across1) * inverse : (Real)(0.0f);
  at.low2 = inside ? dots(rest, across2) * inverse : (Real)(0.0f);
  return at;
}

/// interpolateUv for each lane.
INLINE Real interpolateUvs(Real a, Real b, Real c, const Positions* at, Real* low) {
  const Real e1 = b - a, e2 = c - a;
  const Real part1 = at->b1 * e1, part2 = at->b2 * e2;
  const Real with1 = a + part1, sum = with1 + part2;
  *low = sumErrorReal(a, part1, with1) + sumErrorReal(with1, part2, sum) + fma(at->b1, e1, -part1) + fma(at->b2, e2, -part2) +
         at->b1 * sumErrorReal(b, -a, e1) + at->b2 * sumErrorReal(c, -a, e2) + at->low1 * e1 + at->low2 * e2;
  return sum;
}

INLINE void interpolateUvSets(__global const float* values, const Natural* corner, const Positions* at, uint set, Uvs* uv) {
  const Natural a = corner[0] * 2u, b = corner[1] * 2u, c = corner[2] * 2u;
  uv->u[set] = interpolateUvs(gather(values, a), gather(values, b), gather(values, c), at, &uv->uLow[set]);
  uv->v[set] = interpolateUvs(gather(values + 1, a), gather(values + 1, b), gather(values + 1, c), at, &uv->vLow[set]);
}

/// Both sets of texture coordinates; 0 for a set that the scene has not.
INLINE Uvs uvsAt(const SceneView* scene, const Natural* corner, const Positions* at) {
  Uvs uv;
  for (uint set = 0; set < 2; ++set) uv.u[set] = uv.v[set] = uv.uLow[set] = uv.vLow[set] = (Real)(0.0f);
#if HAS(UV0)
  if (scene->uv0) interpolateUvSets(scene->uv0, corner, at, 0, &uv);
#endif
#if HAS(UV1)
  if (scene->uv1) interpolateUvSets(scene->uv1, corner, at, 1, &uv);
#endif
  return uv;
}

#if HAS(TEXTURES)
/// RGBA of a texture slot of each lane's material; 1 where it has none.
INLINE Texels textureAt(const SceneView* scene, const Places* at, Natural slots, int srgb) {
  const Mask used = slots < 0x80000000u;
  Texels none;
  for (uint n = 0; n < 4; ++n) none.c[n] = (Real)(1.0f);
  if (!some(used)) return none;
  return chooseTexels(used, sampleTextures(scene, used ? slots : (Natural)(0), &at->uv, srgb), none);
}
/// The same by the slot's name, its colours stored as scene_tables.h says.
#define TEXTURE_AT(scene, at, slot) textureAt(scene, at, MATERIAL_BITS(at, slot), slot##Encoding)
#endif

#if HAS(VERTEX_NORMALS) || HAS(VERTEX_COLORS) || HAS(TEXTURES)
/// Vertices of the triangles' corners. Of narrow ones two words hold three, from their first half on or their second.
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

/// Lanes that hit nothing must name a triangle that is there.
INLINE Places placesOf(const SceneView* scene, Natural triangleIndex, Real3 o, Real3 d, Real t, Real b1, Real b2) {
  Places at;
  __global const float* triangles = (__global const float*)scene->triangles;
  const Natural word = triangleIndex * WORDS_OF(DeviceTriangle);
  at.p0 = gather3(triangles, word);
  at.p1 = gather3(triangles + 3, word);
  at.p2 = gather3(triangles + 6, word);
  at.material = recordsAt(scene->materials, AS_NATURAL(gather(triangles + WORD_OF(DeviceTriangle, material), word)),
                          WORDS_OF(DeviceMaterial));
  at.b0 = 1.0f - b1 - b2;
  at.b1 = b1;
  at.b2 = b2;
#if HAS(VERTEX_NORMALS) || HAS(VERTEX_COLORS) || HAS(TEXTURES)
  cornersOf(scene, triangleIndex, at.corner);
#else
  for (uint k = 0; k < 3; ++k) at.corner[k] = (Natural)(0);  // nothing is interpolated, and the buffer is not there
#endif
  Positions forTextures = {at.b0, b1, b2, (Real)(0.0f), (Real)(0.0f)};
#if HAS(TEXTURES)
  // For texture coordinates alone: what no texture shows keeps its bits whether this is compiled or not.
  forTextures = refinedPositions(at.p0, at.p1, at.p2, o, d, t, forTextures);
#endif
  at.uv = uvsAt(scene, at.corner, &forTextures);
  return at;
}

/// Base colour and alpha: factor, texture, vertex colour.
INLINE Real3 baseColorsAt(const SceneView* scene, const Places* at, Real* alpha) {
  const uint word = WORD_OF(DeviceMaterial, baseColor);
  Real c[4];
  for (uint n = 0; n < 4; ++n) c[n] = wordOf(&at->material, word + n);
#if HAS(TEXTURES) && HAS(BASE_COLOR_TEXTURE)
  const Texels texel = TEXTURE_AT(scene, at, baseColorTexture);
  for (uint n = 0; n < 4; ++n) c[n] *= texel.c[n];
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
  return choose3(missing, n_g, choose3(finite3(n), n, n_g));
}
#endif

#if HAS(TEXTURES) && HAS(NORMAL_TEXTURE)
/// n tilted by the normal map; n itself where there is none or no tangent to lay it along.
INLINE Real3 mappedNormals(const SceneView* scene, const Places* at, Real3 n) {
  const Natural slots = MATERIAL_BITS(at, normalTexture);
  const Mask mapped = slots < 0x80000000u;
  if (!scene->tangents || !some(mapped)) return n;
  const Real3 along = blend(at, gather3(scene->tangents, at->corner[0] * 4u), gather3(scene->tangents, at->corner[1] * 4u),
                            gather3(scene->tangents, at->corner[2] * 4u));
  const Real3 tangent = normalized(sub3(along, scale3(dots(n, along), n)));
  const Real3 bitangent = scale3(gather(scene->tangents + 3, at->corner[0] * 4u), crosses(n, tangent));
  const Texels texel = textureAt(scene, at, slots, normalTextureEncoding);
  const Real scale = MATERIAL(at, normalScale);
  const Real x = (texel.c[0] * 2.0f - 1.0f) * scale, y = (texel.c[1] * 2.0f - 1.0f) * scale, z = texel.c[2] * 2.0f - 1.0f;
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
#if HAS(TEXTURES) && HAS(SPECULAR_TEXTURE)
  const Texels specular = TEXTURE_AT(scene, at, specularTexture);
  strength *= specular.c[3];
#endif
#if HAS(TEXTURES) && HAS(SPECULAR_COLOR_TEXTURE)
  const Texels specularColor = TEXTURE_AT(scene, at, specularColorTexture);
  tint = mul3(tint, real3(specularColor.c[0], specularColor.c[1], specularColor.c[2]));
#endif
  const Real3 f0 = scale3(r0, tint), one = same3((float3)(1.0f));
  s->specularF0 = scale3(strength, real3(f0.x < 1.0f ? f0.x : one.x, f0.y < 1.0f ? f0.y : one.y, f0.z < 1.0f ? f0.z : one.z));
  s->specularF90 = strength;
#endif
}

/// What the material says at the hits, textures included.
INLINE void materialAt(const SceneView* scene, const Places* at, Surfel* s) {
  s->flags = MATERIAL_BITS(at, flags);
  Real alpha;
  s->baseColor = baseColorsAt(scene, at, &alpha);
  s->alpha = (Real)(1.0f);
#if HAS(ALPHA_BLEND)
  s->alpha = (s->flags & MATERIAL_BLEND) != 0 ? clampUnit(alpha) : s->alpha;
#endif
  s->metallic = MATERIAL(at, metallic);
  s->roughness = MATERIAL(at, roughness);
#if HAS(TEXTURES) && HAS(METALLIC_ROUGHNESS_TEXTURE)
  const Texels metallicRoughness = TEXTURE_AT(scene, at, metallicRoughnessTexture);
  s->metallic *= metallicRoughness.c[2];
  s->roughness *= metallicRoughness.c[1];
#endif
  s->metallic = clampUnit(s->metallic);
  s->roughness = clampUnit(s->roughness);
  s->transmission = MATERIAL(at, transmission);
#if HAS(TEXTURES) && HAS(TRANSMISSION_TEXTURE)
  const Texels transmission = TEXTURE_AT(scene, at, transmissionTexture);
  s->transmission *= transmission.c[0];
#endif
  s->ior = MATERIAL(at, ior);
  s->sigma_a = MATERIAL3(at, sigma_a);
  specularReflectance(scene, at, s);
  s->emission = same3((float3)(0.0f));
#if HAS(EMISSION)
  Real3 emission = MATERIAL3(at, emission);
#if HAS(TEXTURES) && HAS(EMISSION_TEXTURE)
  const Texels glow = TEXTURE_AT(scene, at, emissionTexture);
  emission = mul3(emission, real3(glow.c[0], glow.c[1], glow.c[2]));
#endif
  s->emission = choose3(s->front | ((s->flags & MATERIAL_DOUBLE_SIDED) != 0), emission, s->emission);
#endif
}

/// The surfels at the hits (triangle, t, b1, b2) of the rays o + t d.
INLINE Surfel surfelAt(const SceneView* scene, Natural triangleIndex, Real3 o, Real3 d, Real t, Real b1, Real b2) {
  Surfel s;
  const Places at = placesOf(scene, triangleIndex, o, d, t, b1, b2);
  const Real3 p0 = at.p0, p1 = at.p1, p2 = at.p2;
  s.position = blend(&at, p0, p1, p2);
  s.extent = blend(&at, real3(fabs(p0.x), fabs(p0.y), fabs(p0.z)), real3(fabs(p1.x), fabs(p1.y), fabs(p1.z)),
                   real3(fabs(p2.x), fabs(p2.y), fabs(p2.z)));
  const Real3 n_g = normalized(crosses(sub3(p1, p0), sub3(p2, p0)));
  s.front = dots(n_g, d) < 0.0f;
  Real3 n = n_g;
#if HAS(VERTEX_NORMALS)
  n = vertexNormalsAt(scene, &at, n_g);
#endif
#if HAS(TEXTURES) && HAS(NORMAL_TEXTURE)
  n = mappedNormals(scene, &at, n);
#endif
  s.n_g = choose3(s.front, n_g, minus3(n_g));
  n = choose3(s.front, n, minus3(n));
  s.n = choose3(dots(n, d) < 0.0f, n, s.n_g);
  materialAt(scene, &at, &s);
  return s;
}
