// How many impulses a hit can send out. In a file of its own: programs that do not ask are the same for either answer.
#include "lib/math.cl"

#if HAS(BOTH_BRANCHES)
#define IMPULSES_OF_HIT 2
#else
#define IMPULSES_OF_HIT 1
#endif
