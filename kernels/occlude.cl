// occlude: what of the light reaches each shadow ray's origin. Reads the shadow queue (indices of candidates), adds
// contribution · transmittance to the entry's radiance: an entry has one shadow ray for each light round, so no two
// work items add to the same place.
#include "lib/search/traverse_packet.cl"

#if HAS(PACKETS)
/// Sixteen entries of a shadow queue that are in use.
typedef struct {
  __global const uint* entries;
  uint active;     // lanes in use
  int neighbours;  // 1: sixteen entries in a row, so that planes are read and written whole
} ShadowLanes;

/// A plane of the candidates, one entry in each lane; lanes out of use copy the first.
INLINE float16 loadLanes(const ShadowLanes* s, __global const float* plane) {
  if (s->neighbours) return vload16(0, plane + s->entries[0]);
  float part[PACKET_RAYS];
  for (uint k = 0; k < PACKET_RAYS; ++k) part[k] = plane[s->entries[k < s->active ? k : 0]];
  return vload16(0, part);
}

INLINE void addLight(const ShadowLanes* s, int16 blocked, const uint* stops, __global const float* shadows,
                     uint capacity, __global float* entryRadiance) {
#if !HAS(FILTERED_SHADOWS)
  if (s->neighbours) {
    for (int c = 0; c < 3; ++c) {
      __global float* radiance = entryRadiance + (size_t)c * capacity + s->entries[0];
      const float16 before = vload16(0, radiance);
      const float16 contribution = loadLanes(s, shadows + (size_t)(SHADOW_CONTRIBUTION + c) * capacity);
      vstore16(select(before + contribution, before, blocked), 0, radiance);
    }
    return;
  }
#endif
  int dark[PACKET_RAYS];
  vstore16(blocked, 0, dark);
  for (uint k = 0; k < s->active; ++k) {
    if (dark[k]) continue;
    const uint own[3] = {stops[k], stops[PACKET_RAYS + k], stops[2 * PACKET_RAYS + k]};
    const uint entry = s->entries[k];
    const Real3 contribution = loadReal3(shadows, capacity, SHADOW_CONTRIBUTION, entry);
    const Real3 before = loadReal3(entryRadiance, capacity, 0, entry);
    storeReal3(entryRadiance, capacity, 0, entry, add3(before, mul3(contribution, transmittanceFromStops(own))));
  }
}
#endif

__kernel void occlude(SCENE_PARAMS, const uint count, const uint capacity, const uint set,
                      __global const uint* shadowQueue,  // [count] entries with a shadow ray, in order
                      __global const float* shadows,     // [sets][SHADOW_PLANES][capacity] candidates by entry
                      __global float* entryRadiance,     // [3][capacity]
                      __global uint* counters) {         // COUNTER_SPENT_WALK; may be null
  const SceneView scene = SCENE_VIEW;
  shadows += (size_t)set * SHADOW_PLANES * capacity;
#if HAS(PACKETS)
  const uint i = (uint)get_global_id(0) * PACKET_RAYS;
  if (i >= count) return;
  ShadowLanes s;
  s.entries = shadowQueue + i;
  s.active = min(count - i, (uint)PACKET_RAYS);
  // The queue is in order, so sixteen entries that span sixteen are neighbours.
  s.neighbours = s.active == PACKET_RAYS && s.entries[PACKET_RAYS - 1] == s.entries[0] + PACKET_RAYS - 1;
  float16 o[3], d[3];
  for (int a = 0; a < 3; ++a) {
    o[a] = loadLanes(&s, shadows + (size_t)(SHADOW_O + a) * capacity);
    d[a] = loadLanes(&s, shadows + (size_t)(SHADOW_D + a) * capacity);
  }
  Packet p = makePacket(o, d);
  const int16 lane = (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const float16 length = loadLanes(&s, shadows + (size_t)SHADOW_LENGTH * capacity);
  // Nothing lies before a length of 0, less, or NaN.
  float16 tMax = select((float16)(-1.0f), length, (lane < (int)s.active) & (length > 0.0f));
  uint stops[3 * PACKET_RAYS];
#if HAS(FILTERED_SHADOWS) || HAS(ALPHA_MASK)
  for (int k = 0; k < 3 * PACKET_RAYS; ++k) stops[k] = 0;
#endif
  occludedPacket(&scene, &p, &tMax, stops);
  addLight(&s, tMax == -INFINITY, stops, shadows, capacity, entryRadiance);
#else
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const uint entry = shadowQueue[i];
  const Ray r = makeRay(loadReal3(shadows, capacity, SHADOW_O, entry), loadReal3(shadows, capacity, SHADOW_D, entry));
  uint left = LOOP_BUDGET;
  const Real3 transmittance = transmittanceSingle(&scene, &r, shadows[(size_t)SHADOW_LENGTH * capacity + entry], &left);
  tellSpent(left, counters);
  if (!anyPositive(transmittance)) return;
  const Real3 contribution = loadReal3(shadows, capacity, SHADOW_CONTRIBUTION, entry);
  const Real3 before = loadReal3(entryRadiance, capacity, 0, entry);
  storeReal3(entryRadiance, capacity, 0, entry, add3(before, mul3(contribution, transmittance)));
#endif
}
