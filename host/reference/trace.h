// Whitted's recursion ("An improved illumination model for shaded display", 1980): Li is the radiance that
// arrives, Lo the radiance that leaves. README.md in this folder says precisely what is computed.
#pragma once

#include <optional>

#include "reference/bsdf.h"
#include "reference/cone.h"
#include "reference/reference.h"
#include "scene/emitters.h"
#include "scene/ray_tree.h"
#include "scene/sky_light.h"

namespace whittle::reference {

/// What all samples share.
struct World {
  const Scene& scene;
  const Settings& settings;
  const TriangleIndex& triangles;
  const Camera& camera;
  std::vector<Emitter> emitters = emittersOf(scene);
  SkyTable sky = hasSkyLight(scene) ? skyTableOf(scene.background) : SkyTable{};
  TextureLevels levels = TextureLevels(scene, settings);
};

/// One sample of one pixel, and where its rays are counted.
struct Sample {
  std::uint32_t pixel;
  std::uint32_t index;
  RayCounts& rays;
  /// With Settings::alpha receives the share of the background that the eye sees straight on; null: nobody
  /// asks.
  double* transmittance = nullptr;
  /// Receives what becomes of the sample's rays; null: nobody asks.
  RayTree* tree = nullptr;
};

/// Where on its way a ray is: `bounce` 1 for eye rays; `passed` surfaces went by straight on, the last of
/// them at `after`; `branched` of them, up to 63, sent out an impulse too.
struct Step {
  int bounce = 1;
  int passed = 0;
  int branched = 0;
  std::optional<Hit> after = {};
  int parent = -1;  ///< the ray that this one comes of, in Sample::tree
  Cone cone = {};   ///< of the ray
};

/// The first surface after `after`, in the order of README.md, that alpha masks and back faces leave
/// standing.
/// `nearest`: metres, before which nothing is met.
std::optional<Hit> nearestSurface(const World& world, const Ray& ray, const std::optional<Hit>& after = {},
                                  double nearest = 0);

/// Radiance, W/(m² sr), that arrives at the origin of `ray` from its direction.
/// throughput: the share of it that reaches the eye, so that rays that cannot matter are left out.
/// `seen`, if given, receives the hit.
Vec3 Li(const World& world, const Sample& sample, const Ray& ray, const Step& step, const Vec3& throughput,
        std::optional<Hit>* seen = nullptr);

/// The share, per channel, of the light from w_i at `distance` metres that is not blocked.
Vec3 visibility(const World& world, const Surfel& surfel, const Vec3& w_i, double distance);

struct PixelResult {
  Vec3 radiance{0};             ///< mean of the samples
  double transmittance = 0;     ///< likewise
  std::optional<Hit> seen;      ///< by the first sample
  std::uint64_t nonFinite = 0;  ///< samples left out
};

PixelResult traceOnePixel(const World& world, int x, int y, RayCounts& rays);
/// What becomes of the rays of one of its samples.
RayTree treeOfSample(const World& world, int x, int y, std::uint32_t sample);

}  // namespace whittle::reference
