// The point of a triangle that a hit means: barycentrics and texture coordinates against double precision.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/shared/layout.h"
#include "reference/vec.h"
#include "support/lane_bench.h"
#include "support/random_scenes.h"

namespace whittle {
namespace {

using reference::Vec2;
using reference::Vec3;

/// A hit for each lane.
constexpr const char* kLanes = R"(
Barycentrics given(Natural entry, __global const float* hits) {
  return barycentrics(gather(hits + 1, 3u * entry), gather(hits + 2, 3u * entry));
}
Barycentrics refined(Natural entry, __global const float* corners, __global const float* o, __global const float* d,
                     __global const float* hits) {
  return refinedBarycentrics(gather3(corners, 9u * entry), gather3(corners + 3, 9u * entry),
                             gather3(corners + 6, 9u * entry), gather3(o, 3u * entry), gather3(d, 3u * entry),
                             gather(hits, 3u * entry), given(entry, hits));
}
)";

/// Out: texture coordinate from the barycentrics as given, and from the refined ones; each as high
/// and low parts.
constexpr const char* kSurfelKernels = R"(
__kernel void coordinates(uint n, __global const float* corners, __global const float* uv, __global const float* o,
                          __global const float* d, __global const float* hits, __global float* out) {
  FOR_ENTRIES(i, n)
  const Barycentrics places[2] = {given(entry, hits), refined(entry, corners, o, d, hits)};
  const Natural corner[3] = {3u * entry, 3u * entry + 1u, 3u * entry + 2u};
  for (uint k = 0; k < 2; ++k) {
    Uv at;
    interpolateUvSet(uv, corner, &places[k], 0, &at);
    const Natural to = 8u * entry + 4u * k;
    put(out, to, at.u[0]);
    put(out, to + 1u, at.v[0]);
    put(out, to + 2u, at.uLow[0]);
    put(out, to + 3u, at.vLow[0]);
  }
}
)";

struct Hits {
  std::vector<float> corners, uv, o, d,
      found;                   ///< found: t, b1, b2 as a search in single precision gives them
  std::vector<Vec2> expected;  ///< texture coordinate where the ray meets the plane
};

void push(std::vector<float>& values, const glm::vec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); }

/// Floor-like triangles of some metres, 20 m away, seen at about a degree, with some dozen repeats on them.
Hits grazingHits(test::Rng& rng, int count) {
  Hits hits;
  while (count > 0) {
    const glm::vec3 offset = rng.inBox(10);
    glm::vec3 p[3];
    for (auto& corner : p)
      corner = offset + glm::vec3(rng.between(-5, 5), rng.between(-0.01F, 0.01F), rng.between(-5, 5));
    const float b1 = rng.unit() * 0.9F, b2 = (1 - b1) * rng.unit();
    const glm::vec3 target = p[0] + b1 * (p[1] - p[0]) + b2 * (p[2] - p[0]);
    const glm::vec3 o = target + glm::vec3(20 * rng.direction().x, 0.4F, 20 * rng.direction().z);
    const glm::vec3 d = glm::normalize(target - o);
    const Vec3 e1 = Vec3(p[1]) - Vec3(p[0]), e2 = Vec3(p[2]) - Vec3(p[0]), q = Vec3(o) - Vec3(p[0]);
    const Vec3 normal = glm::cross(e1, e2), D(d);
    const double slant = glm::dot(normal, D);
    // Slivers, and what is seen from its edge, have a test of their own.
    if (glm::length(normal) < 1 || std::abs(slant) < 0.01 * glm::length(normal)) continue;
    const double exact1 = glm::dot(glm::cross(q, e2), D) / slant;
    const double exact2 = glm::dot(glm::cross(e1, q), D) / slant;
    if (!(exact1 > 1e-3 && exact2 > 1e-3 && exact1 + exact2 < 0.999)) continue;
    const double t = -glm::dot(normal, q) / slant;
    Vec2 uv[3];
    for (int k = 0; k < 3; ++k) {
      push(hits.corners, p[k]);
      const glm::vec2 at(rng.between(-30, 30), rng.between(-30, 30));
      hits.uv.insert(hits.uv.end(), {at.x, at.y});
      uv[k] = Vec2(at);
    }
    push(hits.o, o);
    push(hits.d, d);
    const auto rounded = [&](double x) { return static_cast<float>(x) * (1 + (rng.unit() - 0.5F) * 1e-6F); };
    hits.found.insert(hits.found.end(), {rounded(t), rounded(exact1), rounded(exact2)});
    hits.expected.push_back(uv[0] + exact1 * (uv[1] - uv[0]) + exact2 * (uv[2] - uv[0]));
    --count;
  }
  return hits;
}

/// A texel of 1024 is 1e-3 of a repeat. What single precision gives is off by whole percents of one here;
/// what the refined hit gives must be off by less than a ten-thousandth, so that no picture shows it.
TEST(Surfel, TextureCoordinatesOfGrazingHitsAreExact) {
  test::LaneBench bench({"lib/surface/surfel.cl"}, std::string(kLanes) + kSurfelKernels);
  test::Rng rng(61);
  const Hits hits = grazingHits(rng, 5000);
  const auto n = static_cast<std::uint32_t>(hits.expected.size());
  const auto out = bench.map<float>("coordinates", n, 8, hits.corners, hits.uv, hits.o, hits.d, hits.found);
  double given = 0, refined = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto off = [&](std::uint32_t at) {
      const float* v = out.data() + 8 * i + at;
      return glm::length(Vec2(v[0], v[1]) + Vec2(v[2], v[3]) - hits.expected[i]);
    };
    given = std::max(given, off(0));
    refined = std::max(refined, off(4));
  }
  EXPECT_LE(refined, 1e-3 / 1e4);
  EXPECT_GE(given, 1e-3 / 1e2) << "the test must be one that plain barycentrics fail";
}

/// Slivers, edge-on triangles, points, far and tiny ones: what comes out lies in the triangle and is finite.
TEST(Surfel, RefinedBarycentricsStayInTheTriangle) {
  constexpr const char* kRefine = R"(
__kernel void refine(uint n, __global const float* corners, __global const float* o, __global const float* d,
                     __global const float* hits, __global float* out) {
  FOR_ENTRIES(i, n)
  const Barycentrics at = refined(entry, corners, o, d, hits);
  put3(out, 3u * entry, real3(at.b0, at.b1, at.b2));
  put(out + 3 * n, 2u * entry, at.low1);
  put(out + 3 * n, 2u * entry + 1u, at.low2);
}
)";
  test::LaneBench bench({"lib/surface/surfel.cl"}, std::string(kLanes) + kRefine);
  test::Rng rng(62);
  Hits hits;
  const std::uint32_t n = 20000;
  for (std::uint32_t i = 0; i < n; ++i) {
    const float size = std::pow(10.0F, rng.between(-12, 12));
    glm::vec3 p[3];
    for (auto& corner : p) corner = size * rng.inBox(1);
    if (i % 4 == 1) p[2] = p[0] + 0.5F * (p[1] - p[0]) + size * 1e-7F * rng.inBox(1);
    if (i % 4 == 2) p[1] = p[2] = p[0];
    for (const auto& corner : p) push(hits.corners, corner);
    const float b1 = rng.unit(), b2 = (1 - b1) * rng.unit();
    const glm::vec3 target = p[0] + b1 * (p[1] - p[0]) + b2 * (p[2] - p[0]);
    const glm::vec3 o = i % 4 == 3 ? p[0] + 3.0F * (p[1] - p[0]) : target + size * rng.inBox(10);
    push(hits.o, o);
    push(hits.d, glm::normalize(target - o));
    hits.found.insert(hits.found.end(), {glm::length(target - o), b1, b2});
  }
  const auto out = bench.map<float>("refine", n, 5, hits.corners, hits.o, hits.d, hits.found);
  for (std::uint32_t i = 0; i < n; ++i) {
    const float* b = out.data() + 3 * i;
    for (int k = 0; k < 3; ++k)
      ASSERT_TRUE(b[k] >= -1e-6F && b[k] <= 1) << i << ": " << b[0] << ' ' << b[1] << ' ' << b[2];
    const float* low = out.data() + 3 * n + 2 * i;
    ASSERT_TRUE(std::isfinite(low[0]) && std::isfinite(low[1])) << i;
  }
}

}  // namespace
}  // namespace whittle
