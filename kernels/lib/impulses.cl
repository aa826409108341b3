// How many impulses a hit can send out, and where the cone of one lies in its planes and in a ray's. In a file of its
// own: programs that do not ask are the same for any answer.
#include "lib/math.cl"

#if HAS(BOTH_BRANCHES)
#define IMPULSES_OF_HIT 2
#else
#define IMPULSES_OF_HIT 1
#endif

#if HAS(TEXTURE_LEVELS)
#define IMPULSE_STRIDE (IMPULSE_PLANES + CONE_PLANES)
#else
#define IMPULSE_STRIDE IMPULSE_PLANES
#endif

// Of a second impulse that splits: behind the planes of both, for green and for blue.
#if HAS(DISPERSION) && HAS(BOTH_BRANCHES)
#define SPLIT_BASE (2 * IMPULSE_STRIDE)
#define SPLIT_STRIDE (SPLIT_PLANES + IMPULSE_STRIDE - IMPULSE_PLANES)
#endif

#if HAS(STRAIGHT)
#define RAY_CONE RAY_PLANES_STRAIGHT
#else
#define RAY_CONE RAY_PLANES
#endif
