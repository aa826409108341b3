// Searches for one ray at a time through the eight-wide tree: one ray against eight boxes, or eight triangles, in the
// lanes of a float8. For rays that share no way, where a packet would drag the others along. The arithmetic of a lane
// is that of the other searches, so the answers are the same bits.
#include "lib/search/bvh8.cl"

#if HAS(TREE) && HAS(PACKETS)

/// The rays of a packet: what a search is given and gives back.
typedef struct {
  float o[3][PACKET_RAYS], d[3][PACKET_RAYS];
  float inverse[3][PACKET_RAYS], shear[3][PACKET_RAYS];  // as in Ray: sx, sy, sz
  float nearBias[3][PACKET_RAYS], farBias[3][PACKET_RAYS];
  int kz[PACKET_RAYS];
  float t[PACKET_RAYS];  // < 0: asleep; else how far to look, and afterwards the distance of the nearest hit
  uint triangle[PACKET_RAYS];
  float b1[PACKET_RAYS], b2[PACKET_RAYS];
#if HAS(STRAIGHT)
  float passedOrder[PACKET_RAYS];  // as in Passed
  uint passedPrimitive[PACKET_RAYS];
  float order[PACKET_RAYS];  // afterwards that of the nearest hit
#endif
#if HAS(COST)
  uint nodes[PACKET_RAYS], tests[PACKET_RAYS];  // afterwards, as in Hit
#endif
} RayTable;

/// A ray of the table, as its tests want it.
typedef struct {
  float o[3], inverse[3];
  float nearBias[3], farBias[3];  // -o/d for near and far planes, wider by more than they are off
  int nearPlane[3];               // floats from a node to its planes: 8 · axis, and 24 for hi
  int regular;                    // 1: no part of the direction is next to 0
  int kx, ky, kz;
  float sx, sy, sz;
  uint lane;  // of the table
#if HAS(STRAIGHT)
  Passed passed;
#endif
} Bvh8Ray;

/// Written in place, axis by axis: a copy of what was just written in parts would wait for it.
INLINE void takeRay(const RayTable* rays, uint lane, Bvh8Ray* r) {
  r->lane = lane;
  r->regular = 1;
#pragma unroll
  for (int a = 0; a < 3; ++a) {
    const float inverse = rays->inverse[a][lane];
    r->o[a] = rays->o[a][lane];
    r->inverse[a] = inverse;
    r->nearBias[a] = rays->nearBias[a][lane];
    r->farBias[a] = rays->farBias[a][lane];
    r->nearPlane[a] = a * 8 + (inverse >= 0.0f ? 0 : 24);
    r->regular &= fabs(inverse) < INFINITY;
  }
  r->kz = rays->kz[lane];
  r->kx = r->kz == 2 ? 0 : r->kz + 1;
  r->ky = r->kx == 2 ? 0 : r->kx + 1;
  r->sx = rays->shear[0][lane];
  r->sy = rays->shear[1][lane];
  r->sz = rays->shear[2][lane];
#if HAS(STRAIGHT)
  r->passed.order = rays->passedOrder[lane];
  r->passed.primitive = rays->passedPrimitive[lane];
  r->passed.tMin = r->passed.order * PASSED_MARGIN;
#endif
}

/// The eight children of a node: mask of those that the ray enters before tMax, and where. Lets in all that childEntry
/// lets in, and a little more where the direction is regular.
INLINE int8 childEntries8(const Bvh8Ray* r, __global const float* node, float tMax, float8* entry) {
  float8 enter = (float8)(0.0f), leave = (float8)(tMax);
#if HAS(STRAIGHT)
  enter = (float8)(r->passed.tMin);
#endif
  if (r->regular) {
    const int x = r->nearPlane[0], y = r->nearPlane[1], z = r->nearPlane[2];
    const float8 nearX = fma(vload8(0, node + x), (float8)(r->inverse[0]), (float8)(r->nearBias[0]));
    const float8 nearY = fma(vload8(0, node + y), (float8)(r->inverse[1]), (float8)(r->nearBias[1]));
    const float8 nearZ = fma(vload8(0, node + z), (float8)(r->inverse[2]), (float8)(r->nearBias[2]));
    const float8 farX = fma(vload8(0, node + 24 - x), (float8)(r->inverse[0]), (float8)(r->farBias[0]));
    const float8 farY = fma(vload8(0, node + 40 - y), (float8)(r->inverse[1]), (float8)(r->farBias[1]));
    const float8 farZ = fma(vload8(0, node + 56 - z), (float8)(r->inverse[2]), (float8)(r->farBias[2]));
    enter = largest8(nearX, nearY, nearZ, enter);
    leave = smallest8(farX, farY, farZ, leave);
  } else {
    for (int a = 0; a < 3; ++a) {
      const int down = !(r->inverse[a] >= 0.0f);
      const float8 near = (vload8(0, node + (a + 3 * down) * 8) - r->o[a]) * r->inverse[a];
      const float8 far = (vload8(0, node + (a + 3 * (1 - down)) * 8) - r->o[a]) * r->inverse[a];
      enter = near > enter ? near : enter;
      leave = far < leave ? far : leave;
    }
  }
  *entry = enter;
  return enter <= leave * FAR_WIDENING;
}

/// clampToBox for the triangles of a leaf.
float8 clampToBox8(const Bvh8Ray* r, const Leaf* leaf, float8 t) {
  float8 far[3];
  for (int a = 0; a < 3; ++a) {
    float8 lo, hi;
    leafExtents(leaf, a, &lo, &hi);
    const int down = !(r->inverse[a] >= 0.0f);
    const float8 near = ((down ? hi : lo) - r->o[a]) * r->inverse[a];
    far[a] = ((down ? lo : hi) - r->o[a]) * r->inverse[a];
    t = near > t ? near : t;
  }
  for (int a = 0; a < 3; ++a) t = far[a] < t ? far[a] : t;
  return t;
}

/// intersectTriangle for a leaf's triangles: bits of those met at 0 < t <= tMax; t of all lanes, and the areas whose
/// ratios v/det and w/det are the barycentrics b1 and b2.
INLINE uint intersectLeaf(const Bvh8Ray* r, const Leaf* leaf, float tMax, float8* t, float8* areaV, float8* areaW,
                          float8* area) {
  const float ox = r->o[r->kx], oy = r->o[r->ky], oz = r->o[r->kz];
  const float8 az = leafPlane(leaf, 0, r->kz) - oz;
  const float8 bz = leafPlane(leaf, 1, r->kz) - oz;
  const float8 cz = leafPlane(leaf, 2, r->kz) - oz;
  const float8 sx = (float8)(-r->sx), sy = (float8)(-r->sy);
  const float8 ax = fma(sx, az, leafPlane(leaf, 0, r->kx) - ox);
  const float8 ay = fma(sy, az, leafPlane(leaf, 0, r->ky) - oy);
  const float8 bx = fma(sx, bz, leafPlane(leaf, 1, r->kx) - ox);
  const float8 by = fma(sy, bz, leafPlane(leaf, 1, r->ky) - oy);
  const float8 cx = fma(sx, cz, leafPlane(leaf, 2, r->kx) - ox);
  const float8 cy = fma(sy, cz, leafPlane(leaf, 2, r->ky) - oy);
  float8 u, v, w;
  const int8 inside = edgeTest8(ax, ay, bx, by, cx, cy, &u, &v, &w);
  const uint lanes = laneBits(inside) & leafLanes(leaf);
  if (lanes == 0) return 0;
  const float8 det = u + v + w;
  int8 far;
  *t = hitDistance8(u, v, w, det, (float8)(r->sz), az, bz, cz, &far);
  if (lanes & laneBits(far)) *t = select(*t, clampToBox8(r, leaf, *t), far);
  *areaV = v, *areaW = w, *area = det;
  return lanes & laneBits((*t > 0.0f) & (*t <= tMax));
}

INLINE void testNearestLeaf(const SceneView* scene, const Bvh8Ray* r, int child, Hit* best) {
  const Leaf leaf = leafOf(scene, child);
  float8 t8, v8, w8, det8;
  COUNT(best->tests, leaf.count);
#if HAS(STRAIGHT)
  uint bits = intersectLeaf(r, &leaf, best->order * ORDER_WIDENING, &t8, &v8, &w8, &det8);
#else
  uint bits = intersectLeaf(r, &leaf, best->t, &t8, &v8, &w8, &det8);
#endif
  if (bits == 0) return;
  float t[8], v[8], w[8], det[8];
  vstore8(t8, 0, t);
  vstore8(v8, 0, v);
  vstore8(w8, 0, w);
  vstore8(det8, 0, det);
  for (; bits != 0; bits &= bits - 1) {
    const uint lane = lowestBit(bits), index = leaf.first + lane;
#if HAS(STRAIGHT)
    const float order = orderOf(scene, index, t[lane]);
    if (order > best->order || (order == best->order && !comesFirst(scene, index, best->triangle))) continue;
    if (!comesAfter(scene, &r->passed, index, order)) continue;
    const Corners corners = {leaf.corners + lane, leaf.count};
    if (mayLieOnEdge(v[lane], w[lane], det[lane]) && (scene->triangles[index].flags & TRIANGLE_FILTERS) &&
        !ownsHit(r->o, r->kx, r->ky, r->kz, r->sx, r->sy, &corners))
      continue;
#else
    if (t[lane] > best->t || (t[lane] == best->t && !comesFirst(scene, index, best->triangle))) continue;
#endif
#if HAS(ONE_SIDED)
    if (!showsSide(scene, index, facesRay(det[lane], r->sz))) continue;
#endif
    const float b1 = v[lane] / det[lane], b2 = w[lane] / det[lane];
#if HAS(ALPHA_MASK)
    if ((scene->triangles[index].flags & TRIANGLE_MASKED) && !passesAlphaMask(scene, index, b1, b2)) continue;
#endif
    best->t = t[lane];
    best->b1 = b1;
    best->b2 = b2;
    best->triangle = index;
#if HAS(STRAIGHT)
    best->order = order;
#endif
  }
}

/// 1 once the light is blocked. stops: [3], see testOcclusion.
INLINE int testOcclusionLeaf(const SceneView* scene, const RayTable* rays, const Bvh8Ray* r, int child, float tMax,
                             uint* stops) {
  const Leaf leaf = leafOf(scene, child);
  float8 t8, v8, w8, det8;
  uint bits = intersectLeaf(r, &leaf, tMax, &t8, &v8, &w8, &det8);
  if (bits == 0) return 0;
#if HAS(FILTERED_SHADOWS) || HAS(ALPHA_MASK)
  const Ray whole = makeRay(real3(rays->o[0][r->lane], rays->o[1][r->lane], rays->o[2][r->lane]),
                            real3(rays->d[0][r->lane], rays->d[1][r->lane], rays->d[2][r->lane]));
  for (; bits != 0; bits &= bits - 1)
    if (testOcclusion(scene, &whole, leaf.first + lowestBit(bits), tMax, stops)) return 1;
  return 0;
#else
  return (bits & laneBits(t8 < tMax)) != 0;
#endif
}

/// A ray on its way to its nearest hit: children of `group` still to visit, the groups above it on the stack.
typedef struct {
  Bvh8Ray r;
  Hit best;
  uint limit;  // keyLimit(best.t)
  uint8 keys;
  int group, depth;
  uint waiting[8 * BVH8_DEPTH];
  int groups[BVH8_DEPTH];
} Walk;

/// One step: what waits and lies behind the hit is left, then a node opened or a leaf tested. 0 at the end of the way.
INLINE int step(const SceneView* scene, Walk* w) {
  uint least = least8(w->keys);
  while (least > w->limit) {
    if (w->depth == 0) return 0;
    --w->depth;
    w->keys = vload8(w->depth, w->waiting);
    w->group = w->groups[w->depth];
    least = least8(w->keys);
  }
  const uint8 keys = select(w->keys, (uint8)(NO_CHILD), as_uint8(w->keys == least));
  const int child = as_int(scene->bvh8Nodes[(size_t)w->group * BVH8_NODE_FLOATS + 48 + (least & 7u)]);
  if (child < 0) {
    testNearestLeaf(scene, &w->r, child, &w->best);
    w->limit = keyLimit(w->best.t);
    w->keys = keys;
    return 1;
  }
  float8 entry;
  COUNT(w->best.nodes, 1);
  const int8 entered = childEntries8(&w->r, scene->bvh8Nodes + (size_t)child * BVH8_NODE_FLOATS, w->best.t, &entry);
  vstore8(keys, w->depth, w->waiting);
  w->groups[w->depth] = w->group;
  w->depth += anyOf8(keys != NO_CHILD);
  w->keys = childKeys(entered, entry);
  w->group = child;
  return 1;
}

/// The next ray of the table that is awake, from lane *next on; PACKET_RAYS: there is none.
INLINE uint nextAwake(const RayTable* rays, uint* next) {
  while (*next < PACKET_RAYS && rays->t[*next] < 0.0f) ++*next;
  return *next < PACKET_RAYS ? (*next)++ : PACKET_RAYS;
}

/// Puts the next ray at the root; 0: there is none.
INLINE int startWalk(const SceneView* scene, const RayTable* rays, uint* next, Walk* w) {
  const uint lane = nextAwake(rays, next);
  if (lane == PACKET_RAYS) return 0;
  takeRay(rays, lane, &w->r);
  w->best = noHit(rays->t[lane]);
  COUNT(w->best.nodes, 1);
  w->limit = keyLimit(w->best.t);
  float8 entry;
  w->keys = childKeys(childEntries8(&w->r, scene->bvh8Nodes, w->best.t, &entry), entry);
  w->group = 0, w->depth = 0;
  return 1;
}

INLINE void endWalk(const Walk* w, RayTable* rays) {
  rays->t[w->r.lane] = w->best.t;
  rays->triangle[w->r.lane] = w->best.triangle;
  rays->b1[w->r.lane] = w->best.b1;
  rays->b2[w->r.lane] = w->best.b2;
#if HAS(STRAIGHT)
  rays->order[w->r.lane] = w->best.order;
#endif
#if HAS(COST)
  rays->nodes[w->r.lane] = w->best.nodes;
  rays->tests[w->r.lane] = w->best.tests;
#endif
}

/// Nearest hits. Two rays take turns, so that one computes while the other waits for memory or for its own last result.
void nearestApart(const SceneView* scene, RayTable* rays) {
  for (int i = 0; i < PACKET_RAYS; ++i) rays->triangle[i] = NO_HIT, rays->b1[i] = rays->b2[i] = 0.0f;
#if HAS(COST)
  for (int i = 0; i < PACKET_RAYS; ++i) rays->nodes[i] = rays->tests[i] = 0;
#endif
  uint next = 0;
  Walk a, b;
  int hasA = startWalk(scene, rays, &next, &a);
  int hasB = startWalk(scene, rays, &next, &b);
  while (hasA & hasB) {
    if (!step(scene, &a)) {
      endWalk(&a, rays);
      hasA = startWalk(scene, rays, &next, &a);
    }
    if (!step(scene, &b)) {
      endWalk(&b, rays);
      hasB = startWalk(scene, rays, &next, &b);
    }
  }
  if (hasA) {
    while (step(scene, &a))
      ;
    endWalk(&a, rays);
  }
  if (hasB) {
    while (step(scene, &b))
      ;
    endWalk(&b, rays);
  }
}

/// A shadow ray on its way: one bit for each child of `group` still to visit, in the order of the node, which has the
/// largest first: a ray that meets anything is at its end.
typedef struct {
  Bvh8Ray r;
  float tMax;
  uint bits;
  int group, depth;
  uint stops[3];
  uchar waiting[BVH8_DEPTH];
  int groups[BVH8_DEPTH];
} ShadowWalk;

#define SHADOW_ON 0
#define SHADOW_OPEN 1
#define SHADOW_BLOCKED 2

INLINE int stepShadow(const SceneView* scene, const RayTable* rays, ShadowWalk* w) {
  while (w->bits == 0) {
    if (w->depth == 0) return SHADOW_OPEN;
    --w->depth;
    w->bits = w->waiting[w->depth];
    w->group = w->groups[w->depth];
  }
  const int child = as_int(scene->bvh8Nodes[(size_t)w->group * BVH8_NODE_FLOATS + 48 + lowestBit(w->bits)]);
  w->bits &= w->bits - 1;
  if (child < 0) return testOcclusionLeaf(scene, rays, &w->r, child, w->tMax, w->stops) ? SHADOW_BLOCKED : SHADOW_ON;
  w->waiting[w->depth] = (uchar)w->bits;
  w->groups[w->depth] = w->group;
  w->depth += w->bits != 0;
  float8 entry;
  w->bits = laneBits(childEntries8(&w->r, scene->bvh8Nodes + (size_t)child * BVH8_NODE_FLOATS, w->tMax, &entry));
  w->group = child;
  return SHADOW_ON;
}

INLINE int startShadow(const SceneView* scene, const RayTable* rays, uint* next, ShadowWalk* w) {
  const uint lane = nextAwake(rays, next);
  if (lane == PACKET_RAYS) return 0;
  takeRay(rays, lane, &w->r);
  w->tMax = rays->t[lane];
  w->stops[0] = w->stops[1] = w->stops[2] = 0;
  float8 entry;
  w->bits = laneBits(childEntries8(&w->r, scene->bvh8Nodes, w->tMax, &entry));
  w->group = 0, w->depth = 0;
  return 1;
}

/// stops: [3][PACKET_RAYS]
INLINE void endShadow(const ShadowWalk* w, int end, RayTable* rays, uint* stops) {
  if (end == SHADOW_BLOCKED) rays->t[w->r.lane] = -INFINITY;
#if HAS(FILTERED_SHADOWS) || HAS(ALPHA_MASK)
  for (int k = 0; k < 3; ++k) stops[k * PACKET_RAYS + w->r.lane] = w->stops[k];
#endif
}

/// Shadow rays: t becomes -inf where the light is blocked. stops: [3][PACKET_RAYS]. Two take turns, as above.
void occludedApart(const SceneView* scene, RayTable* rays, uint* stops) {
  uint next = 0;
  ShadowWalk a, b;
  int hasA = startShadow(scene, rays, &next, &a);
  int hasB = startShadow(scene, rays, &next, &b);
  while (hasA | hasB) {
    if (hasA) {
      const int end = stepShadow(scene, rays, &a);
      if (end != SHADOW_ON) {
        endShadow(&a, end, rays, stops);
        hasA = startShadow(scene, rays, &next, &a);
      }
    }
    if (hasB) {
      const int end = stepShadow(scene, rays, &b);
      if (end != SHADOW_ON) {
        endShadow(&b, end, rays, stops);
        hasB = startShadow(scene, rays, &next, &b);
      }
    }
  }
}

#endif
