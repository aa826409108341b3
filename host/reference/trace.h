// Whitted's recursion ("An improved illumination model for shaded display", 1980): Li is the radiance that
// arrives, Lo the radiance that leaves. README.md in this folder says precisely what is computed.
#pragma once

#include <optional>

#include "reference/bsdf.h"
#include "reference/reference.h"

namespace whittle::reference {

/// What all samples share.
struct World {
  const Scene& scene;
  const Settings& settings;
  const TriangleIndex& triangles;
  const Camera& camera;
};

/// One sample of one pixel, and where its rays are counted.
struct Sample {
  std::uint32_t pixel;
  std::uint32_t index;
  RayCounts& rays;
};

/// The nearest surface that alpha masks leave standing.
std::optional<Hit> nearestSurface(const World& world, const Ray& ray);

/// Radiance, W/(m² sr), that arrives at the origin of `ray` from its direction. depth: 1 for eye rays.
/// throughput: the share of it that reaches the eye, so that rays that cannot matter are left out.
/// `seen`, if given, receives the hit.
Vec3 Li(const World& world, const Sample& sample, const Ray& ray, int depth, const Vec3& throughput,
        std::optional<Hit>* seen = nullptr);

/// Radiance that leaves the surfel towards w_o.
Vec3 Lo(const World& world, const Sample& sample, const Surfel& surfel, const Vec3& w_o, int depth,
        const Vec3& throughput);

/// The share, per channel, of the light from w_i at `distance` metres that is not blocked.
Vec3 visibility(const World& world, const Surfel& surfel, const Vec3& w_i, double distance);

struct PixelResult {
  Vec3 radiance{0};             ///< mean of the samples
  std::optional<Hit> seen;      ///< by the first sample
  std::uint64_t nonFinite = 0;  ///< samples left out
};

PixelResult traceOnePixel(const World& world, int x, int y, RayCounts& rays);

}  // namespace whittle::reference
