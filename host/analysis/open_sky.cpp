// See open_sky.h.
#include "analysis/open_sky.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "analysis/focus.h"
#include "analysis/ray_triangle.h"
#include "scene/material_predicates.h"

namespace whittle {
namespace {

constexpr int kRays = 8;
/// Of the way back to the eye, so that no ray meets the surface that it starts from.
constexpr double kBack = 1e-4;

/// Evenly in what a level surface receives; unit.
glm::dvec3 skyward(int ray) {
  constexpr double kGoldenAngle = 2.399963229728653;
  const double up = std::sqrt((ray + 0.5) / kRays), across = std::sqrt(1.0 - up * up);
  return {across * std::cos(kGoldenAngle * ray), up, across * std::sin(kGoldenAngle * ray)};
}

/// The share of rays from each place that meet nothing.
std::vector<double> sharesOf(const Scene& scene, const std::vector<glm::dvec3>& places) {
  std::vector<std::atomic<bool>> isBlocked(places.size() * kRays);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, scene.triangles.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Triangle& t = scene.triangles[i];
      if (filters(scene.materials[t.material])) continue;
      for (std::size_t ray = 0; ray < isBlocked.size(); ++ray)
        if (!isBlocked[ray].load(std::memory_order_relaxed) &&
            std::isfinite(distanceTo(scene, t, places[ray / kRays], skyward(static_cast<int>(ray % kRays)))))
          isBlocked[ray].store(true, std::memory_order_relaxed);
    }
  });
  std::vector<double> shares(places.size());
  for (std::size_t ray = 0; ray < isBlocked.size(); ++ray)
    shares[ray / kRays] += isBlocked[ray] ? 0.0 : 1.0 / kRays;
  return shares;
}

}  // namespace

double openSky(const Scene& scene, const Camera& camera, double aspect) {
  constexpr std::array<glm::dvec2, 5> kPlaces{
      {{0.5, 0.5}, {0.25, 0.3}, {0.75, 0.3}, {0.25, 0.75}, {0.75, 0.75}}};
  std::vector<glm::dvec3> places;
  for (const glm::dvec2& at : kPlaces)
    if (const auto seen = pointUnder(scene, camera, aspect, at.x, at.y))
      places.push_back(glm::mix(*seen, glm::dvec3(camera.position), kBack));
  if (places.empty()) return 1.0;
  std::vector<double> shares = sharesOf(scene, places);
  const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
  std::nth_element(shares.begin(), middle, shares.end());
  constexpr double kOfWalls = 0.5;  // a wall sees half of it
  return std::min(1.0, *middle / kOfWalls);
}

}  // namespace whittle
