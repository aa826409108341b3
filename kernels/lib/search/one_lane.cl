// Searches ask about one surface at a time, whatever the width of their rays: programs that search have one lane
// (lanes.cl). Included before anything that counts lanes.
#ifdef LANES
#error "searches have one lane"
#endif
#define LANES 1
#define TEXTURE_LOOKUP INLINE
#include "lib/lanes.cl"
