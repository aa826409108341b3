// Scattering at surfels: the finite part (Lambert and the glTF microfacet lobe) for direct light, and the impulses
// (mirror reflection, refraction, straight transmission); then the layers over them. Formulas:
// host/reference/README.md.
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

/// Ratio of indices n_t/n_i for light arriving from the viewer's side.
INLINE Real interfaceEta(const Surfel* s) {
  const Mask outside = s->front | ((s->flags & MATERIAL_VOLUME) == 0);
  return outside ? s->ior : 1.0f / s->ior;
}

INLINE Real3 schlick(Real3 f0, Real3 f90, Real cosine) {
  return add3(f0, scale3(schlickWeight(cosine), sub3(f90, f0)));
}

/// Dielectric reflectance seen along w_o, without a film; total: set at total reflection.
INLINE Real3 clearReflectance(const Surfel* s, Real cosine, Mask* total) {
  const Real ratio = (s->ior - 1.0f) / (s->ior + 1.0f);
  const Real r0 = ratio * ratio;
  const Mask opaque = (s->ior == 0.0f) | (r0 >= 1.0f);
  const Real r = fresnelDielectric(cosine, interfaceEta(s), total);
  *total = *total & !opaque;
  const Real3 reflectance = choose3(opaque, s->specularF0, real3(r, r, r));
#if HAS(SPECULAR_EXTENSION)
  // Untinted: the bits of the kernels without this extension.
  const Mask plain = (s->specularF90 == 1.0f) & (s->specularF0.x == r0) & (s->specularF0.y == r0) &
                     (s->specularF0.z == r0);
  const Real3 f90 = real3(s->specularF90, s->specularF90, s->specularF90);
  // Where nothing enters, r is 1 at every angle and gives no rise.
  const Real rise = opaque ? schlickWeight(cosine) : (r - r0) / (1.0f - r0);
  const Real3 tinted = add3(s->specularF0, scale3(rise, sub3(f90, s->specularF0)));
  // Dense dielectrics dip below R0.
  return choose3(plain | *total, reflectance, real3(clampUnit(tinted.x), clampUnit(tinted.y), clampUnit(tinted.z)));
#else
  return reflectance;
#endif
}

/// Dielectric reflectance seen along w_o; total: set at total reflection.
INLINE Real3 dielectricReflectance(const Surfel* s, Real cosine, Mask* total) {
  const Real3 r = clearReflectance(s, cosine, total);
#if HAS(IRIDESCENCE)
  return choose3(*total, r, belowFilm(&s->film, cosine, s->specularF0, r));
#else
  return r;
#endif
}

INLINE Facets facetsOf(const Surfel* s) {
  Facets facets = facetsAbout(s->n, s->roughness);
#if HAS(ANISOTROPY)
  facets.tangent = s->grain;
  facets.along = facets.alpha + (1.0f - facets.alpha) * s->stretch;
#endif
  return facets;
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

/// What of light that goes one way or the other the layers over the surface leave to it.
INLINE Real belowLayers(const Surfel* s, Real cosO, Real cosI) {
  Real kept = (Real)(1.0f);
#if HAS(SHEEN)
  kept = belowSheen(&s->sheen, sheenAlbedoBetween(&s->sheen, cosO, cosI));
#endif
#if HAS(CLEARCOAT)
  kept *= 1.0f - s->coat.reflectance;
#endif
  return kept;
}

/// f(w_i, w_o), 1/sr, without impulses and layers; both directions on the side of n. light: LIGHT_…, since what glossy
/// surfaces reflect of surfaces that glow and of the sky is in their impulses.
INLINE Real3 baseScattering(const RenderConstants* constants, const Surfel* s, Real3 w_o, Real3 w_i, uint light) {
  const Real cosO = dot3(s->n, w_o);
  const Real dielectric = 1.0f - s->metallic;
  const Real3 diffuse = scale3(1.0f - s->transmission, scale3((Real)(1.0f / PI), s->baseColor));
  const Mask smooth = isSmooth(constants, s);
  Real3 f = scale3(dielectric, diffuse);
#if HAS(MICROFACET)
  if (some(!smooth)) {
    const Real3 h = normalize3(add3(w_i, w_o));
    const Real cosD = clampUnit(dot3(w_o, h));
    const Facets facets = facetsOf(s);
    Real lobe = facetLobe(&facets, w_o, w_i, h);
#if HAS(GLOSS) && (HAS(SURFACE_LIGHTS) || HAS(SKY_LIGHTS))
    if (light == LIGHT_SURFACE || light == LIGHT_SKY) lobe = isGlossy(constants, s) ? (Real)(0.0f) : lobe;
#endif
    const Real3 fresnel = facetReflectance(s, cosD);
    const Real largest = largestOfThree(fresnel.x, fresnel.y, fresnel.z);
    f = scale3(dielectric, add3(scale3(1.0f - largest, diffuse), scale3(lobe, fresnel)));
#if HAS(METAL)
    f = add3(f, scale3(lobe, scale3(s->metallic, metalReflectance(s, cosD))));
#endif
  }
#endif
  if (some(smooth)) {
    Mask total;
    const Real3 r = dielectricReflectance(s, cosO < 1.0f ? cosO : (Real)(1.0f), &total);
    const Real3 passing = real3(dielectric * (1.0f - r.x), dielectric * (1.0f - r.y), dielectric * (1.0f - r.z));
    f = choose3(smooth, mul3(passing, diffuse), f);
  }
  return f;
}

/// The same with the layers above.
INLINE Real3 finiteScattering(const RenderConstants* constants, const Surfel* s, Real3 w_o, Real3 w_i, uint light) {
  Real3 f = baseScattering(constants, s, w_o, w_i, light);
#if HAS(SHEEN) || HAS(CLEARCOAT)
  const Real3 h = normalize3(add3(w_i, w_o));
  const Real cosI = dot3(s->n, w_i);
#endif
#if HAS(SHEEN)
  if (some(s->sheen.largest > 0.0f)) {
    const Real cosO = dot3(s->n, w_o), albedo = sheenAlbedoBetween(&s->sheen, cosO, cosI);
    const Real fibres = sheenLobe(&s->sheen, cosO, cosI, dot3(s->n, h), albedo);
    f = add3(scale3(belowSheen(&s->sheen, albedo), f), scale3(fibres, s->sheen.color));
  }
#endif
#if HAS(CLEARCOAT)
  const Real coat = coatLobe(constants, &s->coat, w_o, w_i, h, cosI, light);
  f = add3(scale3(1.0f - s->coat.reflectance, f), real3(coat, coat, coat));
#endif
  return f;
}

#if HAS(AMBIENT)
/// What surfels send back of radiance 1 from all sides: Lambert's part, and where they are rough their metal. What
/// impulses reflect, of smooth ones and with GLOSS of all, is not in it.
INLINE Real3 baseAmbient(const RenderConstants* constants, const Surfel* s, Real3 w_o) {
  const Mask smooth = isSmooth(constants, s);
  const Real matte = (1.0f - s->metallic) * (1.0f - s->transmission);
#if HAS(GLOSS)
  const Mask reflects = smooth | isGlossy(constants, s);
#else
  const Mask reflects = smooth;
#endif
  Real3 share = scale3(reflects ? matte : matte + s->metallic, s->baseColor);
  if (some(reflects)) {
    const Real cosO = dot3(s->n, w_o);
    Mask total;
    const Real3 r = dielectricReflectance(s, cosO < 1.0f ? cosO : (Real)(1.0f), &total);
    share = choose3(reflects, mul3(real3(1.0f - r.x, 1.0f - r.y, 1.0f - r.z), share), share);
  }
  return share;
}

/// The same with the layers above.
INLINE Real3 ambientReflectance(const RenderConstants* constants, const Surfel* s, Real3 w_o) {
  Real3 share = baseAmbient(constants, s, w_o);
#if HAS(SHEEN)
  const Real cosO = dot3(s->n, w_o), albedo = sheenAlbedo(&s->sheen, cosO);
  const Real scattered = albedo < 1.0f ? albedo : (Real)(1.0f);
  share = add3(scale3(belowSheen(&s->sheen, albedo), share), scale3(scattered, s->sheen.color));
#endif
#if HAS(CLEARCOAT)
  const Real coat = coatReflects(constants, &s->coat) ? (Real)(0.0f) : s->coat.reflectance;
  share = add3(scale3(1.0f - s->coat.reflectance, share), real3(coat, coat, coat));
#endif
#if HAS(UNLIT)
  return choose3((s->flags & MATERIAL_UNLIT) != 0, same3((float3)(0.0f)), share);
#else
  return share;
#endif
}
#endif

/// A direction with an RGB magnitude for each lane; magnitude 0: there is none.
typedef struct {
  Real3 w_i;
  Real3 magnitude;
  Mask straight;  // goes on as the ray came; known with STRAIGHT
} Impulse;

#if HAS(MIRROR) || HAS(REFRACTION)
/// n: of the surface, or of a microfacet.
INLINE Impulse mirrorImpulse(const RenderConstants* constants, const Surfel* s, Real3 n, Real3 w_o, Real cosine,
                             Real3 reflectance, Mask total) {
  Impulse impulse;
  const Mask inside = total & ((s->flags & MATERIAL_VOLUME) != 0) & (s->transmission > 0.0f);
  const Real3 aboutN = sub3(scale3(2.0f * cosine, n), w_o);
  const Real3 aboutG = sub3(scale3(2.0f * dot3(s->n_g, w_o), s->n_g), w_o);
  impulse.w_i = normalize3(choose3(dot3(s->n_g, aboutN) > 0.0f, aboutN, aboutG));
  Real3 magnitude = scale3(1.0f - s->metallic, reflectance);
#if HAS(METAL)
  magnitude = add3(magnitude, scale3(s->metallic, metalReflectance(s, cosine)));
#endif
  Mask reflects = isSmooth(constants, s) | inside;
#if HAS(GLOSS)
  const Mask glossy = isGlossy(constants, s);
  const Facets facets = facetsOf(s);
  impulse.w_i = choose3(glossy, aboutN, impulse.w_i);
  magnitude = choose3(glossy, scale3(reflectionWeight(&facets, s->n_g, w_o, aboutN), magnitude), magnitude);
  reflects = reflects | glossy;
#endif
  impulse.magnitude = choose3(reflects, scale3(s->alpha, magnitude), same3((float3)(0.0f)));
  impulse.straight = (Mask)(0);
  return impulse;
}
#endif

#if HAS(TRANSMISSION)
#if HAS(REFRACTION)
/// Refracted direction about n, or 0 at total reflection.
INLINE Real3 refracted(Real3 n, Real3 w_o, Real eta) {
  const Real along = dot3(n, w_o);
  const Real cosine = along < 1.0f ? along : (Real)(1.0f);
  const Real sin2 = 1.0f - cosine * cosine;
  const Real sin2T = (sin2 > 0.0f ? sin2 : (Real)(0.0f)) / (eta * eta);
  const Real3 w_t = normalize3(sub3(scale3(cosine / eta - sqrt(1.0f - sin2T), n), over3(w_o, eta)));
  return choose3(sin2T < 1.0f, w_t, same3((float3)(0.0f)));
}
#endif

INLINE Impulse transmissionImpulse(const RenderConstants* constants, const Surfel* s, Real3 n, Real3 w_o,
                                   Real3 reflectance) {
  Impulse impulse;
  const Real3 zero = same3((float3)(0.0f));
  impulse.w_i = minus3(w_o);
  impulse.straight = s->transmission > 0.0f;
  const Real passing = s->alpha * (1.0f - s->metallic) * s->transmission;
  impulse.magnitude = mul3(scale3(passing, s->baseColor),
                           real3(1.0f - reflectance.x, 1.0f - reflectance.y, 1.0f - reflectance.z));
#if HAS(REFRACTION)
  const Real eta = interfaceEta(s);
  const Mask volume = (s->flags & MATERIAL_VOLUME) != 0;
  const Mask bends = volume & (s->ior != 0.0f) & (eta != 1.0f);
  Real3 w_t = refracted(n, w_o, eta);
#if HAS(GLOSS)
  // Behind a microfacet; what does not come out behind the surface is lost. Smith's G1 of the way there.
  const Mask glossy = isGlossy(constants, s);
  w_t = choose3((dot3(s->n_g, w_t) < 0.0f) | glossy, w_t, refracted(s->n_g, w_o, eta));
  const Facets facets = facetsOf(s);
  const Real kept = dot3(s->n, w_t) < 0.0f ? 2.0f / (1.0f + smithRoot(&facets, w_t)) : (Real)(0.0f);
  impulse.magnitude = choose3(glossy & bends, scale3(kept, impulse.magnitude), impulse.magnitude);
#else
  w_t = choose3(dot3(s->n_g, w_t) < 0.0f, w_t, refracted(s->n_g, w_o, eta));
#endif
  impulse.w_i = choose3(bends, w_t, impulse.w_i);
  impulse.straight = impulse.straight & !bends;
  const Mask stopped = (volume & (s->ior == 0.0f)) | (bends & !(dot3(s->n_g, w_t) < 0.0f));
  impulse.magnitude = choose3(stopped, zero, impulse.magnitude);
#endif
  impulse.w_i = choose3(s->transmission > 0.0f, impulse.w_i, minus3(w_o));
  impulse.magnitude = choose3(s->transmission > 0.0f, impulse.magnitude, zero);
  return impulse;
}
#endif

#if HAS(SHEEN) || HAS(CLEARCOAT)
/// What layers leave of the reflection and the transmission below them, and the coat's own reflection: with the one
/// below it where both go the same way, and where a third impulse leaves no room for two.
INLINE void addLayers(const RenderConstants* constants, const Surfel* s, Real3 w_o, Square facets, Impulse* reflection,
                      Impulse* transmission) {
  const Real cosO = dot3(s->n, w_o);
  reflection->magnitude = scale3(belowLayers(s, cosO, dot3(s->n, reflection->w_i)), reflection->magnitude);
  transmission->magnitude = scale3(belowLayers(s, cosO, cosO), transmission->magnitude);
#if HAS(CLEARCOAT) && HAS(MIRROR)
  Real magnitude;
  const Real3 w_i = coatDirection(constants, &s->coat, s->n_g, w_o, facets, &magnitude);
  const Real carried = s->alpha * magnitude;
  const Real3 coat = real3(carried, carried, carried);
  const Mask both = (carried > 0.0f) & anyPositive(reflection->magnitude);
  const Mask alike = isSmooth(constants, s) & isSmoothCoat(constants, &s->coat) & (s->n.x == s->coat.n.x) &
                     (s->n.y == s->coat.n.y) & (s->n.z == s->coat.n.z);
  const Mask full = (s->alpha < 1.0f) | anyPositive(transmission->magnitude);
  const Mask apart = both & !alike & !full;
  transmission->w_i = choose3(apart, reflection->w_i, transmission->w_i);
  transmission->magnitude = choose3(apart, reflection->magnitude, transmission->magnitude);
  transmission->straight = transmission->straight & !apart;
  reflection->w_i = choose3((carried > 0.0f) & (apart | !both), w_i, reflection->w_i);
  reflection->magnitude = choose3(apart, coat, add3(reflection->magnitude, coat));
#endif
}
#endif

/// The impulses of surfels, at most two each, in their fixed order.
/// `facets`: with GLOSS which of the microfacets that w_o sees.
INLINE void impulsesAt(const RenderConstants* constants, const Surfel* s, Real3 w_o, Square facets, Impulse* first,
                       Impulse* second) {
  const Real3 zero = same3((float3)(0.0f)), back = minus3(w_o);
  first->magnitude = second->magnitude = zero;
  first->w_i = second->w_i = back;
  first->straight = second->straight = (Mask)(0);
#if HAS(IMPULSES)
#if HAS(MIRROR) || HAS(REFRACTION) || HAS(TRANSMISSION)
  Real3 n = s->n;
  Mask asked = isSmooth(constants, s) | (s->transmission > 0.0f);
#if HAS(GLOSS)
  const Mask glossy = isGlossy(constants, s);
  const Facets rough = facetsOf(s);
  n = choose3(glossy, visibleNormal(&rough, w_o, facets), n);
  asked = asked | glossy;
#endif
  if (some(asked)) {
    const Real along = dot3(n, w_o);
    const Real cosine = along < 1.0f ? along : (Real)(1.0f);
    Mask total;
    Real3 reflectance = dielectricReflectance(s, cosine, &total);
#if HAS(GLOSS)
    // As its highlight has it (finiteScattering).
    const Mask opaque = glossy & !(s->transmission > 0.0f);
    reflectance = choose3(opaque, facetReflectance(s, cosine), reflectance);
    total = total & !opaque;
#endif
#if HAS(MIRROR) || HAS(REFRACTION)
    *first = mirrorImpulse(constants, s, n, w_o, cosine, reflectance, total);
#endif
#if HAS(TRANSMISSION)
    if (some(s->transmission > 0.0f)) *second = transmissionImpulse(constants, s, n, w_o, reflectance);
#endif
  }
#if HAS(SHEEN) || HAS(CLEARCOAT)
  addLayers(constants, s, w_o, facets, first, second);
#endif
#endif
  const Real straight = 1.0f - s->alpha;
  const Real3 straight3 = real3(straight, straight, straight);
#if HAS(ALPHA_BLEND)
  const Mask thin = s->alpha < 1.0f;
  if (some(thin)) {
    // Three directions would be needed where it bends: the reflection is left out.
    const Mask bends = ((s->flags & MATERIAL_VOLUME) != 0) & anyPositive(second->magnitude);
    const Impulse reflection = *first;
    const Real3 through = choose3(bends, straight3, add3(second->magnitude, straight3));
    first->w_i = choose3(thin, back, reflection.w_i);
    first->magnitude = choose3(thin, through, reflection.magnitude);
    second->w_i = choose3(thin & !bends, reflection.w_i, second->w_i);
    second->magnitude = choose3(thin & !bends, reflection.magnitude, second->magnitude);
    first->straight = thin | reflection.straight;
    second->straight = second->straight & !thin;
  }
#endif
#if HAS(UNLIT)
  const Mask unlit = (s->flags & MATERIAL_UNLIT) != 0;
  first->w_i = choose3(unlit, back, first->w_i);
  first->magnitude = choose3(unlit, straight3, first->magnitude);
  second->w_i = choose3(unlit, back, second->w_i);
  second->magnitude = choose3(unlit, zero, second->magnitude);
  first->straight = first->straight | unlit;
#endif
#endif
}
