// What searches ask of a surface that they met: whether it is there, and how much light it lets through. The
// mathematics is that of shading (lib/surface), in one lane.
#include "lib/scene.cl"
#include "lib/search/one_lane.cl"

#include "lib/corners.cl"

#if HAS(ALPHA_MASK) || HAS(FILTERED_SHADOWS)
#include "lib/surface/point.cl"

/// A point as the search found it: no picture shows the rounding that shading takes out of it.
INLINE TrianglePoint foundPoint(const SceneView* scene, uint triangleIndex, float b1, float b2) {
  const Barycentrics found = barycentrics(b1, b2);
  TrianglePoint at = trianglePoint(scene, triangleIndex, &found);
  at.uv = uvAt(scene, at.corner, &found);
  return at;
}
#endif

#if HAS(ALPHA_MASK)
/// 1 if a masked triangle is really there at these barycentrics.
INLINE int passesAlphaMask(const SceneView* scene, uint triangleIndex, float b1, float b2) {
  const TrianglePoint at = foundPoint(scene, triangleIndex, b1, b2);
  return baseColorAt(scene, &at).c[3] >= MATERIAL(&at, alphaCutoff);
}
#endif

#if HAS(FILTERED_SHADOWS)
#if HAS(TRANSMISSION)
#include "lib/surface/fresnel.cl"
#include "lib/surface/material.cl"

/// Share of the light that passes straight through the material itself, before its colour; alpha: what is covered.
INLINE Real transmittedShare(const SceneView* scene, const TrianglePoint* at, Real alpha, Real3 d) {
  Real metallic, roughness;
  metallicRoughnessAt(scene, at, &metallic, &roughness);
  const Real transmission = transmissionAt(scene, at), ior = MATERIAL(at, ior);
  if (!(transmission > 0.0f) || (MATERIAL_BITS(at, flags) & MATERIAL_UNLIT)) return 0.0f;
  const Real3 n_g = normalize3(cross3(sub3(at->p1, at->p0), sub3(at->p2, at->p0)));
  const Real cosine = fabs(dot3(n_g, d));
  Mask total;
  const Real reflected = ior == 0.0f ? 1.0f : fresnelDielectric(fmin(cosine, 1.0f), ior, &total);
  return alpha * transmission * (1.0f - metallic) * (1.0f - reflected);
}
#endif

/// How much of the light a surface lets straight through to a shadow ray along d; host/reference/README.md.
/// For a masked triangle: 1 below the cutoff, else 0 (the hit counts).
INLINE Real3 shadowTransmittance(const SceneView* scene, uint triangleIndex, float b1, float b2, Real3 d) {
  const TrianglePoint at = foundPoint(scene, triangleIndex, b1, b2);
  const Natural flags = MATERIAL_BITS(&at, flags);
  const Rgba c = baseColorAt(scene, &at);
  Real alpha = 1.0f;
#if HAS(ALPHA_MASK)
  if ((flags & MATERIAL_MASK) && c.c[3] < MATERIAL(&at, alphaCutoff)) return real3(1.0f, 1.0f, 1.0f);
#endif
#if HAS(ALPHA_BLEND)
  if (flags & MATERIAL_BLEND) alpha = clampUnit(c.c[3]);
#endif
  Real3 through = real3(1.0f - alpha, 1.0f - alpha, 1.0f - alpha);
#if HAS(TRANSMISSION)
  through = add3(through, scale3(transmittedShare(scene, &at, alpha, d), real3(c.c[0], c.c[1], c.c[2])));
#endif
  return real3(clampUnit(through.x), clampUnit(through.y), clampUnit(through.z));  // vertex colours may exceed 1
}
#endif
