// Every feature a scene or a setting may or may not need, once, for host and kernels: its name, its bit and
// what a person calls it. The host hands the kernels ONE number (-D SCENE_FEATURES=0x…); kernels ask by
// name: `#if HAS(EMISSION)`. Left out, everything is on, so that any kernel file compiles by itself. For
// the host cmake/feature_list.cmake turns these lines into WHITTLE_FEATURES(X), with X(NAME, bit, "what a
// person calls it"). Bits that are free: 29, 30.
#ifndef WHITTLE_FEATURES_H
#define WHITTLE_FEATURES_H

#define BIT_PACKETS 0                      // packets of sixteen rays
#define BIT_TREE 1                         // tree search
#define BIT_SHADOWS 2                      // shadow rays
#define BIT_FILTERED_SHADOWS 3             // shadows through transparent surfaces
#define BIT_POINT_LIGHTS 4                 // point lights
#define BIT_DIRECTIONAL_LIGHTS 5           // directional lights
#define BIT_SPOT_LIGHTS 6                  // spot lights
#define BIT_LIGHT_RANGE 7                  // light range
#define BIT_MICROFACET 8                   // microfacet highlights
#define BIT_METAL 9                        // metal
#define BIT_MIRROR 10                      // mirror impulses
#define BIT_TRANSMISSION 11                // transmission impulses
#define BIT_REFRACTION 12                  // refraction
#define BIT_ABSORPTION 13                  // absorption
#define BIT_ALPHA_MASK 14                  // alpha mask
#define BIT_ALPHA_BLEND 15                 // alpha blend
#define BIT_EMISSION 16                    // emission
#define BIT_UNLIT 17                       // unlit materials
#define BIT_SPECULAR_EXTENSION 18          // specular strength and colour
#define BIT_VERTEX_NORMALS 19              // vertex normals
#define BIT_VERTEX_COLORS 20               // vertex colours
#define BIT_TEXTURES 21                    // textures
#define BIT_UV0 22                         // first UV set
#define BIT_UV1 23                         // second UV set
#define BIT_BASE_COLOR_TEXTURE 24          // base colour texture
#define BIT_METALLIC_ROUGHNESS_TEXTURE 25  // metallic-roughness texture
#define BIT_NORMAL_TEXTURE 26              // normal map
#define BIT_DIFFUSE_TRANSMISSION 27        // diffuse transmission
#define BIT_DISPERSION 28                  // dispersion
#define BIT_BACKGROUND 31                  // background radiance
#define BIT_BACKGROUND_MAP 32              // background map
#define BIT_BOTH_BRANCHES 33               // two impulses from one hit
#define BIT_ONE_IMPULSE 34                 // one impulse chosen at random
#define BIT_ORTHOGRAPHIC 35                // orthographic camera
#define BIT_SAMPLER_RANDOM 36              // random sampler
#define BIT_SAMPLER_STRATIFIED 37          // stratified sampler
#define BIT_SAMPLER_SOBOL 38               // Sobol sampler
#define BIT_FIXED_RAY_OFFSET 39            // fixed ray offset
#define BIT_AOVS 40                        // auxiliary outputs
#define BIT_IMPULSES 41                    // impulse queue
#define BIT_LIGHTS 42                      // direct light
#define BIT_NEAREST_FILTER 43              // nearest texture filter
#define BIT_CUTOFF 44                      // cut-off of weak impulses
#define BIT_STRAIGHT 45                    // rays that go straight on
#define BIT_ONE_SIDED 46                   // back faces left out
#define BIT_NEAR_PLANE 47                  // near plane
#define BIT_FAR_PLANE 48                   // far plane
#define BIT_AMBIENT 49                     // ambient light
#define BIT_DEEP_TEXTURES 50               // textures of 16 bits
#define BIT_COVERAGE 51                    // alpha channel
#define BIT_COST 52                        // search cost
#define BIT_LIGHT_SIZE 53                  // lights of some size
#define BIT_LENS 54                        // thin lens
#define BIT_GLOSS 55                       // glossy impulses
#define BIT_SURFACE_LIGHTS 56              // surface lights
#define BIT_TEXTURE_LEVELS 57              // texture levels
#define BIT_CLEARCOAT 58                   // clear coats
#define BIT_SHEEN 59                       // sheen
#define BIT_SKY_LIGHTS 60                  // sky lights
#define BIT_TERMINATOR 61                  // smooth terminator
#define BIT_IRIDESCENCE 62                 // iridescence
#define BIT_ANISOTROPY 63                  // anisotropy

#ifdef __OPENCL_VERSION__
#ifndef SCENE_FEATURES
#define SCENE_FEATURES 0xffffffffffffffff  // preprocessor arithmetic is 64 bits wide, without a sign for such a number
#endif
#define HAS(feature) ((SCENE_FEATURES >> BIT_##feature) & 1)
#else
#include <feature_list.h>
#endif

// Tuning numbers: defaults for kernels compiled alone; the host passes its choice as -D NAME=value.
#ifndef COMPACT_CHUNK
#define COMPACT_CHUNK 1024  // entries that one work item of the compaction walks: many on a CPU, few on a GPU
#endif

#ifndef LOOP_BUDGET
#define LOOP_BUDGET 0  // iterations of a walk, where a driver ends loops (host/cl/device_facts.h); 0: it does not
#endif

#define TEXTURE_PROBES 4   // lookups side by side along a footprint, at most
#define LONG_RUN 256       // a sample with more entries than this in one queue is cut into slices of this length
#define PACKET_RAYS 16     // rays of a packet, with PACKETS; one for each work item without
#define ENTRY_LANES 8      // entries that a work item of the other stages handles, likewise
#define BVH8_DEPTH 64      // nodes on a way through the eight-wide tree; a deeper one is refused
#define MAX_TREE_DEPTH 60  // traversal stack; the builder keeps to it

#endif
