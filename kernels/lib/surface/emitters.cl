// Light from the triangles that glow. A few of them are drawn by their power, one of those by what it brings here, so
// that the work does not grow with their number (Talbot, Cline, Egbert, "Importance Resampling for Global
// Illumination", 2005), and of that one a direction. Table: host/scene/emitters.h.
#include "lib/shares.cl"
#include "lib/surface/light.cl"
#include "lib/surface/ray_offset.cl"
#include "lib/surface/seen_triangle.cl"

#if HAS(SURFACE_LIGHTS)
/// One emitter for each lane.
typedef struct {
  Natural triangle;
  Real inverseDensity;  // m²
  Real weight;          // what it brings here over the chance of drawing it, up to a factor
} Candidate;

/// The one that is drawn for u in [0, 1).
INLINE Candidate candidateFor(const SceneView* scene, const Surfel* lit, uint count, Real u) {
  float at[LANES], inverseDensity[LANES];
  uint triangle[LANES];
  int twoSided[LANES];
  STORE(u, at);
  for (uint k = 0; k < LANES; ++k) {
    const Share share = shareAt(&scene->emitters->until, WORDS_OF(DeviceEmitter), count, at[k]);
    __global const DeviceEmitter* own = scene->emitters + share.chosen;
    triangle[k] = own->triangle;
    inverseDensity[k] = own->inverseDensity;
    twoSided[k] = own->twoSided != 0 ? -1 : 0;
  }
  Candidate c;
  c.triangle = LOAD(triangle);
  c.inverseDensity = LOAD(inverseDensity);
  const SeenTriangle seen = seenTriangle(scene, c.triangle, lit->position);
  const Real weight = receivedFrom(&seen, lit->n) / sqrt(dot3(seen.across, seen.across));
  const Mask shines = (!showsBack(&seen) | (LOAD(twoSided) != 0)) & (weight > 0.0f) & isfinite(weight);
  c.weight = shines ? weight : (Real)(0.0f);
  return c;
}

/// One of EMITTER_CANDIDATES, drawn at equal steps from `offset` on; its weight becomes the mean of all over its own.
/// at->u says which, then how far into that one's share. Those of one triangle are neighbours, and have one share: so
/// the points of a lamp of few triangles are as even as those of the square.
INLINE Candidate chosenEmitter(const SceneView* scene, const Surfel* lit, uint count, Real offset, Square* at) {
  Candidate all[EMITTER_CANDIDATES];
  Real sum = (Real)(0.0f);
  for (uint i = 0; i < EMITTER_CANDIDATES; ++i) {
    all[i] = candidateFor(scene, lit, count, ((float)i + offset) * (1.0f / EMITTER_CANDIDATES));
    sum += all[i].weight;
  }
  const Real wanted = at->u * sum;
  Candidate chosen = all[0];
  Real before = all[0].weight, runBegin = (Real)(0.0f), begin = (Real)(0.0f);
  for (uint i = 1; i < EMITTER_CANDIDATES; ++i) {
    runBegin = all[i].triangle == all[i - 1].triangle ? runBegin : before;
    const Mask later = !(wanted < before) & (all[i].weight > 0.0f);
    chosen.triangle = later ? all[i].triangle : chosen.triangle;
    chosen.inverseDensity = later ? all[i].inverseDensity : chosen.inverseDensity;
    chosen.weight = later ? all[i].weight : chosen.weight;
    begin = later ? runBegin : begin;
    before += all[i].weight;
  }
  Real share = (Real)(0.0f);
  for (uint i = 0; i < EMITTER_CANDIDATES; ++i)
    share += all[i].triangle == chosen.triangle ? all[i].weight : (Real)(0.0f);
  at->u = clampUnit((wanted - begin) / share);
  chosen.weight = chosen.weight > 0.0f ? sum * (1.0f / EMITTER_CANDIDATES) / chosen.weight : (Real)(0.0f);
  return chosen;
}

/// offset: of the candidates; at: which of them, and where in it. The distance ends where no rounding takes a shadow
/// ray through the emitter's plane, which lies the offsets of both ends over the cosine nearer than its point.
INLINE Illumination emitterIllumination(const SceneView* scene, const RenderConstants* constants, const Surfel* lit,
                                        uint count, Real offset, Square at) {
  Illumination result;
  result.w_i = result.biradiance = same3((float3)(0.0f));
  result.distance = (Real)(0.0f);
  if (count == 0) return result;
  const Candidate chosen = chosenEmitter(scene, lit, count, offset, &at);
  const SeenTriangle seen = seenTriangle(scene, chosen.triangle, lit->position);
  const Real solidAngle = solidAngleOf(&seen);
  const Mask wide = (solidAngle >= LEAST_SOLID_ANGLE) & (solidAngle <= MOST_SOLID_ANGLE);
  const Real root = sqrt(at.u);
  Real b1 = root * (1.0f - at.v), b2 = root * at.v, inDirection1, inDirection2;
  placeAlong(&seen, directionInto(&seen, solidAngle, at), &inDirection1, &inDirection2);
  b1 = wide ? inDirection1 : b1;
  b2 = wide ? inDirection2 : b2;
  const Real3 toLight = add3(add3(seen.first, scale3(b1, seen.e1)), scale3(b2, seen.e2));
  const Real d2 = dot3(toLight, toLight);
  const Mask reached = (d2 > 0.0f) & (chosen.weight > 0.0f);
  result.distance = sqrt(d2);
  result.w_i = choose3(reached, normalize3(toLight), result.w_i);
  const Surfel s = surfelAt(scene, chosen.triangle, lit->position, result.w_i, result.distance, b1, b2, noFootprint());
  const Real facing = -dot3(s.n_g, result.w_i);
  const Real area = 0.5f * sqrt(dot3(seen.across, seen.across));
  const Real weight = chosen.weight * chosen.inverseDensity * (wide ? solidAngle / area : facing / d2);
  const Real own = rayOffsetAt(constants, lit), others = rayOffsetAt(constants, &s);
  result.distance += 2.0f * (own - (own > others ? own : others) / facing);
  result.biradiance = choose3(reached & (facing > 0.0f), scale3(weight * s.alpha, s.emission), result.biradiance);
  return result;
}
#endif
