// The eight-wide tree (host/bvh/bvh8.h) as searches see it: leaves, masks of eight lanes, the order of children.
#include "lib/search/traverse_bvh2.cl"

#if HAS(TREE) && HAS(PACKETS)

#define BVH8_NODE_FLOATS 64  // lo[3][8], hi[3][8], child[8], pad

/// Up to eight triangles: first, first + 1, … in leaf order.
typedef struct {
  __global const float* corners;  // [3 corners][3 axes][count], m; may be read eight floats beyond
  uint first, count;
} Leaf;

INLINE Leaf leafOf(const SceneView* scene, int child) {
  const uint packed = (uint)~child;
  Leaf leaf;
  leaf.first = packed >> 3;
  leaf.count = (packed & 7u) + 1;
  leaf.corners = scene->leaves + (size_t)leaf.first * 9;
  return leaf;
}

/// One coordinate of one corner of all the leaf's triangles; lanes beyond its count hold others.
INLINE float8 leafPlane(const Leaf* leaf, int corner, int axis) {
  return vload8(0, leaf->corners + (uint)(3 * corner + axis) * leaf->count);
}

/// Where the leaf's triangles begin and end along an axis.
INLINE void leafExtents(const Leaf* leaf, int axis, float8* lo, float8* hi) {
  const float8 a = leafPlane(leaf, 0, axis), b = leafPlane(leaf, 1, axis), c = leafPlane(leaf, 2, axis);
  const float8 least = a < b ? a : b, greatest = a < b ? b : a;
  *lo = c < least ? c : least;
  *hi = c > greatest ? c : greatest;
}

INLINE uint leafLanes(const Leaf* leaf) { return (1u << leaf->count) - 1u; }

/// Children of a node as keys: the bits of the distance at which each is entered (not negative, so that they sort as
/// integers), with the lane in the lowest three bits; NO_CHILD where there is none. A key is never above its distance.
#define NO_CHILD 0xffffffffu

INLINE uint8 childKeys(int8 entered, float8 entry) {
  const uint8 lane = (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
  return select((uint8)(NO_CHILD), (as_uint8(entry) & ~7u) | lane, as_uint8(entered));
}

/// Keys above this belong to children that lie behind t.
INLINE uint keyLimit(float t) { return as_uint(t * FAR_WIDENING) | 7u; }

#endif
