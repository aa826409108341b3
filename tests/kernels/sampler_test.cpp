// The samplers against a twin written from host/reference/README.md, "Eye rays": every bit of hash, scramble
// and position.
#include <gtest/gtest.h>

#include <bitset>

#include "kernels/shared/layout.h"
#include "support/kernel_bench.h"
#include "support/random_scenes.h"

namespace whittle {
namespace {

using U = std::uint32_t;

U mix(U v) {
  v ^= v >> 16, v *= 0x7feb352dU;
  v ^= v >> 15, v *= 0x846ca68bU;
  return v ^ (v >> 16);
}
U hash(U p, U s, U dim, U seed) { return mix(p + mix(s + mix(dim + mix(seed + 0x9e3779b9U)))); }
float unit(U h) { return static_cast<float>(h >> 8) / 16777216.0F; }
U reversed(U v) {
  std::bitset<32> in(v), out;
  for (std::size_t i = 0; i < 32; ++i) out[31 - i] = in[i];
  return static_cast<U>(out.to_ulong());
}
U owen(U x, U seed) {
  x = reversed(x) + seed;
  for (const U factor : {0x6c50b47cU, 0xb82f1e52U, 0xc7afe638U, 0x8d22f6e6U}) x ^= x * factor;
  return reversed(x);
}
U sobol2(U i) {
  U result = 0, v = U{1} << 31;
  for (int k = 0; k < 32; ++k, v ^= v >> 1) result ^= (i >> k & 1U) ? v : 0;
  return result;
}

glm::vec2 position(U sampler, U p, U s, U n, U seed) {
  const glm::vec2 random(unit(hash(p, s, 0, seed)), unit(hash(p, s, 1, seed)));
  if (n == 1) return {0.5F, 0.5F};
  if (sampler == 2) {
    const U i = owen(s, hash(p, 0, 2, seed));
    return {unit(owen(reversed(i), hash(p, 0, 3, seed))), unit(owen(sobol2(i), hash(p, 0, 4, seed)))};
  }
  U m = 1;
  while ((m + 1) * (m + 1) <= n) ++m;
  if (sampler == 0 || s >= m * m) return random;
  return {(static_cast<float>(s % m) + random.x) / static_cast<float>(m),
          (static_cast<float>(s / m) + random.y) / static_cast<float>(m)};
}

constexpr const char* kSamplerKernels = R"(
__kernel void positions(uint n, const DeviceCamera camera, __global const uint* v, __global float* out) {
  const uint i = get_global_id(0);
  if (i >= n) return;
  const DeviceCamera own = camera;
  vstore2(samplePixel(&own, v[2 * i], v[2 * i + 1]), i, out);
}
__kernel void words(uint n, __global const uint* v, __global uint* out) {
  const uint i = get_global_id(0);
  if (i >= n) return;
  out[4 * i] = hash4(v[4 * i], v[4 * i + 1], v[4 * i + 2], v[4 * i + 3]);
  out[4 * i + 1] = owenScramble(v[4 * i], v[4 * i + 1]);
  out[4 * i + 2] = sobolSecond(v[4 * i]);
  out[4 * i + 3] = as_uint(unitFloat(v[4 * i]));
}
)";

TEST(Sampler, EveryBitOfTheTwin) {
  test::KernelBench bench({"lib/sampler.cl"}, kSamplerKernels);
  test::Rng rng(31);
  std::vector<U> words{0, 0, 0, 0, ~0U, ~0U, ~0U, ~0U, 1, 0, 0, 0};
  while (words.size() < 4 * 5003) words.push_back(static_cast<U>(rng.bits()));
  const auto count = static_cast<U>(words.size() / 4);
  const auto out = bench.map<U>("words", count, 4, bench.compute.upload("v", words));
  for (U i = 0; i < count; ++i) {
    const U* w = words.data() + 4 * i;
    float u;
    std::memcpy(&u, &out[4 * i + 3], sizeof(u));
    ASSERT_EQ(out[4 * i], hash(w[0], w[1], w[2], w[3]));
    ASSERT_EQ(out[4 * i + 1], owen(w[0], w[1]));
    ASSERT_EQ(out[4 * i + 2], sobol2(w[0]));
    ASSERT_EQ(u, unit(w[0]));
    ASSERT_LT(u, 1.0F);
  }

  for (U sampler = 0; sampler < 3; ++sampler) {
    for (const U n : {1U, 2U, 4U, 10U, 16U, 255U, 65536U}) {
      device::DeviceCamera camera{};
      camera.raysPerPixel = n;
      camera.sampler = sampler;
      camera.seed = 77 + n;
      std::vector<U> at;
      for (U i = 0; i < 301; ++i)
        at.insert(at.end(), {static_cast<U>(rng.bits() % 4000000), static_cast<U>(rng.bits() % n)});
      const auto where = bench.map<float>("positions", 301, 2, camera, bench.compute.upload("v", at));
      for (U i = 0; i < 301; ++i) {
        const glm::vec2 expected = position(sampler, at[2 * i], at[2 * i + 1], n, camera.seed);
        // One division may be off by 2.5 units where a device does not round it correctly; the rest is exact.
        const float tolerance = sampler == 1 ? 3 * 0x1p-24F : 0.0F;
        ASSERT_NEAR(where[2 * i], expected.x, tolerance) << "sampler " << sampler << " n " << n;
        ASSERT_NEAR(where[2 * i + 1], expected.y, tolerance) << "sampler " << sampler << " n " << n;
        ASSERT_TRUE(where[2 * i] >= 0 && where[2 * i] < 1 && where[2 * i + 1] >= 0 && where[2 * i + 1] < 1);
      }
    }
  }
}

/// What the formulas are for: 16 aligned Sobol samples are a (0,4,2)-net, one in each cell of 16×1, 8×2, 4×4,
/// 2×8, 1×16.
TEST(Sampler, AlignedSobolBlocksAreNets) {
  test::KernelBench bench({"lib/sampler.cl"}, kSamplerKernels);
  device::DeviceCamera camera{};
  camera.raysPerPixel = 64;
  camera.sampler = 2;
  for (const U pixel : {0U, 5U, 123456U}) {
    std::vector<U> at;
    for (U s = 0; s < 64; ++s) at.insert(at.end(), {pixel, s});
    const auto where = bench.map<float>("positions", 64, 2, camera, bench.compute.upload("v", at));
    for (U block = 0; block < 4; ++block) {
      for (U shift = 0; shift <= 4; ++shift) {
        std::bitset<16> taken;
        for (U s = 16 * block; s < 16 * (block + 1); ++s) {
          const U columns = U{1} << shift, rows = 16U / columns;
          taken[static_cast<U>(where[2 * s] * static_cast<float>(columns)) * rows +
                static_cast<U>(where[2 * s + 1] * static_cast<float>(rows))] = true;
        }
        EXPECT_TRUE(taken.all()) << "pixel " << pixel << " block " << block << " of 2^" << shift
                                 << " columns";
      }
    }
  }
}

}  // namespace
}  // namespace whittle
