// intersect: the nearest hit of each ray of a segment of the ray queue. One ray for each work item, or eight
// neighbouring ones (PACKETS). Writes the hit queue; entry i of the hits belongs to ray first + i.
#include "lib/traverse_wide.cl"

__kernel void intersect(SCENE_PARAMS, const uint first, const uint count, const uint capacity,
                        __global const float* rays,  // [RAY_PLANES][capacity]
                        __global float* hits) {      // [HIT_PLANES][capacity]
  const SceneView scene = SCENE_VIEW;
  const size_t stride = capacity;
#if HAS(PACKETS)
  const uint i = (uint)get_global_id(0) * 8;
  if (i >= count) return;
  __global const float* r = rays + first + i;
  const Packet p = makePacket(vload8(0, r + RAY_O * stride), vload8(0, r + (RAY_O + 1) * stride),
                              vload8(0, r + (RAY_O + 2) * stride), vload8(0, r + RAY_D * stride),
                              vload8(0, r + (RAY_D + 1) * stride), vload8(0, r + (RAY_D + 2) * stride));
  const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  const int8 awake = lane < (int)(count - i);
  const PacketHit hit = nearestPacket(&scene, &p, select((float8)(-1.0f), (float8)(MAXFLOAT), awake));
  vstore8(hit.t, 0, hits + HIT_T * stride + i);
  vstore8(as_float8(hit.triangle), 0, hits + HIT_TRIANGLE * stride + i);
  vstore8(hit.b1, 0, hits + HIT_B1 * stride + i);
  vstore8(hit.b2, 0, hits + HIT_B2 * stride + i);
#else
  const uint begin = (uint)get_global_id(0) * RAYS_EACH, end = min(begin + RAYS_EACH, count);
  for (uint i = begin; i < end; ++i) {
    const Ray r = makeRay(loadPlanes3(rays, capacity, RAY_O, first + i), loadPlanes3(rays, capacity, RAY_D, first + i));
    const Hit hit = nearestOne(&scene, &r);
    hits[HIT_T * stride + i] = hit.t;
    hits[HIT_TRIANGLE * stride + i] = as_float(hit.triangle);
    hits[HIT_B1 * stride + i] = hit.b1;
    hits[HIT_B2 * stride + i] = hit.b2;
  }
#endif
}
