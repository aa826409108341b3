// What --bounces and --transparent-bounces end: counted as the reference counts it, and never more than the
// bound says.
#include <fmt/format.h>

#include <cmath>

#include "report/profile_table.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

/// Two mirrors of reflectance 1/2, 1 m apart, and a camera between them that looks straight at the lower.
Scene corridor() {
  Scene scene;
  addFloor(scene, mirror(glm::vec3(0.5F)), 0, true, 4);
  addFloor(scene, mirror(glm::vec3(0.5F)), 1, false, 4);
  scene.background.radiance = {1, 1, 1};
  Camera camera = lookingDown();
  camera.orthographic = true;
  camera.position = {0, 0.5F, 0};
  camera.ymag = 0.1F;
  scene.cameras = {camera};
  return scene;
}

/// `count` panes over a floor that glows, each letting 7/8 through and giving off nothing.
Scene panes(int count) {
  Scene scene;
  addFloor(scene, emitter(glm::vec3(1)), 0, true, 4);
  Material m = lambert(glm::vec3(0));
  m.unlit = true;
  m.alphaMode = AlphaMode::Blend;
  m.baseColor.a = 0.125F;
  m.doubleSided = true;
  const std::uint32_t material = addMaterial(scene, m);
  for (int i = 0; i < count; ++i)
    addQuad(scene, material, {-4, 0.1F + 0.01F * static_cast<float>(i), -4}, {0, 0, 8}, {8, 0, 0});
  scene.cameras = {lookingDown()};
  return scene;
}

Settings limited(int bounces) {
  Settings settings = wholeSettings(bounces);
  settings.width = 48;
  settings.height = 32;
  return settings;
}

/// Units of 2^-26 are rounded up, one for each impulse.
void expectSum(double counted, double expected, const std::string& what) {
  EXPECT_GE(counted, expected * (1 - 1e-6)) << what;
  EXPECT_LE(counted, expected * (1 + 1e-5) + 1e-7) << what;
}

TEST(Limits, AHallOfMirrorsEndsAPowerOfItsReflectance) {
  for (const Lanes lanes : {Lanes::Auto, Lanes::One})
    for (const int bounces : {2, 3, 8, 20}) {
      Settings settings = limited(bounces);
      settings.lanes = lanes;
      const Stats stats = renderOnDevice(corridor(), settings).stats;
      const double samples = static_cast<double>(stats.rays.primary);
      expectSum(stats.ended.bounces / samples, std::pow(0.5, bounces), fmt::format("{} bounces", bounces));
      EXPECT_EQ(stats.ended.straight, 0);
      EXPECT_EQ(stats.ended.cutOff, 0);
      // The background is never seen, and yet might be for all that is known.
      EXPECT_NEAR(stats.biasBound, std::pow(0.5, bounces), 2e-5);
    }
}

TEST(Limits, PanesEndWhatTheyHaveLetThrough) {
  const Scene scene = panes(12);
  for (const int limit : {0, 1, 5, 11, 12, 64}) {
    Settings settings = limited(1);
    settings.transparentBounces = limit;
    const RenderResult result = renderOnDevice(scene, settings);
    const double samples = static_cast<double>(result.stats.rays.primary);
    const double passed = limit < 12 ? std::pow(0.875, limit + 1) : 0;
    expectSum(result.stats.ended.straight / samples, passed, fmt::format("limit {}", limit));
    EXPECT_EQ(result.stats.ended.bounces, 0);
    // What is missing is what the last of them would have shown, at most.
    const double whole = std::pow(0.875, 12), seen = static_cast<double>(colorOf(result).x);
    EXPECT_LE(whole - seen, result.stats.biasBound + 1e-6);
    EXPECT_EQ(result.stats.biasBound == 0, passed == 0);
  }
}

class LimitsOf : public ::testing::TestWithParam<const char*> {};

TEST_P(LimitsOf, AreCountedAsTheReferenceCounts) {
  for (const int bounces : {2, 4}) {
    Settings settings = limited(bounces);
    settings.transparentBounces = 1;
    const Agreement agreement = compareWithReference(ownScene(GetParam()), settings);
    const RayCounts& expected = agreement.reference.rays;
    const EndedThroughput& ended = agreement.kernel.stats.ended;
    // A pixel on an edge may be another: at most one sample's throughput each.
    const double loose = static_cast<double>(agreement.outliers) + 1e-5 * expected.bounces + 1e-4;
    EXPECT_NEAR(ended.bounces, expected.bounces, loose) << bounces;
    EXPECT_NEAR(ended.straight, expected.straight, loose) << bounces;
  }
}

TEST_P(LimitsOf, TakeNoMoreThanTheBound) {
  const Scene scene = ownScene(GetParam());
  const RenderResult whole = renderOnDevice(scene, limited(14));
  double bound = std::numeric_limits<double>::infinity();
  for (const int bounces : {1, 2, 3, 6, 10}) {
    const RenderResult cut = renderOnDevice(scene, limited(bounces));
    glm::dvec3 lost(0);
    for (std::size_t i = 0; i < whole.radiance.pixels.size(); ++i)
      lost[static_cast<int>(i % 3)] += static_cast<double>(whole.radiance.pixels[i] - cut.radiance.pixels[i]);
    const double most = std::max(lost.x, std::max(lost.y, lost.z)) / (48 * 32);
    fmt::print("{} {}: lost {:.3g}, bound {:.3g}\n", GetParam(), bounces, most, cut.stats.biasBound);
    EXPECT_LE(most, cut.stats.biasBound + 1e-6) << bounces;
    EXPECT_LE(cut.stats.biasBound, bound * (1 + 1e-5)) << bounces;
    bound = cut.stats.biasBound;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, LimitsOf,
                         ::testing::Values("cornell_box", "refraction", "mirror_box", "textured",
                                           "nested_glass"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(Limits, ANoteSaysWhatIsVisible) {
  EXPECT_TRUE(limitNotes(renderOnDevice(corridor(), limited(9)).stats).empty()) << "1/512";
  const auto notes = limitNotes(renderOnDevice(corridor(), limited(4)).stats);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("6.25 % of what rays carry (throughput) ends at --bounces 4"), std::string::npos)
      << notes[0];
  Settings settings = limited(8);
  settings.transparentBounces = 3;
  const auto straight = limitNotes(renderOnDevice(panes(12), settings).stats);
  ASSERT_EQ(straight.size(), 1U);
  EXPECT_NE(straight[0].find("ends at --transparent-bounces 3"), std::string::npos) << straight[0];
}

}  // namespace
}  // namespace whittle::test
