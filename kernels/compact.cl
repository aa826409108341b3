// compact: dense queues from sparse candidates, order kept (reduce, then scan, then scatter: Blelloch 1990), without
// barriers: a work item walks COMPACT_CHUNK entries serially, which a CPU likes best and a GPU can afford with a small
// COMPACT_CHUNK. compact_count: shadow rays and impulses in each chunk, and the throughput that ended there.
// scan_chunks: exclusive sums of chunk totals. compact_shadow writes the shadow queue (indices of candidates),
// compact_impulse the next ray queue.
#include "lib/entry_flags.cl"
#include "lib/impulses.cl"

#define CHUNKS(count) (((count) + COMPACT_CHUNK - 1) / COMPACT_CHUNK)

#if HAS(DISPERSION) && HAS(BOTH_BRANCHES)
/// Whether a colour of the impulse that splits is a ray.
INLINE int carries(__global const float* impulses, uint capacity, uint i, uint channel) {
  return impulses[(size_t)(IMPULSE_STRIDE + IMPULSE_THROUGHPUT + channel) * capacity + i] > 0.0f;
}
#endif

/// Whether the second impulse of an entry splits.
INLINE int isSplit(uint flags) {
#if HAS(DISPERSION) && HAS(BOTH_BRANCHES)
  return (flags & ENTRY_SPLIT1) == ENTRY_SPLIT1;
#else
  return 0;
#endif
}

/// Rays that an entry sends out.
INLINE uint raysOf(__global const float* impulses, uint capacity, uint i, uint flags) {
#if HAS(DISPERSION) && HAS(BOTH_BRANCHES)
  if (impulses && isSplit(flags))
    return ((flags >> 1) & 1u) + carries(impulses, capacity, i, 0) + carries(impulses, capacity, i, 1) +
           carries(impulses, capacity, i, 2);
#endif
  return ((flags >> 1) & 1u) + ((flags >> 2) & 1u);
}

/// Adds the units of what ended at entry i to the sum of what ended it.
INLINE void addEnded(__global const float* impulses, uint capacity, uint i, uint flags, ulong* ended) {
  for (uint k = 0; k < IMPULSES_OF_HIT; ++k) {
    if (!(flags & (ENTRY_ENDED0 << k)) || (k == 1 && isSplit(flags))) continue;
    const float signedShare = impulses[(size_t)(k * IMPULSE_STRIDE + IMPULSE_THROUGHPUT) * capacity + i];
    const float share = fabs(signedShare);
    const ulong units = (ulong)((share < ENDED_MOST ? share : ENDED_MOST) * ENDED_UNITS) + 1;
    const int straight = (flags & (ENTRY_STRAIGHT0 << k)) != 0;
    ended[signedShare < 0.0f ? ENDED_CUTOFF : (straight ? ENDED_STRAIGHT : ENDED_BOUNCES)] += units;
  }
}

__kernel void compact_count(const uint count, const uint capacity,
                            const uint set,                  // of shadow candidates; impulses come with the first
                            __global const uchar* flags,     // [sets][capacity]
                            __global const float* impulses,  // null: nothing can have ended or split
                            __global uint* totals) {         // [SUMS][chunks], of those that ended only with impulses
  const uint chunk = get_global_id(0);
  const uint begin = chunk * COMPACT_CHUNK;
  if (begin >= count) return;
  const uint end = count - begin < COMPACT_CHUNK ? count : begin + COMPACT_CHUNK;
  flags += (size_t)set * capacity;
  uint shadows = 0, found = 0;
  ulong ended[ENDED_KINDS] = {0, 0, 0};
  for (uint i = begin; i < end; ++i) {
    shadows += flags[i] & ENTRY_SHADOW;
    found += raysOf(impulses, capacity, i, flags[i]);
    if (impulses && flags[i] >= ENTRY_ENDED0) addEnded(impulses, capacity, i, flags[i], ended);
  }
  totals[SUM_SHADOW * CHUNKS(count) + chunk] = shadows;
  if (set > 0) return;
  totals[SUM_IMPULSE * CHUNKS(count) + chunk] = found;
  if (!impulses) return;
  for (uint kind = 0; kind < ENDED_KINDS; ++kind) {
    totals[(SUM_ENDED + 2 * kind) * CHUNKS(count) + chunk] = (uint)ended[kind];
    totals[(SUM_ENDED + 2 * kind + 1) * CHUNKS(count) + chunk] = (uint)(ended[kind] >> 32);
  }
}

/// One work item for each kind. Of the two kinds of rays totals[kind][i] becomes the sum of those before it and
/// sums[kind] the sum of all; the ENDED_KINDS behind them are summed alone.
__kernel void scan_chunks(const uint chunks, const uint kinds, __global uint* totals, __global uint* sums) {
  const uint kind = get_global_id(0);
  if (!sums || kind >= kinds) return;  // no sums: compiled ahead of its first launch
  if (kind >= SUM_ENDED) {
    const uint low = SUM_ENDED + 2 * (kind - SUM_ENDED);
    ulong ended = 0;
    for (uint i = 0; i < chunks; ++i) ended += totals[low * chunks + i] | (ulong)totals[(low + 1) * chunks + i] << 32;
    sums[low] = (uint)ended;
    sums[low + 1] = (uint)(ended >> 32);
    return;
  }
  __global uint* own = totals + kind * chunks;
  uint running = 0;
  for (uint i = 0; i < chunks; ++i) {
    const uint total = own[i];
    own[i] = running;
    running += total;
  }
  sums[kind] = running;
}

__kernel void compact_shadow(const uint count, const uint capacity, const uint set,
                             __global const uchar* flags,   // [sets][capacity]
                             __global const uint* offsets,  // [2][chunks] exclusive sums
                             __global uint* shadowQueue) {  // [capacity]
  const uint chunk = get_global_id(0);
  const uint begin = chunk * COMPACT_CHUNK;
  if (begin >= count) return;
  const uint end = count - begin < COMPACT_CHUNK ? count : begin + COMPACT_CHUNK;
  flags += (size_t)set * capacity;
  uint out = offsets[chunk];
  for (uint i = begin; i < end; ++i)
    if (flags[i] & ENTRY_SHADOW) shadowQueue[out++] = i;
}

#if HAS(STRAIGHT)
/// What an impulse of an entry adds to the steps of its ray.
INLINE uint stepOf(uint flags, int straight, uint steps) {
  if (!straight) return STEP_BOUNCE;
  const int counts = (flags & ENTRY_BRANCHED) && steps / STEP_BRANCHED < 63u;
  return STEP_STRAIGHT + (counts ? STEP_BRANCHED : 0u);
}
#endif

/// An impulse of entry i as the ray `out` of the next queue: k, or of the second that splits k - 1 says which colour.
INLINE void writeRay(__global const float* impulses, uint capacity, uint i, uint k, int splits, __global float* next,
                     uint out) {
  const uint base = splits ? IMPULSE_STRIDE : k * IMPULSE_STRIDE;
  for (uint plane = 0; plane < IMPULSE_PLANES; ++plane)
    next[(size_t)plane * capacity + out] = impulses[(size_t)(base + plane) * capacity + i];
#if HAS(TEXTURE_LEVELS)
  uint cone = base + IMPULSE_PLANES;
#endif
#if HAS(DISPERSION) && HAS(BOTH_BRANCHES)
  if (splits) {
    const uint channel = k - 1;
    for (uint other = 0; other < 3; ++other)
      if (other != channel) next[(size_t)(RAY_THROUGHPUT + other) * capacity + out] = 0.0f;
    if (channel > 0) {
      const uint way = SPLIT_BASE + (channel - 1) * SPLIT_STRIDE;
      for (uint axis = 0; axis < 3; ++axis)
        next[(size_t)(RAY_D + axis) * capacity + out] = impulses[(size_t)(way + SPLIT_D + axis) * capacity + i];
#if HAS(TEXTURE_LEVELS)
      cone = way + SPLIT_PLANES;
#endif
    }
  }
#endif
#if HAS(TEXTURE_LEVELS)
  for (uint plane = 0; plane < CONE_PLANES; ++plane)
    next[(size_t)(RAY_CONE + plane) * capacity + out] = impulses[(size_t)(cone + plane) * capacity + i];
#endif
}

#if HAS(DISPERSION) && HAS(BOTH_BRANCHES)
#define RAYS_OF_HIT 4
#else
#define RAYS_OF_HIT IMPULSES_OF_HIT
#endif

/// Whether the k-th of the rays that an entry may send out is there: the first impulse, then the second, or its
/// colours.
INLINE int isRay(__global const float* impulses, uint capacity, uint i, uint flags, int splits, uint k) {
#if HAS(DISPERSION) && HAS(BOTH_BRANCHES)
  if (k > 0 && splits) return carries(impulses, capacity, i, k - 1);
  if (k > 1) return 0;
#endif
  return (flags & (ENTRY_IMPULSE0 << k)) != 0;
}

__kernel void compact_impulse(const uint first, const uint count, const uint capacity, const uint bounce,
                              __global const uchar* flags, __global const uint* offsets, __global const float* impulses,
                              __global const float* rays,  // the queue the impulses came from: slots, steps
                              __global const float* hits,  // read with STRAIGHT
                              __global float* next) {      // [RAY_PLANES…][capacity]
  const uint chunk = get_global_id(0);
  const uint begin = chunk * COMPACT_CHUNK;
  if (begin >= count) return;
  const uint end = count - begin < COMPACT_CHUNK ? count : begin + COMPACT_CHUNK;
  uint out = offsets[CHUNKS(count) + chunk];
  for (uint i = begin; i < end; ++i) {
    const int splits = isSplit(flags[i]);
    for (uint k = 0; k < RAYS_OF_HIT; ++k) {
      if (!isRay(impulses, capacity, i, flags[i], splits, k)) continue;
      writeRay(impulses, capacity, i, k, k > 0 && splits, next, out);
      next[(size_t)RAY_SLOT * capacity + out] = rays[(size_t)RAY_SLOT * capacity + first + i];
#if HAS(STRAIGHT)
      const int straight = !(k > 0 && splits) && (flags[i] & (ENTRY_STRAIGHT0 << k)) != 0;
      const uint steps = bounce > 1 ? as_uint(rays[(size_t)RAY_STEPS * capacity + first + i]) : STEP_BOUNCE;
      next[(size_t)RAY_AFTER_ORDER * capacity + out] = straight ? hits[(size_t)HIT_ORDER * capacity + i] : 0.0f;
      next[(size_t)RAY_AFTER_TRIANGLE * capacity + out] = straight ? hits[(size_t)HIT_TRIANGLE * capacity + i]
                                                                   : as_float(NO_HIT);
      next[(size_t)RAY_STEPS * capacity + out] = as_float(steps + stepOf(flags[i], straight, steps));
#endif
      ++out;
    }
  }
}

/// Raises the counter if a sample has more than LONG_RUN entries in a queue.
__kernel void find_long_runs(const uint count, const uint capacity, __global const float* rays,
                             __global uint* counters) {
  const uint i = get_global_id(0);
  if (i + LONG_RUN >= count) return;
  __global const float* slots = rays + (size_t)RAY_SLOT * capacity;
  if (as_uint(slots[i]) == as_uint(slots[i + LONG_RUN])) counters[COUNTER_LONG_RUN] = 1;
}
