// What a lane has does not depend on the lanes beside it, whatever those hold: infinities, NaN, angles so
// large that a vector's sine takes another way. One lane alone has no neighbours, and must have the same
// bits.
#include <gtest/gtest.h>

#include <cmath>

#include "support/lane_bench.h"

namespace whittle {
namespace {

constexpr const char* kKernels = R"(
__kernel void circle(uint n, __global const float* x, __global float* out) {
  FOR_ENTRIES(i, n)
  Real c, s;
  aroundCircle(gather(x, entry), &c, &s);
  put(out, 2u * entry, c);
  put(out, 2u * entry + 1u, s);
}
__kernel void volume(uint n, __global const float* sigma, __global const float* t, __global float* out) {
  FOR_ENTRIES(i, n)
  put(out, entry, absorbed(gather(sigma, entry), gather(t, entry)));
}
)";

/// Each hostile value stands in each lane of some vector, among usual ones.
std::vector<float> amongHostile(float scale) {
  const float hostile[] = {INFINITY, -INFINITY, NAN, 1e30F, -1e30F, 3e38F, 1e-30F, 0.0F, 123456.7F};
  std::vector<float> values;
  for (const float h : hostile)
    for (std::size_t at = 0; at < ENTRY_LANES; ++at)
      for (std::size_t lane = 0; lane < ENTRY_LANES; ++lane)
        values.push_back(lane == at ? h : scale * static_cast<float>(values.size() % 97 + 1) / 97.0F);
  return values;
}

TEST(Neighbours, ChangeNoBit) {
  test::LaneBench bench({"lib/surface/absorption.cl"}, kKernels);
  const std::vector<float> turns = amongHostile(1.0F), sigma = amongHostile(5.0F);
  std::vector<float> lengths(sigma.size(), 0.75F);
  const auto count = static_cast<std::uint32_t>(turns.size());
  const auto circle = bench.map<float>("circle", count, 2, turns);  // fails where the widths differ in a bit
  const auto volume = bench.map<float>("volume", count, 1, sigma, lengths);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    if (turns[i] > 0 && turns[i] <= 1) {  // 4 ulp of 1, and what a float of the turns leaves open
      EXPECT_NEAR(circle[2 * i], std::cos(2 * M_PI * static_cast<double>(turns[i])), 1e-6) << turns[i];
    }
    if (sigma[i] > 0 && sigma[i] <= 5) {
      EXPECT_NEAR(volume[i], std::exp(-0.75 * static_cast<double>(sigma[i])), 1e-6) << sigma[i];
    }
  }
}

}  // namespace
}  // namespace whittle
