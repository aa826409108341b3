// Sixteen neighbouring rays, one in each lane of a float16, and what one triangle does to them. The arithmetic of a
// lane is that of a single ray (triangle.cl, traverse_bvh2.cl), bit for bit.
#include "lib/search/traverse_bvh2.cl"

#if HAS(PACKETS)

typedef struct {
  float16 o[3];
  float16 d[3];
  float16 inverse[3];
  float16 nearBias[3], farBias[3];  // as in Bvh8Ray
  float16 shear[3];                 // sx, sy, sz of each lane's own axes
  int16 kz;                         // largest axis of the direction
  int axes[3];                      // 1: some lane of those that go together has this axis
  int mixed;                        // 1: they differ in it
#if HAS(STRAIGHT)
  float16 passedOrder, tMin;  // as in Passed
  uint16 passedPrimitive;
#endif
} Packet;

typedef struct {
  float16 t;  // nearest so far; < 0: lane asleep
  uint16 triangle;
  float16 v, w, det;  // areas: the barycentrics b1 and b2 are v/det and w/det
#if HAS(STRAIGHT)
  float16 order;  // of the nearest so far; < 0 as t
#endif
#if HAS(COST)
  uint16 nodes, tests;  // as in Hit; of the whole packet as long as it goes together
#endif
} PacketHit;

INLINE float16 boxInverse16(float16 d) { return fabs(d) > 1e-18f ? 1.0f / d : copysign((float16)(INFINITY), d); }

/// The largest axes of `lanes`, one bit for each.
INLINE void findAxes(Packet* p, uint lanes) {
  for (int a = 0; a < 3; ++a) p->axes[a] = (lanes & laneBits16(p->kz == a)) != 0;
  p->mixed = p->axes[0] + p->axes[1] + p->axes[2] > 1;
}

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
#if !HAS(TREE)
  findAxes(&p, ~0u);  // of all: they go together
#endif
  const float16 dkz = select(select(d[2], d[1], yFirst), d[0], xFirst);
  const float16 dkx = select(select(d[0], d[2], yFirst), d[1], xFirst);
  const float16 dky = select(select(d[1], d[0], yFirst), d[2], xFirst);
  p.shear[2] = 1.0f / dkz;
  p.shear[0] = dkx * p.shear[2];
  p.shear[1] = dky * p.shear[2];
#if HAS(STRAIGHT)
  p.passedOrder = p.tMin = (float16)(0.0f);
  p.passedPrimitive = (uint16)(0);
#endif
  return p;
}

/// tMax, but < 0 in lanes with NaN or infinite parts.
INLINE float16 wakeFinite(const Packet* p, float16 tMax) {
  float16 zero = (float16)(0.0f);  // stays 0 but for NaN and infinite parts
  for (int a = 0; a < 3; ++a) zero += (p->o[a] - p->o[a]) + (p->d[a] - p->d[a]);
  return select((float16)(-1.0f), tMax, zero == 0.0f);
}

/// clampToBox for the rays of a packet.
float16 clampToBox16(const Packet* p, __global const float* triangle, uint stride, float16 t) {
  float16 far[3];
  for (uint a = 0; a < 3; ++a) {
    float lo, hi;
    extent(triangle[a * stride], triangle[(3 + a) * stride], triangle[(6 + a) * stride], &lo, &hi);
    const float16 first = (lo - p->o[a]) * p->inverse[a], second = (hi - p->o[a]) * p->inverse[a];
    const int16 down = as_int16(p->inverse[a]);  // select reads the sign bit
    const float16 near = select(first, second, down);
    far[a] = select(second, first, down);
    t = near > t ? near : t;
  }
  for (int a = 0; a < 3; ++a) t = far[a] < t ? far[a] : t;
  return t;
}

/// intersectTriangle for sixteen rays: lanes whose largest axis is kz and that meet a triangle at 0 < t <= tMax. Its
/// coordinates: corner k, axis a at triangle[(3 k + a) stride].
INLINE int16 intersectAxis(const Packet* p, __global const float* triangle, uint stride, int kz, float16 tMax,
                           float16* t, float16* areaV, float16* areaW, float16* area) {
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
  float16 u, v, w;
  int16 inside = edgeTest16(ax, ay, bx, by, cx, cy, &u, &v, &w);
  if (p->mixed) inside &= p->kz == kz;
  if (!anyOf16(inside)) return inside;
  const float16 det = u + v + w;
  int16 far;
  *t = hitDistance16(u, v, w, det, p->shear[2], az, bz, cz, &far);
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

#if HAS(STRAIGHT)
/// `met` without the lanes of `edges` whose hits belong to a neighbour.
int16 ownedHits(const Packet* p, const Corners* triangle, int16 met, int16 edges) {
  int lanes[PACKET_RAYS], asked[PACKET_RAYS];
  float o[3][PACKET_RAYS], d[3][PACKET_RAYS];
  vstore16(met, 0, lanes);
  vstore16(edges, 0, asked);
  for (int a = 0; a < 3; ++a) {
    vstore16(p->o[a], 0, o[a]);
    vstore16(p->d[a], 0, d[a]);
  }
  for (int i = 0; i < PACKET_RAYS; ++i) {
    if (!asked[i]) continue;
    const Ray r = makeRay(real3(o[0][i], o[1][i], o[2][i]), real3(d[0][i], d[1][i], d[2][i]));
    if (!ownsHit(r.o, r.kx, r.ky, r.kz, r.sx, r.sy, triangle)) lanes[i] = 0;
  }
  return vload16(0, lanes);
}

/// comesAfter for sixteen rays.
INLINE int16 comesAfter16(const SceneView* scene, const Packet* p, uint index, float16 order) {
  const int16 ties = order == p->passedOrder;
  int16 after = order > p->passedOrder;
  if (anyOf16(ties)) after |= ties & (scene->triangles[index].primitive > p->passedPrimitive);
  return after;
}
#endif

/// 1 if a lane found something nearer.
INLINE int testNearestPacket(const SceneView* scene, const Packet* p, __global const float* triangle, uint stride,
                             uint index, PacketHit* best) {
  float16 t = (float16)(0.0f), v = t, w = t, det = t;
  COUNT(best->tests, 1);
#if HAS(STRAIGHT)
  int16 met = intersectPacket(p, triangle, stride, best->order * ORDER_WIDENING, &t, &v, &w, &det);
  if (!anyOf16(met)) return 0;
  const float16 order = scene->triangles[index].flags & TRIANGLE_COATS ? t * COAT_ORDER : t;
  met &= (order <= best->order) & comesAfter16(scene, p, index, order);
  const int16 edges = met & ((v == 0.0f) | (w == 0.0f) | (det == v + w));
  const Corners corners = {triangle, stride};
  if (anyOf16(edges) && (scene->triangles[index].flags & TRIANGLE_FILTERS)) met = ownedHits(p, &corners, met, edges);
  if (!anyOf16(met)) return 0;
  const int16 ties = met & (order == best->order);
#else
  int16 met = intersectPacket(p, triangle, stride, best->t, &t, &v, &w, &det);
  if (!anyOf16(met)) return 0;
  const int16 ties = met & (t == best->t);
#endif
  if (anyOf16(ties)) met &= ~ties | firstOfTies(scene, index, ties, best->triangle);
#if HAS(ONE_SIDED)
  const int16 front = (det > 0.0f) == (p->shear[2] > 0.0f);
  if (anyOf16(met & ~front) && !showsSide(scene, index, 0)) met &= front;
#endif
#if HAS(ALPHA_MASK)
  met = passAlphaMask(scene, index, met, v / det, w / det);
#endif
#if HAS(STRAIGHT)
  best->order = select(best->order, order, met);
#endif
  best->t = select(best->t, t, met);
  best->v = select(best->v, v, met);
  best->w = select(best->w, w, met);
  best->det = select(best->det, det, met);
  best->triangle = select(best->triangle, (uint16)(index), as_uint16(met));
  return 1;
}

#if HAS(FILTERED_SHADOWS) || HAS(ALPHA_MASK)
/// The lanes of `met` that triangle `index` (leaf order) blocks; the others may be dimmed. stops:
/// [3][16], see testOcclusion.
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
    const Ray r = makeRay(real3(o[0][i], o[1][i], o[2][i]), real3(d[0][i], d[1][i], d[2][i]));
    uint own[3];
    for (int k = 0; k < 3; ++k) own[k] = stops[k * PACKET_RAYS + i];
    if (!testOcclusion(scene, &r, index, ends[i], own)) lanes[i] = 0;
    for (int k = 0; k < 3; ++k) stops[k * PACKET_RAYS + i] = own[k];
  }
  return vload16(0, lanes);
}
#endif

/// Shadow lanes against one triangle: tMax becomes -inf where the light is now blocked. stops: [3][16], see
/// testOcclusion. 1 if a lane met it.
INLINE int testOcclusionPacket(const SceneView* scene, const Packet* p, __global const float* triangle, uint stride,
                               uint index, float16* tMax, uint* stops) {
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

#endif
