// A triangle as it is seen from a point: how much of the directions it takes up, and a direction to it, all of them as
// likely (Arvo, "Stratified Sampling of Spherical Triangles", 1995; without his angles, whose differences cancel, after
// Peters, "BRDF Importance Sampling for Polygonal Lights", 2021).
#include "lib/corners.cl"

typedef struct {
  Real3 first, e1, e2;  // towards its first corner, and along its sides from there, m
  Real3 d[3];           // unit, towards its corners
  Real3 across;         // normal of its front times twice its area, m²
  Real rise, run;       // the tangent of half its solid angle; of d0, d1, d2: rise is their volume
} SeenTriangle;

/// The volume comes from the sides, so that it does not cancel where the triangle is far and small.
INLINE SeenTriangle seenFrom(Real3 from, Real3 p0, Real3 p1, Real3 p2) {
  SeenTriangle t;
  t.first = sub3(p0, from);
  t.e1 = sub3(p1, p0);
  t.e2 = sub3(p2, p0);
  t.across = cross3(t.e1, t.e2);
  const Real3 second = sub3(p1, from), third = sub3(p2, from);
  const Real l0 = sqrt(dot3(t.first, t.first)), l1 = sqrt(dot3(second, second)), l2 = sqrt(dot3(third, third));
  t.d[0] = over3(t.first, l0);
  t.d[1] = over3(second, l1);
  t.d[2] = over3(third, l2);
  t.rise = fabs(dot3(t.across, t.first)) / (l0 * l1 * l2);
  t.run = 1.0f + dot3(t.d[0], t.d[1]) + dot3(t.d[1], t.d[2]) + dot3(t.d[2], t.d[0]);
  return t;
}

INLINE SeenTriangle seenTriangle(const SceneView* scene, Natural triangle, Real3 from) {
  const CornerPlace place = cornerPlace(scene, triangle);
  return seenFrom(from, cornerAt(scene, &place, 0), cornerAt(scene, &place, 1), cornerAt(scene, &place, 2));
}

/// Seen from its back.
INLINE Mask showsBack(const SeenTriangle* t) { return dot3(t->across, t->first) > 0.0f; }

/// sr (Van Oosterom, Strackee 1983); lane by lane, since atan2 of a vector may round otherwise.
INLINE Real solidAngleOf(const SeenTriangle* t) {
  float rise[LANES], run[LANES];
  STORE(t->rise, rise);
  STORE(t->run, run);
  for (uint k = 0; k < LANES; ++k) rise[k] = 2.0f * atan2(rise[k], run[k]);
  return LOAD(rise);
}

/// About the solid angle (to 1 %) times the mean cosine to n of what lies above the horizon of n, of corners and
/// middle: more than 0 where any part of the triangle does. NaN where it has no size.
INLINE Real receivedFrom(const SeenTriangle* t, Real3 n) {
  const Mask steep = t->rise > fabs(t->run);
  const Real ratio = steep ? t->run / t->rise : t->rise / t->run;
  const Real small = ratio / (1.0f + 0.28f * ratio * ratio);
  const Real halfAngle = steep ? 0.5f * PI - small : (t->run < 0.0f ? PI + small : small);
  const Real3 middle = add3(add3(t->d[0], t->d[1]), t->d[2]);
  const Real a = dot3(n, t->d[0]), b = dot3(n, t->d[1]), c = dot3(n, t->d[2]);
  const Real m = (a + b + c) / sqrt(dot3(middle, middle));
  const Real zero = (Real)(0.0f);
  return 0.5f * halfAngle *
         ((a > 0.0f ? a : zero) + (b > 0.0f ? b : zero) + (c > 0.0f ? c : zero) + (m > 0.0f ? m : zero));
}

/// A unit direction into the triangle: towards the part of it that `at.u` of its solid angle lies before, from the
/// first corner to the third, and there at.v of the way from the second.
INLINE Real3 directionInto(const SeenTriangle* t, Real solidAngle, Square at) {
  const Real g1 = dot3(t->d[0], t->d[2]) + dot3(t->d[1], t->d[2]), g2 = 1.0f + dot3(t->d[0], t->d[1]);
  Real cosine, sine;
  aroundCircle(solidAngle * at.u * (0.25f / PI), &cosine, &sine);
  const Real3 between = add3(scale3(t->rise * cosine - g1 * sine, t->d[0]), scale3(g2 * sine, t->d[2]));
  const Real mirrored = 2.0f * dot3(t->d[0], between) / dot3(between, between);
  const Real3 end = sub3(scale3(mirrored, between), t->d[0]);
  const Real3 apart = sub3(end, t->d[1]);
  const Real versine = 0.5f * dot3(apart, apart);
  const Real away = sqrt(at.v * (2.0f - versine * at.v) / (2.0f - versine));
  return normalize3(add3(scale3(1.0f - versine * at.v - away * (1.0f - versine), t->d[1]), scale3(away, end)));
}

/// Barycentrics of the second and third corner where the unit direction w meets the triangle.
INLINE void placeAlong(const SeenTriangle* t, Real3 w, Real* b1, Real* b2) {
  const Real distance = dot3(t->across, t->first) / dot3(t->across, w);
  const Real3 from = sub3(scale3(distance, w), t->first);
  const Real square = dot3(t->across, t->across);
  *b1 = clampUnit(dot3(cross3(from, t->e2), t->across) / square);
  const Real second = clampUnit(dot3(cross3(t->e1, from), t->across) / square), room = 1.0f - *b1;
  *b2 = second < room ? second : room;
}
