// The small mathematics of kernels/lib against exact or double-precision twins: contraction, differences
// of products, normalisation, Fresnel reflectance, the edge of a spot light; what is in lanes with one
// and with eight.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernels/shared/layout.h"
#include "support/lane_bench.h"
#include "support/random_scenes.h"
#include "support/record.h"

namespace whittle {
namespace {

/// Numbers of a single value and of eight or sixteen, whatever the lanes.
constexpr const char* kWidths = R"(
__kernel void difference(uint n, __global const float* v, __global float* out) {
  const uint i = get_global_id(0);
  if (i < n) out[i] = differenceOfProducts(v[4 * i], v[4 * i + 1], v[4 * i + 2], v[4 * i + 3]);
}
__kernel void eight(uint n, __global const float* v, __global float* out) {
  const uint i = get_global_id(0);
  if (i >= n) return;
  const float8 x = vload8(4 * i, v), y = vload8(4 * i + 1, v), z = vload8(4 * i + 2, v), w = vload8(4 * i + 3, v);
  vstore8(x * y - y * x, 3 * i, out);
  vstore8((x * w - y * z) + (z * y - w * x), 3 * i + 1, out);
  vstore8(differenceOfProducts8(x, y, z, w), 3 * i + 2, out);
}
__kernel void sixteen(uint n, __global const float* v, __global float* out) {
  const uint i = get_global_id(0);
  if (i >= n) return;
  const float16 x = vload16(4 * i, v), y = vload16(4 * i + 1, v), z = vload16(4 * i + 2, v), w = vload16(4 * i + 3, v);
  vstore16(x * y - y * x, 3 * i, out);
  vstore16((x * w - y * z) + (z * y - w * x), 3 * i + 1, out);
  vstore16(differenceOfProducts16(x, y, z, w), 3 * i + 2, out);
}
)";

constexpr const char* kMathKernels = R"(
__kernel void canary(uint n, __global const float* v, __global float* out) {
  FOR_ENTRIES(i, n)
  const Real x = gather(v, 4u * entry), y = gather(v + 1, 4u * entry), z = gather(v + 2, 4u * entry),
             w = gather(v + 3, 4u * entry);
  const Real3 c = cross3(real3(x, y, z), real3(x, y, z));
  // Second: the edge function from both sides.
  put3(out, 3u * entry, real3(x * y - y * x, (x * w - y * z) + (z * y - w * x), fabs(c.x) + fabs(c.y) + fabs(c.z)));
}
__kernel void unit_vector(uint n, __global const float* v, __global float* out) {
  FOR_ENTRIES(i, n)
  put3(out, 3u * entry, normalize3(gather3(v, 3u * entry)));
}
__kernel void fresnel(uint n, __global const float* v, __global float* out) {
  FOR_ENTRIES(i, n)
  Mask total;
  put(out, 2u * entry, fresnelDielectric(gather(v, 2u * entry), gather(v + 1, 2u * entry), &total));
  put(out, 2u * entry + 1u, total ? (Real)(1.0f) : (Real)(0.0f));
}
__kernel void spot(uint n, __global const DeviceLight* light, __global const float* v, __global float* out) {
  const uint i = get_global_id(0);
  if (i < n) out[i] = FIRST(spotFactor(light + i, same3(vload3(i, v))));
}
)";

test::KernelBench makeBench() { return test::KernelBench({"lib/math.cl"}, kWidths); }
test::LaneBench makeLanes() { return {{"lib/surface/fresnel.cl", "lib/surface/light.cl"}, kMathKernels}; }

float sized(test::Rng& rng, float decades) {
  return rng.between(1, 2) * std::pow(10.0F, rng.between(-decades, decades)) *
         (rng.bits() & 1U ? 1.0F : -1.0F);
}

TEST(Math, NothingIsContracted) {
  auto bench = makeLanes();
  test::Rng rng(1);
  std::vector<float> v(4 * 20011);
  for (float& x : v) x = sized(rng, 3);
  const auto out = bench.map<float>("canary", 20011, 3, v);
  test::recordCount("1", "x·y − y·x, an edge function from both sides, v × v", "0 exactly",
                    out.size() - static_cast<std::size_t>(std::count(out.begin(), out.end(), 0.0F)),
                    out.size(), "values");
}

/// The same for numbers side by side; their difference of products has the single form's bits.
TEST(Math, EightAndSixteenAreAsManyTimesOne) {
  auto bench = makeBench();
  for (const auto& [kernel, width] : {std::pair{"eight", std::size_t{8}}, {"sixteen", std::size_t{16}}}) {
    SCOPED_TRACE(kernel);
    test::Rng rng(3);
    constexpr std::uint32_t kGroups = 2501;
    std::vector<float> v(4 * width * kGroups);
    for (float& x : v) x = sized(rng, 3);
    std::vector<float> single(v.size());  // the operands of one value side by side
    for (std::size_t i = 0; i < v.size(); ++i)
      single[i / (4 * width) * (4 * width) + i % width * 4 + i / width % 4] = v[i];
    const auto wide = bench.map<float>(kernel, kGroups, 3 * width, bench.compute.upload("v", v));
    const auto ones = bench.map<float>("difference", static_cast<std::uint32_t>(v.size() / 4), 1,
                                       bench.compute.upload("single", single));
    std::size_t contracted = 0, different = 0;
    for (std::size_t i = 0; i < ones.size(); ++i) {
      const float* out = &wide[i / width * 3 * width + i % width];
      contracted += out[0] != 0.0F || out[width] != 0.0F;
      different += out[2 * width] != ones[i];
    }
    EXPECT_EQ(contracted, 0U);
    EXPECT_EQ(different, 0U);
  }
}

/// a·b − c·d where both products nearly agree: the sign must be the exact one, the error at most 2
/// units in the last place (1.5 proven by Jeannerod, Louvet and Muller 2013; the exact value is rounded
/// once more here).
TEST(Math, DifferenceOfProductsHasTheRightSign) {
  auto bench = makeBench();
  test::Rng rng(2);
  constexpr std::uint32_t kCount = 200003;
  std::vector<float> v;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const float a = sized(rng, 3), b = sized(rng, 3), c = sized(rng, 3);
    float d = static_cast<float>(static_cast<double>(a) * b / c);
    for (auto steps = rng.bits() % 3; steps > 0; --steps)
      d = std::nextafter(d, rng.bits() & 1U ? 1e30F : -1e30F);
    if (i % 5 == 0) {
      v.insert(v.end(), {a, b, b, a});  // exactly 0
    } else {
      v.insert(v.end(), {a, b, c, d});
    }
  }
  const auto out = bench.map<float>("difference", kCount, 1, bench.compute.upload("v", v));
  std::size_t wrongSign = 0, inexact = 0, naiveWrong = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const float* p = v.data() + 4 * i;
    // Products of two floats fit a double exactly, and long double holds their difference to 64 bits: its
    // sign is exact.
    const long double exact = static_cast<long double>(static_cast<double>(p[0]) * p[1]) -
                              static_cast<long double>(static_cast<double>(p[2]) * p[3]);
    const auto sign = [](auto x) { return (x > 0) - (x < 0); };
    wrongSign += sign(out[i]) != sign(exact);
    naiveWrong += sign(p[0] * p[1] - p[2] * p[3]) != sign(exact);
    inexact += std::abs(static_cast<long double>(out[i]) - exact) > 2 * 0x1p-23L * std::abs(exact);
  }
  EXPECT_EQ(wrongSign, 0U);
  EXPECT_EQ(inexact, 0U);
  EXPECT_GT(naiveWrong, kCount / 10) << "the inputs must be hard enough to tell";
}

TEST(Math, NormalizeSurvivesAnySize) {
  auto bench = makeLanes();
  test::Rng rng(3);
  std::vector<float> v;
  std::vector<glm::dvec3> expected;
  for (int exponent = -30; exponent <= 30; ++exponent) {
    for (int i = 0; i < 20; ++i) {
      const glm::vec3 w = rng.inBox(1) * std::pow(10.0F, static_cast<float>(exponent));
      v.insert(v.end(), {w.x, w.y, w.z});
      expected.push_back(glm::normalize(glm::dvec3(w)));
    }
  }
  const auto count = static_cast<std::uint32_t>(expected.size());
  v.insert(v.end(), {0, 0, 0});
  const auto out = bench.map<float>("unit_vector", count + 1, 3, v);
  for (std::uint32_t i = 0; i < count; ++i)
    for (int a = 0; a < 3; ++a)  // two divisions, a root, a sum: fewer than 8 roundings, 2.5 units each where
                                 // a device is allowed that
      ASSERT_NEAR(static_cast<double>(out[3 * i + static_cast<std::uint32_t>(a)]), expected[i][a],
                  16 * 0x1p-24)
          << "vector " << i;
  EXPECT_TRUE(std::isnan(out[3 * count])) << "no direction";
}

double exactFresnel(double cosine, double eta) {
  const double sin2T = (1 - cosine * cosine) / (eta * eta);
  if (sin2T >= 1) return 1;
  if (eta == 1) return 0;
  const double c = std::sqrt(1 - sin2T), s = (cosine - eta * c) / (cosine + eta * c),
               p = (eta * cosine - c) / (eta * cosine + c);
  return 0.5 * (s * s + p * p);
}

class FresnelBench {
 public:
  /// R at each (cosine, eta).
  std::vector<float> operator()(const std::vector<float>& pairs) {
    const auto count = static_cast<std::uint32_t>(pairs.size() / 2);
    const auto out = bench_.map<float>("fresnel", count, 2, pairs);
    std::vector<float> r(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      r[i] = out[2 * i];
      EXPECT_TRUE(r[i] >= 0 && r[i] <= 1)
          << "cosine " << pairs[2 * i] << " eta " << pairs[2 * i + 1] << ": " << r[i];
      EXPECT_TRUE(out[2 * i + 1] == 0 || r[i] == 1) << "total reflection leaves nothing";
    }
    return r;
  }

 private:
  test::LaneBench bench_ = makeLanes();
};

constexpr double kDegree = std::numbers::pi / 180;

TEST(Fresnel, AgreesWithDoubleEverywhere) {
  FresnelBench fresnel;
  std::vector<float> pairs;
  for (const float eta : {0.4F, 1 / 1.5F, 0.99F, 1.01F, 1.33F, 1.5F, 2.4F})
    for (int i = 0; i <= 1000; ++i) pairs.insert(pairs.end(), {static_cast<float>(i) / 1000, eta});
  const auto r = fresnel(pairs);
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double cosine = pairs[2 * i], eta = pairs[2 * i + 1];
    // Near the critical angle cosT = sqrt(1 − sin²) turns a rounding e of sin² into e/(2 cosT), or sqrt(e) at
    // the angle itself, and R falls by 4 (1/η + η)·cosT/cos there.
    const double room = 1 - (1 - cosine * cosine) / (eta * eta), e = 8 * 0x1p-24 / (eta * eta);
    const double error = std::sqrt(std::max(room, 0.0) + e) - std::sqrt(std::max(room, 0.0));
    const double slope = 4 * (eta + 1 / eta) / std::max(cosine, 0.05);
    EXPECT_NEAR(static_cast<double>(r[i]), exactFresnel(cosine, eta), 1e-6 + slope * error)
        << "cosine " << cosine << " eta " << eta;
  }
}

TEST(Fresnel, CriticalAngleIsReachedWithoutAStep) {
  FresnelBench fresnel;
  const double critical = std::asin(1 / 1.5);
  EXPECT_NEAR(critical / kDegree, 41.8103, 5e-5);
  std::vector<float> below, above;
  for (int k = 0; k <= 8; ++k) {
    below.insert(below.end(),
                 {static_cast<float>(std::cos(critical - std::pow(10.0, -k) * kDegree)), 1 / 1.5F});
    above.insert(above.end(),
                 {static_cast<float>(std::cos(critical + std::pow(10.0, -k) * kDegree)), 1 / 1.5F});
  }
  const auto rising = fresnel(below), total = fresnel(above);
  for (std::size_t k = 1; k < rising.size(); ++k)
    EXPECT_GE(rising[k], rising[k - 1]) << "monotone towards the angle, k = " << k;
  for (std::size_t k = 0; k <= 4; ++k) EXPECT_EQ(total[k], 1.0F) << "beyond by 1e-" << k << " degrees";
  EXPECT_GT(rising.back(), 0.99F);
}

TEST(Fresnel, GrazingReachesOneAndNeverMore) {
  FresnelBench fresnel;
  for (const float eta : {1.5F, 1 / 1.5F, 1.0001F, 2.4F}) {
    std::vector<float> pairs;
    for (int k = 0; k <= 12; ++k)
      pairs.insert(pairs.end(), {static_cast<float>(std::sin(std::pow(10.0, -k) * kDegree)), eta});
    pairs.insert(pairs.end(), {0.0F, eta});
    const auto r = fresnel(pairs);
    for (std::size_t k = 1; k < r.size(); ++k) EXPECT_GE(r[k], r[k - 1]) << "eta " << eta << ", k = " << k;
    EXPECT_EQ(r.back(), 1.0F);
  }
}

TEST(Fresnel, EqualIndicesAreInvisible) {
  FresnelBench fresnel;
  std::vector<float> equal, nearly;
  for (int i = 1; i <= 1000; ++i) {
    equal.insert(equal.end(), {static_cast<float>(i) / 1000, 1.0F});
    nearly.insert(nearly.end(), {static_cast<float>(i) / 1000, 1.0F + 1e-7F});
    nearly.insert(nearly.end(), {static_cast<float>(i) / 1000, 1.0F - 1e-7F});
  }
  for (const float r : fresnel(equal)) EXPECT_EQ(r, 0.0F);
  // From 2.6° above the surface on (cosine 0.045), R stays below a 16-bit step.
  const auto r = fresnel(nearly);
  for (std::size_t i = 90; i < r.size(); ++i) EXPECT_LT(r[i], 1.0F / 65536) << "cosine " << nearly[2 * i];
}

TEST(Fresnel, BrewsterAndNormalIncidence) {
  FresnelBench fresnel;
  const auto brewster = static_cast<float>(std::cos(std::atan(1.5)));
  const auto r = fresnel({brewster, 1.5F, 1.0F, 1.5F, 1.0F, 1 / 1.5F});
  EXPECT_NEAR(r[0], 0.0739645, 1e-6);  // ½ ((1.5² − 1)/(1.5² + 1))²
  EXPECT_NEAR(r[1], 0.04, 1e-7);
  EXPECT_NEAR(r[2], 0.04, 1e-7);
}

struct SpotCase {
  double inner, outer, off;  // radians
};

TEST(Spot, EdgeAgainstDouble) {
  auto bench = makeLanes();
  std::vector<SpotCase> cases;
  for (const double outer : {0.01 * kDegree, 1 * kDegree, 45 * kDegree, 89.9 * kDegree})
    for (const double inner : {0.0, 0.5 * outer, outer})
      for (int i = 0; i <= 60; ++i) cases.push_back({inner, outer, outer * i / 40.0});
  const auto versine = [](double angle) { return 2 * std::sin(angle / 2) * std::sin(angle / 2); };
  test::Rng rng(5);
  std::vector<device::DeviceLight> lights;
  std::vector<float> directions;
  for (const SpotCase& c : cases) {
    device::DeviceLight light{};
    // Along an axis, so that the light's own direction is exact and a hundredth of a degree means something
    // in floats.
    light.direction[1] = -1;
    light.versineOuter = static_cast<float>(versine(c.outer));
    light.versineInner = static_cast<float>(versine(c.inner));
    lights.push_back(light);
    const double turn = rng.unit() * 6.28;
    directions.insert(directions.end(), {static_cast<float>(std::sin(c.off) * std::cos(turn)),
                                         static_cast<float>(std::cos(c.off)),
                                         static_cast<float>(std::sin(c.off) * std::sin(turn))});
  }
  const auto count = static_cast<std::uint32_t>(cases.size());
  const auto out = bench.map<float>("spot", count, 1, lights, directions);
  for (std::uint32_t i = 0; i < count; ++i) {
    const SpotCase& c = cases[i];
    const double v = versine(c.off), vo = versine(c.outer), vi = versine(c.inner);
    if (std::abs(v - vo) < 1e-5 * vo) continue;  // on the edge itself either answer is right
    const double f = v >= vo ? 0.0 : std::min((vo - v) / (vo - vi), 1.0);
    // Versines carry some 4 roundings of themselves, divided by the width of the rim.
    const double tolerance = vo > vi ? 1e-6 + 4 * 8 * 0x1p-24 * vo / (vo - vi) : 0.0;
    EXPECT_NEAR(static_cast<double>(out[i]), f * f, tolerance)
        << "inner " << c.inner << " outer " << c.outer << " off " << c.off;
  }
}

}  // namespace
}  // namespace whittle
