// Balls sink, and are pushed apart and out of what they lie in, one after another, until they rest. Sums,
// products and square roots: the same bits on every machine.
#include "shapes/heap.h"

#include <algorithm>
#include <cmath>

#include "hash.h"

namespace generator {
namespace {

constexpr int kHeapPasses = 12;
constexpr double kSink = 0.03;  // radii that a ball falls in each step

void pushApart(std::vector<glm::dvec3>& balls, double radius) {
  for (std::size_t i = 0; i < balls.size(); ++i) {
    for (std::size_t k = i + 1; k < balls.size(); ++k) {
      const glm::dvec3 d = balls[k] - balls[i];
      const double square = glm::dot(d, d);
      if (square >= 4 * radius * radius || square == 0) continue;
      const double length = std::sqrt(square);
      const glm::dvec3 push = 0.5 * (2 * radius - length) / length * d;
      balls[i] -= push;
      balls[k] += push;
    }
  }
}

void pushOut(glm::dvec3& ball, const HeapSpec& spec) {
  const double gap = spec.distance(ball) - spec.radius, h = 1e-4 * spec.radius;
  if (gap >= 0) return;
  glm::dvec3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 beside = ball;
    beside[axis] += h;
    slope[axis] = (spec.distance(beside) - spec.radius - gap) / h;
  }
  const double square = glm::dot(slope, slope);
  if (square > 0) ball -= gap / std::sqrt(square) * slope;
}

}  // namespace

std::vector<glm::dvec3> heapOfBalls(const HeapSpec& spec) {
  std::vector<glm::dvec3> balls;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(spec.count); ++i) {
    const auto chance = [&](std::uint32_t k) { return 2 * unitValue(spec.series + k, i) - 1; };
    balls.emplace_back(0.7 * spec.spread * chance(0), spec.start + 0.4 * spec.radius * i,
                       0.7 * spec.spread * chance(1));
  }
  for (int step = 0; step < spec.steps; ++step) {
    // At the end nothing sinks any more, so that nothing is left inside another.
    const double sink = kSink * spec.radius * std::min(1.0, 4.0 * (spec.steps - 1 - step) / spec.steps);
    for (glm::dvec3& ball : balls) ball.y -= sink;
    for (int k = 0; k < kHeapPasses; ++k) {
      pushApart(balls, spec.radius);
      for (glm::dvec3& ball : balls) pushOut(ball, spec);
    }
  }
  return balls;
}

}  // namespace generator
