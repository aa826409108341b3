// A clear coat (KHR_materials_clearcoat): a thin layer of index 1.5 over everything else, with a roughness and a normal
// of its own. What it reflects, by the angle to its normal, does not get below.
#include "lib/surface/facets.cl"
#include "lib/surface/fresnel.cl"

typedef struct {
  Real3 n;           // unit, turned to the viewer
  Real roughness;    // perceptual
  Real reflectance;  // towards the viewer, times how much of the surface the coat covers; 0: there is none
} Coat;

/// Of a coat that covers `share` of the surface, seen along d.
INLINE Coat coatOf(Real3 n, Real3 d, Real share, Real roughness) {
  Coat coat;
  coat.n = n;
  coat.roughness = clampUnit(roughness);
  const Real along = -dot3(n, d);
  coat.reflectance = clampUnit(share) * (0.04f + 0.96f * schlickWeight(along < 1.0f ? along : (Real)(1.0f)));
  return coat;
}

INLINE Mask isSmoothCoat(const RenderConstants* constants, const Coat* coat) {
  return coat->roughness < constants->mirrorRoughness;
}

/// Sends out an impulse.
INLINE Mask coatReflects(const RenderConstants* constants, const Coat* coat) {
  Mask reflects = isSmoothCoat(constants, coat);
#if HAS(GLOSS)
  reflects = reflects | ((Natural)(constants->glossy) == 1u);
#endif
  return reflects & (coat->reflectance > 0.0f);
}

/// Its highlight, times the ratio of the cosines of w_i to its own normal and to the surface's, by which the caller
/// multiplies. light: LIGHT_…, as in finiteScattering.
INLINE Real coatLobe(const RenderConstants* constants, const Coat* coat, Real3 w_o, Real3 w_i, Real3 h, Real cosI,
                     uint light) {
  const Facets facets = facetsAbout(coat->n, coat->roughness);
  const Real along = dot3(coat->n, w_i);
  Mask shows = !isSmoothCoat(constants, coat) & (coat->reflectance > 0.0f) & (along > 0.0f);
#if HAS(GLOSS) && (HAS(SURFACE_LIGHTS) || HAS(SKY_LIGHTS))
  if (light == LIGHT_SURFACE || light == LIGHT_SKY) shows = shows & !coatReflects(constants, coat);
#endif
  if (!some(shows)) return (Real)(0.0f);
  return shows ? coat->reflectance * facetLobe(&facets, w_o, w_i, h) * (along / cosI) : (Real)(0.0f);
}

#if HAS(MIRROR)
/// Where it sends its impulse; n_g: of the surface. `magnitude`: of the impulse, 0 where there is none.
INLINE Real3 coatDirection(const RenderConstants* constants, const Coat* coat, Real3 n_g, Real3 w_o, Square at,
                           Real* magnitude) {
  const Real3 aboutN = sub3(scale3(2.0f * dot3(coat->n, w_o), coat->n), w_o);
  const Real3 aboutG = sub3(scale3(2.0f * dot3(n_g, w_o), n_g), w_o);
  Real3 w_i = normalize3(choose3(dot3(n_g, aboutN) > 0.0f, aboutN, aboutG));
  *magnitude = coatReflects(constants, coat) ? coat->reflectance : (Real)(0.0f);
#if HAS(GLOSS)
  const Mask rough = !isSmoothCoat(constants, coat);
  if (some(rough)) {
    const Facets facets = facetsAbout(coat->n, coat->roughness);
    const Real3 m = visibleNormal(&facets, w_o, at);
    const Real3 aboutFacet = sub3(scale3(2.0f * dot3(m, w_o), m), w_o);
    w_i = choose3(rough, aboutFacet, w_i);
    *magnitude = rough ? *magnitude * reflectionWeight(&facets, n_g, w_o, aboutFacet) : *magnitude;
  }
#endif
  return w_i;
}
#endif
