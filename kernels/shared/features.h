// Every feature a scene or a setting may or may not need, once, for host and kernels. The host hands the
// kernels ONE number (-D SCENE_FEATURES=0x…); kernels ask by name: `#if HAS(EMISSION)`. Left out, everything
// is on, so that any kernel file compiles by itself. X(NAME, bit, "what a person calls it").
#ifndef WHITTLE_FEATURES_H
#define WHITTLE_FEATURES_H

#define WHITTLE_FEATURES(X)                                       \
  X(PACKETS, 0, "packets of sixteen rays")                        \
  X(TREE, 1, "tree search")                                       \
  X(SHADOWS, 2, "shadow rays")                                    \
  X(FILTERED_SHADOWS, 3, "shadows through transparent surfaces")  \
  X(POINT_LIGHTS, 4, "point lights")                              \
  X(DIRECTIONAL_LIGHTS, 5, "directional lights")                  \
  X(SPOT_LIGHTS, 6, "spot lights")                                \
  X(LIGHT_RANGE, 7, "light range")                                \
  X(MICROFACET, 8, "microfacet highlights")                       \
  X(METAL, 9, "metal")                                            \
  X(MIRROR, 10, "mirror impulses")                                \
  X(TRANSMISSION, 11, "transmission impulses")                    \
  X(REFRACTION, 12, "refraction")                                 \
  X(ABSORPTION, 13, "absorption")                                 \
  X(ALPHA_MASK, 14, "alpha mask")                                 \
  X(ALPHA_BLEND, 15, "alpha blend")                               \
  X(EMISSION, 16, "emission")                                     \
  X(UNLIT, 17, "unlit materials")                                 \
  X(SPECULAR_EXTENSION, 18, "specular strength and colour")       \
  X(VERTEX_NORMALS, 19, "vertex normals")                         \
  X(VERTEX_COLORS, 20, "vertex colours")                          \
  X(TEXTURES, 21, "textures")                                     \
  X(UV0, 22, "first UV set")                                      \
  X(UV1, 23, "second UV set")                                     \
  X(BASE_COLOR_TEXTURE, 24, "base colour texture")                \
  X(METALLIC_ROUGHNESS_TEXTURE, 25, "metallic-roughness texture") \
  X(NORMAL_TEXTURE, 26, "normal map")                             \
  X(EMISSION_TEXTURE, 27, "emission texture")                     \
  X(SPECULAR_TEXTURE, 28, "specular texture")                     \
  X(SPECULAR_COLOR_TEXTURE, 29, "specular colour texture")        \
  X(TRANSMISSION_TEXTURE, 30, "transmission texture")             \
  X(BACKGROUND, 31, "background radiance")                        \
  X(BACKGROUND_MAP, 32, "background map")                         \
  X(BOTH_BRANCHES, 33, "two impulses from one hit")               \
  X(ONE_IMPULSE, 34, "one impulse chosen at random")              \
  X(ORTHOGRAPHIC, 35, "orthographic camera")                      \
  X(SAMPLER_RANDOM, 36, "random sampler")                         \
  X(SAMPLER_STRATIFIED, 37, "stratified sampler")                 \
  X(SAMPLER_SOBOL, 38, "Sobol sampler")                           \
  X(FIXED_RAY_OFFSET, 39, "fixed ray offset")                     \
  X(AOVS, 40, "auxiliary outputs")                                \
  X(IMPULSES, 41, "impulse queue")                                \
  X(LIGHTS, 42, "direct light")                                   \
  X(NEAREST_FILTER, 43, "nearest texture filter")                 \
  X(CUTOFF, 44, "cut-off of weak impulses")

#ifdef __OPENCL_VERSION__
// Preprocessor arithmetic is 64 bits wide; the macro above cannot define macros, so the bits stand here again
// by name. tests/kernels/layout_test.cpp compares the two lists.
#define BIT_PACKETS 0
#define BIT_TREE 1
#define BIT_SHADOWS 2
#define BIT_FILTERED_SHADOWS 3
#define BIT_POINT_LIGHTS 4
#define BIT_DIRECTIONAL_LIGHTS 5
#define BIT_SPOT_LIGHTS 6
#define BIT_LIGHT_RANGE 7
#define BIT_MICROFACET 8
#define BIT_METAL 9
#define BIT_MIRROR 10
#define BIT_TRANSMISSION 11
#define BIT_REFRACTION 12
#define BIT_ABSORPTION 13
#define BIT_ALPHA_MASK 14
#define BIT_ALPHA_BLEND 15
#define BIT_EMISSION 16
#define BIT_UNLIT 17
#define BIT_SPECULAR_EXTENSION 18
#define BIT_VERTEX_NORMALS 19
#define BIT_VERTEX_COLORS 20
#define BIT_TEXTURES 21
#define BIT_UV0 22
#define BIT_UV1 23
#define BIT_BASE_COLOR_TEXTURE 24
#define BIT_METALLIC_ROUGHNESS_TEXTURE 25
#define BIT_NORMAL_TEXTURE 26
#define BIT_EMISSION_TEXTURE 27
#define BIT_SPECULAR_TEXTURE 28
#define BIT_SPECULAR_COLOR_TEXTURE 29
#define BIT_TRANSMISSION_TEXTURE 30
#define BIT_BACKGROUND 31
#define BIT_BACKGROUND_MAP 32
#define BIT_BOTH_BRANCHES 33
#define BIT_ONE_IMPULSE 34
#define BIT_ORTHOGRAPHIC 35
#define BIT_SAMPLER_RANDOM 36
#define BIT_SAMPLER_STRATIFIED 37
#define BIT_SAMPLER_SOBOL 38
#define BIT_FIXED_RAY_OFFSET 39
#define BIT_AOVS 40
#define BIT_IMPULSES 41
#define BIT_LIGHTS 42
#define BIT_NEAREST_FILTER 43
#define BIT_CUTOFF 44
#ifndef SCENE_FEATURES
#define SCENE_FEATURES 0x7fffffffffffffff
#endif
#define HAS(feature) ((SCENE_FEATURES >> BIT_##feature) & 1)
#endif

// Tuning numbers: defaults for kernels compiled alone; the host passes its choice as -D NAME=value.
#ifndef COMPACT_CHUNK
#define COMPACT_CHUNK 1024  // entries that one work item of the compaction walks: many on a CPU, few on a GPU
#endif

#define LONG_RUN 256    // a sample with more entries than this in one queue is cut into slices of this length
#define PACKET_RAYS 16  // rays of a packet, with PACKETS; one for each work item without
#define ENTRY_LANES 8   // entries that a work item of the other stages handles, likewise
#define BVH8_DEPTH 64   // nodes on a way through the eight-wide tree; a deeper one is refused
#define MAX_TREE_DEPTH 60  // traversal stack; the builder keeps to it

#endif
