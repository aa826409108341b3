// Microfacets: GGX (Walter et al. 2007) with the heights of masking and shadowing correlated (Heitz 2014), as glTF 2.0,
// appendix B, has it; with ANISOTROPY rougher along a tangent (KHR_materials_anisotropy).
#include "lib/lanes.cl"

/// A surface of microfacets.
typedef struct {
  Real3 n;     // unit
  Real alpha;  // across the tangent
#if HAS(ANISOTROPY)
  Real3 tangent;  // unit, across n; 0: the facets have no direction
  Real along;     // alpha along it
#endif
} Facets;

/// Of that perceptual roughness; a mirror's lobe would be 0/0.
INLINE Facets facetsAbout(Real3 n, Real roughness) {
  Facets f;
  f.n = n;
  const Real squared = roughness * roughness;
  f.alpha = squared > 1e-3f ? squared : (Real)(1e-3f);
#if HAS(ANISOTROPY)
  f.tangent = same3((float3)(0.0f));
  f.along = f.alpha;
#endif
  return f;
}

/// Distribution times visibility, 1/sr; h: halfway between w_o and w_i. Directions on the side of n.
INLINE Real facetLobe(const Facets* f, Real3 w_o, Real3 w_i, Real3 h) {
  const Real cosO = dot3(f->n, w_o), cosI = dot3(f->n, w_i), cosH = dot3(f->n, h);
  const Real a2 = f->alpha * f->alpha;
  Real k = cosH * cosH * (a2 - 1.0f) + 1.0f;
  Real o = a2 + (1.0f - a2) * cosO * cosO, i = a2 + (1.0f - a2) * cosI * cosI;
#if HAS(ANISOTROPY)
  const Real ratio = f->alpha / f->along, more = f->along * f->along - a2;
  const Real tangentO = dot3(f->tangent, w_o), tangentI = dot3(f->tangent, w_i), tangentH = dot3(f->tangent, h);
  const Real acrossH = dot3(cross3(f->n, f->tangent), h), alongH = tangentH * ratio;
  k = ratio < 1.0f ? alongH * alongH + acrossH * acrossH + a2 * cosH * cosH : k;
  // What the isotropic terms lack along the tangent.
  o += more * tangentO * tangentO;
  i += more * tangentI * tangentI;
#endif
  Real distribution = a2 / (PI * k * k);
#if HAS(ANISOTROPY)
  distribution *= ratio;
#endif
  const Real visibility = 0.5f / (cosI * sqrt(o) + cosO * sqrt(i));
  return distribution * visibility;
}

#if HAS(GLOSS)
/// The normal of a microfacet that w_o sees, sampled by how much of w_o each takes up (Heitz 2018; by spherical caps,
/// Dupuy and Benyoub 2023).
INLINE Real3 visibleNormal(const Facets* f, Real3 w_o, Square at) {
  const Real across = f->alpha;
  Real along = across;
  Real3 right, up;
  basisAbout(f->n, &right, &up);
#if HAS(ANISOTROPY)
  const Mask directed = dot3(f->tangent, f->tangent) > 0.0f;
  right = choose3(directed, f->tangent, right);
  up = choose3(directed, cross3(f->n, f->tangent), up);
  along = f->along;
#endif
  const Real3 seen = normalize3(real3(along * dot3(right, w_o), across * dot3(up, w_o), dot3(f->n, w_o)));
  Real cosine, sine;
  aroundCircle(at.u, &cosine, &sine);
  const Real z = (1.0f - at.v) * (1.0f + seen.z) - seen.z;
  const Real rest = 1.0f - z * z, radius = sqrt(rest > 0.0f ? rest : (Real)(0.0f));
  const Real x = radius * cosine + seen.x, y = radius * sine + seen.y;
  return normalize3(add3(add3(scale3(along * x, right), scale3(across * y, up)), scale3(z + seen.z, f->n)));
}

/// sqrt(1 + alpha² tan²) of the angle to n: 1 + 2 Λ of Smith's shadowing (Heitz 2014).
INLINE Real smithRoot(const Facets* f, Real3 w) {
  const Real cosine = dot3(f->n, w), c2 = cosine * cosine;
  const Real s2 = 1.0f - c2;
  Real spread = f->alpha * f->alpha * (s2 > 0.0f ? s2 : (Real)(0.0f));
#if HAS(ANISOTROPY)
  const Real tangent = dot3(f->tangent, w);
  spread += (f->along * f->along - f->alpha * f->alpha) * tangent * tangent;
#endif
  return sqrt(1.0f + spread / c2);
}

/// What is left of a reflection along a sampled normal, G2/G1 of height-correlated Smith; 0 below the surface, whose
/// geometric normal is n_g.
INLINE Real reflectionWeight(const Facets* f, Real3 n_g, Real3 w_o, Real3 w_i) {
  const Real o = smithRoot(f, w_o), i = smithRoot(f, w_i);
  const Mask above = (dot3(f->n, w_i) > 0.0f) & (dot3(n_g, w_i) > 0.0f);
  return above ? (1.0f + o) / (o + i) : (Real)(0.0f);
}
#endif
