// Lights: direction, distance and biradiance at a point (KHR_lights_punctual). The spot's edge is measured by
// 1 - cos of the angle, computed without cancellation, so that a cone of 0.01 degrees is a cone.
#include "lib/lanes.cl"

typedef struct {
  Real3 w_i;         // unit, towards the light
  Real distance;     // m, inf for directional
  Real3 biradiance;  // W/m² on a surface that faces the light, unshadowed
} Illumination;

INLINE Real spotFactor(__global const DeviceLight* light, Real3 w_i) {
  const Real3 sum = add3(w_i, same3(load3(light->direction)));
  const Real versine = 0.5f * dot3(sum, sum);
  const Real f = (light->versineOuter - versine) / (light->versineOuter - light->versineInner);
  const Real c = f < 1.0f ? f : (Real)(1.0f);  // inner = outer: f = +inf
  return versine < light->versineOuter ? c * c : (Real)(0.0f);
}

INLINE Illumination illuminationAt(__global const DeviceLight* light, Real3 p) {
  Illumination result;
  result.biradiance = same3((float3)(0.0f));
  result.w_i = same3((float3)(0.0f));
  result.distance = (Real)(INFINITY);
#if HAS(DIRECTIONAL_LIGHTS)
  if (light->kind == LIGHT_DIRECTIONAL) {
    result.w_i = same3(-load3(light->direction));
    result.biradiance = same3(load3(light->intensity));
    return result;
  }
#endif
#if HAS(POINT_LIGHTS) || HAS(SPOT_LIGHTS)  // every light with a place: one that is missing here is black when alone
  const Real3 toLight = sub3(same3(load3(light->position)), p);
  const Real d2 = dot3(toLight, toLight);
  Mask reached = d2 > 0.0f;
  const Real d = sqrt(d2);
  Real factor = (Real)(1.0f);
#if HAS(LIGHT_RANGE)
  if (light->range < INFINITY) {
    reached = reached & !(d > light->range);
    const Real r = d / light->range;
    factor = clampUnit(1.0f - r * r * r * r);
  }
#endif
  result.w_i = choose3(reached, normalize3(toLight), result.w_i);
  result.distance = d;
#if HAS(SPOT_LIGHTS)
  if (light->kind == LIGHT_SPOT) factor *= spotFactor(light, result.w_i);
  reached = reached & (factor > 0.0f);  // outside the cone even a light of NaN is dark
#endif
  const Real3 arriving = scale3(factor, over3(same3(load3(light->intensity)), d2));
  result.biradiance = choose3(reached, arriving, result.biradiance);
#endif
  return result;
}

#if HAS(LIGHT_SIZE)
/// A direction within a cone about `axis` (unit), evenly in solid angle. less: 1 - cos of the angle between them, at
/// most that of the cone.
INLINE Real3 inCone(Real3 axis, Real less, Real turns) {
  Real cosine, sine;
  aroundCircle(turns, &cosine, &sine);
  Real3 right, up;
  basisAbout(axis, &right, &up);
  const Real away = sqrt(less * (2.0f - less));
  const Real3 across = add3(scale3(away * cosine, right), scale3(away * sine, up));
  return normalize3(add3(scale3(1.0f - less, axis), across));
}

/// What a light of some size sends to the entries by one of its points instead of all of it: a sphere of the same
/// intensity about a light with a place (which is dark inside), a cone of directions about that of a directional one,
/// both of one radiance. Evenly in solid angle (Pharr, Jakob, Humphreys 2023, 6.2.4); cones and ranges go by the
/// middle.
INLINE Illumination spread(__global const DeviceLight* light, const RenderConstants* constants,
                           const Illumination* point, Square at) {
  Illumination result = *point;
#if HAS(DIRECTIONAL_LIGHTS)
  if (light->kind == LIGHT_DIRECTIONAL) {
    if (constants->sunVersine > 0.0f) {
      result.w_i = inCone(point->w_i, at.u * constants->sunVersine, at.v);
      result.biradiance = scale3((Real)(2.0f / (2.0f - constants->sunVersine)), point->biradiance);
    }
    return result;
  }
#endif
#if HAS(POINT_LIGHTS) || HAS(SPOT_LIGHTS)
  if (constants->lightRadius > 0.0f) {
    const Real ratio = constants->lightRadius / point->distance, squared = ratio * ratio;
    const Mask outside = squared < 1.0f;
    const Real root = sqrt(outside ? 1.0f - squared : (Real)(0.0f));
    const Real less = at.u * squared / (1.0f + root);
    const Real chord = squared - less * (2.0f - less);
    result.w_i = inCone(point->w_i, less, at.v);
    result.distance = point->distance * (1.0f - less - sqrt(chord > 0.0f ? chord : (Real)(0.0f)));
    const Real3 spreadOut = scale3(2.0f / (1.0f + root), point->biradiance);
    result.biradiance = choose3(outside, spreadOut, same3((float3)(0.0f)));
  }
#endif
  return result;
}
#endif
