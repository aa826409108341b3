// Light from the triangles that glow: one of them is chosen by its power, and a point of it evenly (Shirley, Wang,
// Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", 1996). Table: host/scene/emitters.h.
#include "lib/surface/light.cl"
#include "lib/surface/ray_offset.cl"

#if HAS(SURFACE_LIGHTS)
/// The emitter for u in [0, 1), the first whose share ends beyond it; *u: how far into its share.
INLINE uint chosenEmitter(__global const DeviceEmitter* emitters, uint count, float* u) {
  uint low = 0, high = count - 1;
  while (low < high) {
    const uint middle = (low + high) / 2;
    if (*u < emitters[middle].until)
      high = middle;
    else
      low = middle + 1;
  }
  const float begin = low > 0 ? emitters[low - 1].until : 0.0f;
  *u = (*u - begin) / (emitters[low].until - begin);
  return low;
}

/// The distance ends where no rounding takes a shadow ray through the emitter's plane, which lies the offsets of both
/// ends over the cosine nearer than its point.
INLINE Illumination emitterIllumination(const SceneView* scene, const RenderConstants* constants, const Surfel* lit,
                                        uint count, Square at) {
  const Real3 p = lit->position;
  Illumination result;
  result.w_i = result.biradiance = same3((float3)(0.0f));
  result.distance = (Real)(0.0f);
  if (count == 0) return result;
  float u[LANES], inverseDensity[LANES];
  uint triangle[LANES];
  STORE(at.u, u);
  for (uint k = 0; k < LANES; ++k) {
    __global const DeviceEmitter* own = scene->emitters + chosenEmitter(scene->emitters, count, u + k);
    triangle[k] = own->triangle;
    inverseDensity[k] = own->inverseDensity;
  }
  const Real root = sqrt(LOAD(u));
  const Real b1 = root * (1.0f - at.v), b2 = root * at.v;
  const Barycentrics there = barycentrics(b1, b2);
  const TrianglePoint point = trianglePoint(scene, LOAD(triangle), &there);
  const Real3 toLight = sub3(blend(&point, point.p0, point.p1, point.p2), p);
  const Real d2 = dot3(toLight, toLight);
  const Mask reached = d2 > 0.0f;
  result.distance = sqrt(d2);
  result.w_i = choose3(reached, normalize3(toLight), result.w_i);
  const Surfel s = surfelAt(scene, LOAD(triangle), p, result.w_i, result.distance, b1, b2, noFootprint());
  const Real facing = -dot3(s.n_g, result.w_i);
  const Real weight = facing * LOAD(inverseDensity) / d2;
  const Real own = rayOffsetAt(constants, lit), others = rayOffsetAt(constants, &s);
  result.distance += 2.0f * (own - (own > others ? own : others) / facing);
  result.biradiance = choose3(reached & (facing > 0.0f), scale3(weight * s.alpha, s.emission), result.biradiance);
  return result;
}
#endif
