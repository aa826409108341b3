// How much surfels reflect: of dielectrics by Fresnel, tinted or under a film, each colour by its own index where they
// split light; of metals and of facets by Schlick. Formulas: host/reference/README.md.
#include "lib/surface/fresnel.cl"
#include "lib/surface/surfel.cl"

INLINE Mask isSmooth(const RenderConstants* constants, const Surfel* s) {
  return s->roughness < constants->mirrorRoughness;
}

#if HAS(GLOSS)
/// Rough, and reflects whatever is around it.
INLINE Mask isGlossy(const RenderConstants* constants, const Surfel* s) {
  return !isSmooth(constants, s) & ((Natural)(constants->glossy) == 1u);
}
#endif

/// Ratio of indices n_t/n_i for light arriving from the viewer's side, of which the surface has the index `ior`.
INLINE Real interfaceEta(const Surfel* s, Real ior) {
  const Mask outside = s->front | ((s->flags & MATERIAL_VOLUME) == 0);
  return outside ? ior : 1.0f / ior;
}

INLINE Real3 schlick(Real3 f0, Real3 f90, Real cosine) {
  return add3(f0, scale3(schlickWeight(cosine), sub3(f90, f0)));
}

/// Dielectric reflectance seen along w_o, without a film, of index `ior` and f0 at normal incidence; total: set at
/// total reflection.
INLINE Real3 clearReflectance(const Surfel* s, Real ior, Real3 f0, Real cosine, Mask* total) {
  const Real ratio = (ior - 1.0f) / (ior + 1.0f);
  const Real r0 = ratio * ratio;
  const Mask opaque = (ior == 0.0f) | (r0 >= 1.0f);
  const Real r = fresnelDielectric(cosine, interfaceEta(s, ior), total);
  *total = *total & !opaque;
  const Real3 reflectance = choose3(opaque, f0, real3(r, r, r));
#if HAS(SPECULAR_EXTENSION)
  // Untinted: the bits of the kernels without this extension.
  const Mask plain = (s->specularF90 == 1.0f) & (f0.x == r0) & (f0.y == r0) & (f0.z == r0);
  const Real3 f90 = real3(s->specularF90, s->specularF90, s->specularF90);
  // Where nothing enters, r is 1 at every angle and gives no rise.
  const Real rise = opaque ? schlickWeight(cosine) : (r - r0) / (1.0f - r0);
  const Real3 tinted = add3(f0, scale3(rise, sub3(f90, f0)));
  // Dense dielectrics dip below R0.
  return choose3(plain | *total, reflectance, real3(clampUnit(tinted.x), clampUnit(tinted.y), clampUnit(tinted.z)));
#else
  return reflectance;
#endif
}

#if HAS(DISPERSION)
/// Where colours have indices of their own: that of one channel, which has f0 at normal incidence.
INLINE void splitReflectance(const Surfel* s, uint channel, Real f0, Real cosine, Real* reflectance, Mask* total) {
  const Mask splits = s->halfSpread > 0.0f;
  Mask own;
  const Real3 r = clearReflectance(s, channelIndex(s->ior, s->halfSpread, channel), real3(f0, f0, f0), cosine, &own);
  *reflectance = splits ? r.x : *reflectance;
  *total = splits ? own : *total;
}
#endif

/// Dielectric reflectance seen along w_o; total: set at total reflection.
INLINE Real3 dielectricReflectance(const Surfel* s, Real cosine, Mask3* total) {
  Real3 r = clearReflectance(s, s->ior, s->specularF0, cosine, &total->x);
  total->y = total->z = total->x;
#if HAS(DISPERSION)
  if (some(s->halfSpread > 0.0f)) {
    splitReflectance(s, 0, s->specularF0.x, cosine, &r.x, &total->x);
    splitReflectance(s, 1, s->specularF0.y, cosine, &r.y, &total->y);
    splitReflectance(s, 2, s->specularF0.z, cosine, &r.z, &total->z);
  }
#endif
#if HAS(IRIDESCENCE)
  return chooseEach3(*total, r, belowFilm(&s->film, cosine, s->specularF0, r));
#else
  return r;
#endif
}

/// Reflectance of rough dielectrics and of metals at that angle to a facet.
INLINE Real3 facetReflectance(const Surfel* s, Real cosine) {
  const Real3 r = schlick(s->specularF0, real3(s->specularF90, s->specularF90, s->specularF90), cosine);
#if HAS(IRIDESCENCE)
  return belowFilm(&s->film, cosine, s->specularF0, r);
#else
  return r;
#endif
}
INLINE Real3 metalReflectance(const Surfel* s, Real cosine) {
  const Real3 r = schlick(s->baseColor, same3((float3)(1.0f)), cosine);
#if HAS(IRIDESCENCE)
  return belowFilm(&s->film, cosine, s->baseColor, r);
#else
  return r;
#endif
}
