// Searches for eight neighbouring rays at once, one in each lane of a float8: a CPU's vector unit then tests eight rays
// against each box and triangle. The arithmetic of a lane is that of the single-ray search, bit for bit, so the two agree.
#include "lib/traverse_single.cl"

#if HAS(PACKETS)

typedef struct {
  float8 o[3];
  float8 d[3];
  float8 inverse[3];
  float8 nearBias[3];  // -o/d for near and far planes, wider by more than they are off
  float8 farBias[3];
  float8 shear[3];    // sx, sy, sz of each lane's own axes
  int8 kz;            // largest axis of the direction
  int axes[3];        // 1: some lane has this axis
  int nearPlane[3];   // 0: lo is the near plane, 6: hi; where all lanes agree
  int regular;        // 1: they agree on all three axes, and no direction is parallel to one
} Packet;

typedef struct {
  float8 t;  // nearest so far; -inf: lane asleep
  uint8 triangle, primitive;
  float8 b1, b2;
} PacketHit;

/// True if any lane's mask (all bits set or none) is set. Where the compiler has a reduction of its own it becomes one
/// instruction.
#if defined(__clang__) && defined(__has_builtin)
#if __has_builtin(__builtin_reduce_or)
#define HAS_REDUCTIONS 1
#endif
#endif
INLINE int anyLane(int8 mask) {
#ifdef HAS_REDUCTIONS
  return __builtin_reduce_or(mask) < 0;
#else
  const int4 a = mask.lo | mask.hi;
  const int2 b = a.lo | a.hi;
  return (b.x | b.y) != 0;
#endif
}

INLINE int allLanes(int8 mask) {
#ifdef HAS_REDUCTIONS
  return __builtin_reduce_and(mask) < 0;
#else
  const int4 a = mask.lo & mask.hi;
  const int2 b = a.lo & a.hi;
  return (b.x & b.y) != 0;
#endif
}

INLINE float8 boxInverse8(float8 d) { return fabs(d) > 1e-18f ? 1.0f / d : copysign((float8)(INFINITY), d); }

INLINE Packet makePacket(float8 ox, float8 oy, float8 oz, float8 dx, float8 dy, float8 dz) {
  Packet p;
  p.o[0] = ox, p.o[1] = oy, p.o[2] = oz;
  p.d[0] = dx, p.d[1] = dy, p.d[2] = dz;
  p.regular = 1;
  for (int a = 0; a < 3; ++a) {
    p.inverse[a] = boxInverse8(p.d[a]);
    const int8 negative = !(p.inverse[a] >= 0.0f);
    const int down = allLanes(negative);
    p.nearPlane[a] = down ? 6 : 0;
    if (!down && anyLane(negative)) p.regular = 0;
    if (anyLane(!(fabs(p.inverse[a]) < INFINITY))) p.regular = 0;
    const float8 bias = -p.o[a] * p.inverse[a];
    const float8 margin = fabs(bias) * BIAS_MARGIN;
    p.nearBias[a] = bias - margin;
    p.farBias[a] = bias + margin;
  }
  const float8 ax = fabs(dx), ay = fabs(dy), az = fabs(dz);
  const int8 xFirst = (ax > ay) & (ax > az);
  const int8 yFirst = ~(ax > ay) & (ay > az);
  p.kz = select(select((int8)(2), (int8)(1), yFirst), (int8)(0), xFirst);
  p.axes[0] = anyLane(xFirst);
  p.axes[1] = anyLane(yFirst);
  p.axes[2] = anyLane(~(xFirst | yFirst));
  const float8 dkz = select(select(dz, dy, yFirst), dx, xFirst);
  const float8 dkx = select(select(dx, dz, yFirst), dy, xFirst);
  const float8 dky = select(select(dy, dx, yFirst), dz, xFirst);
  p.shear[2] = 1.0f / dkz;
  p.shear[0] = dkx * p.shear[2];
  p.shear[1] = dky * p.shear[2];
  return p;
}

/// Mask of the lanes that enter child c before tMax; entry receives their distances.
INLINE int8 childEntries(const Packet* p, __global const Node* node, int c, float8 tMax, float8* entry) {
  float8 enter = (float8)(0.0f), leave = tMax;
  if (p->regular) {
    __global const float* box = node->lo[c];  // hi[c] lies 6 floats on
    const float8 nearX = fma((float8)(box[p->nearPlane[0]]), p->inverse[0], p->nearBias[0]);
    const float8 nearY = fma((float8)(box[p->nearPlane[1] + 1]), p->inverse[1], p->nearBias[1]);
    const float8 nearZ = fma((float8)(box[p->nearPlane[2] + 2]), p->inverse[2], p->nearBias[2]);
    const float8 farX = fma((float8)(box[6 - p->nearPlane[0]]), p->inverse[0], p->farBias[0]);
    const float8 farY = fma((float8)(box[6 - p->nearPlane[1] + 1]), p->inverse[1], p->farBias[1]);
    const float8 farZ = fma((float8)(box[6 - p->nearPlane[2] + 2]), p->inverse[2], p->farBias[2]);
    enter = largest8(nearX, nearY, nearZ, enter);
    leave = smallest8(farX, farY, farZ, leave);
  } else {
    for (int a = 0; a < 3; ++a) {
      const float8 lo = (node->lo[c][a] - p->o[a]) * p->inverse[a];
      const float8 hi = (node->hi[c][a] - p->o[a]) * p->inverse[a];
      const int8 down = as_int8(p->inverse[a]);  // select reads the sign bit
      const float8 near = select(lo, hi, down);
      const float8 far = select(hi, lo, down);
      enter = near > enter ? near : enter;
      leave = far < leave ? far : leave;
    }
  }
  *entry = enter;
  return enter <= leave * FAR_WIDENING;
}

/// Lanes with NaN or infinite parts sleep.
INLINE float8 wakeFinite(const Packet* p, float8 tMax) {
  int8 finite = isfinite(p->o[0]) & isfinite(p->o[1]) & isfinite(p->o[2]);
  finite &= isfinite(p->d[0]) & isfinite(p->d[1]) & isfinite(p->d[2]);
  return select((float8)(-1.0f), tMax, finite);
}

/// Lanes whose largest axis is kz and that meet the triangle at 0 < t <= tMax.
INLINE int8 intersectAxis(const Packet* p, __global const DeviceTriangle* triangle, int kz, float8 tMax, float8* t, float8* b1,
                   float8* b2) {
  const int kx = kz == 2 ? 0 : kz + 1;
  const int ky = kx == 2 ? 0 : kx + 1;
  const float8 ox = p->o[kx], oy = p->o[ky], oz = p->o[kz];
  const float8 sx = -p->shear[0], sy = -p->shear[1];
  const float8 az = triangle->v[0][kz] - oz;
  const float8 bz = triangle->v[1][kz] - oz;
  const float8 cz = triangle->v[2][kz] - oz;
  const float8 ax = fma(sx, az, triangle->v[0][kx] - ox);
  const float8 ay = fma(sy, az, triangle->v[0][ky] - oy);
  const float8 bx = fma(sx, bz, triangle->v[1][kx] - ox);
  const float8 by = fma(sy, bz, triangle->v[1][ky] - oy);
  const float8 cx = fma(sx, cz, triangle->v[2][kx] - ox);
  const float8 cy = fma(sy, cz, triangle->v[2][ky] - oy);
  const float8 u = differenceOfProducts8(cx, by, cy, bx);
  const float8 v = differenceOfProducts8(ax, cy, ay, cx);
  const float8 w = differenceOfProducts8(bx, ay, by, ax);
  int8 inside = ((u >= 0.0f) & (v >= 0.0f) & (w >= 0.0f)) | ((u <= 0.0f) & (v <= 0.0f) & (w <= 0.0f));
  inside &= p->kz == kz;
  if (!anyLane(inside)) return inside;
  const float8 det = u + v + w;
  *t = fma(u, az, fma(v, bz, w * cz)) * p->shear[2] / det;
  *b1 = v / det;
  *b2 = w / det;
  return inside & (*t > 0.0f) & (*t <= tMax);
}

/// All lanes against one triangle; merges the axes that occur in the packet.
INLINE int8 intersectPacket(const Packet* p, __global const DeviceTriangle* triangle, float8 tMax, float8* t, float8* b1, float8* b2) {
  int8 met = (int8)(0);
#pragma unroll
  for (int kz = 0; kz < 3; ++kz) {
    if (!p->axes[kz]) continue;
    float8 tk, b1k, b2k;
    const int8 m = intersectAxis(p, triangle, kz, tMax, &tk, &b1k, &b2k);
    if (!anyLane(m)) continue;
    *t = select(*t, tk, m);
    *b1 = select(*b1, b1k, m);
    *b2 = select(*b2, b2k, m);
    met |= m;
  }
  return met;
}

INLINE void testNearestPacket(const SceneView* scene, const Packet* p, uint index, PacketHit* best) {
  __global const DeviceTriangle* triangle = scene->triangles + index;
  float8 t = (float8)(0.0f), b1 = (float8)(0.0f), b2 = (float8)(0.0f);
  int8 met = intersectPacket(p, triangle, best->t, &t, &b1, &b2);
  if (!anyLane(met)) return;
  met &= (t < best->t) | as_int8(triangle->primitive < best->primitive);
#if HAS(ALPHA_MASK)
  if (triangle->flags & TRIANGLE_MASKED) {
    int lanes[8];
    float b1s[8], b2s[8];
    vstore8(met, 0, lanes);
    vstore8(b1, 0, b1s);
    vstore8(b2, 0, b2s);
    for (int i = 0; i < 8; ++i)
      if (lanes[i] && !passesAlphaMask(scene, index, b1s[i], b2s[i])) lanes[i] = 0;
    met = vload8(0, lanes);
  }
#endif
  best->t = select(best->t, t, met);
  best->b1 = select(best->b1, b1, met);
  best->b2 = select(best->b2, b2, met);
  best->triangle = select(best->triangle, (uint8)(index), as_uint8(met));
  best->primitive = select(best->primitive, (uint8)(triangle->primitive), as_uint8(met));
}

/// Shadow lanes against one triangle; returns the lanes whose light is now blocked. stops: [3][8], see testOcclusion.
INLINE int8 testOcclusionPacket(const SceneView* scene, const Packet* p, uint index, float8 tMax, uint* stops) {
  __global const DeviceTriangle* triangle = scene->triangles + index;
  float8 t = (float8)(0.0f), b1 = (float8)(0.0f), b2 = (float8)(0.0f);
  int8 met = intersectPacket(p, triangle, tMax, &t, &b1, &b2);
  met &= t < tMax;
#if HAS(FILTERED_SHADOWS) || HAS(ALPHA_MASK)
  if (anyLane(met) && (triangle->flags & (TRIANGLE_FILTERS | TRIANGLE_MASKED))) {
    int lanes[8];
    float dx[8], dy[8], dz[8], ox[8], oy[8], oz[8], ends[8];
    vstore8(met, 0, lanes);
    vstore8(p->d[0], 0, dx);
    vstore8(p->d[1], 0, dy);
    vstore8(p->d[2], 0, dz);
    vstore8(p->o[0], 0, ox);
    vstore8(p->o[1], 0, oy);
    vstore8(p->o[2], 0, oz);
    vstore8(tMax, 0, ends);
    for (int i = 0; i < 8; ++i) {
      if (!lanes[i]) continue;
      const Ray r = makeRay((float3)(ox[i], oy[i], oz[i]), (float3)(dx[i], dy[i], dz[i]));
      uint own[3] = {stops[i], stops[8 + i], stops[16 + i]};
      if (!testOcclusion(scene, &r, index, ends[i], own)) lanes[i] = 0;
      stops[i] = own[0], stops[8 + i] = own[1], stops[16 + i] = own[2];
    }
    met = vload8(0, lanes);
  }
#endif
  return met;
}

#if HAS(TREE)
PacketHit nearestPacket(const SceneView* scene, const Packet* p, float8 tMax) {
  PacketHit best;
  best.t = wakeFinite(p, tMax);
  best.triangle = (uint8)(NO_HIT);
  best.primitive = (uint8)(NO_HIT);
  best.b1 = best.b2 = (float8)(0.0f);
  int stack[MAX_TREE_DEPTH + 4];
  int depth = 0;
  int current = 0;
  for (;;) {
    if (current < 0) {
      const uint packed = (uint)~current;
      const uint first = packed >> 4, count = (packed & 15u) + 1;
      for (uint i = first; i < first + count; ++i) testNearestPacket(scene, p, i, &best);
    } else {
      __global const Node* node = scene->nodes + current;
      float8 t0, t1;
      const int8 hit0 = childEntries(p, node, 0, best.t, &t0);
      const int8 hit1 = childEntries(p, node, 1, best.t, &t1);
      const int any0 = anyLane(hit0), any1 = anyLane(hit1);
      if (any0 && any1) {
        const int secondFirst = anyLane(hit0 & hit1 & (t1 < t0));
        stack[depth++] = node->child[1 - secondFirst];
        current = node->child[secondFirst];
        continue;
      }
      if (any0 || any1) {
        current = node->child[any1];
        continue;
      }
    }
    if (depth == 0) return best;
    current = stack[--depth];
  }
}

/// stops: [3][8]. Returns the mask of blocked lanes. Lanes with tMax < 0 sleep.
int8 occludedPacket(const SceneView* scene, const Packet* p, float8 tMax, uint* stops) {
  int8 blocked = (int8)(0);
  tMax = wakeFinite(p, tMax);
  int stack[MAX_TREE_DEPTH + 4];
  int depth = 0;
  int current = 0;
  for (;;) {
    if (current < 0) {
      const uint packed = (uint)~current;
      const uint first = packed >> 4, count = (packed & 15u) + 1;
      for (uint i = first; i < first + count; ++i) {
        const int8 now = testOcclusionPacket(scene, p, i, tMax, stops);
        blocked |= now;
        tMax = select(tMax, (float8)(-INFINITY), now);
      }
      if (allLanes(tMax < 0.0f)) return blocked;
    } else {
      __global const Node* node = scene->nodes + current;
      float8 t0, t1;
      const int8 hit0 = childEntries(p, node, 0, tMax, &t0);
      const int8 hit1 = childEntries(p, node, 1, tMax, &t1);
      const int any0 = anyLane(hit0), any1 = anyLane(hit1);
      if (any0 && any1) {
        const int secondFirst = anyLane(hit0 & hit1 & (t1 < t0));
        stack[depth++] = node->child[1 - secondFirst];
        current = node->child[secondFirst];
        continue;
      }
      if (any0 || any1) {
        current = node->child[any1];
        continue;
      }
    }
    if (depth == 0) return blocked;
    current = stack[--depth];
  }
}
#else
PacketHit nearestPacket(const SceneView* scene, const Packet* p, float8 tMax) {
  PacketHit best;
  best.t = wakeFinite(p, tMax);
  best.triangle = (uint8)(NO_HIT);
  best.primitive = (uint8)(NO_HIT);
  best.b1 = best.b2 = (float8)(0.0f);
  for (uint i = 0; i < scene->triangleCount; ++i) testNearestPacket(scene, p, i, &best);
  return best;
}

int8 occludedPacket(const SceneView* scene, const Packet* p, float8 tMax, uint* stops) {
  int8 blocked = (int8)(0);
  tMax = wakeFinite(p, tMax);
  for (uint i = 0; i < scene->triangleCount; ++i) {
    const int8 now = testOcclusionPacket(scene, p, i, tMax, stops);
    blocked |= now;
    tMax = select(tMax, (float8)(-INFINITY), now);
    if (allLanes(tMax < 0.0f)) break;
  }
  return blocked;
}
#endif

#endif
