// Searches for one ray at a time through the eight-wide tree: one ray against eight boxes, or eight triangles, in the
// lanes of a float8. For rays that share no way, where a packet would drag seven others along. The arithmetic of a lane is
// that of the other searches, so the answers are the same bits.
#include "lib/traverse_packet.cl"

#if HAS(WIDE)

#define WIDE_NODE_FLOATS 64   // lo[3][8], hi[3][8], child[8], pad
#define BLOCK_FLOATS 88       // v[3][3][8], primitive[8], first, count, pad
#define BLOCK_PRIMITIVE 72
#define BLOCK_FIRST 80

/// One bit for each lane of a comparison.
INLINE uint laneBits(int8 mask) {
#if defined(__AVX__) && defined(__clang__)
  return (uint)__builtin_ia32_movmskps256(as_float8(mask));
#else
  const int8 bits = mask & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
  const int4 a = bits.lo | bits.hi;
  const int2 b = a.lo | a.hi;
  return (uint)(b.x | b.y);
#endif
}

INLINE uint lowestBit(uint bits) { return popcount((bits & (0u - bits)) - 1u); }

/// What a ray needs for box tests beside itself.
typedef struct {
  float nearBias[3], farBias[3];  // as in Packet
  int nearPlane[3];               // floats from a node to its planes: 8 · axis, and 24 for hi
  int regular;                    // 1: no part of the direction is next to 0
} BoxRay;

INLINE BoxRay makeBoxRay(const Ray* r) {
  BoxRay b;
  b.regular = 1;
  for (int a = 0; a < 3; ++a) {
    const float bias = -r->o[a] * r->inverse[a], margin = fabs(bias) * BIAS_MARGIN;
    b.nearBias[a] = bias - margin;
    b.farBias[a] = bias + margin;
    b.nearPlane[a] = a * 8 + (r->inverse[a] >= 0.0f ? 0 : 24);
    if (!(fabs(r->inverse[a]) < INFINITY)) b.regular = 0;
  }
  return b;
}

/// The eight children of a node: bits of those that the ray enters before tMax, and where.
INLINE uint wideEntries(const Ray* r, const BoxRay* b, __global const float* node, float tMax, float8* entry) {
  float8 enter = (float8)(0.0f), leave = (float8)(tMax);
  if (b->regular) {
    const int x = b->nearPlane[0], y = b->nearPlane[1], z = b->nearPlane[2];
    const float8 nearX = fma(vload8(0, node + x), (float8)(r->inverse[0]), (float8)(b->nearBias[0]));
    const float8 nearY = fma(vload8(0, node + y), (float8)(r->inverse[1]), (float8)(b->nearBias[1]));
    const float8 nearZ = fma(vload8(0, node + z), (float8)(r->inverse[2]), (float8)(b->nearBias[2]));
    const float8 farX = fma(vload8(0, node + 24 - x), (float8)(r->inverse[0]), (float8)(b->farBias[0]));
    const float8 farY = fma(vload8(0, node + 40 - y), (float8)(r->inverse[1]), (float8)(b->farBias[1]));
    const float8 farZ = fma(vload8(0, node + 56 - z), (float8)(r->inverse[2]), (float8)(b->farBias[2]));
    enter = largest8(nearX, nearY, nearZ, enter);
    leave = smallest8(farX, farY, farZ, leave);
  } else {
    for (int a = 0; a < 3; ++a) {
      const int down = !(r->inverse[a] >= 0.0f);
      const float8 near = (vload8(0, node + (a + 3 * down) * 8) - r->o[a]) * r->inverse[a];
      const float8 far = (vload8(0, node + (a + 3 * (1 - down)) * 8) - r->o[a]) * r->inverse[a];
      enter = near > enter ? near : enter;
      leave = far < leave ? far : leave;
    }
  }
  *entry = enter;
  return laneBits(enter <= leave * FAR_WIDENING);
}

/// The triangles of a block: bits of those met at 0 < t <= tMax; t, b1, b2 of all lanes.
INLINE uint intersectBlock(const Ray* r, __global const float* block, float tMax, float8* t, float8* b1, float8* b2) {
  const float ox = r->o[r->kx], oy = r->o[r->ky], oz = r->o[r->kz];
  const float8 az = vload8(0, block + (0 + r->kz) * 8) - oz;
  const float8 bz = vload8(0, block + (3 + r->kz) * 8) - oz;
  const float8 cz = vload8(0, block + (6 + r->kz) * 8) - oz;
  const float8 sx = (float8)(-r->sx), sy = (float8)(-r->sy);
  const float8 ax = fma(sx, az, vload8(0, block + (0 + r->kx) * 8) - ox);
  const float8 ay = fma(sy, az, vload8(0, block + (0 + r->ky) * 8) - oy);
  const float8 bx = fma(sx, bz, vload8(0, block + (3 + r->kx) * 8) - ox);
  const float8 by = fma(sy, bz, vload8(0, block + (3 + r->ky) * 8) - oy);
  const float8 cx = fma(sx, cz, vload8(0, block + (6 + r->kx) * 8) - ox);
  const float8 cy = fma(sy, cz, vload8(0, block + (6 + r->ky) * 8) - oy);
  const float8 u = differenceOfProducts8(cx, by, cy, bx);
  const float8 v = differenceOfProducts8(ax, cy, ay, cx);
  const float8 w = differenceOfProducts8(bx, ay, by, ax);
  const int8 inside = ((u >= 0.0f) & (v >= 0.0f) & (w >= 0.0f)) | ((u <= 0.0f) & (v <= 0.0f) & (w <= 0.0f));
  if (laneBits(inside) == 0) return 0;
  const float8 det = u + v + w;
  *t = fma(u, az, fma(v, bz, w * cz)) * r->sz / det;
  *b1 = v / det;
  *b2 = w / det;
  return laneBits(inside & (*t > 0.0f) & (*t <= tMax));
}

INLINE void testNearestBlock(const SceneView* scene, const Ray* r, __global const float* block, Hit* best) {
  float8 t8, b18, b28;
  uint bits = intersectBlock(r, block, best->t, &t8, &b18, &b28);
  if (bits == 0) return;
  float t[8], b1[8], b2[8];
  vstore8(t8, 0, t);
  vstore8(b18, 0, b1);
  vstore8(b28, 0, b2);
  const uint first = as_uint(block[BLOCK_FIRST]);
  for (; bits != 0; bits &= bits - 1) {
    const uint lane = lowestBit(bits);
    const uint primitive = as_uint(block[BLOCK_PRIMITIVE + lane]);
    if (t[lane] > best->t || (t[lane] == best->t && primitive > best->primitive)) continue;
#if HAS(ALPHA_MASK)
    if ((scene->triangles[first + lane].flags & TRIANGLE_MASKED) && !passesAlphaMask(scene, first + lane, b1[lane], b2[lane]))
      continue;
#endif
    best->t = t[lane];
    best->b1 = b1[lane];
    best->b2 = b2[lane];
    best->triangle = first + lane;
    best->primitive = primitive;
  }
}

/// 1 once the light is blocked.
INLINE int testOcclusionBlock(const SceneView* scene, const Ray* r, __global const float* block, float tMax, uint* stops) {
  float8 t8, b18, b28;
  uint bits = intersectBlock(r, block, tMax, &t8, &b18, &b28);
  if (bits == 0) return 0;
#if HAS(FILTERED_SHADOWS) || HAS(ALPHA_MASK)
  const uint first = as_uint(block[BLOCK_FIRST]);
  for (; bits != 0; bits &= bits - 1)
    if (testOcclusion(scene, r, first + lowestBit(bits), tMax, stops)) return 1;
  return 0;
#else
  return (bits & laneBits(t8 < tMax)) != 0;
#endif
}

Hit nearestWide(const SceneView* scene, const Ray* r) {
  Hit best = {MAXFLOAT, NO_HIT, NO_HIT, 0.0f, 0.0f};
  if (!isFiniteRay(r)) return best;
  const BoxRay box = makeBoxRay(r);
  int waiting[WIDE_STACK];
  float entries[WIDE_STACK];
  int depth = 0;
  int current = 0;
  for (;;) {
    if (current < 0) {
      testNearestBlock(scene, r, scene->blocks + (size_t)~current * BLOCK_FLOATS, &best);
    } else {
      __global const float* node = scene->wideNodes + (size_t)current * WIDE_NODE_FLOATS;
      __global const int* child = (__global const int*)(node + 48);
      float8 entry8;
      uint bits = wideEntries(r, &box, node, best.t, &entry8);
      if (bits != 0) {
        const uint i = lowestBit(bits);
        bits &= bits - 1;
        if (bits == 0) {
          current = child[i];
          continue;
        }
        float entry[8];
        vstore8(entry8, 0, entry);
        // Nearest first: the others wait, the nearest of them on top.
        int next = child[i];
        float nextEntry = entry[i];
        const int bottom = depth;
        for (; bits != 0; bits &= bits - 1) {
          const uint k = lowestBit(bits);
          int c = child[k];
          float e = entry[k];
          if (e < nextEntry) {
            const int swapped = next;
            const float swappedEntry = nextEntry;
            next = c, nextEntry = e;
            c = swapped, e = swappedEntry;
          }
          int at = depth++;
          for (; at > bottom && entries[at - 1] < e; --at) {
            entries[at] = entries[at - 1];
            waiting[at] = waiting[at - 1];
          }
          entries[at] = e;
          waiting[at] = c;
        }
        current = next;
        continue;
      }
    }
    do {
      if (depth == 0) return best;
      --depth;
    } while (entries[depth] > best.t * FAR_WIDENING);
    current = waiting[depth];
  }
}

INLINE float3 transmittanceWide(const SceneView* scene, const Ray* r, float tMax) {
  uint stops[3] = {0, 0, 0};
  if (!isFiniteRay(r)) return (float3)(1.0f);
  const BoxRay box = makeBoxRay(r);
  int waiting[WIDE_STACK];
  int depth = 0;
  int current = 0;
  for (;;) {
    if (current < 0) {
      if (testOcclusionBlock(scene, r, scene->blocks + (size_t)~current * BLOCK_FLOATS, tMax, stops))
        return (float3)(0.0f);
    } else {
      __global const float* node = scene->wideNodes + (size_t)current * WIDE_NODE_FLOATS;
      __global const int* child = (__global const int*)(node + 48);
      float8 entry;
      uint bits = wideEntries(r, &box, node, tMax, &entry);
      if (bits != 0) {
        current = child[lowestBit(bits)];
        for (bits &= bits - 1; bits != 0; bits &= bits - 1) waiting[depth++] = child[lowestBit(bits)];
        continue;
      }
    }
    if (depth == 0) return transmittanceFromStops(stops);
    current = waiting[--depth];
  }
}

#endif

// The search for one ray, and how many of them a work item walks one after another: a stack for eight-wide nodes is large,
// and PoCL gives each work item of a group its own.
#if HAS(WIDE)
#define RAYS_EACH 8
#define nearestOne nearestWide
#define transmittanceOne transmittanceWide
#else
#define RAYS_EACH 1
#define nearestOne nearestSingle
#define transmittanceOne transmittanceSingle
#endif
