// Searches for sixteen neighbouring rays at once, one in each lane of a float16. The arithmetic of a lane is that of
// the single-ray search, bit for bit, so the two agree (packet.cl).
//
// Through the eight-wide tree those rays of a packet go down together that run the same way: bounds of their origins
// and directions are held against eight boxes in the lanes of a float8 (interval arithmetic; Boulos, Wald, Shirley,
// "Geometric and Arithmetic Culling Methods for Entire Ray Packets", 2006), then sixteen rays against each box that is
// left, and only triangles whose own boxes the bounds meet are tested. Rays that share no way, or no longer do, are
// walked one by one.
#include "lib/search/alike.cl"
#include "lib/search/part_packet.cl"

#if HAS(PACKETS)

#if !HAS(TREE)
// Leaf after leaf, so that where the corners are is found once for each: of eight triangles in their order, or those of
// a tree that a general program searched before.

void nearestPacket(const SceneView* scene, const Packet* p, PacketHit* best) {
  best->t = wakeFinite(p, best->t);
#if HAS(STRAIGHT)
  best->order = best->t;
#endif
  uint count;
  for (uint first = 0; first < scene->triangleCount; first += count) {
    const Corners leaf = cornersOfTriangle(scene, first);
    count = leaf.stride;
    for (uint lane = 0; lane < count; ++lane) testNearestPacket(scene, p, leaf.at + lane, count, first + lane, best);
  }
}

void occludedPacket(const SceneView* scene, const Packet* p, float16* tMax, uint* stops) {
  *tMax = wakeFinite(p, *tMax);
  uint count;
  for (uint first = 0; first < scene->triangleCount; first += count) {
    const Corners leaf = cornersOfTriangle(scene, first);
    count = leaf.stride;
    for (uint lane = 0; lane < count; ++lane)
      if (testOcclusionPacket(scene, p, leaf.at + lane, count, first + lane, tMax, stops) && allOf16(*tMax < 0.0f))
        return;
  }
}

#else

/// Distances of the planes `at` from `origin`, the least and the greatest for the directions of a packet.
INLINE float8 leastDistance(float8 at, float origin, float inverseLo, float inverseHi) {
  const float8 along = at - origin;
  const float8 a = along * inverseLo, b = along * inverseHi;
  return a < b ? a : b;
}

INLINE float8 greatestDistance(float8 at, float origin, float inverseLo, float inverseHi) {
  const float8 along = at - origin;
  const float8 a = along * inverseLo, b = along * inverseHi;
  return a > b ? a : b;
}

/// Eight boxes (near and far planes): mask of those that some ray of the packet may enter before tMax, and the least
/// distance at which. Rounding is monotonic, so whatever a single ray's test (childEntry) lets in is let in here.
INLINE int8 packetEntries8(const PacketBounds* b, const float8* near, const float8* far, float tMax, float8* entry) {
  const float8 nearX = leastDistance(near[0], b->nearOrigin[0], b->inverseLo[0], b->inverseHi[0]);
  const float8 nearY = leastDistance(near[1], b->nearOrigin[1], b->inverseLo[1], b->inverseHi[1]);
  const float8 nearZ = leastDistance(near[2], b->nearOrigin[2], b->inverseLo[2], b->inverseHi[2]);
  const float8 farX = greatestDistance(far[0], b->farOrigin[0], b->inverseLo[0], b->inverseHi[0]);
  const float8 farY = greatestDistance(far[1], b->farOrigin[1], b->inverseLo[1], b->inverseHi[1]);
  const float8 farZ = greatestDistance(far[2], b->farOrigin[2], b->inverseLo[2], b->inverseHi[2]);
#if HAS(STRAIGHT)
  const float8 begin = (float8)(b->tMin);
#else
  const float8 begin = (float8)(0.0f);
#endif
  const float8 enter = largest8(nearX, nearY, nearZ, begin);
  const float8 leave = smallest8(farX, farY, farZ, (float8)(tMax));
  *entry = enter;
  return enter <= leave * FAR_WIDENING;
}

INLINE int8 packetChildren(const PacketBounds* b, __global const float* node, float tMax, float8* entry) {
  float8 near[3], far[3];
  for (int a = 0; a < 3; ++a) {
    near[a] = vload8(0, node + b->nearPlane[a]);
    far[a] = vload8(0, node + (24 + 16 * a) - b->nearPlane[a]);
  }
  return packetEntries8(b, near, far, tMax, entry);
}

/// One bit for each ray of the packet that enters lane `child` of a node before its own tMax, by the same fma as
/// childEntries8. For packets that run together.
INLINE uint entersChild(const Packet* p, const PacketBounds* b, float16 tMax, __global const float* node, uint child) {
  __global const float* box = node + child;
  const float16 nearX = fma((float16)(box[b->nearPlane[0]]), p->inverse[0], p->nearBias[0]);
  const float16 nearY = fma((float16)(box[b->nearPlane[1]]), p->inverse[1], p->nearBias[1]);
  const float16 nearZ = fma((float16)(box[b->nearPlane[2]]), p->inverse[2], p->nearBias[2]);
  const float16 farX = fma((float16)(box[24 - b->nearPlane[0]]), p->inverse[0], p->farBias[0]);
  const float16 farY = fma((float16)(box[40 - b->nearPlane[1]]), p->inverse[1], p->farBias[1]);
  const float16 farZ = fma((float16)(box[56 - b->nearPlane[2]]), p->inverse[2], p->farBias[2]);
#if HAS(STRAIGHT)
  const float16 begin = p->tMin;
#else
  const float16 begin = (float16)(0.0f);
#endif
  const float16 enter = largest16(nearX, nearY, nearZ, begin);
  const float16 leave = smallest16(farX, farY, farZ, tMax);
  return laneBits16(enter <= leave * FAR_WIDENING);
}

/// Triangles of a leaf whose own boxes the packet may meet.
INLINE uint packetTriangles(const PacketBounds* b, const Leaf* leaf, float tMax) {
  float8 near[3], far[3];
  for (int a = 0; a < 3; ++a) {
    float8 lo, hi;
    leafExtents(leaf, a, &lo, &hi);
    near[a] = b->down[a] ? hi : lo;
    far[a] = b->down[a] ? lo : hi;
  }
  float8 entry;
  return laneBits(packetEntries8(b, near, far, tMax, &entry)) & leafLanes(leaf);
}

/// Nearest hits of the rays in `lanes`, which are alike; the others of `best` sleep.
/// rays: the packet's, once parted.
void nearestTogether(const SceneView* scene, const Packet* p, uint lanes, PacketHit* best, RayTable* rays,
                     int* parted) {
  const PacketBounds bounds = boundPacket(p, lanes);
  // As a single ray's way (Walk), but that a child is looked at more closely before it is visited.
  uint waiting[8 * BVH8_DEPTH];
  int groups[BVH8_DEPTH];
  int depth = 0, group = 0;
  float tMax = greatest16(best->t);
  uint limit = keyLimit(tMax);
  float8 entry;
  uint8 keys = childKeys(packetChildren(&bounds, scene->bvh8Nodes, tMax, &entry), entry);
  COUNT(best->nodes, 1);
  for (;;) {
    const uint least = least8(keys);
    if (least > limit) {
      if (depth == 0) return;
      --depth;
      keys = vload8(depth, waiting);
      group = groups[depth];
      continue;
    }
    keys = select(keys, (uint8)(NO_CHILD), as_uint8(keys == least));
    __global const float* node = scene->bvh8Nodes + (size_t)group * BVH8_NODE_FLOATS;
    const uint entering = entersChild(p, &bounds, best->t, node, least & 7u);
    if (entering == 0) continue;
    const int child = as_int(node[48 + (least & 7u)]);
    if (popcount(entering) <= PACKET_FEW) {
      if (!*parted) *rays = tableOf(p, best->t), *parted = 1;
      nearestBelow(scene, rays, entering, child, best);
      tMax = greatest16(best->t);
      limit = keyLimit(tMax);
      continue;
    }
    if (child < 0) {
      const Leaf leaf = leafOf(scene, child);
      int met = 0;
      for (uint bits = packetTriangles(&bounds, &leaf, tMax); bits != 0; bits &= bits - 1) {
        const uint lane = lowestBit(bits);
        met |= testNearestPacket(scene, p, leaf.corners + lane, leaf.count, leaf.first + lane, best);
      }
      if (met) {
        tMax = greatest16(best->t);
        limit = keyLimit(tMax);
      }
      continue;
    }
    COUNT(best->nodes, 1);
    const int8 entered = packetChildren(&bounds, scene->bvh8Nodes + (size_t)child * BVH8_NODE_FLOATS, tMax, &entry);
    vstore8(keys, depth, waiting);
    groups[depth] = group;
    depth += anyOf8(keys != NO_CHILD);
    keys = childKeys(entered, entry);
    group = child;
  }
}

/// Nearest hits of `lanes`, one by one.
void nearestOneByOne(const SceneView* scene, const Packet* p, int16 lanes, PacketHit* best) {
  RayTable rays = tableOf(p, select((float16)(-1.0f), best->t, lanes));
  nearestApart(scene, &rays);
  best->t = select(best->t, vload16(0, rays.t), lanes);
  best->triangle = select(best->triangle, vload16(0, rays.triangle), as_uint16(lanes));
  best->v = select(best->v, vload16(0, rays.b1), lanes);
  best->w = select(best->w, vload16(0, rays.b2), lanes);
  best->det = select(best->det, (float16)(1.0f), lanes);
#if HAS(STRAIGHT)
  best->order = select(best->order, vload16(0, rays.order), lanes);
#endif
#if HAS(COST)
  best->nodes = select(best->nodes, vload16(0, rays.nodes), as_uint16(lanes));
  best->tests = select(best->tests, vload16(0, rays.tests), as_uint16(lanes));
#endif
}

/// best: t < 0 in lanes that sleep, MAXFLOAT in the others, nothing met (det 1).
void nearestPacket(const SceneView* scene, Packet* p, PacketHit* best) {
  const float16 asleep = (float16)(-1.0f);
  best->t = wakeFinite(p, best->t);
#if HAS(STRAIGHT)
  best->order = best->t;
#endif
  Lanes lanes = lanesOf(p, best->t);
  RayTable rays;
  int parted = 0;
  for (uint bits = nextGroup(p, &lanes); bits != 0; bits = nextGroup(p, &lanes)) {
    const int16 same = lanesOfBits(bits);
    const float16 others = best->t;
    best->t = select(asleep, others, same);
#if HAS(STRAIGHT)
    const float16 otherOrders = best->order;
    best->order = select(asleep, otherOrders, same);
#endif
    findAxes(p, bits);
    nearestTogether(scene, p, bits, best, &rays, &parted);
    best->t = select(others, best->t, same);
#if HAS(STRAIGHT)
    best->order = select(otherOrders, best->order, same);
#endif
  }
  if (lanes.alone != 0) nearestOneByOne(scene, p, lanesOfBits(lanes.alone), best);
}

/// As nearestTogether: tMax < 0 in all other lanes.
void occludedTogether(const SceneView* scene, const Packet* p, uint lanes, float16* tMax, uint* stops, RayTable* rays,
                      int* parted) {
  const PacketBounds bounds = boundPacket(p, lanes);
  uchar waiting[BVH8_DEPTH];
  int groups[BVH8_DEPTH];
  int depth = 0, group = 0;
  float end = greatest16(*tMax);
  float8 entry;
  uint bits = laneBits(packetChildren(&bounds, scene->bvh8Nodes, end, &entry));
  for (;;) {
    while (bits == 0) {
      if (depth == 0) return;
      --depth;
      bits = waiting[depth];
      group = groups[depth];
    }
    __global const float* node = scene->bvh8Nodes + (size_t)group * BVH8_NODE_FLOATS;
    const uint at = lowestBit(bits);
    bits &= bits - 1;
    const uint entering = entersChild(p, &bounds, *tMax, node, at);
    if (entering == 0) continue;
    const int child = as_int(node[48 + at]);
    if (popcount(entering) <= PACKET_FEW) {
      if (!*parted) *rays = tableOf(p, *tMax), *parted = 1;
      if (!occludedBelow(scene, rays, entering, child, (float*)tMax, stops)) continue;
      end = greatest16(*tMax);
      if (end < 0.0f) return;
      continue;
    }
    if (child < 0) {
      const Leaf leaf = leafOf(scene, child);
      int met = 0;
      for (uint left = packetTriangles(&bounds, &leaf, end); left != 0; left &= left - 1) {
        const uint lane = lowestBit(left);
        met |= testOcclusionPacket(scene, p, leaf.corners + lane, leaf.count, leaf.first + lane, tMax, stops);
      }
      if (met) {
        end = greatest16(*tMax);
        if (end < 0.0f) return;
      }
      continue;
    }
    waiting[depth] = (uchar)bits;
    groups[depth] = group;
    depth += bits != 0;
    bits = laneBits(packetChildren(&bounds, scene->bvh8Nodes + (size_t)child * BVH8_NODE_FLOATS, end, &entry));
    group = child;
  }
}

/// tMax: lengths, < 0 in lanes that sleep; -inf afterwards where the light is blocked. stops: [3][16].
void occludedPacket(const SceneView* scene, Packet* p, float16* tMax, uint* stops) {
  const float16 asleep = (float16)(-1.0f);
  *tMax = wakeFinite(p, *tMax);
  Lanes lanes = lanesOf(p, *tMax);
  RayTable rays;
  int parted = 0;
  for (uint bits = nextGroup(p, &lanes); bits != 0; bits = nextGroup(p, &lanes)) {
    const int16 same = lanesOfBits(bits);
    float16 own = select(asleep, *tMax, same);
    findAxes(p, bits);
    occludedTogether(scene, p, bits, &own, stops, &rays, &parted);
    *tMax = select(*tMax, own, same);
  }
  if (lanes.alone == 0) return;
  const int16 alone = lanesOfBits(lanes.alone);
  rays = tableOf(p, select(asleep, *tMax, alone));
  occludedApart(scene, &rays, stops);
  *tMax = select(*tMax, vload16(0, rays.t), alone);
}
#endif

#endif
