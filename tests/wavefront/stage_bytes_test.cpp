// Bytes that stages move, (wavefront/stages.h) against counts made by hand from what the kernels
// read and write.
#include "analysis/light_groups.h"
#include "support/pictures.h"

namespace whittle::test {
namespace {

TEST(StageBytes, OfAMatteSceneIsWhatItsKernelsTouch) {
  // No impulses: one bounce. Eye rays 6 floats and no slot, hits 3 without their distances, radiance 3, flags
  // a byte; a place for each pixel.
  Settings settings = smallSettings(1);
  settings.raysPerPixel = 2;
  const Stats stats = renderOnDevice(ownScene("shadow"), settings).stats;
  const std::uint64_t rays = stats.rays.primary, pixels = rays / 2, shadow = stats.rays.shadow;
  ASSERT_GT(shadow, 0U);
  EXPECT_EQ(stageOf(stats, "raygen").bytes, rays * 24 + pixels * 4);
  EXPECT_EQ(stageOf(stats, "intersect").bytes, rays * (24 + 12));
  // Each light's candidates are 10 floats, and a byte of flags; all of these lights are of one group.
  const std::uint64_t lights = ownScene("shadow").lights.size();
  ASSERT_LE(lights, kLightsWaiting);
  EXPECT_EQ(stageOf(stats, "shade").bytes, rays * (24 + 12 + 12 + lights) + shadow * 40);
  EXPECT_EQ(stageOf(stats, "occlude").bytes, shadow * (4 + 40 + 24));
  EXPECT_EQ(stageOf(stats, "compact_shadow").bytes, lights * rays + shadow * 4);
  EXPECT_EQ(stageOf(stats, "compact_count").bytes, lights * rays);
  // The first look at the film writes its 8 planes and reads the samples.
  EXPECT_EQ(stageOf(stats, "film").bytes, rays * 12 + pixels * 8 * 4);
}

/// A further group reads rays, hits, radiance and flags again.
TEST(StageBytes, OfASecondGroupOfLights) {
  Scene scene = ownScene("shadow");
  scene.lights.resize(kLightsWaiting + 1, scene.lights.front());
  const Stats stats = renderOnDevice(scene, smallSettings(1)).stats;
  const std::uint64_t rays = stats.rays.primary;
  EXPECT_EQ(stageOf(stats, "shade").bytes + stageOf(stats, "shade_light").bytes,
            rays * (24 + 12 + 12 + kLightsWaiting) + rays * (24 + 12 + 24 + 2) + stats.rays.shadow * 40);
}

}  // namespace
}  // namespace whittle::test
