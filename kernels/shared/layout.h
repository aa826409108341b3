// Every struct and queue layout that host and device both read. Only 4-byte scalars and plain arrays of
// them, so that alignment and padding cannot differ; sizes are asserted on the host and asked of the device
// by a test.
#ifndef WHITTLE_LAYOUT_H
#define WHITTLE_LAYOUT_H

#ifndef __OPENCL_VERSION__
#include <cstdint>

#include <kernels/shared/scene_tables.h>
namespace whittle::device {
using uint = std::uint32_t;
#define WHITTLE_STRUCT(Name) struct Name
#else
#include "shared/scene_tables.h"
#define WHITTLE_STRUCT(Name) \
  typedef struct Name Name;  \
  struct Name
#endif

// Two children, boxes kept in the parent: one 64-byte line decides both. Mirrors whittle::TreeNode.
WHITTLE_STRUCT(Node) {
  float lo[2][3];
  float hi[2][3];
  int child[2];  // >= 0: node; < 0: leaf, ~child = first << 4 | count - 1 into the triangles
  int pad[2];
};

#define TRIANGLE_MASKED 1u     // alpha MASK: a hit must pass the alpha test
#define TRIANGLE_FILTERS 2u    // lets some light through: shadow rays go on, dimmed
#define TRIANGLE_COATS 4u      // alpha BLEND: comes before what lies in the same plane
#define TRIANGLE_ONE_SIDED 8u  // eye and impulse rays do not meet its back
// Behind the flags, where the triangle lies in its leaf: its lane, and the leaf's triangles less one, three bits each.
// 0 without PACKETS.
#define TRIANGLE_PLACE 8
#define TRIANGLE_PLACE_BITS (63u << TRIANGLE_PLACE)

// A triangle in leaf order. Its corners are in `leaves` (kernels/lib/corners.cl).
WHITTLE_STRUCT(DeviceTriangle) {
  uint primitive;  // index in the scene, decides ties
  uint flags;      // TRIANGLE_…
  uint material;
};

#define MATERIAL_UNLIT 1u
#define MATERIAL_VOLUME 2u
#define MATERIAL_DOUBLE_SIDED 4u
#define MATERIAL_MASK 8u
#define MATERIAL_BLEND 16u

#define WHITTLE_VECTOR(name, size, ...) float name[size];
#define WHITTLE_SCALAR(name, ...) float name;
#define WHITTLE_INDEX(slot, FEATURE, encoding, factor, OTHERS) int slot;
WHITTLE_STRUCT(DeviceMaterial) {
  WHITTLE_MATERIAL_FACTORS(WHITTLE_VECTOR, WHITTLE_SCALAR)
  uint flags;                           // MATERIAL_…
  WHITTLE_TEXTURE_SLOTS(WHITTLE_INDEX)  // indices into the texture slots, -1: none
};
#undef WHITTLE_VECTOR
#undef WHITTLE_SCALAR
#undef WHITTLE_INDEX

// How the colours of each slot are stored: baseColorTextureEncoding is SRGB, and so on.
enum { LINEAR, SRGB };
enum {
#define WHITTLE_ENCODING(slot, FEATURE, encoding, factor, OTHERS) slot##Encoding = encoding,
  WHITTLE_TEXTURE_SLOTS(WHITTLE_ENCODING)
#undef WHITTLE_ENCODING
};

#define WRAP_REPEAT 0u
#define WRAP_CLAMP 1u
#define WRAP_MIRROR 2u

#define TEXTURE_NEAREST 1u  // no filtering
#define TEXTURE_DEEP 2u     // 16 bits for each channel, with DEEP_TEXTURES

WHITTLE_STRUCT(DeviceTexture) {
  float transform[6];  // u' = t0 u + t1 v + t2, v' = t3 u + t4 v + t5
  uint firstTexel;     // words: one of RGBA8 for each texel, or two of RG16, BA16
  int width;
  int height;
  uint wrapS;
  uint wrapT;
  uint flags;  // TEXTURE_…
  uint uvSet;
  uint levels;  // 1: this one alone; else each smaller one lies behind the one that it is made of
};

// Light types: LIGHT_POINT, LIGHT_DIRECTIONAL, LIGHT_SPOT, …
enum {
#define WHITTLE_CODE(Kind, NAME, word, unit, isPlaced, isAimed, hasCone) LIGHT_##NAME,
  WHITTLE_LIGHT_TYPES(WHITTLE_CODE)
#undef WHITTLE_CODE
};

WHITTLE_STRUCT(DeviceLight) {
  float intensity[3];  // W/sr, or W/m² (directional)
  uint kind;           // LIGHT_…
  float position[3];
  float range;         // metres, inf: none
  float direction[3];  // the way it shines
  uint castsShadows;
  float versineOuter;  // 1 - cos of the half angles
  float versineInner;
  uint index;     // in the scene
  uint behind;    // 1: what it brings to the side away from the viewer, with DIFFUSE_TRANSMISSION
  uint emitters;  // of a surface light
};

// A triangle that glows, see host/scene/emitters.h.
WHITTLE_STRUCT(DeviceEmitter) {
  uint triangle;  // in leaf order
  float until;
  float inverseDensity;  // m²
  uint twoSided;         // 1: it glows on both sides
};

// How many emitters are drawn by their power for each light ray, of which one is kept by what it brings. More make less
// noise, and each takes time; measured: kernels/README.md.
#define EMITTER_CANDIDATES 4
// Between these a triangle's points are drawn evenly in solid angle, beyond them evenly over its area. Smaller ones
// look the same from all their points, but for the rounding of directions; those that fill the hemisphere touch the
// surface.
#define LEAST_SOLID_ANGLE 1e-6f
#define MOST_SOLID_ANGLE 6.22f

// Vectors are four floats apart: a compiler loads the fourth along, and the bits of a small integer there
// are a subnormal float, whose product stalls a CPU for a hundred cycles (measured: raygen took seven
// times as long).
WHITTLE_STRUCT(DeviceCamera) {
  float position[4];
  float forward[4];
  // Half a pixel to the right and down on the image plane one unit ahead (orthographic: in metres); high and
  // low parts.
  float stepX[4];
  float stepXLow[4];
  float stepY[4];
  float stepYLow[4];
  uint orthographic;
  uint seed;
  uint width;  // pixels
  uint height;
  uint raysPerPixel;
  uint sampler;  // 0 random, 1 stratified, 2 sobol
  float znear;   // metres along forward: where eye rays begin, with NEAR_PLANE
  uint pad;
  // With LENS: unit vectors in its plane, its radius, and how far along forward it is focused, m.
  float right[4];
  float up[4];
  float lensRadius;
  float focusDistance;
  uint padding[2];
};

// With TERMINATOR: a triangle counts as a piece of a curved surface where the cosine between its plane's normal and a
// corner's is below the first at one corner and above the second at all: 1 degree, of which the facets would show as
// steps of a fiftieth of the light, to 60 degrees, where normals round an edge instead.
#define COARSE_COSINE 0.99984770f
#define EDGE_COSINE 0.5f

// Constants of a render that a kernel needs by value.
WHITTLE_STRUCT(RenderConstants) {
  float background[3];
  float rayOffset;  // metres; < 0: derived at each hit
  int backgroundWidth;
  int backgroundHeight;
  float mirrorRoughness;
  uint seed;
  float cutoff;             // an impulse whose throughput is at most this in every channel is not traced
  float forward[3];         // of the camera
  float zfar;               // metres along it: where eye rays end, with FAR_PLANE
  uint transparentBounces;  // surfaces that a ray may pass straight on, besides its bounces
  float ambient;            // radiance from all sides that every lit surface receives, with AMBIENT
  float backgroundAhead;    // u of the map seen along -Z, in [0, 1]: a half, where it is not turned
  uint backgroundClear;     // 1: what the eye sees of it straight on counts as transmittance, with COVERAGE
  // With LIGHT_SIZE: the radius of lights with a place, m; 1 - cos of half the angle that directional ones fill.
  float lightRadius;
  float sunVersine;
  uint sampler;  // as in DeviceCamera
  uint raysPerPixel;
  uint glossy;  // 1: rough surfaces send out impulses, with GLOSS
  // With TEXTURE_LEVELS the cone of a pixel's eye rays: its width, m (of a pinhole 0), and how fast it grows along the
  // camera's axis; and the most lookups along a footprint.
  float coneWidth;
  float coneSpread;
  uint textureProbes;
};

// The samples of one batch: pixels [firstPixel, firstPixel + pixels) of the pixel order, times samples
// [firstSample, firstSample + samples). Slot = (pixel - firstPixel) · samples + (sample - firstSample).
WHITTLE_STRUCT(Batch) {
  uint firstPixel;
  uint pixels;
  uint firstSample;
  uint samples;
};

// Queues are struct-of-arrays: plane p of entry i is queue[p * capacity + i]. Buffers are padded by
// QUEUE_PADDING entries so that a packet may load past the end.
#define QUEUE_PADDING 16

// Ray queue: origin (m), direction (unit), throughput (RGB; eye rays: not written, it is 1), slot of its
// sample (uint bits). Entries of one sample are neighbours. Without IMPULSES there are eye rays alone, entry
// i is that of slot i, and the queue ends before the throughput.
#define RAY_O 0
#define RAY_D 3
#define RAY_THROUGHPUT 6
#define RAY_SLOT 9
#define RAY_PLANES 10
#define EYE_RAY_PLANES 6

// With STRAIGHT, behind those (eye rays: not written): what the ray has met already, where it went straight on. Origin
// and direction stay as they were, so that nothing is lost between two surfaces, and hits go on in the order of
// (HIT_ORDER, triangle index), strictly after the last: that order (0: none yet) and the triangle in leaf order. Then
// its steps: bounces, passages straight on (from bit 13) and, up to 63, those of them where the surface sent out an
// impulse too (from bit 26).
#define RAY_AFTER_ORDER 10
#define RAY_AFTER_TRIANGLE 11
#define RAY_STEPS 12
#define RAY_PLANES_STRAIGHT 13
#define STEP_BOUNCE 1u
#define STEP_STRAIGHT (1u << 13)
#define STEP_BRANCHED (1u << 26)
// A surface that both reflects and lets straight on makes two rays of one, and a stack of them would make thousands: an
// impulse is followed only if there would be a bounce for it had those passages been bounces, or if it still carries
// this share of the picture, which few can.
#define BRANCH_SHARE 0.125f

// With TEXTURE_LEVELS and IMPULSES, behind all of those (eye rays: not written, it follows from the camera), and in
// the same order behind the planes of each impulse candidate: the ray's cone, its width at the origin (m) and how much
// wider it is with each metre, negative where it narrows.
#define CONE_WIDTH 0
#define CONE_SPREAD 1
#define CONE_PLANES 2

// Hits: triangle in leaf order (uint bits, NO_HIT), barycentrics b1, b2, distance (m). Only TEXTURES,
// ABSORPTION and AOVS ask how far away a hit is; without them the queue ends before that.
#define HIT_TRIANGLE 0
#define HIT_B1 1
#define HIT_B2 2
#define HIT_T 3
#define HIT_PLANES 4
#define HIT_PLANES_WITHOUT_T 3
// With STRAIGHT also what decides which hit comes first: the distance, but of a blended surface a little
// less (COAT_ORDER). So a decal shows that lies exactly in the plane of a wall, whatever rounding makes of
// the two distances.
#define HIT_ORDER 4
#define HIT_PLANES_STRAIGHT 5
// With COST also what the search visited (uint bits): nodes opened and triangles tested, of a packet that goes
// together those of the whole packet.
#define HIT_NODES 5
#define HIT_TESTS 6
#define HIT_PLANES_COST 7
#define COAT_ORDER 0.99999905f  // 1 - 2^-20: above the rounding of two distances, 5 um at 5 m
#define NO_HIT 0xffffffffu

// Shadow candidates, one for each ray entry and light round: offset origin, direction, length, contribution.
#define SHADOW_O 0
#define SHADOW_D 3
#define SHADOW_LENGTH 6
#define SHADOW_CONTRIBUTION 7
#define SHADOW_PLANES 10

// Impulse candidates, two for each ray entry (plane + k * IMPULSE_PLANES), or one where no surface sends out
// two: origin, direction, throughput; with TEXTURE_LEVELS each set is longer by CONE_PLANES. Of one that is not
// followed (ENTRY_ENDED0) only the first plane of the throughput is written: its largest channel, negative where
// --cutoff ended it.
#define IMPULSE_O 0
#define IMPULSE_D 3
#define IMPULSE_THROUGHPUT 6
#define IMPULSE_PLANES 9
// With DISPERSION and two candidates, behind both: what the second has for green and for blue, direction and cone; its
// own are for red. ENTRY_IMPULSE1 with ENTRY_ENDED1 means that it splits: into a ray for each positive channel of its
// throughput, which carries that channel alone.
#define SPLIT_D 0
#define SPLIT_PLANES 3

// What shade found at an entry: these flags in a byte.
#define ENTRY_SHADOW 1u
#define ENTRY_IMPULSE0 2u
#define ENTRY_IMPULSE1 4u
#define ENTRY_STRAIGHT0 8u  // that impulse goes straight on
#define ENTRY_STRAIGHT1 16u
#define ENTRY_BRANCHED 32u  // one impulse goes straight on, the other does not
#define ENTRY_ENDED0 64u    // that impulse is not followed
#define ENTRY_ENDED1 128u
#define ENTRY_SPLIT1 (ENTRY_IMPULSE1 | ENTRY_ENDED1)  // both: that impulse splits

// What is not followed is counted by what ended it: sums of throughputs (largest channel) in these units, each rounded
// up, so that no order changes a sum. A throughput counts as at most ENDED_MOST; a queue of 2^24 of them fits 64 bits.
#define ENDED_CUTOFF 0
#define ENDED_BOUNCES 1
#define ENDED_STRAIGHT 2  // --transparent-bounces
#define ENDED_KINDS 3
#define ENDED_UNITS 67108864.0f  // 2^26
#define ENDED_MOST 8192.0f
// Sums over chunks and over all of them: shadow rays, impulses, then the low and high half of each ENDED_ kind.
#define SUM_SHADOW 0
#define SUM_IMPULSE 1
#define SUM_ENDED 2
#define SUMS (SUM_ENDED + 2 * ENDED_KINDS)

// Radiance of entries and samples: RGB, and with COVERAGE the transmittance: how much of what lies behind the
// scene shows, straight on from the eye. The picture's alpha is what is left of 1.
#define RADIANCE_PLANES 3
#define RADIANCE_TRANSMITTANCE 3
#define RADIANCE_PLANES_COVERAGE 4

// Film planes for each pixel, in the pixel order: compensated sums of RGB, and of the mean of their squares
// for the error estimate; with COVERAGE of the transmittance, behind all others. One sample for each pixel needs
// the sums only, without squares. A batch that does not go over
// neighbouring pixels goes over whole blocks of FILM_BLOCK of them (the picture's last may be shorter, and
// comes last).
#define FILM_BLOCK 64
#define FILM_SUM 0
#define FILM_COMPENSATION 3
#define FILM_SQUARES 6
#define FILM_SQUARES_COMPENSATION 7
#define FILM_PLANES 8
#define FILM_PLANES_OF_ONE 3
#define FILM_TRANSMITTANCE 8
#define FILM_TRANSMITTANCE_COMPENSATION 9
#define FILM_PLANES_COVERAGE 10
#define FILM_TRANSMITTANCE_OF_ONE 3
#define FILM_PLANES_OF_ONE_COVERAGE 4

// Auxiliary outputs of a pixel's first sample.
#define AOV_DEPTH 0
#define AOV_PRIMITIVE 1  // float of the index; -1 for none; exact below 2^24
#define AOV_NORMAL 2
#define AOV_ALBEDO 5
#define AOV_PLANES 8

// Counters on the device.
#define COUNTER_NONFINITE 0
#define COUNTER_LONG_RUN 1
#define COUNTER_SPENT_WALK 2  // 1: a search was longer than LOOP_BUDGET
#define COUNTERS 3

#ifndef __OPENCL_VERSION__
}  // namespace whittle::device
#endif
#undef WHITTLE_STRUCT

#endif
