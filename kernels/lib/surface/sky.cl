// Light from the background, by one direction for each entry: about the surface's normal as Lambert weighs them, where
// it is one colour, or by the brightness of a map. Table: host/scene/sky.h.
#include "lib/shares.cl"
#include "lib/surface/background.cl"
#include "lib/surface/light.cl"
#include "lib/surface/surfel.cl"

#if HAS(SKY_LIGHTS)
#define LARGEST_BELOW_ONE 0.99999994f  // strata may round up to 1
#define HALF_A_STEP 2.98023224e-8f     // of random numbers: the middle of what was rounded to one

#if HAS(BACKGROUND_MAP)
/// Where in its share u lies, from 0 to 1.
INLINE float placeInShare(const Share* share, float u) {
  return (u - share->begin + HALF_A_STEP) / (share->end - share->begin);
}

/// The place of u in [0, 1] where points are as frequent as what rises or falls evenly from `first` to `last`.
INLINE float placeOnSlope(float u, float first, float last) {
  const float a = first / (first + last), b = last / (first + last);
  const float place = u / (a + sqrt(a * a * (1.0f - u) + b * b * u));
  return place < 1.0f ? place : 1.0f;  // also NaN, of what is black
}

INLINE float brightness(float3 radiance) { return radiance.x + radiance.y + radiance.z; }

/// Towards the place in a cell between four texels' middles where a map is as bright as it is often chosen; *direction
/// gets it. Returns the biradiance: radiance over density.
INLINE float3 mapIllumination(const SceneView* scene, const RenderConstants* constants, float u, float v,
                              float3* direction) {
  const int width = constants->backgroundWidth, height = constants->backgroundHeight;
  u = u < LARGEST_BELOW_ONE ? u : LARGEST_BELOW_ONE;
  v = v < LARGEST_BELOW_ONE ? v : LARGEST_BELOW_ONE;
  const Share row = shareAt(scene->sky, 1, (uint)height + 1, v);
  const Share column = shareAt(scene->sky + height + 1 + (size_t)row.chosen * width, 1, (uint)width, u);
  const int x = (int)column.chosen, y = (int)row.chosen;
  const float3 a = backgroundTexel(scene, constants, x, y - 1), b = backgroundTexel(scene, constants, x + 1, y - 1),
               c = backgroundTexel(scene, constants, x, y), d = backgroundTexel(scene, constants, x + 1, y);
  const float3 top = a + b, low = c + d;
  const float down = placeOnSlope(placeInShare(&row, v), brightness(top), brightness(low));
  const float3 left = a * (1.0f - down) + c * down, right = b * (1.0f - down) + d * down;
  const float across = placeOnSlope(placeInShare(&column, u), brightness(left), brightness(right));
  const float3 radiance = left * (1.0f - across) + right * across;
  // The first and the last row are half as high: from a pole to the middles of the texels there.
  const float begin = y > 0 ? (float)y - 0.5f : 0.0f, end = y < height ? (float)y + 0.5f : (float)height;
  const float polar = (begin + down * (end - begin)) / (float)height, sine = sinpi(polar);
  const float turns = 2.0f * (((float)x + 0.5f + across) / (float)width - constants->backgroundAhead);
  *direction = (float3)(sine * sinpi(turns), cospi(polar), -sine * cospi(turns));
  const float size = sine * (2.0f * PI * PI) * (end - begin) / ((float)height * (float)width);  // sr
  const float mean = 0.25f * brightness(top + low);
  const float inverseDensity = size * (mean / brightness(radiance)) /
                               ((row.end - row.begin) * (column.end - column.begin));
  const float3 color = (float3)(constants->background[0], constants->background[1], constants->background[2]);
  return brightness(radiance) > 0.0f ? color * radiance * inverseDensity : (float3)(0.0f);
}
#endif

INLINE Illumination skyIllumination(const SceneView* scene, const RenderConstants* constants, const Surfel* s,
                                    Square at) {
  Illumination result;
  result.distance = (Real)(INFINITY);
#if HAS(BACKGROUND_MAP)
  if (constants->backgroundWidth > 0) {
    float u[LANES], v[LANES], w[3][LANES], biradiance[3][LANES];
    STORE(at.u, u);
    STORE(at.v, v);
    for (uint k = 0; k < LANES; ++k) {
      float3 d;
      const float3 arriving = mapIllumination(scene, constants, u[k], v[k], &d);
      w[0][k] = d.x, w[1][k] = d.y, w[2][k] = d.z;
      biradiance[0][k] = arriving.x, biradiance[1][k] = arriving.y, biradiance[2][k] = arriving.z;
    }
    result.w_i = normalize3(real3(LOAD(w[0]), LOAD(w[1]), LOAD(w[2])));
    result.biradiance = real3(LOAD(biradiance[0]), LOAD(biradiance[1]), LOAD(biradiance[2]));
    return result;
  }
#endif
  const float* radiance = constants->background;
  Real cosine, sine;
  Real3 right, up;
  aroundCircle(at.v, &cosine, &sine);
  basisAbout(s->n, &right, &up);
  const Real u = at.u < LARGEST_BELOW_ONE ? at.u : (Real)(LARGEST_BELOW_ONE);
  const Real away = sqrt(u);
  const Real3 across = add3(scale3(away * cosine, right), scale3(away * sine, up));
  result.w_i = normalize3(add3(scale3(sqrt(1.0f - u), s->n), across));
  result.biradiance = scale3(PI / dot3(s->n, result.w_i), same3((float3)(radiance[0], radiance[1], radiance[2])));
  return result;
}
#endif
