// The right answer: Whitted's recursion in double precision, as close to the textbook as code can be.
// Shares no code with the kernels; both follow host/reference/README.md.
#pragma once

#include <cstdint>
#include <functional>

#include "image/image_io.h"
#include "scene/ray_tree.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

struct RayCounts {
  std::uint64_t primary = 0;
  std::uint64_t impulse = 0;
  std::uint64_t shadow = 0;
  /// Throughput (largest channel) of the impulses that were not followed, summed: because of the cut-off,
  /// the limit of bounces, the limit of those straight on.
  double cutOff = 0, bounces = 0, straight = 0;
  std::uint64_t total() const { return primary + impulse + shadow; }
};

struct ReferenceResult {
  FloatImage radiance;   ///< RGB, W/(m² sr)
  FloatImage alpha;      ///< with Settings::alpha, 1 channel: the share of each pixel that the scene covers
  FloatImage primitive;  ///< 1 channel: triangle index hit through the pixel's first sample, -1 for none
  FloatImage depth;      ///< 1 channel: distance in metres along that ray, +inf for none
  RayCounts rays;
  std::uint64_t nonFinite = 0;  ///< samples that were not finite and count as 0 radiance
};

/// What the search takes for each triangle, and the result for the whole picture.
inline constexpr std::uint64_t kReferenceTriangleBytes = 200;
std::uint64_t referencePictureBytes(const Settings& settings);

/// Renders `scene` with the given settings (those that apply). Multi-threaded over rows; `progress(done, of)`
/// is called now and then from one thread at a time, may be empty. Throws InputError for an unknown camera.
ReferenceResult renderReference(const Scene& scene, const Settings& settings,
                                const std::function<void(int, int)>& progress = {});

/// What becomes of the rays of a pixel (x from the left, y from the top), sample by sample, at most `samples`
/// of them. `camera`: in the place of the settings'. Throws as renderReference.
std::vector<RayTree> referenceTrees(const Scene& scene, const Settings& settings, int x, int y,
                                    const Camera* camera = nullptr, int samples = kAllSamples);

}  // namespace whittle
