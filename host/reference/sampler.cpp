// Sample positions in a pixel and random numbers, as README.md defines them.
#include "reference/sampler.h"

#include <bit>

namespace whittle::reference {
namespace {

std::uint32_t mix(std::uint32_t v) {
  v ^= v >> 16;
  v *= 0x7feb352dU;
  v ^= v >> 15;
  v *= 0x846ca68bU;
  v ^= v >> 16;
  return v;
}

std::uint32_t reverseBits(std::uint32_t x) {
  std::uint32_t reversed = 0;
  for (int bit = 0; bit < 32; ++bit) reversed |= ((x >> bit) & 1U) << (31 - bit);
  return reversed;
}

/// Every bit changes depending on the bits below it alone.
std::uint32_t laineKarras(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cU;
  x ^= x * 0xb82f1e52U;
  x ^= x * 0xc7afe638U;
  x ^= x * 0x8d22f6e6U;
  return x;
}

/// Every bit changes depending on the bits above it alone: a nested uniform scramble of the unit interval.
std::uint32_t owen(std::uint32_t x, std::uint32_t seed) {
  return reverseBits(laineKarras(reverseBits(x), seed));
}

std::uint32_t secondSobolDimension(std::uint32_t index) {
  std::uint32_t point = 0;
  for (std::uint32_t v = 1U << 31; index != 0; index >>= 1, v ^= v >> 1) {
    if (index & 1U) point ^= v;
  }
  return point;
}

Vec2 stratified(std::uint32_t sample, std::uint32_t count, const Vec2& random) {
  auto m = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(count)));
  if (sample >= m * m) return random;
  return (Vec2(sample % m, sample / m) + random) / static_cast<double>(m);
}

Vec2 sobol(std::uint32_t pixel, std::uint32_t sample, std::uint32_t dimension, std::uint32_t seed) {
  const std::uint32_t index = owen(sample, hash(pixel, 0, dimension + 2, seed));
  return {unit(owen(reverseBits(index), hash(pixel, 0, dimension + 3, seed))),
          unit(owen(secondSobolDimension(index), hash(pixel, 0, dimension + 4, seed)))};
}

/// The numbers below `count` in another order for each seed: a bijection of the numbers of as many bits,
/// again while the result is not one of them.
std::uint32_t permuted(std::uint32_t i, std::uint32_t count, std::uint32_t seed) {
  const int bits = std::bit_width(count - 1);
  const std::uint32_t mask = bits == 0 ? 0 : ~0U >> (32 - bits);
  const int shift = (bits + 1) / 2;
  do {
    i = (i + seed) & mask;
    i ^= i >> shift;
    i = (i * 0x9e3779b1U) & mask;
    i ^= i >> shift;
    i = (i * 0x85ebca6bU + (seed >> 16)) & mask;
    i ^= i >> shift;
  } while (i >= count);
  return i;
}

}  // namespace

std::uint32_t hash(std::uint32_t pixel, std::uint32_t sample, std::uint32_t dimension, std::uint32_t seed) {
  return mix(pixel + mix(sample + mix(dimension + mix(seed + 0x9e3779b9U))));
}

double unit(std::uint32_t bits) { return (bits >> 8) * 0x1p-24; }

Vec2 samplePosition(Sampler sampler, std::uint32_t pixel, std::uint32_t sample, std::uint32_t count,
                    std::uint32_t seed) {
  if (count == 1) return {0.5, 0.5};
  if (sampler == Sampler::Sobol) return sobol(pixel, sample, 0, seed);
  const Vec2 random(unit(hash(pixel, sample, 0, seed)), unit(hash(pixel, sample, 1, seed)));
  return sampler == Sampler::Stratified ? stratified(sample, count, random) : random;
}

Vec2 squarePosition(Sampler sampler, std::uint32_t pixel, std::uint32_t sample, std::uint32_t count,
                    std::uint32_t dimension, std::uint32_t seed) {
  if (sampler == Sampler::Sobol && count > 1) return sobol(pixel, sample, dimension, seed);
  const Vec2 random(unit(hash(pixel, sample, dimension, seed)),
                    unit(hash(pixel, sample, dimension + 1, seed)));
  if (sampler != Sampler::Stratified || count == 1) return random;
  const auto m = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(count)));
  const std::uint32_t stratum =
      sample < m * m ? permuted(sample, m * m, hash(pixel, 0, dimension + 2, seed)) : sample;
  return stratified(stratum, count, random);
}

}  // namespace whittle::reference
