// Branching in bounded memory: queues are cut, nothing is dropped, and long runs of one sample
// are sliced alike.
#include "kernels/shared/features.h"
#include "kernels/shared/layout.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

std::uint64_t queueBytes(const Stats& stats) {
  std::uint64_t sum = 0;
  for (const auto& b : stats.buffers)
    if (b.group == "queues") sum += b.bytes;
  return sum;
}

/// A ray queue for each bounce, and the work space of one segment: planes of `capacity` entries, each padded,
/// four bytes; of flags, one; candidates and flags for each of `lights` at once.
std::uint64_t documentedBound(std::uint64_t capacity, std::uint64_t bounces, std::uint64_t lights) {
  const std::uint64_t workPlanes = HIT_PLANES + 3 + 3 + lights * SHADOW_PLANES + 1 + 2 * IMPULSE_PLANES;
  const std::uint64_t totals = capacity + 3;
  return (4 * (bounces * RAY_PLANES + workPlanes) + lights) * (capacity + QUEUE_PADDING) + 4 * totals;
}

/// The items of scan_chunks are rounded up to a work-group, and those up to SUMS write, whatever is traced.
TEST(BoundedMemory, SumsHaveRoomWhereNothingReflects) {
  Scene scene;
  addFloor(scene, lambert({0.5F, 0.5F, 0.5F}), 0, true, 4);
  scene.lights.push_back(pointLight({1, 2, 0.5F}, 20));
  scene.cameras = {lookingDown()};
  Settings settings = smallSettings(1);
  const Stats stats = renderOnDevice(scene, settings).stats;
  EXPECT_EQ(stats.rays.impulse, 0U);
  std::uint64_t sums = 0;
  for (const auto& b : stats.buffers)
    if (b.name == "sums") sums = b.bytes;
  EXPECT_GE(sums, SUMS * sizeof(std::uint32_t));
}

TEST(BoundedMemory, NestedGlassSixteenDeep) {
  const Scene scene = ownScene("nested_glass");
  Settings settings = smallSettings(16);
  settings.width = 64;
  settings.height = 36;
  settings.wavefront = 1 << 20;
  const RenderResult large = renderOnDevice(scene, settings);
  EXPECT_EQ(large.stats.dropped, 0U);
  for (const int wavefront : {4096, 512}) {
    settings.wavefront = wavefront;
    const RenderResult small = renderOnDevice(scene, settings);
    const auto capacity = static_cast<std::uint64_t>(small.stats.settings.wavefront);
    EXPECT_EQ(capacity, static_cast<std::uint64_t>(wavefront));
    EXPECT_EQ(small.stats.dropped, 0U);
    EXPECT_EQ(small.stats.rays.total(), large.stats.rays.total());
    EXPECT_EQ(differingPixels(small.radiance, large.radiance), 0U) << wavefront;
    EXPECT_LE(queueBytes(small.stats), documentedBound(capacity, 16, scene.lights.size())) << wavefront;
    EXPECT_GT(stageOf(small.stats, "intersect").launches, stageOf(large.stats, "intersect").launches);
  }
  EXPECT_GT(large.stats.rays.impulse, 10U * 64 * 36) << "or there is nothing to cut";
}

/// Faces of solids one above the other: every hit reflects and refracts, so that a ray becomes
/// 2^(bounces − 1). A ratio so near 1 that a dozen faces turn no ray far enough for total reflection.
Scene sheets() {
  Scene scene;
  Material sheet = glass(1.06F, true);
  sheet.baseColor = {0.9F, 0.95F, 1, 1};
  sheet.emission = {0.2F, 0.1F, 0.15F};  // upwards only
  for (int i = 0; i < 48; ++i) addFloor(scene, sheet, 0.25F * static_cast<float>(i), true, 4);
  Camera camera;
  camera.position = {0.3F, 6.1F, 0.2F};
  camera.yfov = 0.3F;
  aim(camera, {0.1, -1, 0.05});
  scene.cameras = {camera};
  return scene;
}

TEST(BoundedMemory, LongRunsAreSlicedAlike) {
  Settings settings;
  settings.width = 8;
  settings.height = 4;
  settings.bounces = 13;
  const Agreement agreement = compareWithReference(sheets(), settings);
  expectAgreement(agreement, "sheets", 0);
  const Stats& stats = agreement.kernel.stats;
  EXPECT_EQ(stats.rays.impulse, 32U * ((1U << 13) - 2)) << "each ray splits at each bounce";
  EXPECT_GT(stageOf(stats, "find_long_runs").launches, 0U);
  // At bounce 10 a sample has 512 entries, two slices; each then grows and is sliced again: far more
  // than 13 segments.
  EXPECT_GT(stageOf(stats, "intersect").launches, 13U + 2 * 32);
  settings.raysPerPixel = 3;
  const RenderResult three = renderOnDevice(sheets(), settings);
  for (const int wavefront : {512, 1600, 1 << 22}) {
    settings.wavefront = wavefront;
    const RenderResult other = renderOnDevice(sheets(), settings);
    EXPECT_EQ(differingPixels(other.radiance, three.radiance), 0U) << wavefront;
    EXPECT_EQ(other.stats.dropped, 0U);
    EXPECT_LE(queueBytes(other.stats),
              documentedBound(static_cast<std::uint64_t>(other.stats.settings.wavefront), 13, 1))
        << wavefront;
  }
}

}  // namespace
}  // namespace whittle::test
