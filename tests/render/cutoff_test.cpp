// Impulses that the cut-off leaves out: as in the reference, never more than the bound says, the same sum
// however the samples are cut into batches.
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "kernels/shared/layout.h"
#include "scene/input_error.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

/// Two dark, tinted mirrors that face each other, a lamp at one end and a matte wall at the other.
Scene hall() {
  Scene scene;
  addFloor(scene, mirror({0.7F, 0.5F, 0.4F}), 0, true, 12);
  addFloor(scene, mirror({0.5F, 0.6F, 0.3F}), 2, false, 12);
  addQuad(scene, addMaterial(scene, lambert({0.6F, 0.5F, 0.4F})), {-12, 0, -12}, {24, 0, 0}, {0, 2, 0});
  addQuad(scene, addMaterial(scene, emitter({1, 2, 1.5F})), {11, 0.5F, -12}, {0, 0, 24}, {0, 1, 0});
  scene.lights = {pointLight({0, 1, -10}, 5)};
  scene.background.radiance = {0.1F, 0.2F, 0.4F};
  Camera camera;
  camera.position = {-1, 1.2F, 5};
  aim(camera, {0.3, -0.7, -1});
  scene.cameras = {camera};
  return scene;
}

Scene sceneOf(const std::string& name) { return name == "hall" ? hall() : ownScene(name); }

Settings cutSettings(float cutoff, int bounces = 14) {
  Settings settings = wholeSettings(bounces);
  settings.width = 64;
  settings.height = 36;
  settings.cutoff = cutoff;
  return settings;
}

/// Mean over the picture of a − b, the channel where it is furthest from 0.
double bias(const RenderResult& a, const RenderResult& b) {
  glm::dvec3 sum(0);
  const auto &p = a.radiance.pixels, &q = b.radiance.pixels;
  for (std::size_t i = 0; i < p.size(); ++i)
    sum[static_cast<int>(i % 3)] += static_cast<double>(p[i]) - static_cast<double>(q[i]);
  const glm::dvec3 mean = glm::abs(sum) / (static_cast<double>(p.size()) / 3);
  return std::max(mean.x, std::max(mean.y, mean.z));
}

/// Pictures without a cut-off, as far as rounding goes.
constexpr double kRounding = 1e-7;

TEST(Cutoff, OfNothingCompilesNothingAndChangesNoBit) {
  const Scene scene = ownScene("nested_glass");
  const auto cutSettings = [](float cutoff) {
    Settings settings = whittle::test::cutSettings(cutoff);
    settings.keepAllFeatures = false;
    return settings;
  };
  const RenderResult none = renderOnDevice(scene, cutSettings(0));
  EXPECT_FALSE(uses(none.stats, "cut-off of weak impulses"));
  const std::pair<std::string, std::string> line("cut-off of weak impulses", "no cut-off was asked for");
  const auto& lines = none.stats.featuresLeftOut;
  EXPECT_NE(std::find(lines.begin(), lines.end(), line), lines.end());
  EXPECT_EQ(none.stats.ended.cutOff, 0);
  // Compiled, but far below every throughput.
  const RenderResult tiny = renderOnDevice(scene, cutSettings(1e-36F));
  EXPECT_TRUE(uses(tiny.stats, "cut-off of weak impulses"));
  EXPECT_EQ(differingPixels(none.radiance, tiny.radiance), 0U);
  EXPECT_EQ(none.stats.rays.total(), tiny.stats.rays.total());
  EXPECT_EQ(statsToJson(tiny.stats)["cutOffThroughput"], 0.0);
  EXPECT_EQ(none.stats.ended.bounces, tiny.stats.ended.bounces);
  Settings kept = cutSettings(0);
  kept.keepAllFeatures = true;
  EXPECT_FALSE(uses(renderOnDevice(scene, kept).stats, "cut-off of weak impulses"));
}

TEST(Cutoff, IsNotCompiledWhereNothingSendsOutImpulses) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, 4);
  scene.cameras = {lookingDown()};
  const Stats stats = renderOnDevice(scene, cutSettings(0.5F)).stats;
  EXPECT_FALSE(uses(stats, "cut-off of weak impulses"));
  EXPECT_EQ(stats.biasBound, 0);
}

TEST(Cutoff, AgreesWithTheReference) {
  for (const char* name : {"hall", "nested_glass", "cornell_box", "refraction"}) {
    for (const float cutoff : {0.05F, 0.2F}) {
      const Agreement agreement = compareWithReference(sceneOf(name), cutSettings(cutoff, 8));
      expectAgreement(agreement, fmt::format("{} cut off at {}", name, cutoff), 1);
      const double expected = agreement.reference.rays.cutOff;
      EXPECT_GT(expected, 0) << name;
      EXPECT_GE(agreement.kernel.stats.ended.cutOff, 0.999 * expected) << name;
      // A unit of 2^-26 each, and what rounding moves across the cut-off.
      EXPECT_LE(agreement.kernel.stats.ended.cutOff, 1.01 * expected) << name;
    }
  }
}

class CutoffBound : public ::testing::TestWithParam<const char*> {};

TEST_P(CutoffBound, IsNeverPassedAndShrinksWithTheCutoff) {
  const Scene scene = sceneOf(GetParam());
  const RenderResult whole = renderOnDevice(scene, cutSettings(0));
  std::uint64_t rays = whole.stats.rays.total();
  double bound = 0;
  for (const float cutoff : {1e-5F, 1e-3F, 0.02F, 0.3F, 1.0F}) {
    SCOPED_TRACE(cutoff);
    const RenderResult cut = renderOnDevice(scene, cutSettings(cutoff));
    const double lost = bias(whole, cut);
    fmt::print("{} {:g}: {} rays, bias {:.3g}, bound {:.3g}\n", GetParam(), cutoff, cut.stats.rays.total(),
               lost, cut.stats.biasBound);
    EXPECT_LE(lost, cut.stats.biasBound + kRounding);
    EXPECT_LE(cut.stats.rays.total(), rays);
    EXPECT_GE(cut.stats.biasBound, bound * (1 - 1e-6)) << "but for the units of more and more impulses";
    EXPECT_EQ(cut.stats.dropped, 0U);
    rays = cut.stats.rays.total();
    bound = cut.stats.biasBound;
  }
  EXPECT_LT(rays, whole.stats.rays.total());
  EXPECT_TRUE(std::isfinite(bound));
  EXPECT_GT(bound, 0);
}

TEST_P(CutoffBound, HoldsWhereNoImpulseIsTraced) {
  const Scene scene = sceneOf(GetParam());
  Settings alone = cutSettings(0, 1);
  alone.transparentBounces = 0;
  const RenderResult direct = renderOnDevice(scene, alone);
  for (const float cutoff : {1.0F, kLargestCutoff}) {
    const RenderResult cut = renderOnDevice(scene, cutSettings(cutoff));
    EXPECT_EQ(cut.stats.rays.impulse, 0U);
    EXPECT_EQ(stageOf(cut.stats, "compact_impulse").launches, 0U);
    EXPECT_EQ(differingPixels(cut.radiance, direct.radiance), 0U);
    EXPECT_LE(bias(renderOnDevice(scene, cutSettings(0)), cut), cut.stats.biasBound + kRounding);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CutoffBound,
                         ::testing::Values("hall", "nested_glass", "cornell_box", "refraction",
                                           "white_furnace", "emission", "mirror_box", "textured"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(Cutoff, BoundHoldsForOneImpulseAndSeveralRays) {
  const Scene scene = ownScene("refraction");
  Settings settings = cutSettings(0, 12);
  settings.impulses = ImpulseMode::One;
  settings.raysPerPixel = 16;
  const RenderResult whole = renderOnDevice(scene, settings);
  settings.cutoff = 0.6F;  // a choice among grey branches takes nothing off the throughput, absorption does
  const RenderResult cut = renderOnDevice(scene, settings);
  EXPECT_LT(cut.stats.rays.impulse, whole.stats.rays.impulse);
  EXPECT_GT(cut.stats.biasBound, 0);
  EXPECT_LE(bias(whole, cut), cut.stats.biasBound + kRounding);
}

TEST(Cutoff, PictureAndSumAreTheSameHoweverItIsTraced) {
  for (const char* name : {"hall", "nested_glass"}) {
    const Scene scene = sceneOf(name);
    Settings settings = cutSettings(0.01F);
    settings.raysPerPixel = 3;
    const RenderResult base = renderOnDevice(scene, settings);
    EXPECT_GT(base.stats.ended.cutOff, 0);
    const auto expectSame = [&](const Settings& s, const std::string& what) {
      const RenderResult other = renderOnDevice(scene, s);
      EXPECT_EQ(differingPixels(base.radiance, other.radiance), 0U) << what;
      EXPECT_EQ(base.stats.rays.total(), other.stats.rays.total()) << what;
      EXPECT_EQ(base.stats.ended.cutOff, other.stats.ended.cutOff) << what;
      EXPECT_EQ(base.stats.ended.bounces, other.stats.ended.bounces) << what;
      EXPECT_EQ(base.stats.biasBound, other.stats.biasBound) << what;
      EXPECT_EQ(other.stats.dropped, 0U) << what;
    };
    for (const int wavefront : {512, 1001, 4099, 1 << 20}) {
      Settings s = settings;
      s.wavefront = wavefront;
      expectSame(s, fmt::format("{} wavefront {}", name, wavefront));
    }
    for (const int workGroup : {1, 7}) {
      Settings s = settings;
      s.workGroup = workGroup;
      expectSame(s, fmt::format("{} work-group {}", name, workGroup));
    }
    Settings other = settings;
    other.lanes = Lanes::One;
    expectSame(other, "one lane");
    other = settings;
    other.targetError = 1e-30;  // in passes
    expectSame(other, "passes");
  }
}

TEST(Cutoff, ThereIsNoBoundForALightOnASurface) {
  Scene scene = hall();
  scene.lights[0].position = {0, 1, -12};
  const Stats stats = renderOnDevice(scene, cutSettings(0.1F)).stats;
  EXPECT_TRUE(std::isinf(stats.biasBound));
  EXPECT_TRUE(statsToJson(stats)["biasBound"].is_null());
}

TEST(Cutoff, OutsideItsRangeIsRefused) {
  for (const float cutoff : {-1e-6F, 2000.0F, NAN})
    EXPECT_THROW(renderOnDevice(hall(), cutSettings(cutoff)), InputError) << cutoff;
}

#ifdef WHITTLE_BINARY
/// PoCL reads its number of threads once, so each takes a process of its own.
TEST(Cutoff, SumDoesNotDependOnThreads) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("whittle_cutoff_{}", getpid());
  std::filesystem::create_directories(folder);
  std::vector<nlohmann::json> stats;
  for (const int threads : {1, 2}) {
    const auto file = folder / "stats.json";
    const std::string command = fmt::format(
        "{} render {}/nested_glass.glb --quiet --width 64 --height 36 --bounces 12 --cutoff 0.01 --threads "
        "{} "
        "--stats {}",
        WHITTLE_BINARY, WHITTLE_SCENES, threads, file.string());
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    stats.push_back(nlohmann::json::parse(std::ifstream(file)));
  }
  std::filesystem::remove_all(folder);
  EXPECT_GT(stats[0]["biasBound"].get<double>(), 0);
  for (const char* key : {"biasBound", "cutOffThroughput", "bouncesThroughput", "rays"})
    EXPECT_EQ(stats[0][key], stats[1][key]);
}
#endif

}  // namespace
}  // namespace whittle::test
