// Where in its pixel a sample lies: hashes of (pixel, sample, dimension, seed), never of a thread or a time.
// Sobol points with Owen scrambling by hashing: Laine and Karras 2011, Burley, "Practical Hash-based Owen
// Scrambling", JCGT 2020.
#pragma once

#include <cstdint>

#include "reference/vec.h"
#include "scene/settings.h"

namespace whittle::reference {

/// Dimension of the choice between two impulses at bounce 0; bounce d uses kImpulseDimension + d.
inline constexpr std::uint32_t kImpulseDimension = 16;

/// A well-mixed 32-bit hash.
std::uint32_t hash(std::uint32_t pixel, std::uint32_t sample, std::uint32_t dimension, std::uint32_t seed);

/// The upper 24 bits as a number in [0, 1).
double unit(std::uint32_t bits);

/// Of the lens's square.
inline constexpr std::uint32_t kLensDimension = 8;

/// Where the eight dimensions of the microfacets' square at round r begin, less 8 r; of light i's, less
/// 8 (r + kRounds i).
inline constexpr std::uint32_t kGlossDimension = 0x10000, kLightDimension = 0x40000, kRounds = 8192;
/// Where among a light's eight the square begins that says which emitter: its dimensions are no sampler's of
/// the first.
inline constexpr std::uint32_t kChoiceDimension = 3;

/// Position in [0,1)² of a sample in a square of its own, whose dimensions begin at `dimension`.
Vec2 squarePosition(Sampler sampler, std::uint32_t pixel, std::uint32_t sample, std::uint32_t count,
                    std::uint32_t dimension, std::uint32_t seed);

/// Position in [0,1)² of sample `sample` of `count` in pixel number `pixel`; the centre if count is 1.
Vec2 samplePosition(Sampler sampler, std::uint32_t pixel, std::uint32_t sample, std::uint32_t count,
                    std::uint32_t seed);

}  // namespace whittle::reference
