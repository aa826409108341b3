// Directions into a spherical triangle, of kernels and reference: where they lie, how evenly, and that both
// take the same way from the unit square.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "kernels/shared/layout.h"
#include "reference/emitters.h"
#include "support/lane_bench.h"

namespace whittle::test {
namespace {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Corners = std::array<Vec3, 3>;

constexpr std::uint32_t kAcross = 256;  ///< points of the unit square, in a grid

/// Corners of a triangle as seen from the origin, three floats each; points of the unit square.
constexpr const char* kKernels = R"(
__kernel void direction(uint n, __global const float* p, __global const float* squares, __global float* out) {
  FOR_ENTRIES(i, n)
  const SeenTriangle t = seenFrom(same3((float3)(0.0f)), same3(load3(p)), same3(load3(p + 3)), same3(load3(p + 6)));
  const Square at = {gather(squares, 2u * entry), gather(squares + 1, 2u * entry)};
  const Real solidAngle = solidAngleOf(&t);
  put3(out, 4u * entry, directionInto(&t, solidAngle, at));
  put(out, 4u * entry + 3u, solidAngle);
}
__kernel void place(uint n, __global const float* p, __global const float* weights, __global float* out) {
  FOR_ENTRIES(i, n)
  const Real3 p0 = same3(load3(p)), p1 = same3(load3(p + 3)), p2 = same3(load3(p + 6));
  const SeenTriangle t = seenFrom(same3((float3)(0.0f)), p0, p1, p2);
  const Real b1 = gather(weights, 2u * entry), b2 = gather(weights + 1, 2u * entry);
  const Real3 to = add3(p0, add3(scale3(b1, sub3(p1, p0)), scale3(b2, sub3(p2, p0))));
  Real found1, found2;
  placeAlong(&t, normalize3(to), &found1, &found2);
  put(out, 2u * entry, found1);
  put(out, 2u * entry + 1u, found2);
}
)";

LaneBench makeBench() { return {{"lib/surface/seen_triangle.cl"}, kKernels}; }

struct Case {
  const char* name;
  Corners p;
  double tolerance;  ///< radians: single precision of directions over the triangle's size
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"an octant", {Vec3(1, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 3)}, 1e-6},
      {"one overhead", {Vec3(-3, 1, -2), Vec3(4, 1, -2), Vec3(0, 1, 5)}, 1e-6},
      {"as near to a hemisphere as is sampled so",
       {Vec3(-3, 0.04, -2), Vec3(4, 0.04, -2), Vec3(0, 0.04, 5)},
       1e-5},
      {"nearly a hemisphere", {Vec3(-3, 0.01, -2), Vec3(4, 0.01, -2), Vec3(0, 0.01, 5)}, 2e-5},
      {"a needle", {Vec3(-2, 1, 0), Vec3(2, 1, 0), Vec3(0, 1, 0.01)}, 1e-5},
      {"one seen from its edge", {Vec3(1, 0, 0), Vec3(3, 0.01, 0), Vec3(2, 0, 1)}, 1e-5},
      {"a small one", {Vec3(0, 100, 0), Vec3(0.2, 100, 0), Vec3(0, 100, 0.2)}, 1e-6},
  };
  return all;
}

std::vector<float> floats(const Corners& p) {
  std::vector<float> out;
  for (const Vec3& v : p)
    for (int c = 0; c < 3; ++c) out.push_back(static_cast<float>(v[c]));
  return out;
}

/// As single precision has them.
Corners unit(const Corners& p) {
  return {glm::normalize(Vec3(glm::vec3(p[0]))), glm::normalize(Vec3(glm::vec3(p[1]))),
          glm::normalize(Vec3(glm::vec3(p[2])))};
}

/// Girard: the angles' sum less π; angles between the planes through the sides.
double solidAngle(const Corners& d) {
  double sum = -std::numbers::pi;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = d[i], &b = d[(i + 1) % 3], &c = d[(i + 2) % 3];
    const Vec3 n = glm::cross(a, b), m = glm::cross(a, c);
    sum += std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m));
  }
  return sum;
}

/// ∫ w dω over the triangle: half the sum of its sides' angles times the normals of their planes (Lambert).
Vec3 vectorOf(const Corners& d) {
  Vec3 sum(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 n = glm::cross(d[i], d[(i + 1) % 3]);
    const double angle = std::atan2(glm::length(n), glm::dot(d[i], d[(i + 1) % 3]));
    sum += angle * glm::normalize(n);
  }
  return glm::dot(sum, d[0] + d[1] + d[2]) > 0 ? sum / 2.0 : -sum / 2.0;
}

/// The middles of a grid's cells.
std::vector<float> grid() {
  std::vector<float> squares;
  for (std::uint32_t i = 0; i < kAcross * kAcross; ++i) {
    squares.push_back((static_cast<float>(i % kAcross) + 0.5F) / kAcross);
    squares.push_back((static_cast<float>(i / kAcross) + 0.5F) / kAcross);
  }
  return squares;
}

/// Which of the four parts of a triangle w lies in that the middles of its sides make: beside a corner, if it
/// is on that one's side of the plane through the two middles, or between the three.
std::size_t partOf(const std::array<Corners, 4>& parts, const Vec3& w) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 n = glm::cross(parts[k][1], parts[k][2]);
    if (glm::dot(w, n) * glm::dot(parts[k][0], n) > 0) return k;
  }
  return 3;
}

std::array<Corners, 4> quarters(const Corners& d) {
  const Vec3 ab = glm::normalize(d[0] + d[1]), bc = glm::normalize(d[1] + d[2]),
             ca = glm::normalize(d[2] + d[0]);
  return {Corners{d[0], ca, ab}, Corners{d[1], ab, bc}, Corners{d[2], bc, ca}, Corners{ab, bc, ca}};
}

/// Over a grid of the unit square, whatever gives the directions.
void expectEven(const Case& c, const std::function<Vec3(std::size_t)>& direction) {
  const Corners d = unit(c.p);
  const double all = solidAngle(d), count = kAcross * kAcross;
  const std::array<Corners, 4> parts = quarters(d);
  std::array<double, 4> counts{};
  Vec3 sum(0);
  double outside = 0;
  const Vec3 turn(glm::dot(d[0], glm::cross(d[1], d[2])) > 0 ? 1 : -1);
  for (std::size_t i = 0; i < kAcross * kAcross; ++i) {
    const Vec3 w = direction(i);
    EXPECT_NEAR(glm::length(w), 1, 1e-6);
    sum += w / count;
    for (std::size_t k = 0; k < 3; ++k)
      outside = std::max(outside, -glm::dot(turn * w, glm::normalize(glm::cross(d[k], d[(k + 1) % 3]))));
    ++counts[partOf(parts, w)];
  }
  EXPECT_LE(outside, c.tolerance) << c.name;
  // The middle of each cell in place of all of it: where the way there begins as a root does, an error of
  // h^(3/2).
  const double quadrature = 2 * std::pow(kAcross, -1.5);
  EXPECT_NEAR(glm::length(sum - vectorOf(d) / all), 0, quadrature + c.tolerance) << c.name;
  // Cells that lie across the border of two parts are of one side or the other: less than a row of the grid.
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(counts[k] / count, solidAngle(parts[k]) / all, 1.0 / kAcross) << c.name << ", part " << k;
}

TEST(SeenTriangle, DirectionsAreEven) {
  auto bench = makeBench();
  const std::vector<float> squares = grid();
  for (const Case& c : cases()) {
    const auto out = bench.map<float>("direction", kAcross * kAcross, 4, floats(c.p), squares);
    const double expected = solidAngle(unit(c.p));
    EXPECT_NEAR(out[3] / expected, 1, 1e-4) << c.name;
    expectEven(c, [&](std::size_t i) { return Vec3(out[4 * i], out[4 * i + 1], out[4 * i + 2]); });
  }
}

TEST(SeenTriangle, DirectionsOfTheReferenceAreEven) {
  const std::vector<float> squares = grid();
  for (const Case& c : cases()) {
    const Corners d = unit(c.p);
    const double all = solidAngle(d);
    expectEven(c, [&](std::size_t i) {
      return reference::directionInto(d, all, Vec2(squares[2 * i], squares[2 * i + 1]));
    });
  }
}

/// Arvo's formulas and ours, for triangles that are sampled so: of larger ones rounding of the solid angle
/// moves directions by more than shows here, evenly (see above).
TEST(SeenTriangle, KernelsAndReferenceGoTheSameWay) {
  auto bench = makeBench();
  const std::vector<float> squares = grid();
  for (const Case& c : cases()) {
    const auto out = bench.map<float>("direction", kAcross * kAcross, 4, floats(c.p), squares);
    const Corners d = unit(c.p);
    const double all = solidAngle(d);
    if (all > static_cast<double>(MOST_SOLID_ANGLE)) continue;
    double worst = 0;
    for (std::size_t i = 0; i < kAcross * kAcross; ++i) {
      const Vec3 other = reference::directionInto(d, all, Vec2(squares[2 * i], squares[2 * i + 1]));
      worst = std::max(worst, glm::length(Vec3(out[4 * i], out[4 * i + 1], out[4 * i + 2]) - other));
    }
    EXPECT_LE(worst, 50 * c.tolerance) << c.name;
  }
}

TEST(SeenTriangle, ADirectionIsFoundAgainInTheTriangle) {
  auto bench = makeBench();
  std::vector<float> weights;
  for (int i = 0; i < 100; ++i) {
    const float b1 = static_cast<float>(i % 10) / 10, b2 = static_cast<float>(i / 10) / 10;
    weights.insert(weights.end(), {b1, std::min(b2, 1 - b1)});
  }
  for (const Case& c : cases()) {
    const auto out = bench.map<float>("place", 100, 2, floats(c.p), weights);
    for (std::size_t i = 0; i < 200; ++i) EXPECT_NEAR(out[i], weights[i], 3e-3) << c.name;
  }
}

}  // namespace
}  // namespace whittle::test
