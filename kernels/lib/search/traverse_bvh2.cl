// Searches for one ray: the nearest triangle, and what a shadow ray meets; through the tree or through every triangle.
// Ties go to the lowest primitive index, so every search gives the same answer. Box test after Williams et al. 2005
// with the far distance widened (Ize 2013), so that rounding cannot hide a triangle.
#include "lib/search/surface.cl"
#include "lib/search/triangle.cl"

// What the triangle test takes must not be lost to its box. Relative to t, two box distances are off by 3
// roundings each, a corner sheared onto the ray by 12 on each of two axes, which makes 30 · 2^-24, and t itself by
// 15: 32 covers either.
#if HAS(STRAIGHT)
#define FAR_WIDENING 1.0000031f  // and what may lie COAT_ORDER behind the nearest
#else
#define FAR_WIDENING 1.0000019f
#endif

// Box distances as plane · (1/d) - o/d in one fma are off by what rounding took from o/d, besides their own rounding:
// half a unit in its last place, and as much again where the margin is added. Four units are taken off near and added
// to far.
#define BIAS_MARGIN 4.7683716e-7f

typedef struct {
  float t;
  uint triangle;  // NO_HIT: nothing met
  uint primitive;
  float b1, b2;
#if HAS(STRAIGHT)
  float order;  // of the nearest so far
#endif
#if HAS(COST)
  uint nodes, tests;  // opened so far; triangles tested
#endif
} Hit;

/// What a search visits is counted for COST alone.
#if HAS(COST)
#define COUNT(total, more) ((total) += (more))
#else
#define COUNT(total, more) ((void)0)
#endif

/// Nothing met yet, as far as tMax.
INLINE Hit noHit(float tMax) {
  Hit hit;
  hit.t = tMax;
  hit.triangle = hit.primitive = NO_HIT;
  hit.b1 = hit.b2 = 0.0f;
#if HAS(STRAIGHT)
  hit.order = tMax;
#endif
#if HAS(COST)
  hit.nodes = hit.tests = 0;
#endif
  return hit;
}

/// The box test: entry distance of child c, or +inf if it is missed or lies beyond tMax. Wider ones (childEntries8,
/// packetEntries8, entersChild) compute it another way and let in at least as much; SearchAgreement.RandomScenes, which
/// holds searches with boxes to the one without, would see what they hide. A ray that runs in the plane of a face gives
/// 0 · inf = NaN there, which every comparison below takes for inside.
INLINE float childEntry(const Ray* r, __global const Node* node, int c, float tMax) {
  float entry = 0.0f, leave = tMax;
#if HAS(STRAIGHT)
  entry = r->passed.tMin;
#endif
  for (int a = 0; a < 3; ++a) {
    const float lo = (node->lo[c][a] - r->o[a]) * r->inverse[a];
    const float hi = (node->hi[c][a] - r->o[a]) * r->inverse[a];
    const float near = r->inverse[a] >= 0.0f ? lo : hi;
    const float far = r->inverse[a] >= 0.0f ? hi : lo;
    entry = near > entry ? near : entry;
    leave = far < leave ? far : leave;
  }
  return entry <= leave * FAR_WIDENING ? entry : INFINITY;
}

/// Keeps the candidate in `best` if it comes before it.
INLINE void testNearest(const SceneView* scene, const Ray* r, uint index, Hit* best) {
  __global const DeviceTriangle* triangle = scene->triangles + index;
  const Corners corners = cornersOfTriangle(scene, index);
  Candidate c;
  COUNT(best->tests, 1);
#if HAS(STRAIGHT)
  if (!intersectTriangle(r, &corners, best->order * ORDER_WIDENING, &c)) return;
  const float order = orderOf(scene, index, c.t);
  if (order > best->order || (order == best->order && triangle->primitive > best->primitive)) return;
  if (!comesAfter(scene, &r->passed, index, order)) return;
  if (c.onEdge && (triangle->flags & TRIANGLE_FILTERS) && !ownsHit(r->o, r->kx, r->ky, r->kz, r->sx, r->sy, &corners))
    return;
#else
  if (!intersectTriangle(r, &corners, best->t, &c)) return;
  if (c.t == best->t && triangle->primitive > best->primitive) return;
#endif
#if HAS(ONE_SIDED)
  if (!showsSide(scene, index, c.front)) return;
#endif
#if HAS(ALPHA_MASK)
  if ((triangle->flags & TRIANGLE_MASKED) && !passesAlphaMask(scene, index, c.b1, c.b2)) return;
#endif
  best->t = c.t;
  best->b1 = c.b1;
  best->b2 = c.b2;
  best->triangle = index;
  best->primitive = triangle->primitive;
#if HAS(STRAIGHT)
  best->order = order;
#endif
}

/// Shadow ray: true once the light is blocked. `stops` collects -log2 of the transmittance in units of 2^-16.
INLINE int testOcclusion(const SceneView* scene, const Ray* r, uint index, float tMax, uint* stops) {
  const Corners corners = cornersOfTriangle(scene, index);
  Candidate c;
  if (!intersectTriangle(r, &corners, tMax, &c) || !(c.t < tMax)) return 0;
#if HAS(FILTERED_SHADOWS)
  if (scene->triangles[index].flags & TRIANGLE_FILTERS) {
    if (c.onEdge && !ownsHit(r->o, r->kx, r->ky, r->kz, r->sx, r->sy, &corners)) return 0;
    const Real3 through = shadowTransmittance(scene, index, c.b1, c.b2, real3(r->d[0], r->d[1], r->d[2]));
    int blocked = 1;
    for (int k = 0; k < 3; ++k) {
      const float value = k == 0 ? through.x : (k == 1 ? through.y : through.z);
      const float loss = value > 0.0f ? -log2(value) * 65536.0f : 2097152.0f;
      stops[k] += loss > 0.0f ? (uint)(loss < 2097152.0f ? rint(loss) : 2097152.0f) : 0u;
      if (stops[k] <= 1048576u) blocked = 0;
      if (stops[k] > 2097152u) stops[k] = 2097152u;
    }
    return blocked;
  }
#endif
#if HAS(ALPHA_MASK)
  if ((scene->triangles[index].flags & TRIANGLE_MASKED) && !passesAlphaMask(scene, index, c.b1, c.b2)) return 0;
#endif
  return 1;
}

/// Transmittance after a search that did not end blocked.
INLINE Real3 transmittanceFromStops(const uint* stops) {
#if HAS(FILTERED_SHADOWS)
  return real3(stops[0] > 1048576u ? 0.0f : exp2((float)stops[0] * -1.52587890625e-5f),
               stops[1] > 1048576u ? 0.0f : exp2((float)stops[1] * -1.52587890625e-5f),
               stops[2] > 1048576u ? 0.0f : exp2((float)stops[2] * -1.52587890625e-5f));
#else
  return real3(1.0f, 1.0f, 1.0f);
#endif
}

// A driver that ends loops says nothing of it. Where there is one, a walk takes its steps from a budget that is spent
// before the driver's, and the host is told.
INLINE int isSpent(uint* left, uint steps) {
#if LOOP_BUDGET
  *left = *left > steps ? *left - steps : 0;
  return *left == 0;
#else
  return 0;
#endif
}

INLINE void tellSpent(uint left, __global uint* counters) {
#if LOOP_BUDGET
  if (left == 0 && counters) counters[COUNTER_SPENT_WALK] = 1;
#endif
}

#if HAS(PACKETS)
// Packets search, and walk their own rays one by one.
#elif HAS(TREE)
Hit nearestSingle(const SceneView* scene, const Ray* r, uint* left) {
  Hit best = noHit(MAXFLOAT);
  if (!isFiniteRay(r)) return best;
  int stack[MAX_TREE_DEPTH + 4];
  int depth = 0;
  int current = 0;
  for (;;) {
    if (isSpent(left, 1)) return best;
    if (current < 0) {
      const uint packed = (uint)~current;
      const uint first = packed >> 4, count = (packed & 15u) + 1;
      if (isSpent(left, count)) return best;
      for (uint i = first; i < first + count; ++i) testNearest(scene, r, i, &best);
    } else {
      __global const Node* node = scene->nodes + current;
      COUNT(best.nodes, 1);
      const float t0 = childEntry(r, node, 0, best.t);
      const float t1 = childEntry(r, node, 1, best.t);
      if (t0 < INFINITY || t1 < INFINITY) {
        const int second = t1 < t0;
        current = node->child[second];
        if (t0 < INFINITY && t1 < INFINITY) stack[depth++] = node->child[1 - second];
        continue;
      }
    }
    if (depth == 0) return best;
    current = stack[--depth];
  }
}

INLINE Real3 transmittanceSingle(const SceneView* scene, const Ray* r, float tMax, uint* left) {
  uint stops[3] = {0, 0, 0};
  if (!isFiniteRay(r)) return real3(1.0f, 1.0f, 1.0f);
  int stack[MAX_TREE_DEPTH + 4];
  int depth = 0;
  int current = 0;
  for (;;) {
    if (isSpent(left, 1)) return real3(0.0f, 0.0f, 0.0f);
    if (current < 0) {
      const uint packed = (uint)~current;
      const uint first = packed >> 4, count = (packed & 15u) + 1;
      if (isSpent(left, count)) return real3(0.0f, 0.0f, 0.0f);
      for (uint i = first; i < first + count; ++i)
        if (testOcclusion(scene, r, i, tMax, stops)) return real3(0.0f, 0.0f, 0.0f);
    } else {
      __global const Node* node = scene->nodes + current;
      const float t0 = childEntry(r, node, 0, tMax);
      const float t1 = childEntry(r, node, 1, tMax);
      if (t0 < INFINITY || t1 < INFINITY) {
        const int second = t1 < t0;
        current = node->child[second];
        if (t0 < INFINITY && t1 < INFINITY) stack[depth++] = node->child[1 - second];
        continue;
      }
    }
    if (depth == 0) return transmittanceFromStops(stops);
    current = stack[--depth];
  }
}
#else
Hit nearestSingle(const SceneView* scene, const Ray* r, uint* left) {
  Hit best = noHit(MAXFLOAT);
  for (uint i = 0; i < scene->triangleCount && !isSpent(left, 1); ++i) testNearest(scene, r, i, &best);
  return best;
}

INLINE Real3 transmittanceSingle(const SceneView* scene, const Ray* r, float tMax, uint* left) {
  uint stops[3] = {0, 0, 0};
  for (uint i = 0; i < scene->triangleCount && !isSpent(left, 1); ++i)
    if (testOcclusion(scene, r, i, tMax, stops)) return real3(0.0f, 0.0f, 0.0f);
  return transmittanceFromStops(stops);
}
#endif
