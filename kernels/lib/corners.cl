// The corners of triangles, m, world space: kept once, in the order in which searches read them. For packets they lie
// leaf by leaf as structs of arrays (host/bvh/bvh8.h), else triangle after triangle.
#include "lib/lanes.cl"
#include "lib/scene.cl"

/// Coordinate `axis` of corner k: float first + (3 k + axis) stride of scene->leaves. Below 2^31, as triangles are
/// below 2^27.
typedef struct {
  Natural first, stride;
} CornerPlace;

/// Of a triangle in leaf order.
INLINE CornerPlace cornerPlace(const SceneView* scene, Natural triangle) {
  CornerPlace place;
#if HAS(PACKETS)
  __global const uint* flags = (__global const uint*)scene->triangles + WORD_OF(DeviceTriangle, flags);
  const Natural at = gatherWords(flags, triangle * WORDS_OF(DeviceTriangle)) >> TRIANGLE_PLACE;
  const Natural lane = at & 7u;
  place.first = (triangle - lane) * 9u + lane;
  place.stride = (at >> 3 & 7u) + 1u;
#else
  place.first = triangle * 9u;
  place.stride = (Natural)(1);
#endif
  return place;
}

INLINE Real3 cornerAt(const SceneView* scene, const CornerPlace* place, uint corner) {
  const Mask x = TO_SIGNED(place->first + place->stride * (3u * corner)), step = TO_SIGNED(place->stride);
  return real3(gatherNear(scene->leaves, x), gatherNear(scene->leaves, x + step),
               gatherNear(scene->leaves, x + step + step));
}
