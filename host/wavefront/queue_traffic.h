// Bytes that a launch must move between queues, film and registers: each plane that it reads or writes, once
// for each entry that needs it, whatever the lanes beside it load. What the scene itself takes (tree,
// triangles, textures) is not among them: it comes from caches mostly, and how much of it nobody counts.
// Bytes over seconds is the effective bandwidth of a stage, to be held against what the machine's memory can
// do.
#pragma once

#include <cstdint>

#include "kernels/shared/layout.h"

namespace whittle::traffic {

using Bytes = std::uint64_t;
inline constexpr Bytes kPlane = sizeof(float);  ///< of one entry in one plane; indices are as wide
inline constexpr Bytes kRay = (RAY_THROUGHPUT - RAY_O) * kPlane;  ///< origin and direction
inline constexpr Bytes kRgb = 3 * kPlane;
// `hitBytes` and `flagBytes`: of one entry, see RayQueues.

/// Writes rays, and slots where impulses need them; reads the place of each pixel.
constexpr Bytes raygen(Bytes rays, Bytes pixels, bool slots) {
  return rays * (kRay + (slots ? kPlane : 0)) + pixels * kPlane;
}
constexpr Bytes intersect(Bytes rays, Bytes hitBytes) { return rays * (kRay + hitBytes); }
/// Reads rays, hits and, after the first bounce, throughputs; writes radiance and flags. Candidates come on
/// top.
constexpr Bytes shade(Bytes entries, bool throughputs, Bytes hitBytes, Bytes flagBytes) {
  return entries * (kRay + hitBytes + kRgb + (throughputs ? kRgb : 0) + flagBytes);
}
/// Reads rays, hits, radiance and flags; writes the last two.
constexpr Bytes shadeLight(Bytes entries, Bytes hitBytes, Bytes flagBytes) {
  return entries * (kRay + hitBytes + 2 * kRgb + 2 * flagBytes);
}
constexpr Bytes shadowCandidates(Bytes rays) { return rays * SHADOW_PLANES * kPlane; }
constexpr Bytes impulseCandidates(Bytes rays) { return rays * IMPULSE_PLANES * kPlane; }
constexpr Bytes compactCount(Bytes entries, Bytes flagBytes) { return entries * flagBytes; }
/// Reads and writes the totals of `chunks` chunks of `kinds` kinds.
constexpr Bytes scanChunks(Bytes chunks, Bytes kinds) { return 2 * chunks * kinds * kPlane; }
constexpr Bytes compactShadow(Bytes entries, Bytes found, Bytes flagBytes) {
  return entries * flagBytes + found * kPlane;
}
/// Reads flags, candidates and slots; writes whole rays.
constexpr Bytes compactImpulse(Bytes entries, Bytes found, Bytes flagBytes) {
  return entries * flagBytes + found * (IMPULSE_PLANES + 1 + RAY_PLANES) * kPlane;
}
/// Reads index, ray, length and contribution; adds to the radiance, as though every light were reached.
constexpr Bytes occlude(Bytes rays) { return rays * (kPlane + SHADOW_PLANES * kPlane + 2 * kRgb); }
/// Reads slot, throughput and radiance; adds to the sample, as though each entry were the only one of its
/// sample.
constexpr Bytes accumulate(Bytes entries) { return entries * (kPlane + 2 * kRgb + 2 * kRgb); }
constexpr Bytes findLongRuns(Bytes entries) { return entries * kPlane; }
/// Reads samples; reads and writes the film's planes, or writes them alone before the first sample.
constexpr Bytes film(Bytes pixels, Bytes samples, Bytes planes, bool first) {
  return pixels * samples * kRgb + pixels * planes * (first ? 1 : 2) * kPlane;
}

}  // namespace whittle::traffic
