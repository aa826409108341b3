// Rays that leave their packet: what a packet hands to the search for single rays, whole or below a child that few of
// its rays enter (as in Benthin, Wald, Woop, Ernst, Mark, "Combining Single and Packet-Ray Tracing for Arbitrary Ray
// Distributions on the Intel MIC Architecture", 2012).
#include "lib/search/packet.cl"
#include "lib/search/traverse_bvh8.cl"

#if HAS(TREE) && HAS(PACKETS)

/// As many rays or fewer leave the packet below a child that only they enter.
#define PACKET_FEW 5

INLINE RayTable tableOf(const Packet* p, float16 tMax) {
  RayTable rays;
  for (int a = 0; a < 3; ++a) {
    vstore16(p->o[a], 0, rays.o[a]);
    vstore16(p->d[a], 0, rays.d[a]);
  }
  for (int a = 0; a < 3; ++a) {
    vstore16(p->inverse[a], 0, rays.inverse[a]);
    vstore16(p->nearBias[a], 0, rays.nearBias[a]);
    vstore16(p->farBias[a], 0, rays.farBias[a]);
    vstore16(p->shear[a], 0, rays.shear[a]);
  }
  vstore16(p->kz, 0, rays.kz);
  vstore16(tMax, 0, rays.t);
#if HAS(STRAIGHT)
  vstore16(p->passedOrder, 0, rays.passedOrder);
  vstore16(p->passedPrimitive, 0, rays.passedPrimitive);
  for (int i = 0; i < PACKET_RAYS; ++i) rays.order[i] = rays.t[i];
#endif
  return rays;
}

/// All the steps below a child; the ray and what it has met so far are in `w`.
INLINE void walkBelow(const SceneView* scene, Walk* w, int child) {
  if (child < 0) {
    testNearestLeaf(scene, &w->r, child, &w->best);
    return;
  }
  COUNT(w->best.nodes, 1);
  w->limit = keyLimit(w->best.t);
  float8 entry;
  const int8 entered = childEntries8(&w->r, scene->bvh8Nodes + (size_t)child * BVH8_NODE_FLOATS, w->best.t, &entry);
  w->keys = childKeys(entered, entry);
  w->group = child, w->depth = 0;
  while (step(scene, w))
    ;
}

/// What a few rays of a packet meet in a child of a node that only they enter.
void nearestBelow(const SceneView* scene, const RayTable* rays, uint lanes, int child, PacketHit* best) {
  float* t = (float*)&best->t;
  float *v = (float*)&best->v, *w = (float*)&best->w, *det = (float*)&best->det;
  uint* triangle = (uint*)&best->triangle;
  for (; lanes != 0; lanes &= lanes - 1) {
    const uint lane = lowestBit(lanes);
    Walk walk;
    takeRay(rays, lane, &walk.r);
    walk.best = noHit(t[lane]);
    walk.best.triangle = triangle[lane];
#if HAS(STRAIGHT)
    float* order = (float*)&best->order;
    walk.best.order = order[lane];
#endif
    walkBelow(scene, &walk, child);
#if HAS(COST)
    ((uint*)&best->nodes)[lane] += walk.best.nodes;
    ((uint*)&best->tests)[lane] += walk.best.tests;
#endif
    if (walk.best.triangle == triangle[lane]) continue;
    t[lane] = walk.best.t;
    triangle[lane] = walk.best.triangle;
    v[lane] = walk.best.b1, w[lane] = walk.best.b2, det[lane] = 1.0f;
#if HAS(STRAIGHT)
    order[lane] = walk.best.order;
#endif
  }
}

/// As walkBelow: how it ends.
INLINE int walkShadowBelow(const SceneView* scene, const RayTable* rays, ShadowWalk* w, int child) {
  if (child < 0) return testOcclusionLeaf(scene, rays, &w->r, child, w->tMax, w->stops) ? SHADOW_BLOCKED : SHADOW_OPEN;
  float8 entry;
  w->bits = laneBits(childEntries8(&w->r, scene->bvh8Nodes + (size_t)child * BVH8_NODE_FLOATS, w->tMax, &entry));
  w->group = child, w->depth = 0;
  int end = SHADOW_ON;
  while (end == SHADOW_ON) end = stepShadow(scene, rays, w);
  return end;
}

/// As nearestBelow; 1 if a ray is blocked. tMax: [16]
int occludedBelow(const SceneView* scene, RayTable* rays, uint lanes, int child, float* tMax, uint* stops) {
  int blocked = 0;
  for (; lanes != 0; lanes &= lanes - 1) {
    const uint lane = lowestBit(lanes);
    ShadowWalk walk;
    takeRay(rays, lane, &walk.r);
    walk.tMax = tMax[lane];
#if HAS(FILTERED_SHADOWS) || HAS(ALPHA_MASK)
    for (int k = 0; k < 3; ++k) walk.stops[k] = stops[k * PACKET_RAYS + lane];
#endif
    const int end = walkShadowBelow(scene, rays, &walk, child);
    endShadow(&walk, end, rays, stops);
    if (end != SHADOW_BLOCKED) continue;
    tMax[lane] = -INFINITY;
    blocked = 1;
  }
  return blocked;
}

#endif
