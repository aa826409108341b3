// The flags of LANES entries (ENTRY_… of layout.h) in registers and in memory: a byte for each entry, or a word where
// what a cut-off kept back stands above them. In a file of its own: programs that do not ask are the same for either
// answer.
#include "lib/lanes.cl"

#if HAS(CUTOFF)
typedef uint EntryFlags;
INLINE Natural loadFlags(__global const EntryFlags* flags) { return LOAD(flags); }
INLINE void storeFlags(Natural found, __global EntryFlags* flags) { STORE(found, flags); }
#elif LANES == ENTRY_LANES
typedef uchar EntryFlags;
INLINE Natural loadFlags(__global const EntryFlags* flags) { return convert_uint8(LOAD(flags)); }
INLINE void storeFlags(Natural found, __global EntryFlags* flags) { STORE(convert_uchar8(found), flags); }
#else
typedef uchar EntryFlags;
INLINE Natural loadFlags(__global const EntryFlags* flags) { return *flags; }
INLINE void storeFlags(Natural found, __global EntryFlags* flags) { *flags = (EntryFlags)found; }
#endif
