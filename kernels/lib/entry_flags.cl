// The flags of LANES entries (ENTRY_… of layout.h) in registers and in memory, a byte each.
#include "lib/lanes.cl"

#if LANES == ENTRY_LANES
INLINE Natural loadFlags(__global const uchar* flags) { return convert_uint8(LOAD(flags)); }
INLINE void storeFlags(Natural found, __global uchar* flags) { STORE(convert_uchar8(found), flags); }
#else
INLINE Natural loadFlags(__global const uchar* flags) { return *flags; }
INLINE void storeFlags(Natural found, __global uchar* flags) { *flags = (uchar)found; }
#endif
