// shade: what happens at each hit, LANES of them for each work item. Reads rays and hits of a segment; writes the
// entry's radiance (emission, background, light that need not wait), its candidates for the first group of lights, its
// impulse candidates and their flags. What is written for an entry without its flag means nothing. shade_light: the
// candidates of a further group, a launch for each, so that memory does not grow with the lights; lights are in groups
// (host/analysis/light_groups.h), because it takes longer to find what lies at a hit than what a light does there.
// add_light: the light of a candidate that needs no shadow ray but had to wait for those of another, so that sums keep
// the order of the lights.
#include "lib/arrivals.cl"
#include "lib/surface/absorption.cl"
#include "lib/surface/background.cl"
#include "lib/surface/bsdf.cl"
#include "lib/surface/choice.cl"
#include "lib/surface/shadow_ray.cl"
#include "lib/entry_flags.cl"
#include "lib/impulses.cl"
#include "lib/surface/emitters.cl"
#include "lib/surface/sky.cl"
#include "lib/sample_names.cl"

// Dimensions of squares, behind those of pixel, lens and chosen impulses: of the microfacets at each bounce, then of
// each light at each bounce.
#define SQUARE_DIMENSIONS 8u
#define GLOSS_DIMENSION 0x10000u
#define LIGHT_DIMENSION 0x40000u
#define CHOICE_DIMENSION 3u  // of the eight: where a second square begins, whose numbers no sampler takes for the first
#define ROUNDS 8192u         // more than bounces and passages straight on together

#if HAS(LIGHT_SIZE) || HAS(SURFACE_LIGHTS) || HAS(SKY_LIGHTS)
#define LIGHT_NAMES (&names)
#else
#define LIGHT_NAMES 0
#endif

#if HAS(LIGHTS)
/// Direct light from one light where `lit`: a candidate if it has to wait, else added to `radiance` at once. names: of
/// the entries, where the light is sampled. Returns ENTRY_SHADOW for a candidate, else 0.
INLINE Natural directLight(const SceneView* scene, const RenderConstants* constants, const Surfel* s, Real3 w_o,
                           Mask lit, uint lightIndex, int waits, Real3 attenuation, uint i, uint capacity,
                           __global float* shadows, Real3* radiance, const SampleNames* names, uint bounce) {
#if HAS(UNLIT)
  lit = lit & ((s->flags & MATERIAL_UNLIT) == 0);
#endif
  __global const DeviceLight* light = scene->lights + lightIndex;
  const Surfel* side = s;  // that the light comes to
#if HAS(DIFFUSE_TRANSMISSION)
  Surfel other;
  if (light->behind) {
    lit = lit & (s->diffuseTransmission > 0.0f);
    if (!some(lit)) return (Natural)(0);
    other = turnedOver(s);
    side = &other;
  }
#endif
  Illumination arriving = illuminationAt(light, s->position);
#if HAS(LIGHT_SIZE) || HAS(SURFACE_LIGHTS) || HAS(SKY_LIGHTS)
  const uint dimension = LIGHT_DIMENSION + SQUARE_DIMENSIONS * (bounce + ROUNDS * light->index);
  const Square square = sampleSquares(constants, names, dimension);
#if HAS(LIGHT_SIZE)
  arriving = spread(light, constants, &arriving, square);
#endif
#if HAS(SURFACE_LIGHTS)
  if (light->kind == LIGHT_SURFACE) {
    const Square choice = sampleSquares(constants, names, dimension + CHOICE_DIMENSION);
    arriving = emitterIllumination(scene, constants, side, light->emitters, choice.u, square);
  }
#endif
#if HAS(SKY_LIGHTS)
  if (light->kind == LIGHT_SKY) arriving = skyIllumination(scene, constants, side, square);
#endif
#endif
  const Real cosine = dot3(side->n, arriving.w_i);
  lit = lit & (cosine > 0.0f) & isLitSide(side, arriving.w_i) & notDark(arriving.biradiance);
  if (!some(lit)) return (Natural)(0);
#if HAS(DIFFUSE_TRANSMISSION)
  const Real3 f = light->behind ? transmittedScattering(constants, s, w_o, arriving.w_i)
                                : finiteScattering(constants, s, w_o, arriving.w_i, light->kind);
#else
  const Real3 f = finiteScattering(constants, s, w_o, arriving.w_i, light->kind);
#endif
  const Real3 contribution = scale3(cosine, mul3(scale3(s->alpha, f), arriving.biradiance));
  lit = lit & notDark(contribution);
  const Real3 carried = mul3(contribution, attenuation);
#if HAS(SHADOWS)
  if (waits) {
    if (light->castsShadows) {
      const ShadowRay ray = shadowRayAlong(constants, side, arriving.w_i, arriving.distance);
      storeReal3(shadows, capacity, SHADOW_O, i, ray.o);
      storeReal3(shadows, capacity, SHADOW_D, i, ray.d);
      STORE(ray.length, shadows + (size_t)SHADOW_LENGTH * capacity + i);
    }
    storeReal3(shadows, capacity, SHADOW_CONTRIBUTION, i, carried);
    return lit ? (Natural)(ENTRY_SHADOW) : (Natural)(0);
  }
#endif
  *radiance = choose3(lit, add3(*radiance, carried), *radiance);
  return (Natural)(0);
}
#endif

#if HAS(LIGHTS)
/// The lights of a launch.
typedef struct {
  uint first, end;
  uint waiting;  // the last of them, which have a set of candidates and of flags each
} LightGroup;

/// Of all sets but the first, whose flags hold more.
INLINE void clearFlags(const LightGroup* group, uint i, uint capacity, __global uchar* flags) {
  for (uint set = 1; set < group->waiting; ++set) storeFlags((Natural)(0), flags + (size_t)set * capacity + i);
}

/// directLight of each light of a group. Returns the flags of the first set, and stores those of the others.
INLINE Natural directLights(const SceneView* scene, const RenderConstants* constants, const Surfel* s, Real3 w_o,
                            Mask lit, const LightGroup* group, Real3 attenuation, uint i, uint capacity,
                            __global float* shadows, __global uchar* flags, Real3* radiance, const SampleNames* names,
                            uint bounce) {
  Natural first = (Natural)(0);
  for (uint light = group->first; light < group->end; ++light) {
    const uint left = group->end - light, set = left < group->waiting ? group->waiting - left : 0;
    const Natural found = directLight(scene, constants, s, w_o, lit, light, left <= group->waiting, attenuation, i,
                                      capacity, shadows + (size_t)set * SHADOW_PLANES * capacity, radiance, names,
                                      bounce);
    if (set == 0)
      first = first | found;
    else
      storeFlags(found, flags + (size_t)set * capacity + i);
  }
  return first;
}
#endif

#if HAS(IMPULSES)
/// Where the limits let no impulse go on: `last` of the bounces, and what arrivals.cl says of rays that go straight on.
INLINE Mask isEnded(const Arrivals* a, const Impulse* impulse, Real share, Mask last) {
#if HAS(STRAIGHT)
  return impulse->straight ? !a->goesOn : !a->bounces | (a->hasBranched & !(share >= BRANCH_SHARE));
#else
  return last;
#endif
}

#if HAS(TEXTURE_LEVELS)
/// The cone of an impulse along w_i, the first of its planes at `cones`: what goes straight on keeps its ray's.
INLINE void storeCone(const RenderConstants* constants, const Arrivals* a, const Surfel* s, Real3 w_i, Real eta,
                      Mask straight, __global float* cones, uint capacity) {
  Cone cone = bentCone(footprintOf(constants, a).width, a->cone.spread, s->bend, -dot3(s->n, a->d), s->n, w_i, eta);
#if HAS(STRAIGHT)
  cone.width = straight ? a->cone.width : cone.width;
  cone.spread = straight ? a->cone.spread : cone.spread;
#endif
  STORE(cone.width, cones + (size_t)CONE_WIDTH * capacity);
  STORE(cone.spread, cones + (size_t)CONE_SPREAD * capacity);
}
#endif

#if HAS(DISPERSION) && HAS(BOTH_BRANCHES)
/// Stores the ways of green and blue behind both sets of planes, and returns the flags of the impulse that splits.
INLINE Natural storeSplit(const RenderConstants* constants, const Arrivals* a, const Surfel* s, const Impulse* impulse,
                          Mask sent, Natural flags, uint i, uint capacity, __global float* impulses) {
  const Mask splits = sent & impulse->splits;
  if (!some(splits)) return flags;
  for (uint c = 0; c < 2; ++c) {
    const uint plane = SPLIT_BASE + c * SPLIT_STRIDE;
    storeReal3(impulses, capacity, plane + SPLIT_D, i, impulse->ways[c]);
#if HAS(TEXTURE_LEVELS)
    storeCone(constants, a, s, impulse->ways[c], interfaceEta(s, channelIndex(s->ior, s->halfSpread, c + 1)),
              splits & 0, impulses + (size_t)(plane + SPLIT_PLANES) * capacity + i, capacity);
#endif
  }
  return splits ? (Natural)(ENTRY_SPLIT1) : flags;
}
#endif

/// Stores impulse k of the entries from i, where it carries anything, in the k-th set of planes, and returns its flags.
/// Of what is not followed it stores the throughput alone, as layout.h says.
INLINE Natural storeImpulse(const RenderConstants* constants, const Arrivals* a, const Surfel* s,
                            const Impulse* impulse, Real3 throughput, Mask last, uint k, uint i, uint capacity,
                            __global float* impulses) {
  const Real3 carried = mul3(throughput, impulse->magnitude);
  const Mask carries = a->hit & anyPositive(carried) & isFinite3(impulse->w_i);
  const Real share = largestOfThree(carried.x, carried.y, carried.z);
  Mask ended = carries & isEnded(a, impulse, share, last);
  Real first = ended ? share : carried.x;
#if HAS(CUTOFF)
  const Mask weak = carries & !ended & (share <= constants->cutoff);
  first = weak ? -share : first;
  ended = ended | weak;
#endif
  const Mask sent = carries & !ended;
  Natural flags = ended ? (Natural)(ENTRY_ENDED0 << k) : (Natural)(0);
  flags = sent ? (Natural)(ENTRY_IMPULSE0 << k) : flags;
#if HAS(STRAIGHT)
  flags = carries & impulse->straight ? flags | (ENTRY_STRAIGHT0 << k) : flags;
#endif
  const uint base = k * IMPULSE_STRIDE;
  if (some(carries)) STORE(first, impulses + (size_t)(base + IMPULSE_THROUGHPUT) * capacity + i);
  if (!some(sent)) return flags;
  Real3 origin = offsetOrigin(constants, s, impulse->w_i);
#if HAS(STRAIGHT)
  origin = choose3(impulse->straight, a->o, origin);
#endif
  storeReal3(impulses, capacity, base + IMPULSE_O, i, origin);
  storeReal3(impulses, capacity, base + IMPULSE_D, i, impulse->w_i);
  STORE(carried.y, impulses + (size_t)(base + IMPULSE_THROUGHPUT + 1) * capacity + i);
  STORE(carried.z, impulses + (size_t)(base + IMPULSE_THROUGHPUT + 2) * capacity + i);
#if HAS(TEXTURE_LEVELS)
#if HAS(DISPERSION)
  const Real eta = impulse->eta;
#else
  const Real eta = interfaceEta(s, s->ior);
#endif
  storeCone(constants, a, s, impulse->w_i, eta, impulse->straight,
            impulses + (size_t)(base + IMPULSE_PLANES) * capacity + i, capacity);
#endif
#if HAS(DISPERSION) && HAS(BOTH_BRANCHES)
  if (k == 1) flags = storeSplit(constants, a, s, impulse, sent, flags, i, capacity, impulses);
#endif
  return flags;
}

/// Radiance, or NaN where an impulse's magnitude is: that is not traced, but the film has to count the sample.
INLINE Real3 spoiltBy(Real3 radiance, Real3 magnitude) {
  const Mask clean = (magnitude.x == magnitude.x) & (magnitude.y == magnitude.y) & (magnitude.z == magnitude.z);
  return choose3(clean, radiance, magnitude);
}

#endif

#if HAS(STRAIGHT) && HAS(BOTH_BRANCHES)
/// ENTRY_BRANCHED where there are two impulses, one of them straight on.
INLINE Natural branching(const Impulse* first, const Impulse* second) {
  const Mask two = anyPositive(first->magnitude) & anyPositive(second->magnitude);
  return two & (first->straight | second->straight) ? (Natural)(ENTRY_BRANCHED) : (Natural)(0);
}
#endif

#if HAS(AOVS)
/// Auxiliary outputs of the pixels whose first sample is among the entries.
INLINE void storeAovs(const SceneView* scene, const SampleNames* names, const Arrivals* a, const Surfel* s, uint active,
                      uint pixels, __global float* aovs) {
  float own[AOV_PLANES][LANES];
  uint triangle[LANES];
  int hit[LANES];
  const Real values[AOV_PLANES] = {a->t, a->t, s->n.x, s->n.y, s->n.z, s->baseColor.x, s->baseColor.y, s->baseColor.z};
  for (uint n = 0; n < AOV_PLANES; ++n) STORE(values[n], own[n]);
  STORE(a->triangle, triangle);
  STORE(a->hit, hit);
  for (uint k = 0; k < active; ++k) {
    if (names->sample[k] != 0) continue;
    own[AOV_PRIMITIVE][k] = (float)scene->triangles[triangle[k]].primitive;
    for (uint n = 0; n < AOV_PLANES; ++n) {
      const float missed = n == AOV_DEPTH ? INFINITY : (n == AOV_PRIMITIVE ? -1.0f : 0.0f);
      aovs[(size_t)n * pixels + names->pixel[k]] = hit[k] ? own[n][k] : missed;
    }
  }
}
#endif

__kernel void shade(SCENE_PARAMS, const RenderConstants constants, const Batch batch, const uint first,
                    const uint count, const uint capacity, const uint bounce, const uint lastBounce,
                    const uint lightsEnd, const uint waiting, const uint width, const uint pixels,
                    __global const uint* pixelOrder, __global const float* rays, __global const float* hits,
                    __global float* entryRadiance,  // [RADIANCE_PLANES…][capacity] of the segment's entries
                    __global float* shadows,        // [waiting][SHADOW_PLANES][capacity]
                    __global float* impulses,       // [IMPULSES_OF_HIT IMPULSE_PLANES][capacity]
                    __global uchar* flags,          // [waiting][capacity] ENTRY_…
                    __global float* aovs) {         // [AOV_PLANES][pixels of the film], in the pixel order
  const uint i = (uint)get_global_id(0) * LANES;
  if (i >= count) return;
  const SceneView scene = SCENE_VIEW;
  const RenderConstants own = constants;
  const Batch ownBatch = batch;
  const Arrivals a = arrivalsOf(&own, &ownBatch, rays, hits, first, count, capacity, bounce, lastBounce, i);
#if HAS(AOVS) || HAS(ONE_IMPULSE) || HAS(LIGHT_SIZE) || HAS(SURFACE_LIGHTS) || HAS(SKY_LIGHTS) || HAS(GLOSS)
  const uint active = count - i < LANES ? count - i : LANES;
  const SampleNames names = sampleNames(&ownBatch, width, pixelOrder, rays, capacity, first + i, active);
#endif
  Natural found = (Natural)(0);
  Real3 radiance = same3((float3)(0.0f));
#if HAS(LIGHTS)
  const LightGroup group = {0, lightsEnd, waiting};
  clearFlags(&group, i, capacity, flags);
#endif
#if HAS(COVERAGE)
  const Mask clear = comeFromEye(rays, first + i, capacity, bounce) & ((Natural)(own.backgroundClear) == 1u) & !a.hit;
  STORE(clear ? (Real)(1.0f) : (Real)(0.0f), entryRadiance + (size_t)RADIANCE_TRANSMITTANCE * capacity + i);
#endif
#if HAS(BACKGROUND)
  radiance = backgroundAlong(&scene, &own, a.d, !a.hit);
#if HAS(COVERAGE)
  radiance = choose3(clear, same3((float3)(0.0f)), radiance);
#endif
#endif
  Surfel s;
  if (some(a.hit)) {
    s = surfelAt(&scene, a.triangle, a.o, a.d, a.t, a.b1, a.b2, footprintOf(&own, &a));
    const Real3 w_o = minus3(a.d);
    const Real3 attenuation = absorptionAlong(&s, distanceInside(&a));
#if HAS(AMBIENT)
    const Real3 ambient = scale3((Real)(own.ambient), ambientReflectance(&own, &s, w_o));
    Real3 shaded = mul3(scale3(s.alpha, add3(s.emission, ambient)), attenuation);
#else
    Real3 shaded = mul3(scale3(s.alpha, s.emission), attenuation);
#endif
#if HAS(UNLIT)
    shaded = choose3((s.flags & MATERIAL_UNLIT) != 0, mul3(scale3(s.alpha, s.baseColor), attenuation), shaded);
#endif
#if HAS(LIGHTS)
    found = found | directLights(&scene, &own, &s, w_o, a.hit, &group, attenuation, i, capacity, shadows, flags,
                                 &shaded, LIGHT_NAMES, bounce);
#endif
#if HAS(IMPULSES)
    Impulse one, two;
#if HAS(GLOSS)
    const Square facets = sampleSquares(&own, &names, GLOSS_DIMENSION + SQUARE_DIMENSIONS * bounce);
#else
    const Square facets = {(Real)(0.0f), (Real)(0.0f)};
#endif
    impulsesAt(&own, &s, w_o, facets, &one, &two);
    shaded = spoiltBy(shaded, add3(one.magnitude, two.magnitude));
    Real3 throughput = attenuation;
    if (bounce > 1) throughput = mul3(loadReal3(rays, capacity, RAY_THROUGHPUT, first + i), attenuation);
#if HAS(ONE_IMPULSE)
    const Real choice = randomNumber(&names, 16u + bounce, own.seed);
#if HAS(DISPERSION)
    keepCarried(&two, throughput);
    const Real ofFirst = luminance(one.magnitude) / (luminance(one.magnitude) + luminance(two.magnitude));
    chooseColor(&s, &two, (choice - ofFirst) / (1.0f - ofFirst));
#endif
    chooseOne(&one, &two, choice);
#endif
    const Mask last = (Natural)(bounce) >= (Natural)(lastBounce);
#if HAS(BOTH_BRANCHES)
#if HAS(STRAIGHT)
    found = found + branching(&one, &two);
#endif
    found = found + storeImpulse(&own, &a, &s, &one, throughput, last, 0, i, capacity, impulses);
    found = found + storeImpulse(&own, &a, &s, &two, throughput, last, 1, i, capacity, impulses);
#else
    const Impulse only = existing(&one, &two);
    found = found + storeImpulse(&own, &a, &s, &only, throughput, last, 0, i, capacity, impulses);
#endif
#endif
    radiance = choose3(a.hit, shaded, radiance);
  }
#if HAS(AOVS)
  if (bounce == 1 && aovs) storeAovs(&scene, &names, &a, &s, active, pixels, aovs);
#endif
  storeReal3(entryRadiance, capacity, 0, i, radiance);
  if (flags) storeFlags(found, flags + i);
}

#if HAS(LIGHTS)
__kernel void shade_light(SCENE_PARAMS, const RenderConstants constants, const Batch batch, const uint first,
                          const uint count, const uint capacity, const uint bounce, const uint lightsFirst,
                          const uint lightsEnd, const uint waiting, const uint width, __global const uint* pixelOrder,
                          __global const float* rays, __global const float* hits, __global float* entryRadiance,
                          __global float* shadows, __global uchar* flags) {
  const uint i = (uint)get_global_id(0) * LANES;
  if (i >= count) return;
  const SceneView scene = SCENE_VIEW;
  const RenderConstants own = constants;
  const Batch ownBatch = batch;
  const Arrivals a = arrivalsOf(&own, &ownBatch, rays, hits, first, count, capacity, bounce, 0, i);
  Natural found = (Natural)(0);
  const LightGroup group = {lightsFirst, lightsEnd, waiting};
  clearFlags(&group, i, capacity, flags);
  if (some(a.hit)) {
#if HAS(LIGHT_SIZE) || HAS(SURFACE_LIGHTS) || HAS(SKY_LIGHTS)
    const uint active = count - i < LANES ? count - i : LANES;
    const SampleNames names = sampleNames(&ownBatch, width, pixelOrder, rays, capacity, first + i, active);
#endif
    const Surfel s = surfelAt(&scene, a.triangle, a.o, a.d, a.t, a.b1, a.b2, footprintOf(&own, &a));
    const Real3 attenuation = absorptionAlong(&s, distanceInside(&a));
    Real3 radiance = loadReal3(entryRadiance, capacity, 0, i);
    found = directLights(&scene, &own, &s, minus3(a.d), a.hit, &group, attenuation, i, capacity, shadows, flags,
                         &radiance, LIGHT_NAMES, bounce);
    storeReal3(entryRadiance, capacity, 0, i, radiance);
  }
  if (flags) storeFlags((loadFlags(flags + i) & ~ENTRY_SHADOW) | found, flags + i);
}
#endif

__kernel void add_light(const uint count, const uint capacity, const uint set, __global const uchar* flags,
                        __global const float* shadows, __global float* entryRadiance) {
  const uint i = (uint)get_global_id(0) * LANES;
  if (i >= count) return;
  const Mask lit = (loadFlags(flags + (size_t)set * capacity + i) & ENTRY_SHADOW) != 0;
  if (!some(lit)) return;
  const Real3 before = loadReal3(entryRadiance, capacity, 0, i);
  const Real3 contribution = loadReal3(shadows, capacity, set * SHADOW_PLANES + SHADOW_CONTRIBUTION, i);
  storeReal3(entryRadiance, capacity, 0, i, choose3(lit, add3(before, contribution), before));
}
