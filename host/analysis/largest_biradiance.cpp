// Bounds on what a light delivers. Ericson, Real-Time Collision Detection (2005),
// 5.1: nearest points of triangles.
#include "analysis/largest_biradiance.h"

#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>

#include "scene/light_size.h"

namespace whittle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The kernels blend a hit's position from three corners in single precision: five roundings for each axis.
constexpr double kHitRounding = 0x1p-20;

using Corners = std::array<glm::dvec3, 3>;

double toSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double square = glm::dot(along, along);
  const double t = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return glm::length(a + t * along - p);
}

/// Degenerate triangles are their edges.
double toTriangle(const glm::dvec3& p, const Corners& c) {
  const glm::dvec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
  bool above = glm::dot(n, n) > 0;
  double edges = kInfinity;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 &a = c[i], &b = c[(i + 1) % 3];
    above = above && glm::dot(glm::cross(b - a, p - a), n) >= 0;
    edges = std::min(edges, toSegment(p, a, b));
  }
  return above ? std::min(edges, std::abs(glm::dot(p - c[0], n)) / glm::length(n)) : edges;
}

struct Box {
  glm::dvec3 low{kInfinity}, high{-kInfinity};

  void add(const Corners& corners) {
    for (const glm::dvec3& c : corners) low = glm::min(low, c), high = glm::max(high, c);
  }
};

Corners cornersOf(const Scene& scene, const Triangle& t) {
  return {scene.positions[t.v0], scene.positions[t.v1], scene.positions[t.v2]};
}

/// Never more than toTriangle of any triangle in it, and cheap.
double toBox(const glm::dvec3& p, const Box& box) {
  return glm::length(glm::max(glm::max(box.low - p, p - box.high), glm::dvec3(0)));
}

double roundingOf(const Corners& c) {
  const glm::dvec3 size = glm::max(glm::abs(c[0]), glm::max(glm::abs(c[1]), glm::abs(c[2])));
  return kHitRounding * std::max(size.x, std::max(size.y, size.z));
}

/// Neighbours of one material in the scene's order, so that most triangles are passed by many at a time.
struct Run {
  std::size_t begin = 0, end = 0;
  std::uint32_t material = 0;
  Box box;
  double slack = 0;  ///< the largest roundingOf
};

std::vector<Run> runsOf(const Scene& scene) {
  constexpr std::size_t kMost = 64;
  std::vector<Run> runs;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const Triangle& t = scene.triangles[i];
    if (runs.empty() || runs.back().material != t.material || i - runs.back().begin == kMost)
      runs.push_back({i, i, t.material, {}, 0});
    Run& run = runs.back();
    const Corners corners = cornersOf(scene, t);
    run.end = i + 1;
    run.box.add(corners);
    run.slack = std::max(run.slack, roundingOf(corners));
  }
  return runs;
}

/// For each material, how near to `p` a hit on it can be, metres; infinite where it has no triangle.
std::vector<double> nearestHits(const Scene& scene, const std::vector<Run>& runs, const glm::dvec3& p) {
  const std::vector<double> none(scene.materials.size(), kInfinity);
  tbb::combinable<std::vector<double>> ofThread([&] { return none; });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, runs.size(), 256), [&](const auto& range) {
    std::vector<double>& nearest = ofThread.local();
    for (std::size_t r = range.begin(); r < range.end(); ++r) {
      double& best = nearest[runs[r].material];
      if (toBox(p, runs[r].box) - runs[r].slack >= best) continue;
      for (std::size_t i = runs[r].begin; i < runs[r].end; ++i) {
        const Corners corners = cornersOf(scene, scene.triangles[i]);
        best = std::min(best, std::max(0.0, toTriangle(p, corners) - roundingOf(corners)));
      }
    }
  });
  std::vector<double> nearest = none;
  ofThread.combine_each([&](const std::vector<double>& part) {
    for (std::size_t i = 0; i < part.size(); ++i) nearest[i] = std::min(nearest[i], part[i]);
  });
  return nearest;
}

}  // namespace

std::vector<glm::dvec3> largestBiradiance(const Scene& scene, const Settings& settings) {
  std::vector<glm::dvec3> sums(scene.materials.size(), glm::dvec3(0));
  const std::vector<Run> runs = runsOf(scene);
  for (const Light& light : scene.lights) {
    if (light.kind == LightKind::Surface) {  // beside an edge that glows there is no end to it
      for (auto& sum : sums) sum = glm::dvec3(kInfinity);
      continue;
    }
    if (light.kind == LightKind::Sky) continue;  // radiance from all sides, which is not for here
    // A light of some size is sampled evenly in solid angle: near a sphere that is up to twice what its
    // middle would send, and nothing inside it.
    const double spread = !hasSize(light, settings)     ? 1.0
                          : typeOf(light.kind).isPlaced ? 2.0
                                                        : 2.0 / (2.0 - sunVersine(settings));
    const glm::dvec3 intensity = spread * glm::abs(glm::dvec3(light.intensity));
    if (!typeOf(light.kind).isPlaced) {
      for (auto& sum : sums) sum += intensity;
      continue;
    }
    const std::vector<double> nearest = nearestHits(scene, runs, light.position);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (nearest[i] > static_cast<double>(light.range)) continue;
      for (int c = 0; c < 3; ++c)
        if (intensity[c] > 0) sums[i][c] += intensity[c] / (nearest[i] * nearest[i]);
    }
  }
  return sums;
}

}  // namespace whittle
