// shade: what happens at each hit. Reads rays and hits of a segment; writes the entry's radiance (emission, background,
// light that needs no shadow ray), its shadow candidate for the first light, its impulse candidates and their flags.
// shade_light: the shadow candidate of a further light, one round for each light, so that memory does not grow with them.
#include "lib/bsdf.cl"
#include "lib/light.cl"
#include "lib/sampler.cl"

/// What is left of the radiance from a hit at distance t after the volume in front of it; 1 where it crossed none.
INLINE float3 absorptionAlong(const Surfel* s, float t) {
#if HAS(ABSORPTION)
  if (!s->front && (s->flags & MATERIAL_VOLUME))
    return (float3)(s->sigma_a.x > 0.0f ? exp(-s->sigma_a.x * t) : 1.0f, s->sigma_a.y > 0.0f ? exp(-s->sigma_a.y * t) : 1.0f,
                    s->sigma_a.z > 0.0f ? exp(-s->sigma_a.z * t) : 1.0f);
#endif
  return (float3)(1.0f);
}

#if HAS(LIGHTS)
/// Direct light from one light: a shadow candidate, or added to `radiance` at once where nothing can be in the way.
/// Returns ENTRY_SHADOW for a candidate, else 0.
INLINE uint directLight(const SceneView* scene, const RenderConstants* constants, const Surfel* s, float3 w_o, uint lightIndex,
                 float3 attenuation, uint i, uint capacity, __global float* shadows, float3* radiance) {
#if HAS(UNLIT)
  if (s->flags & MATERIAL_UNLIT) return 0;
#endif
  __global const DeviceLight* light = scene->lights + lightIndex;
  const Illumination arriving = illuminationAt(light, s->position);
  const float cosine = dot3(s->n, arriving.w_i);
  if (!(cosine > 0.0f) || !(dot3(s->n_g, arriving.w_i) > 0.0f) || !anyPositive(arriving.biradiance)) return 0;
  const float3 f = finiteScattering(constants, s, w_o, arriving.w_i);
  const float3 contribution = s->alpha * f * arriving.biradiance * cosine;
  if (!anyPositive(contribution)) return 0;
#if HAS(SHADOWS)
  if (light->castsShadows) {
    storePlanes3(shadows, capacity, SHADOW_O, i, s->position + s->n_g * s->bump);
    storePlanes3(shadows, capacity, SHADOW_D, i, arriving.w_i);
    const float length = arriving.distance < INFINITY ? arriving.distance - 2.0f * s->bump : MAXFLOAT;
    shadows[(size_t)SHADOW_LENGTH * capacity + i] = length > 0.0f ? length : 0.0f;
    storePlanes3(shadows, capacity, SHADOW_CONTRIBUTION, i, contribution * attenuation);
    return ENTRY_SHADOW;
  }
#endif
  *radiance += contribution * attenuation;
  return 0;
}
#endif

#if HAS(IMPULSES)
/// Stores impulse k of entry i if it carries anything; returns its flag.
INLINE uint storeImpulse(const Surfel* s, const Impulse* impulse, float3 throughput, uint k, uint i, uint capacity,
                  __global float* impulses) {
  const float3 carried = throughput * impulse->magnitude;
  if (!anyPositive(carried) || !isFinite3(impulse->w_i)) return 0;
  const float side = dot3(s->n_g, impulse->w_i) > 0.0f ? s->bump : -s->bump;
  const uint base = k * IMPULSE_PLANES;
  storePlanes3(impulses, capacity, base + IMPULSE_O, i, s->position + s->n_g * side);
  storePlanes3(impulses, capacity, base + IMPULSE_D, i, impulse->w_i);
  storePlanes3(impulses, capacity, base + IMPULSE_THROUGHPUT, i, carried);
  return ENTRY_IMPULSE0 << k;
}

/// Keeps one of two impulses with probability proportional to its luminance, divided by that probability.
INLINE void chooseOne(Impulse* first, Impulse* second, float u) {
  const float a = luminance(first->magnitude), b = luminance(second->magnitude);
  const float sum = a + b;
  if (!(sum > 0.0f)) return;
  const float p = a / sum;
  if (u < p) {
    first->magnitude = first->magnitude / p;
    second->magnitude = (float3)(0.0f);
  } else {
    second->magnitude = second->magnitude / (1.0f - p);
    first->magnitude = (float3)(0.0f);
  }
}
#endif

#if HAS(AOVS)
INLINE void storeAov(__global float* aovs, uint pixels, uint pixel, float t, float primitive, float3 n, float3 albedo) {
  aovs[(size_t)AOV_DEPTH * pixels + pixel] = t;
  aovs[(size_t)AOV_PRIMITIVE * pixels + pixel] = primitive;
  storePlanes3(aovs, pixels, AOV_NORMAL, pixel, n);
  storePlanes3(aovs, pixels, AOV_ALBEDO, pixel, albedo);
}
#endif

__kernel void shade(SCENE_PARAMS, const RenderConstants constants, const Batch batch, const uint first, const uint count,
                    const uint capacity, const uint bounce, const uint lastBounce, const uint width, const uint pixels,
                    __global const uint* pixelOrder, __global const float* rays, __global const float* hits,
                    __global float* entryRadiance,  // [3][capacity] of the segment's entries
                    __global float* shadows,        // [SHADOW_PLANES][capacity]
                    __global float* impulses,       // [2 IMPULSE_PLANES][capacity]
                    __global uint* flags,           // [capacity] ENTRY_…
                    __global float* aovs) {         // [AOV_PLANES][pixels]
  const uint i = get_global_id(0);
  if (i >= count) return;
  const SceneView scene = SCENE_VIEW;
  const RenderConstants own = constants;
  const uint triangleIndex = as_uint(hits[(size_t)HIT_TRIANGLE * capacity + i]);
  const float3 d = loadPlanes3(rays, capacity, RAY_D, first + i);
#if HAS(AOVS) || HAS(ONE_IMPULSE)
  const uint slot = as_uint(rays[(size_t)RAY_SLOT * capacity + first + i]);
  const uint packed = pixelOrder[batch.firstPixel + slot / batch.samples];
  const uint sample = batch.firstSample + slot % batch.samples;
  const uint pixel = (packed >> 16) * width + (packed & 0xffffu);
#endif
  uint found = 0;
  float3 radiance = (float3)(0.0f);
  if (triangleIndex == NO_HIT) {
#if HAS(BACKGROUND)
    radiance = backgroundRadiance(&scene, &own, d);
#endif
#if HAS(AOVS)
    if (bounce == 1 && sample == 0 && aovs) storeAov(aovs, pixels, pixel, INFINITY, -1.0f, (float3)(0.0f), (float3)(0.0f));
#endif
  } else {
    const float t = hits[(size_t)HIT_T * capacity + i];
    const Surfel s = surfelAt(&scene, &own, triangleIndex, loadPlanes3(rays, capacity, RAY_O, first + i), d, t,
                              hits[(size_t)HIT_B1 * capacity + i], hits[(size_t)HIT_B2 * capacity + i]);
    const float3 attenuation = absorptionAlong(&s, t);
    radiance = s.alpha * s.emission * attenuation;
#if HAS(UNLIT)
    if (s.flags & MATERIAL_UNLIT) radiance = s.alpha * s.baseColor * attenuation;
#endif
#if HAS(LIGHTS)
    if (lights) found |= directLight(&scene, &own, &s, -d, 0, attenuation, i, capacity, shadows, &radiance);
#endif
#if HAS(IMPULSES)
    if (bounce < lastBounce) {
      Impulse one, two;
      impulsesAt(&own, &s, -d, &one, &two);
#if HAS(ONE_IMPULSE)
      chooseOne(&one, &two, unitFloat(hash4(pixel, sample, 16u + bounce, own.seed)));
#endif
      const float3 carried = bounce > 1 ? loadPlanes3(rays, capacity, RAY_THROUGHPUT, first + i) : (float3)(1.0f);
      const float3 throughput = carried * attenuation;
      found |= storeImpulse(&s, &one, throughput, 0, i, capacity, impulses);
      found |= storeImpulse(&s, &two, throughput, 1, i, capacity, impulses);
    }
#endif
#if HAS(AOVS)
    if (bounce == 1 && sample == 0 && aovs)
      storeAov(aovs, pixels, pixel, t, (float)triangles[triangleIndex].primitive, s.n, s.baseColor);
#endif
  }
  storePlanes3(entryRadiance, capacity, 0, i, radiance);
  if (flags) flags[i] = found;
}

#if HAS(LIGHTS)
__kernel void shade_light(SCENE_PARAMS, const RenderConstants constants, const uint first, const uint count,
                          const uint capacity, const uint light, __global const float* rays, __global const float* hits,
                          __global float* entryRadiance, __global float* shadows, __global uint* flags) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const SceneView scene = SCENE_VIEW;
  const RenderConstants own = constants;
  const uint triangleIndex = as_uint(hits[(size_t)HIT_TRIANGLE * capacity + i]);
  uint found = 0;
  if (triangleIndex != NO_HIT) {
    const float3 d = loadPlanes3(rays, capacity, RAY_D, first + i);
    const float t = hits[(size_t)HIT_T * capacity + i];
    const Surfel s = surfelAt(&scene, &own, triangleIndex, loadPlanes3(rays, capacity, RAY_O, first + i), d, t,
                              hits[(size_t)HIT_B1 * capacity + i], hits[(size_t)HIT_B2 * capacity + i]);
    const float3 attenuation = absorptionAlong(&s, t);
    float3 radiance = loadPlanes3(entryRadiance, capacity, 0, i);
    found = directLight(&scene, &own, &s, -d, light, attenuation, i, capacity, shadows, &radiance);
    storePlanes3(entryRadiance, capacity, 0, i, radiance);
  }
  if (flags) flags[i] = (flags[i] & ~ENTRY_SHADOW) | found;
}
#endif
