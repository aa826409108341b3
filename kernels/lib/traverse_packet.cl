// Searches for sixteen neighbouring rays at once, one in each lane of a float16. The arithmetic of a lane is that of the
// single-ray search, bit for bit, so the two agree.
//
// Through the eight-wide tree the packet goes down once, as long as its rays run the same way: bounds of its origins and
// directions are held against eight boxes in the lanes of a float8 (interval arithmetic; Boulos, Wald, Shirley, "Geometric
// and Arithmetic Culling Methods for Entire Ray Packets", 2006), then sixteen rays against each box that is left, and only
// triangles whose own boxes the bounds meet are tested. Rays that share no way are walked one by one.
#include "lib/traverse_wide.cl"

#if HAS(PACKETS)

typedef struct {
  float16 o[3];
  float16 d[3];
  float16 inverse[3];
  float16 nearBias[3], farBias[3];  // as in WideRay
  float16 shear[3];                 // sx, sy, sz of each lane's own axes
  int16 kz;                         // largest axis of the direction
  int axes[3];                      // 1: some lane has this axis
  int mixed;                        // 1: lanes differ in it
} Packet;

typedef struct {
  float16 t;  // nearest so far; < 0: lane asleep
  uint16 triangle;
  float16 v, w, det;  // areas: the barycentrics b1 and b2 are v/det and w/det
} PacketHit;

INLINE float16 boxInverse16(float16 d) { return fabs(d) > 1e-18f ? 1.0f / d : copysign((float16)(INFINITY), d); }

INLINE Packet makePacket(const float16* o, const float16* d) {
  Packet p;
  for (int a = 0; a < 3; ++a) {
    p.o[a] = o[a];
    p.d[a] = d[a];
    p.inverse[a] = boxInverse16(d[a]);
    const float16 bias = -p.o[a] * p.inverse[a], margin = fabs(bias) * BIAS_MARGIN;
    p.nearBias[a] = bias - margin;
    p.farBias[a] = bias + margin;
  }
  const float16 ax = fabs(d[0]), ay = fabs(d[1]), az = fabs(d[2]);
  const int16 xFirst = (ax > ay) & (ax > az);
  const int16 yFirst = ~(ax > ay) & (ay > az);
  p.kz = select(select((int16)(2), (int16)(1), yFirst), (int16)(0), xFirst);
  p.axes[0] = anyOf16(xFirst);
  p.axes[1] = anyOf16(yFirst);
  p.axes[2] = anyOf16(~(xFirst | yFirst));
  p.mixed = p.axes[0] + p.axes[1] + p.axes[2] > 1;
  const float16 dkz = select(select(d[2], d[1], yFirst), d[0], xFirst);
  const float16 dkx = select(select(d[0], d[2], yFirst), d[1], xFirst);
  const float16 dky = select(select(d[1], d[0], yFirst), d[2], xFirst);
  p.shear[2] = 1.0f / dkz;
  p.shear[0] = dkx * p.shear[2];
  p.shear[1] = dky * p.shear[2];
  return p;
}

/// tMax, but < 0 in lanes with NaN or infinite parts.
INLINE float16 wakeFinite(const Packet* p, float16 tMax) {
  int16 finite = isfinite(p->o[0]) & isfinite(p->o[1]) & isfinite(p->o[2]);
  finite &= isfinite(p->d[0]) & isfinite(p->d[1]) & isfinite(p->d[2]);
  return select((float16)(-1.0f), tMax, finite);
}

/// clampToBox for the rays of a packet.
float16 clampToBox16(const Packet* p, __global const float* triangle, uint stride, float16 t) {
  float16 far[3];
  for (uint a = 0; a < 3; ++a) {
    const float v0 = triangle[a * stride], v1 = triangle[(3 + a) * stride], v2 = triangle[(6 + a) * stride];
    float lo = v0 < v1 ? v0 : v1, hi = v0 < v1 ? v1 : v0;
    lo = v2 < lo ? v2 : lo;
    hi = v2 > hi ? v2 : hi;
    const float16 first = (lo - p->o[a]) * p->inverse[a], second = (hi - p->o[a]) * p->inverse[a];
    const int16 down = as_int16(p->inverse[a]);  // select reads the sign bit
    const float16 near = select(first, second, down);
    far[a] = select(second, first, down);
    t = near > t ? near : t;
  }
  for (int a = 0; a < 3; ++a) t = far[a] < t ? far[a] : t;
  return t;
}

/// Lanes whose largest axis is kz and that meet a triangle at 0 < t <= tMax. Its coordinates: corner k, axis a at
/// triangle[(3 k + a) stride].
INLINE int16 intersectAxis(const Packet* p, __global const float* triangle, uint stride, int kz, float16 tMax, float16* t,
                           float16* areaV, float16* areaW, float16* area) {
  const uint kx = kz == 2 ? 0 : kz + 1;
  const uint ky = kx == 2 ? 0 : kx + 1;
  const float16 ox = p->o[kx], oy = p->o[ky], oz = p->o[kz];
  const float16 sx = -p->shear[0], sy = -p->shear[1];
  const float16 az = triangle[(0 + kz) * stride] - oz;
  const float16 bz = triangle[(3 + kz) * stride] - oz;
  const float16 cz = triangle[(6 + kz) * stride] - oz;
  const float16 ax = fma(sx, az, triangle[(0 + kx) * stride] - ox);
  const float16 ay = fma(sy, az, triangle[(0 + ky) * stride] - oy);
  const float16 bx = fma(sx, bz, triangle[(3 + kx) * stride] - ox);
  const float16 by = fma(sy, bz, triangle[(3 + ky) * stride] - oy);
  const float16 cx = fma(sx, cz, triangle[(6 + kx) * stride] - ox);
  const float16 cy = fma(sy, cz, triangle[(6 + ky) * stride] - oy);
  const float16 u = differenceOfProducts16(cx, by, cy, bx);
  const float16 v = differenceOfProducts16(ax, cy, ay, cx);
  const float16 w = differenceOfProducts16(bx, ay, by, ax);
  int16 inside = ((u >= 0.0f) & (v >= 0.0f) & (w >= 0.0f)) | ((u <= 0.0f) & (v <= 0.0f) & (w <= 0.0f));
  if (p->mixed) inside &= p->kz == kz;
  if (!anyOf16(inside)) return inside;
  const float16 det = u + v + w;
  *t = fma(u, az, fma(v, bz, w * cz)) * p->shear[2] / det;
  const float16 ab = fabs(az) > fabs(bz) ? fabs(az) : fabs(bz), corners = ab > fabs(cz) ? ab : fabs(cz);
  const int16 far = corners * fabs(p->shear[2]) > FAR_CORNERS * fabs(*t);
  if (anyOf16(inside & far)) *t = select(*t, clampToBox16(p, triangle, stride, *t), far);
  *areaV = v, *areaW = w, *area = det;
  return inside & (*t > 0.0f) & (*t <= tMax);
}

/// All lanes against one triangle; merges the axes that occur in the packet.
INLINE int16 intersectPacket(const Packet* p, __global const float* triangle, uint stride, float16 tMax, float16* t,
                             float16* v, float16* w, float16* det) {
  int16 met = (int16)(0);
#pragma unroll
  for (int kz = 0; kz < 3; ++kz) {
    if (!p->axes[kz]) continue;
    float16 tk, vk, wk, detk;
    const int16 m = intersectAxis(p, triangle, stride, kz, tMax, &tk, &vk, &wk, &detk);
    if (!anyOf16(m)) continue;
    *t = select(*t, tk, m);
    *v = select(*v, vk, m);
    *w = select(*w, wk, m);
    *det = select(*det, detk, m);
    met |= m;
  }
  return met;
}

/// The lanes of `ties` in which triangle `index` comes before the one held.
int16 firstOfTies(const SceneView* scene, uint index, int16 ties, uint16 held) {
  int lanes[PACKET_RAYS];
  uint other[PACKET_RAYS];
  vstore16(ties, 0, lanes);
  vstore16(held, 0, other);
  for (int i = 0; i < PACKET_RAYS; ++i) lanes[i] = lanes[i] && comesFirst(scene, index, other[i]) ? -1 : 0;
  return vload16(0, lanes);
}

#if HAS(ALPHA_MASK)
/// The lanes of `met` whose hit with triangle `index` (leaf order) is not cut out.
int16 passAlphaMask(const SceneView* scene, uint index, int16 met, float16 b1, float16 b2) {
  if (!(scene->triangles[index].flags & TRIANGLE_MASKED)) return met;
  int lanes[PACKET_RAYS];
  float b1s[PACKET_RAYS], b2s[PACKET_RAYS];
  vstore16(met, 0, lanes);
  vstore16(b1, 0, b1s);
  vstore16(b2, 0, b2s);
  for (int i = 0; i < PACKET_RAYS; ++i)
    if (lanes[i] && !passesAlphaMask(scene, index, b1s[i], b2s[i])) lanes[i] = 0;
  return vload16(0, lanes);
}
#endif

/// 1 if a lane found something nearer.
INLINE int testNearestPacket(const SceneView* scene, const Packet* p, __global const float* triangle, uint stride, uint index,
                             PacketHit* best) {
  float16 t = (float16)(0.0f), v = t, w = t, det = t;
  int16 met = intersectPacket(p, triangle, stride, best->t, &t, &v, &w, &det);
  if (!anyOf16(met)) return 0;
  const int16 ties = met & (t == best->t);
  if (anyOf16(ties)) met &= ~ties | firstOfTies(scene, index, ties, best->triangle);
#if HAS(ALPHA_MASK)
  met = passAlphaMask(scene, index, met, v / det, w / det);
#endif
  best->t = select(best->t, t, met);
  best->v = select(best->v, v, met);
  best->w = select(best->w, w, met);
  best->det = select(best->det, det, met);
  best->triangle = select(best->triangle, (uint16)(index), as_uint16(met));
  return 1;
}

#if HAS(FILTERED_SHADOWS) || HAS(ALPHA_MASK)
/// The lanes of `met` that triangle `index` (leaf order) blocks; the others may be dimmed. stops: [3][16], see testOcclusion.
int16 filterOcclusion(const SceneView* scene, const Packet* p, uint index, int16 met, float16 tMax, uint* stops) {
  if (!(scene->triangles[index].flags & (TRIANGLE_FILTERS | TRIANGLE_MASKED))) return met;
  int lanes[PACKET_RAYS];
  float o[3][PACKET_RAYS], d[3][PACKET_RAYS], ends[PACKET_RAYS];
  vstore16(met, 0, lanes);
  vstore16(tMax, 0, ends);
  for (int a = 0; a < 3; ++a) {
    vstore16(p->o[a], 0, o[a]);
    vstore16(p->d[a], 0, d[a]);
  }
  for (int i = 0; i < PACKET_RAYS; ++i) {
    if (!lanes[i]) continue;
    const Ray r = makeRay((float3)(o[0][i], o[1][i], o[2][i]), (float3)(d[0][i], d[1][i], d[2][i]));
    uint own[3];
    for (int k = 0; k < 3; ++k) own[k] = stops[k * PACKET_RAYS + i];
    if (!testOcclusion(scene, &r, index, ends[i], own)) lanes[i] = 0;
    for (int k = 0; k < 3; ++k) stops[k * PACKET_RAYS + i] = own[k];
  }
  return vload16(0, lanes);
}
#endif

/// Shadow lanes against one triangle: tMax becomes -inf where the light is now blocked. stops: [3][16], see testOcclusion.
/// 1 if a lane met it.
INLINE int testOcclusionPacket(const SceneView* scene, const Packet* p, __global const float* triangle, uint stride, uint index,
                               float16* tMax, uint* stops) {
  float16 t = (float16)(0.0f), v = t, w = t, det = t;
  int16 met = intersectPacket(p, triangle, stride, *tMax, &t, &v, &w, &det);
  met &= t < *tMax;
  if (!anyOf16(met)) return 0;
#if HAS(FILTERED_SHADOWS) || HAS(ALPHA_MASK)
  met = filterOcclusion(scene, p, index, met, *tMax, stops);
#endif
  *tMax = select(*tMax, (float16)(-INFINITY), met);
  return 1;
}

#if !HAS(TREE)

void nearestPacket(const SceneView* scene, const Packet* p, PacketHit* best) {
  best->t = wakeFinite(p, best->t);
  for (uint i = 0; i < scene->triangleCount; ++i)
    testNearestPacket(scene, p, &scene->triangles[i].v[0][0], 1, i, best);
}

void occludedPacket(const SceneView* scene, const Packet* p, float16* tMax, uint* stops) {
  *tMax = wakeFinite(p, *tMax);
  for (uint i = 0; i < scene->triangleCount; ++i)
    if (testOcclusionPacket(scene, p, &scene->triangles[i].v[0][0], 1, i, tMax, stops) && allOf16(*tMax < 0.0f)) return;
}

#else

/// Bounds of a packet: what can make the distance to a plane least and greatest.
typedef struct {
  float nearOrigin[3];  // origin for which the near plane's distance is least
  float farOrigin[3];   // origin for which the far plane's distance is greatest
  float inverseLo[3], inverseHi[3];
  int nearPlane[3];  // floats from a node to its near planes: 8 · axis, and 24 for hi
  int down[3];       // 1: directions are negative
  int together;      // 1: the rays run the same way, no direction parallel to an axis
} PacketBounds;

/// Largest difference between directions along an axis for which rays run the same way; from 0.1 to 0.25 nothing changes,
/// above it rays of a second bounce drag one another along (experiments/).
#define PACKET_SPREAD 0.25f

INLINE PacketBounds boundPacket(const Packet* p) {
  PacketBounds b;
  b.together = 1;
  for (int a = 0; a < 3; ++a) {
    const float lo = least16(p->o[a]), hi = greatest16(p->o[a]);
    b.inverseLo[a] = least16(p->inverse[a]);
    b.inverseHi[a] = greatest16(p->inverse[a]);
    b.down[a] = b.inverseHi[a] < 0.0f;
    b.nearOrigin[a] = b.down[a] ? lo : hi;
    b.farOrigin[a] = b.down[a] ? hi : lo;
    b.nearPlane[a] = a * 8 + 24 * b.down[a];
    if (!(b.inverseLo[a] > 0.0f || b.inverseHi[a] < 0.0f)) b.together = 0;
    if (!(b.inverseLo[a] > -INFINITY && b.inverseHi[a] < INFINITY)) b.together = 0;
    if (!(fabs(greatest16(p->d[a]) - least16(p->d[a])) <= PACKET_SPREAD)) b.together = 0;
  }
  // 0 but for lanes with NaN or infinite parts: those go alone.
  const float16 zero = (p->o[0] - p->o[0]) + (p->o[1] - p->o[1]) + (p->o[2] - p->o[2]) + (p->d[0] - p->d[0]) +
                       (p->d[1] - p->d[1]) + (p->d[2] - p->d[2]);
  if (!allOf16(zero == 0.0f)) b.together = 0;
  return b;
}

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
/// distance at which. Rounding is monotonic, so whatever a single ray's test lets in is let in here.
INLINE int8 packetEntries(const PacketBounds* b, const float8* near, const float8* far, float tMax, float8* entry) {
  const float8 nearX = leastDistance(near[0], b->nearOrigin[0], b->inverseLo[0], b->inverseHi[0]);
  const float8 nearY = leastDistance(near[1], b->nearOrigin[1], b->inverseLo[1], b->inverseHi[1]);
  const float8 nearZ = leastDistance(near[2], b->nearOrigin[2], b->inverseLo[2], b->inverseHi[2]);
  const float8 farX = greatestDistance(far[0], b->farOrigin[0], b->inverseLo[0], b->inverseHi[0]);
  const float8 farY = greatestDistance(far[1], b->farOrigin[1], b->inverseLo[1], b->inverseHi[1]);
  const float8 farZ = greatestDistance(far[2], b->farOrigin[2], b->inverseLo[2], b->inverseHi[2]);
  const float8 enter = largest8(nearX, nearY, nearZ, (float8)(0.0f));
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
  return packetEntries(b, near, far, tMax, entry);
}

/// True if some ray of the packet enters lane `child` of a node before its own tMax. For packets that run together.
INLINE int entersChild(const Packet* p, const PacketBounds* b, float16 tMax, __global const float* node, uint child) {
  __global const float* box = node + child;
  const float16 nearX = fma((float16)(box[b->nearPlane[0]]), p->inverse[0], p->nearBias[0]);
  const float16 nearY = fma((float16)(box[b->nearPlane[1]]), p->inverse[1], p->nearBias[1]);
  const float16 nearZ = fma((float16)(box[b->nearPlane[2]]), p->inverse[2], p->nearBias[2]);
  const float16 farX = fma((float16)(box[24 - b->nearPlane[0]]), p->inverse[0], p->farBias[0]);
  const float16 farY = fma((float16)(box[40 - b->nearPlane[1]]), p->inverse[1], p->farBias[1]);
  const float16 farZ = fma((float16)(box[56 - b->nearPlane[2]]), p->inverse[2], p->farBias[2]);
  const float16 enter = largest16(nearX, nearY, nearZ, (float16)(0.0f));
  const float16 leave = smallest16(farX, farY, farZ, tMax);
  return anyOf16(enter <= leave * FAR_WIDENING);
}

/// Triangles of a leaf whose own boxes the packet may meet.
INLINE uint packetTriangles(const PacketBounds* b, const Leaf* leaf, float tMax) {
  float8 near[3], far[3];
  for (int a = 0; a < 3; ++a) {
    const float8 v0 = leafPlane(leaf, 0, a), v1 = leafPlane(leaf, 1, a), v2 = leafPlane(leaf, 2, a);
    float8 lo = v0 < v1 ? v0 : v1, hi = v0 < v1 ? v1 : v0;
    lo = v2 < lo ? v2 : lo;
    hi = v2 > hi ? v2 : hi;
    near[a] = b->down[a] ? hi : lo;
    far[a] = b->down[a] ? lo : hi;
  }
  float8 entry;
  return laneBits(packetEntries(b, near, far, tMax, &entry)) & leafLanes(leaf);
}

INLINE RayTable tableOf(const Packet* p, float16 tMax) {
  RayTable rays;
  for (int a = 0; a < 3; ++a) {
    vstore16(p->o[a], 0, rays.o[a]);
    vstore16(p->d[a], 0, rays.d[a]);
  }
  for (int a = 0; a < 3; ++a) {
    vstore16(p->inverse[a], 0, rays.inverse[a]);
    vstore16(p->shear[a], 0, rays.shear[a]);
  }
  vstore16(p->kz, 0, rays.kz);
  vstore16(wakeFinite(p, tMax), 0, rays.t);
  return rays;
}

/// best: t < 0 in lanes that sleep, MAXFLOAT in the others, nothing met (det 1).
void nearestPacket(const SceneView* scene, const Packet* p, PacketHit* best) {
  const PacketBounds bounds = boundPacket(p);
  if (!bounds.together) {
    RayTable rays = tableOf(p, best->t);
    nearestApart(scene, &rays);
    best->t = vload16(0, rays.t);
    best->triangle = vload16(0, rays.triangle);
    best->v = vload16(0, rays.b1);
    best->w = vload16(0, rays.b2);
    return;
  }
  // As a single ray's way (Walk), but that a child is looked at more closely before it is visited.
  uint waiting[8 * WIDE_DEPTH];
  int groups[WIDE_DEPTH];
  int depth = 0, group = 0;
  float tMax = greatest16(best->t);
  uint limit = keyLimit(tMax);
  float8 entry;
  uint8 keys = childKeys(packetChildren(&bounds, scene->wideNodes, tMax, &entry), entry);
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
    __global const float* node = scene->wideNodes + (size_t)group * WIDE_NODE_FLOATS;
    if (!entersChild(p, &bounds, best->t, node, least & 7u)) continue;
    const int child = as_int(node[48 + (least & 7u)]);
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
    const int8 entered = packetChildren(&bounds, scene->wideNodes + (size_t)child * WIDE_NODE_FLOATS, tMax, &entry);
    vstore8(keys, depth, waiting);
    groups[depth] = group;
    depth += anyOf8(keys != NO_CHILD);
    keys = childKeys(entered, entry);
    group = child;
  }
}

/// tMax: lengths, < 0 in lanes that sleep; -inf afterwards where the light is blocked. stops: [3][16].
void occludedPacket(const SceneView* scene, const Packet* p, float16* tMax, uint* stops) {
  const PacketBounds bounds = boundPacket(p);
  if (!bounds.together) {
    RayTable rays = tableOf(p, *tMax);
    occludedApart(scene, &rays, stops);
    *tMax = vload16(0, rays.t);
    return;
  }
  uchar waiting[WIDE_DEPTH];
  int groups[WIDE_DEPTH];
  int depth = 0, group = 0;
  float end = greatest16(*tMax);
  float8 entry;
  uint bits = laneBits(packetChildren(&bounds, scene->wideNodes, end, &entry));
  for (;;) {
    while (bits == 0) {
      if (depth == 0) return;
      --depth;
      bits = waiting[depth];
      group = groups[depth];
    }
    __global const float* node = scene->wideNodes + (size_t)group * WIDE_NODE_FLOATS;
    const uint at = lowestBit(bits);
    bits &= bits - 1;
    if (!entersChild(p, &bounds, *tMax, node, at)) continue;
    const int child = as_int(node[48 + at]);
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
    bits = laneBits(packetChildren(&bounds, scene->wideNodes + (size_t)child * WIDE_NODE_FLOATS, end, &entry));
    group = child;
  }
}
#endif

#endif
