// Scattering at surfels: the finite part (Lambert and the glTF microfacet lobe) for direct light, and the impulses
// (mirror reflection, refraction, straight transmission); then the layers over them. Formulas:
// host/reference/README.md.
#include "lib/surface/reflectance.cl"

INLINE Facets facetsOf(const Surfel* s) {
  Facets facets = facetsAbout(s->n, s->roughness);
#if HAS(ANISOTROPY)
  facets.tangent = s->grain;
  facets.along = facets.alpha + (1.0f - facets.alpha) * s->stretch;
#endif
  return facets;
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

/// What a smooth surface does not reflect of light seen at that angle.
INLINE Real3 enteringShare(const Surfel* s, Real cosine) {
  Mask3 total;
  const Real3 r = dielectricReflectance(s, cosine < 1.0f ? cosine : (Real)(1.0f), &total);
  return real3(1.0f - r.x, 1.0f - r.y, 1.0f - r.z);
}

/// f(w_i, w_o), 1/sr, without impulses and layers; both directions on the side of n. light: LIGHT_…, since what glossy
/// surfaces reflect of surfaces that glow and of the sky is in their impulses.
INLINE Real3 baseScattering(const RenderConstants* constants, const Surfel* s, Real3 w_o, Real3 w_i, uint light) {
  const Real cosO = dot3(s->n, w_o);
  const Real dielectric = 1.0f - s->metallic;
  Real matte = 1.0f - s->transmission;
#if HAS(DIFFUSE_TRANSMISSION)
  matte *= 1.0f - s->diffuseTransmission;
#endif
  const Real3 diffuse = scale3(matte, scale3((Real)(1.0f / PI), s->baseColor));
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
  if (some(smooth)) f = choose3(smooth, mul3(scale3(dielectric, enteringShare(s, cosO)), diffuse), f);
  return f;
}

#if HAS(DIFFUSE_TRANSMISSION)
/// The same of light from the other side, with the layers above: Lambert's part. On its way it is reflected as light
/// from where its mirror image is, on the side of n.
INLINE Real3 transmittedScattering(const RenderConstants* constants, const Surfel* s, Real3 w_o, Real3 w_i) {
  const Real cosO = dot3(s->n, w_o), cosI = -dot3(s->n, w_i);
  const Real3 image = add3(w_i, scale3(2.0f * cosI, s->n));
  const Real3 fresnel = facetReflectance(s, clampUnit(dot3(w_o, normalize3(add3(image, w_o)))));
  const Real below = 1.0f - largestOfThree(fresnel.x, fresnel.y, fresnel.z);
  const Mask smooth = isSmooth(constants, s);
  Real3 kept = real3(below, below, below);
  if (some(smooth)) kept = choose3(smooth, enteringShare(s, cosO), kept);
  const Real share = (1.0f - s->metallic) * (1.0f - s->transmission) * s->diffuseTransmission * (1.0f / PI);
  return scale3(belowLayers(s, cosO, cosI) * share, mul3(kept, s->diffuseTransmissionColor));
}
#endif

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
#if HAS(DIFFUSE_TRANSMISSION)
  const Real through = s->diffuseTransmission;
  const Real3 both = add3(scale3(1.0f - through, s->baseColor), scale3(through, s->diffuseTransmissionColor));
  const Real3 metal = scale3(reflects ? (Real)(0.0f) : s->metallic, s->baseColor);
  share = choose3(through > 0.0f, add3(scale3(matte, both), metal), share);
#endif
  if (some(reflects)) share = choose3(reflects, mul3(enteringShare(s, dot3(s->n, w_o)), share), share);
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
#if HAS(DISPERSION)
  Mask splits;    // each colour by itself: w_i is the way of red
  Real3 ways[2];  // of green and blue
  Real eta;       // of w_i through the surface: n_t/n_i
#endif
} Impulse;

INLINE Impulse noImpulse(Real3 w_i) {
  Impulse impulse;
  impulse.w_i = w_i;
  impulse.magnitude = same3((float3)(0.0f));
  impulse.straight = (Mask)(0);
#if HAS(DISPERSION)
  impulse.splits = (Mask)(0);
  impulse.ways[0] = impulse.ways[1] = w_i;
  impulse.eta = (Real)(1.0f);
#endif
  return impulse;
}

#if HAS(MIRROR) || HAS(REFRACTION)
/// n: of the surface, or of a microfacet.
INLINE Impulse mirrorImpulse(const RenderConstants* constants, const Surfel* s, Real3 n, Real3 w_o, Real cosine,
                             Real3 reflectance, Mask3 total) {
  Impulse impulse = noImpulse(w_o);
  const Mask inside = ((s->flags & MATERIAL_VOLUME) != 0) & (s->transmission > 0.0f);
  const Real3 aboutN = sub3(scale3(2.0f * cosine, n), w_o);
  const Real3 aboutG = sub3(scale3(2.0f * dot3(s->n_g, w_o), s->n_g), w_o);
  impulse.w_i = normalize3(choose3(dot3(s->n_g, aboutN) > 0.0f, aboutN, aboutG));
  Real3 magnitude = scale3(1.0f - s->metallic, reflectance);
#if HAS(METAL)
  magnitude = add3(magnitude, scale3(s->metallic, metalReflectance(s, cosine)));
#endif
  Mask reflects = isSmooth(constants, s);
#if HAS(GLOSS)
  const Mask glossy = isGlossy(constants, s);
  const Facets facets = facetsOf(s);
  impulse.w_i = choose3(glossy, aboutN, impulse.w_i);
  magnitude = choose3(glossy, scale3(reflectionWeight(&facets, s->n_g, w_o, aboutN), magnitude), magnitude);
  reflects = reflects | glossy;
#endif
  const Mask3 reflected = {reflects | (total.x & inside), reflects | (total.y & inside), reflects | (total.z & inside)};
  impulse.magnitude = chooseEach3(reflected, scale3(s->alpha, magnitude), impulse.magnitude);
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

/// Where light goes through the surface, or through its facet of normal n: not behind it where it is stopped. kept:
/// the share that comes out behind a glossy one, Smith's G1 of the way there.
INLINE Real3 bentWay(const RenderConstants* constants, const Surfel* s, Real3 n, Real3 w_o, Real eta, Real* kept) {
  const Real3 w_t = refracted(n, w_o, eta), aboutG = refracted(s->n_g, w_o, eta);
  const Mask leaves = dot3(s->n_g, w_t) < 0.0f;
  *kept = (Real)(1.0f);
#if HAS(GLOSS)
  const Mask glossy = isGlossy(constants, s);
  const Facets facets = facetsOf(s);
  const Real visible = dot3(s->n, w_t) < 0.0f ? 2.0f / (1.0f + smithRoot(&facets, w_t)) : (Real)(0.0f);
  *kept = glossy ? visible : *kept;
  return choose3(leaves | glossy, w_t, aboutG);
#else
  return choose3(leaves, w_t, aboutG);
#endif
}

#if HAS(DISPERSION)
/// The same of each colour, where they split; `magnitude`: of the impulse, of all of them.
INLINE void splitImpulse(const RenderConstants* constants, const Surfel* s, Real3 n, Real3 w_o, Real3 magnitude,
                         Impulse* impulse) {
  const Mask splits = impulse->splits;
  Real3 ways[3];
  Real kept[3], eta = (Real)(1.0f);
  for (uint c = 0; c < 3; ++c) {
    const Real own = interfaceEta(s, channelIndex(s->ior, s->halfSpread, c));
    ways[c] = bentWay(constants, s, n, w_o, own, kept + c);
    kept[c] = dot3(s->n_g, ways[c]) < 0.0f ? kept[c] : (Real)(0.0f);
    eta = c == 0 ? own : eta;
  }
  impulse->w_i = choose3(splits, ways[0], impulse->w_i);
  impulse->ways[0] = ways[1], impulse->ways[1] = ways[2];
  impulse->eta = splits ? eta : impulse->eta;
  impulse->magnitude = choose3(splits, mul3(real3(kept[0], kept[1], kept[2]), magnitude), impulse->magnitude);
}
#endif
#endif

INLINE Impulse transmissionImpulse(const RenderConstants* constants, const Surfel* s, Real3 n, Real3 w_o,
                                   Real3 reflectance) {
  Impulse impulse = noImpulse(minus3(w_o));
  const Real3 zero = same3((float3)(0.0f));
  impulse.straight = s->transmission > 0.0f;
  const Real passing = s->alpha * (1.0f - s->metallic) * s->transmission;
  impulse.magnitude = mul3(scale3(passing, s->baseColor),
                           real3(1.0f - reflectance.x, 1.0f - reflectance.y, 1.0f - reflectance.z));
#if HAS(REFRACTION)
  const Real eta = interfaceEta(s, s->ior);
  const Mask volume = (s->flags & MATERIAL_VOLUME) != 0;
  const Mask bends = volume & (s->ior != 0.0f) & (eta != 1.0f);
  Real kept;
  const Real3 w_t = bentWay(constants, s, n, w_o, eta, &kept), whole = impulse.magnitude;
  impulse.magnitude = choose3(bends, scale3(kept, whole), whole);
  impulse.w_i = choose3(bends, w_t, impulse.w_i);
  impulse.straight = impulse.straight & !bends;
  const Mask stopped = (volume & (s->ior == 0.0f)) | (bends & !(dot3(s->n_g, w_t) < 0.0f));
  impulse.magnitude = choose3(stopped, zero, impulse.magnitude);
#if HAS(DISPERSION)
  impulse.eta = eta;
  impulse.splits = bends & (s->halfSpread > 0.0f);
  if (some(impulse.splits)) splitImpulse(constants, s, n, w_o, whole, &impulse);
#endif
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
#if HAS(DISPERSION)
  transmission->splits = transmission->splits & !apart;
#endif
  reflection->w_i = choose3((carried > 0.0f) & (apart | !both), w_i, reflection->w_i);
  reflection->magnitude = choose3(apart, coat, add3(reflection->magnitude, coat));
#endif
}
#endif

/// The impulses of surfels, at most two each, in their fixed order.
/// `facets`: with GLOSS which of the microfacets that w_o sees.
INLINE void impulsesAt(const RenderConstants* constants, const Surfel* s, Real3 w_o, Square facets, Impulse* first,
                       Impulse* second) {
  const Real3 back = minus3(w_o);
  *first = *second = noImpulse(back);
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
    Mask3 total;
    Real3 reflectance = dielectricReflectance(s, cosine, &total);
#if HAS(GLOSS)
    // As its highlight has it (finiteScattering).
    const Mask opaque = glossy & !(s->transmission > 0.0f);
    reflectance = choose3(opaque, facetReflectance(s, cosine), reflectance);
    total.x = total.x & !opaque, total.y = total.y & !opaque, total.z = total.z & !opaque;
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
#if HAS(DISPERSION)
    second->splits = second->splits & (bends | !thin);
#endif
  }
#endif
#if HAS(UNLIT)
  const Mask unlit = (s->flags & MATERIAL_UNLIT) != 0;
  first->w_i = choose3(unlit, back, first->w_i);
  first->magnitude = choose3(unlit, straight3, first->magnitude);
  second->w_i = choose3(unlit, back, second->w_i);
  second->magnitude = choose3(unlit, same3((float3)(0.0f)), second->magnitude);
  first->straight = first->straight | unlit;
#endif
#endif
}
