// The same bits whatever the threads, queues, work-groups, searches and passes.
#include <unistd.h>
#include <cstdlib>

#include "image/image_io.h"
#include "support/pictures.h"
#include "support/record.h"

namespace whittle::test {
namespace {

struct Subject {
  const char* scene;
  int bounces;
  int width, height;
};
void PrintTo(const Subject& s, std::ostream* out) { *out << s.scene; }

class Determinism : public ::testing::TestWithParam<Subject> {
 protected:
  Settings settings() const {
    Settings s = wholeSettings();
    s.width = GetParam().width;
    s.height = GetParam().height;
    s.bounces = GetParam().bounces;
    return s;
  }
};

TEST_P(Determinism, WavefrontsWorkGroupsAndSearches) {
  const Scene scene = ownScene(GetParam().scene);
  const RenderResult base = renderOnDevice(scene, settings());
  const auto expectSame = [&](const Settings& s, const std::string& what) {
    const RenderResult other = renderOnDevice(scene, s);
    recordCount("30", fmt::format("{}: {}", GetParam().scene, what), "the bits of the default settings",
                differingPixels(base.radiance, other.radiance), base.radiance.pixels.size() / 3, "pixels");
    EXPECT_EQ(other.stats.rays.total(), base.stats.rays.total()) << what;
    EXPECT_EQ(other.stats.dropped, 0U) << what;
  };
  for (const int wavefront : {512, 1001, 4099, 1 << 20}) {  // the first is less than a row of two branches
    Settings s = settings();
    s.wavefront = wavefront;
    expectSame(s, "wavefront " + std::to_string(wavefront));
  }
  for (const int workGroup : {1, 7, 32}) {
    Settings s = settings();
    s.workGroup = workGroup;
    expectSame(s, "work-group " + std::to_string(workGroup));
  }
  Settings single = settings();
  single.lanes = Lanes::One;
  expectSame(single, "one lane");
  single.workGroup = 5;
  single.wavefront = 3000;
  expectSame(single, "one lane, other sizes");
}

TEST_P(Determinism, RandomChoicesDoNotDependOnBatches) {
  const Scene scene = ownScene(GetParam().scene);
  Settings s = settings();
  s.impulses = ImpulseMode::One;
  s.sampler = Sampler::Sobol;
  s.raysPerPixel = 5;
  const RenderResult base = renderOnDevice(scene, s);
  s.wavefront = 700;
  EXPECT_EQ(differingPixels(base.radiance, renderOnDevice(scene, s).radiance), 0U) << "other batches";
  s.timeLimit = 1e9;
  EXPECT_EQ(differingPixels(base.radiance, renderOnDevice(scene, s).radiance), 0U) << "passes";
}

TEST_P(Determinism, TreeAndArray) {
  const Scene scene = ownScene(GetParam().scene);
  Settings s = settings();
  s.width = 24;  // every ray against every triangle
  s.height = 14;
  s.bounces = std::min(s.bounces, 5);
  s.search = Search::Tree;
  const RenderResult tree = renderOnDevice(scene, s);
  s.search = Search::Array;
  const RenderResult array = renderOnDevice(scene, s);
  EXPECT_EQ(differingPixels(tree.radiance, array.radiance), 0U);
  EXPECT_EQ(tree.stats.rays.total(), array.stats.rays.total());
  EXPECT_EQ(tree.stats.searchUsed, "tree");
  EXPECT_EQ(array.stats.searchUsed, "array");
  s.lanes = Lanes::One;
  EXPECT_EQ(differingPixels(tree.radiance, renderOnDevice(scene, s).radiance), 0U) << "one lane, array";
}

TEST_P(Determinism, TenRepeatsAndPasses) {
  const Scene scene = ownScene(GetParam().scene);
  Settings s = settings();
  s.width /= 2;
  s.height /= 2;
  s.bounces = std::min(s.bounces, 8);
  s.raysPerPixel = 6;
  const RenderResult first = renderOnDevice(scene, s);
  std::size_t different = 0;
  for (int i = 1; i < 10; ++i)
    different += differingPixels(first.radiance, renderOnDevice(scene, s).radiance);
  recordCount("30", fmt::format("{}: ten runs", GetParam().scene), "the same bits", different,
              9 * first.radiance.pixels.size() / 3, "pixels");
  Settings passes = s;
  passes.timeLimit = 1e9;
  const RenderResult timed = renderOnDevice(scene, passes);
  EXPECT_EQ(differingPixels(first.radiance, timed.radiance), 0U);
  EXPECT_EQ(timed.stats.error.size(), 3U) << "looks after 2, 4 and 6 samples";
  passes.timeLimit = 0;
  passes.targetError = 1e-30;
  passes.wavefront = 777;
  EXPECT_EQ(differingPixels(first.radiance, renderOnDevice(scene, passes).radiance), 0U);
}

#ifdef WHITTLE_BINARY
/// PoCL reads its number of threads once, so each takes a process of its own.
TEST_P(Determinism, Threads) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("whittle_threads_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const RenderResult here = renderOnDevice(ownScene(GetParam().scene), settings());
  for (const int threads : {1, 2}) {
    const auto file = folder / "picture.exr";
    const std::string command =
        std::string(WHITTLE_BINARY) + " render " + WHITTLE_SCENES + "/" + GetParam().scene +
        ".glb --quiet --keep-all-features --width " + std::to_string(GetParam().width) + " --height " +
        std::to_string(GetParam().height) + " --bounces " + std::to_string(GetParam().bounces) +
        " --threads " + std::to_string(threads) + " -o " + file.string();
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    recordCount("30", fmt::format("{}: {} threads", GetParam().scene, threads),
                "the bits of the default settings", differingPixels(here.radiance, readFloatImage(file)),
                here.radiance.pixels.size() / 3, "pixels");
    std::filesystem::remove(file);
  }
  std::filesystem::remove_all(folder);
}
#endif

INSTANTIATE_TEST_SUITE_P(Scenes, Determinism,
                         ::testing::Values(Subject{"cornell_box", 8, 300, 24},
                                           Subject{"nested_glass", 16, 32, 18},
                                           Subject{"textured", 8, 300, 24}),
                         [](const auto& subject) { return std::string(subject.param.scene); });

}  // namespace
}  // namespace whittle::test
