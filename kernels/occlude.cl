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
  float part[7][8];
  uint entry[8];
  for (uint k = 0; k < 8; ++k) {
    entry[k] = shadowQueue[i + (k < active ? k : 0)];
    for (int plane = 0; plane < 7; ++plane) part[plane][k] = shadows[(size_t)plane * capacity + entry[k]];
  }
  const Packet p = makePacket(vload8(0, part[0]), vload8(0, part[1]), vload8(0, part[2]), vload8(0, part[3]),
                              vload8(0, part[4]), vload8(0, part[5]));
  const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  const float8 length = select((float8)(-1.0f), vload8(0, part[SHADOW_LENGTH]), lane < (int)active);
  uint stops[24];
  for (int k = 0; k < 24; ++k) stops[k] = 0;
  int blocked[8];
  vstore8(occludedPacket(&scene, &p, length, stops), 0, blocked);
  for (uint k = 0; k < active; ++k) {
    if (blocked[k]) continue;
    const uint own[3] = {stops[k], stops[8 + k], stops[16 + k]};
    const float3 contribution = loadPlanes3(shadows, capacity, SHADOW_CONTRIBUTION, entry[k]);
    const float3 before = loadPlanes3(entryRadiance, capacity, 0, entry[k]);
    storePlanes3(entryRadiance, capacity, 0, entry[k], before + contribution * transmittanceFromStops(own));
  }
#elif HAS(WIDE)
  const uint end = min((uint)get_global_id(0) * 8 + 8, count);
  for (uint i = (uint)get_global_id(0) * 8; i < end; ++i) {
    const uint entry = shadowQueue[i];
    const Ray r = makeRay(loadPlanes3(shadows, capacity, SHADOW_O, entry), loadPlanes3(shadows, capacity, SHADOW_D, entry));
    const float3 transmittance = transmittanceWide(&scene, &r, shadows[(size_t)SHADOW_LENGTH * capacity + entry]);
    if (!anyPositive(transmittance)) continue;
    const float3 contribution = loadPlanes3(shadows, capacity, SHADOW_CONTRIBUTION, entry);
    const float3 before = loadPlanes3(entryRadiance, capacity, 0, entry);
    storePlanes3(entryRadiance, capacity, 0, entry, before + contribution * transmittance);
  }
#else
  const uint i = get_global_id(0);
  if (i >= count) return;
  const uint entry = shadowQueue[i];
  const Ray r = makeRay(loadPlanes3(shadows, capacity, SHADOW_O, entry), loadPlanes3(shadows, capacity, SHADOW_D, entry));
  const float3 transmittance = transmittanceSingle(&scene, &r, shadows[(size_t)SHADOW_LENGTH * capacity + entry]);
  if (!anyPositive(transmittance)) return;
  const float3 contribution = loadPlanes3(shadows, capacity, SHADOW_CONTRIBUTION, entry);
  const float3 before = loadPlanes3(entryRadiance, capacity, 0, entry);
  storePlanes3(entryRadiance, capacity, 0, entry, before + contribution * transmittance);
#endif
}
