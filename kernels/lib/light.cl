// Lights: direction, distance and biradiance at a point (KHR_lights_punctual). The spot's edge is measured by
// 1 - cos of the angle, computed without cancellation, so that a cone of 0.01 degrees is a cone.
#include "lib/math.cl"

typedef struct {
  float3 w_i;         // unit, towards the light
  float distance;     // m, inf for directional
  float3 biradiance;  // W/m² on a surface that faces the light, unshadowed
} Illumination;

INLINE float spotFactor(__global const DeviceLight* light, float3 w_i) {
  const float3 sum = w_i + load3(light->direction);
  const float versine = 0.5f * dot3(sum, sum);
  if (!(versine < light->versineOuter)) return 0.0f;
  const float f = (light->versineOuter - versine) / (light->versineOuter - light->versineInner);
  const float c = f < 1.0f ? f : 1.0f;  // inner = outer: f = +inf
  return c * c;
}

INLINE Illumination illuminationAt(__global const DeviceLight* light, float3 p) {
  Illumination result;
  result.biradiance = (float3)(0.0f);
  result.w_i = (float3)(0.0f);
  result.distance = INFINITY;
#if HAS(DIRECTIONAL_LIGHTS)
  if (light->kind == LIGHT_DIRECTIONAL) {
    result.w_i = -load3(light->direction);
    result.biradiance = load3(light->intensity);
    return result;
  }
#endif
#if HAS(POINT_LIGHTS) || HAS(SPOT_LIGHTS)
  const float3 toLight = load3(light->position) - p;
  const float d2 = dot3(toLight, toLight);
  if (!(d2 > 0.0f)) return result;
  const float d = sqrt(d2);
  float factor = 1.0f;
#if HAS(LIGHT_RANGE)
  if (light->range < INFINITY) {
    if (d > light->range) return result;
    const float r = d / light->range;
    factor = clamp(1.0f - r * r * r * r, 0.0f, 1.0f);
  }
#endif
  result.w_i = normalize3(toLight);
  result.distance = d;
#if HAS(SPOT_LIGHTS)
  if (light->kind == LIGHT_SPOT) factor *= spotFactor(light, result.w_i);
#endif
  result.biradiance = load3(light->intensity) / d2 * factor;
#endif
  return result;
}
