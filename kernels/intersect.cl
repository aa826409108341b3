// intersect: the nearest hit of each ray of a segment of the ray queue. One ray for each work item, or sixteen
// neighbouring ones (PACKETS). Writes the hit queue, distances if it has room for them; entry i of the hits belongs to
// ray first + i. (An argument, not a feature: what asks for distances leaves the searches as they are.)
#include "lib/search/traverse_packet.cl"

#if HAS(STRAIGHT) && HAS(PACKETS)
/// What sixteen rays have passed; `rays` begins at the first. Lanes out of use copy that one, as above.
INLINE void passSurfaces(const SceneView* scene, __global const float* rays, size_t stride, int16 awake, Packet* p) {
  __global const float* orders = rays + RAY_AFTER_ORDER * stride;
  float order[PACKET_RAYS];
  uint primitive[PACKET_RAYS];
  int used[PACKET_RAYS];
  vstore16(awake, 0, used);
  for (uint k = 0; k < PACKET_RAYS; ++k) {
    const uint own = used[k] ? k : 0;
    const Passed passed = passedSurface(scene, orders[own], as_uint(rays[RAY_AFTER_TRIANGLE * stride + own]));
    order[k] = passed.order;
    primitive[k] = passed.primitive;
  }
  p->passedOrder = vload16(0, order);
  p->passedPrimitive = vload16(0, primitive);
  p->tMin = p->passedOrder * PASSED_MARGIN;
}
#endif

__kernel void intersect(SCENE_PARAMS, const uint first, const uint count, const uint capacity,
                        __global const float* rays,  // [RAY_PLANES][capacity]
                        __global float* hits,        // [hitPlanes][capacity]
                        const uint hitPlanes,
                        const uint continued,       // 1: some rays went straight on (RAY_AFTER_…)
                        __global uint* counters) {  // COUNTER_SPENT_WALK; may be null
  const SceneView scene = SCENE_VIEW;
  const size_t stride = capacity;
#if HAS(PACKETS)
  const uint i = (uint)get_global_id(0) * PACKET_RAYS;
  if (i >= count) return;
  const int16 lane = (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const int16 awake = lane < (int)(count - i);
  float16 o[3], d[3];
  for (int a = 0; a < 3; ++a) {
    // Lanes past the end are copies of the first ray, asleep: they must not widen the packet's bounds.
    __global const float* from = rays + (size_t)(RAY_O + a) * stride + first + i;
    __global const float* along = rays + (size_t)(RAY_D + a) * stride + first + i;
    o[a] = select((float16)(from[0]), vload16(0, from), awake);
    d[a] = select((float16)(along[0]), vload16(0, along), awake);
  }
  Packet p = makePacket(o, d);
#if HAS(STRAIGHT)
  if (continued) passSurfaces(&scene, rays + first + i, stride, awake, &p);
#endif
  PacketHit hit;
  hit.t = select((float16)(-1.0f), (float16)(MAXFLOAT), awake);
  hit.triangle = (uint16)(NO_HIT);
  hit.v = hit.w = (float16)(0.0f);
  hit.det = (float16)(1.0f);
#if HAS(STRAIGHT)
  hit.order = hit.t;
#endif
#if HAS(COST)
  hit.nodes = hit.tests = (uint16)(0);
#endif
  nearestPacket(&scene, &p, &hit);
#if HAS(STRAIGHT)
  vstore16(hit.order, 0, hits + HIT_ORDER * stride + i);
#endif
  if (hitPlanes > HIT_T) vstore16(hit.t, 0, hits + HIT_T * stride + i);
  vstore16(as_float16(hit.triangle), 0, hits + HIT_TRIANGLE * stride + i);
  vstore16(hit.v / hit.det, 0, hits + HIT_B1 * stride + i);
  vstore16(hit.w / hit.det, 0, hits + HIT_B2 * stride + i);
#if HAS(COST)
  if (hitPlanes > HIT_TESTS) {
    vstore16(as_float16(hit.nodes), 0, hits + HIT_NODES * stride + i);
    vstore16(as_float16(hit.tests), 0, hits + HIT_TESTS * stride + i);
  }
#endif
#else
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  uint left = LOOP_BUDGET;
#if HAS(STRAIGHT)
  Ray r = makeRay(loadReal3(rays, capacity, RAY_O, first + i), loadReal3(rays, capacity, RAY_D, first + i));
  if (continued)
    r.passed = passedSurface(&scene, rays[RAY_AFTER_ORDER * stride + first + i],
                             as_uint(rays[RAY_AFTER_TRIANGLE * stride + first + i]));
  const Hit hit = nearestSingle(&scene, &r, &left);
  hits[HIT_ORDER * stride + i] = hit.order;
#else
  const Ray r = makeRay(loadReal3(rays, capacity, RAY_O, first + i), loadReal3(rays, capacity, RAY_D, first + i));
  const Hit hit = nearestSingle(&scene, &r, &left);
#endif
  tellSpent(left, counters);
  if (hitPlanes > HIT_T) hits[HIT_T * stride + i] = hit.t;
  hits[HIT_TRIANGLE * stride + i] = as_float(hit.triangle);
  hits[HIT_B1 * stride + i] = hit.b1;
  hits[HIT_B2 * stride + i] = hit.b2;
#if HAS(COST)
  if (hitPlanes > HIT_TESTS) {
    hits[HIT_NODES * stride + i] = as_float(hit.nodes);
    hits[HIT_TESTS * stride + i] = as_float(hit.tests);
  }
#endif
#endif
}
