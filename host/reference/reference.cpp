// Every pixel of the picture, rows in parallel. See reference.h.
#include "reference/reference.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <mutex>

#include "reference/camera.h"
#include "reference/trace.h"
#include "scene/camera.h"

namespace whittle {
namespace {

/// What rows count for themselves, so that the sum does not depend on threads.
struct RowCounts {
  RayCounts rays;
  std::uint64_t nonFinite = 0;
};

/// Row `row` of the region.
void traceRow(const reference::World& world, const Region& region, int row, ReferenceResult& result,
              RowCounts& counts) {
  for (int column = 0; column < region.width; ++column) {
    const reference::PixelResult pixel =
        reference::traceOnePixel(world, region.x + column, region.y + row, counts.rays);
    const std::size_t i = static_cast<std::size_t>(row) * region.width + column;
    for (int c = 0; c < 3; ++c) result.radiance.pixels[3 * i + c] = static_cast<float>(pixel.radiance[c]);
    if (world.settings.alpha)
      result.alpha.pixels[i] = static_cast<float>(std::clamp(1 - pixel.transmittance, 0.0, 1.0));
    result.primitive.pixels[i] = pixel.seen ? static_cast<float>(pixel.seen->triangle) : -1.0F;
    result.depth.pixels[i] =
        pixel.seen ? static_cast<float>(pixel.seen->t) : std::numeric_limits<float>::infinity();
    counts.nonFinite += pixel.nonFinite;
  }
}

ReferenceResult render(const Scene& scene, const Settings& settings,
                       const std::function<void(int, int)>& progress) {
  const Camera& camera = scene.cameras[findCamera(scene, settings.camera)];
  const reference::TriangleIndex triangles(scene);
  const reference::World world{scene, settings, triangles, camera};

  ReferenceResult result;
  result.radiance = blackImage(settings, 3);
  if (settings.alpha) result.alpha = blackImage(settings, 1);
  result.primitive = blackImage(settings, 1);
  result.depth = blackImage(settings, 1);
  const Region region = tracedRegion(settings);
  std::vector<RowCounts> rows(region.height);
  std::mutex progressMutex;
  int done = 0;
  tbb::parallel_for(0, region.height, [&](int row) {
    traceRow(world, region, row, result, rows[row]);
    const std::lock_guard lock(progressMutex);
    ++done;
    if (progress) progress(done, region.height);
  });
  for (const RowCounts& row : rows) {
    result.rays.primary += row.rays.primary;
    result.rays.impulse += row.rays.impulse;
    result.rays.shadow += row.rays.shadow;
    result.rays.cutOff += row.rays.cutOff;
    result.rays.bounces += row.rays.bounces;
    result.rays.straight += row.rays.straight;
    result.nonFinite += row.nonFinite;
  }
  return result;
}

}  // namespace

std::uint64_t referencePictureBytes(const Settings& settings) {
  // Radiance, triangle, distance; what encodes them.
  const std::uint64_t pixel = 5 * sizeof(float) + 12 + (settings.alpha ? 2 * sizeof(float) : 0);
  return pixel * tracedRegion(settings).pixels();
}

namespace {

/// `work` on as many threads as the settings ask for.
template <typename Work>
auto onThreads(const Settings& settings, const Work& work) {
  const int threads = settings.threads > 0 ? settings.threads : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute(work);
}

}  // namespace

ReferenceResult renderReference(const Scene& scene, const Settings& settings,
                                const std::function<void(int, int)>& progress) {
  return onThreads(settings, [&] { return render(scene, settings, progress); });
}

std::vector<RayTree> referenceTrees(const Scene& scene, const Settings& settings, int x, int y,
                                    const Camera* camera, int samples) {
  if (!camera) camera = &scene.cameras[findCamera(scene, settings.camera)];
  return onThreads(settings, [&] {
    const reference::TriangleIndex triangles(scene);
    const reference::World world{scene, settings, triangles, *camera};
    const int count = std::min(samples, settings.raysPerPixel);
    std::vector<RayTree> trees;
    trees.reserve(static_cast<std::size_t>(std::max(count, 0)));
    for (int s = 0; s < count; ++s)
      trees.push_back(reference::treeOfSample(world, x, y, static_cast<std::uint32_t>(s)));
    return trees;
  });
}

}  // namespace whittle
