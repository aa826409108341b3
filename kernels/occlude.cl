// occlude: what of the light reaches each shadow ray's origin. Reads the shadow queue (indices of candidates), adds
// contribution · transmittance to the entry's radiance: an entry has one shadow ray for each light round, so no two
// work items add to the same place.
#include "lib/traverse_wide.cl"

__kernel void occlude(SCENE_PARAMS, const uint count, const uint capacity,
                      __global const uint* shadowQueue,   // [count] entries with a shadow ray, in order
                      __global const float* shadows,      // [SHADOW_PLANES][capacity] candidates by entry
                      __global float* entryRadiance) {    // [3][capacity]
  const SceneView scene = SCENE_VIEW;
#if HAS(PACKETS)
  const uint i = (uint)get_global_id(0) * 8;
  if (i >= count) return;
  const uint active = count - i < 8 ? count - i : 8;
  const uint start = shadowQueue[i];
  const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  float8 plane[7];
  // The queue is in order, so eight entries that span eight are neighbours: whole planes are read, not lanes one by one.
  const int neighbours = active == 8 && shadowQueue[i + 7] == start + 7;
  if (neighbours) {
    for (int k = 0; k < 7; ++k) plane[k] = vload8(0, shadows + (size_t)k * capacity + start);
  } else {
    float part[7][8];
    for (uint k = 0; k < 8; ++k) {
      const uint entry = shadowQueue[i + (k < active ? k : 0)];
      for (int n = 0; n < 7; ++n) part[n][k] = shadows[(size_t)n * capacity + entry];
    }
    for (int k = 0; k < 7; ++k) plane[k] = vload8(0, part[k]);
  }
  const Packet p = makePacket(plane[0], plane[1], plane[2], plane[3], plane[4], plane[5]);
  const float8 length = select((float8)(-1.0f), plane[SHADOW_LENGTH], lane < (int)active);
  uint stops[24];
#if HAS(FILTERED_SHADOWS) || HAS(ALPHA_MASK)
  for (int k = 0; k < 24; ++k) stops[k] = 0;
#endif
  const int8 blocked = occludedPacket(&scene, &p, length, stops);
#if !HAS(FILTERED_SHADOWS)
  if (neighbours) {
    for (int c = 0; c < 3; ++c) {
      __global float* radiance = entryRadiance + (size_t)c * capacity + start;
      const float8 before = vload8(0, radiance);
      const float8 contribution = vload8(0, shadows + (size_t)(SHADOW_CONTRIBUTION + c) * capacity + start);
      vstore8(select(before + contribution, before, blocked), 0, radiance);
    }
    return;
  }
#endif
  int dark[8];
  vstore8(blocked, 0, dark);
  for (uint k = 0; k < active; ++k) {
    if (dark[k]) continue;
    const uint own[3] = {stops[k], stops[8 + k], stops[16 + k]};
    const uint entry = shadowQueue[i + k];
    const float3 contribution = loadPlanes3(shadows, capacity, SHADOW_CONTRIBUTION, entry);
    const float3 before = loadPlanes3(entryRadiance, capacity, 0, entry);
    storePlanes3(entryRadiance, capacity, 0, entry, before + contribution * transmittanceFromStops(own));
  }
#else
  const uint begin = (uint)get_global_id(0) * RAYS_EACH, end = min(begin + RAYS_EACH, count);
  for (uint i = begin; i < end; ++i) {
    const uint entry = shadowQueue[i];
    const Ray r = makeRay(loadPlanes3(shadows, capacity, SHADOW_O, entry), loadPlanes3(shadows, capacity, SHADOW_D, entry));
    const float3 transmittance = transmittanceOne(&scene, &r, shadows[(size_t)SHADOW_LENGTH * capacity + entry]);
    if (!anyPositive(transmittance)) continue;
    const float3 contribution = loadPlanes3(shadows, capacity, SHADOW_CONTRIBUTION, entry);
    const float3 before = loadPlanes3(entryRadiance, capacity, 0, entry);
    storePlanes3(entryRadiance, capacity, 0, entry, before + contribution * transmittance);
  }
#endif
}
