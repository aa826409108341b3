// A render that is interrupted anywhere and goes on has the bits of one that never was.
#include <cmath>
#include <fstream>

#include "render/checkpoint_file.h"
#include "scene/input_error.h"
#include "support/pictures.h"

namespace whittle::test {
namespace {

/// Batches of 4096 rays, so that there are many places to stop at.
Settings resumableSettings(int rays) {
  Settings settings = wholeSettings(4);
  settings.raysPerPixel = rays;
  settings.wavefront = 4096;
  settings.resumable = true;
  return settings;
}

struct Sitting {
  RenderResult result;
  RenderState state;
  int asked = 0;  ///< how often it was asked whether to go on
};

/// Stops when it is asked for the `last`-th time.
Sitting sit(const Scene& scene, const Settings& settings, const RenderState* from, int last) {
  Sitting sitting;
  RenderHooks hooks;
  hooks.resumed = from;
  hooks.checkpoint = [&](RenderState state) { sitting.state = std::move(state); };
  hooks.checkpointSeconds = 1e9;
  hooks.keepGoing = [&] { return ++sitting.asked < last; };
  sitting.result = renderOnDevice(scene, settings, hooks);
  return sitting;
}

constexpr int kNever = 1 << 30;

void expectSame(const RenderResult& a, const RenderResult& b, const std::string& where) {
  EXPECT_EQ(differingPixels(a.radiance, b.radiance), 0U) << where;
  EXPECT_EQ(a.stats.rays.primary, b.stats.rays.primary) << where;
  EXPECT_EQ(a.stats.rays.impulse, b.stats.rays.impulse) << where;
  EXPECT_EQ(a.stats.rays.shadow, b.stats.rays.shadow) << where;
  EXPECT_EQ(a.stats.samples.least, b.stats.samples.least) << where;
  EXPECT_EQ(a.stats.samples.most, b.stats.samples.most) << where;
  EXPECT_EQ(b.stats.dropped, 0U) << where;
  EXPECT_EQ(a.stats.ended.bounces, b.stats.ended.bounces) << where;
}

/// Stops at every `step`-th place where it can, and goes on from there.
void expectResumableAnywhere(const Scene& scene, const Settings& settings, int step) {
  Settings plain = settings;
  plain.resumable = false;
  const RenderResult straight = renderOnDevice(scene, plain);
  const Sitting whole = sit(scene, settings, nullptr, kNever);
  expectSame(straight, whole.result, "never interrupted");
  ASSERT_GT(whole.asked, 2 * step) << "nowhere to stop at";
  std::size_t unfinished = 0;
  for (int last = 1; last < whole.asked; last += step) {
    const Sitting first = sit(scene, settings, nullptr, last);
    unfinished += first.result.stats.rays.primary < straight.stats.rays.primary;
    expectSame(straight, sit(scene, settings, &first.state, kNever).result,
               fmt::format("stopped when asked for the {}th time of {}", last, whole.asked));
  }
  EXPECT_GT(unfinished, 0U) << "it never stopped before its end";
}

TEST(Resume, FromAnywhereHasTheSameBits) {
  expectResumableAnywhere(ownScene("cornell_box"), resumableSettings(6), 7);
}

TEST(Resume, WhereDecisionsFollowTheErrorToo) {
  Settings settings = resumableSettings(24);
  settings.adaptive = true;
  settings.width = 48, settings.height = 27;
  expectResumableAnywhere(ownScene("emission"), settings, 11);
  settings.adaptive = false;
  settings.targetErrorRelative = 0.05;
  settings.raysPerPixel = 256;
  expectResumableAnywhere(ownScene("emission"), settings, 11);
}

TEST(Resume, SittingsMayBeAsShortAsABatch) {
  const Scene scene = ownScene("mirror_box");
  const Settings settings = resumableSettings(12);
  const RenderResult straight = renderOnDevice(scene, settings);
  constexpr int kAsked = 25;  // a batch of four bounces asks less often: each sitting gets further
  Sitting sitting = sit(scene, settings, nullptr, kAsked);
  int sittings = 1;
  for (std::uint64_t before = 0; sitting.result.stats.rays.primary < straight.stats.rays.primary;
       ++sittings) {
    ASSERT_GT(sitting.result.stats.rays.primary, before) << "no further after sitting " << sittings;
    before = sitting.result.stats.rays.primary;
    const RenderState from = std::move(sitting.state);
    sitting = sit(scene, settings, &from, kAsked);
  }
  EXPECT_GT(sittings, 3);
  expectSame(straight, sitting.result, "many sittings");
}

TEST(Resume, WhatIsSavedMeanwhileIsAsGood) {
  const Scene scene = ownScene("cornell_box");
  const Settings settings = resumableSettings(4);
  const RenderResult straight = renderOnDevice(scene, settings);
  std::vector<RenderState> states;
  RenderHooks hooks;
  hooks.checkpoint = [&](RenderState state) { states.push_back(std::move(state)); };
  hooks.checkpointSeconds = 0.0;  // between all batches
  expectSame(straight, renderOnDevice(scene, settings, hooks), "saved all the time");
  ASSERT_GT(states.size(), 4U);
  for (std::size_t i = 0; i < states.size(); i += states.size() / 4)
    expectSame(straight, sit(scene, settings, &states[i], kNever).result, fmt::format("state {}", i));
}

TEST(Resume, MoreSamplesAreAddedToAFinishedPicture) {
  const Scene scene = ownScene("textured");
  for (const Sampler sampler : {Sampler::Random, Sampler::Sobol}) {
    Settings settings = resumableSettings(3);
    settings.sampler = sampler;
    settings.aovs = true;
    const Sitting first = sit(scene, settings, nullptr, kNever);
    settings.raysPerPixel = 7;
    const Sitting second = sit(scene, settings, &first.state, kNever);
    const RenderResult straight = renderOnDevice(scene, settings);
    expectSame(straight, second.result, "added");
    EXPECT_EQ(differingPixels(straight.aovs.at("normal"), second.result.aovs.at("normal")), 0U);
  }
}

TEST(Resume, ARenderWithNothingLeftToDoReturnsThePicture) {
  const Scene scene = ownScene("cornell_box");
  const Settings settings = resumableSettings(2);
  const Sitting first = sit(scene, settings, nullptr, kNever);
  expectSame(first.result, sit(scene, settings, &first.state, kNever).result, "again");
}

TEST(Resume, APictureOfAnotherSizeIsRefused) {
  const Scene scene = ownScene("cornell_box");
  Settings settings = resumableSettings(2);
  const Sitting first = sit(scene, settings, nullptr, kNever);
  settings.height = 20;
  EXPECT_THROW(sit(scene, settings, &first.state, kNever), InputError);
}

class CheckpointFile : public ::testing::Test {
 protected:
  std::filesystem::path file_ = std::filesystem::path(::testing::TempDir()) / "whittle_checkpoint_test.state";
  void TearDown() override { std::filesystem::remove(file_); }

  static Checkpoint some() {
    Checkpoint c;
    c.identity = {{"program", "1.2"}, {"settings", {{"bounces", 3}}}};
    c.arguments = {"render", "a b.glb", "--quiet"};
    c.folder = "/somewhere";
    c.state.counts = {4, 4, 2};
    c.state.pending = {{2, 2, {2}}, {4, 4, {0, 1}}};
    for (int i = 0; i < 40; ++i) c.state.film.push_back(0.1F * static_cast<float>(i) - 1.0F);
    c.state.aovs = {1.0F, std::numeric_limits<float>::infinity()};
    c.state.device = "a device";
    c.state.tally.primary = 1ULL << 40;
    c.state.tally.ended = {1, 2, 3};
    c.state.nonFinite = 5;
    c.state.endedShare = 1.0 / 3.0;
    c.state.seconds = 0.1;
    c.state.error = {{0.5, 4.0, std::numeric_limits<double>::infinity(), {}, 0.25},
                     {1.5, 8.0, 1e-3, 2e-3, 0.2}};
    return c;
  }
  /// One line that names the file.
  std::string refusal() const {
    try {
      readCheckpoint(file_);
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
      EXPECT_NE(std::string(e.what()).find(file_.string()), std::string::npos);
      return e.what();
    }
    return "";
  }
  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }
};

TEST_F(CheckpointFile, HoldsEveryNumber) {
  const Checkpoint before = some();
  writeCheckpoint(file_, before);
  const Checkpoint after = readCheckpoint(file_);
  EXPECT_EQ(after.identity, before.identity);
  EXPECT_EQ(after.arguments, before.arguments);
  EXPECT_EQ(after.folder, before.folder);
  const RenderState &a = after.state, &b = before.state;
  EXPECT_EQ(a.counts, b.counts);
  EXPECT_EQ(a.film, b.film);
  EXPECT_EQ(a.aovs, b.aovs);
  ASSERT_EQ(a.pending.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(a.pending[i].blocks, b.pending[i].blocks);
    EXPECT_EQ(a.pending[i].firstSample, b.pending[i].firstSample);
    EXPECT_EQ(a.pending[i].samples, b.pending[i].samples);
  }
  EXPECT_EQ(a.device, b.device);
  EXPECT_EQ(a.tally.primary, b.tally.primary);
  EXPECT_EQ(a.tally.ended, b.tally.ended);
  EXPECT_EQ(a.nonFinite, b.nonFinite);
  EXPECT_EQ(a.endedShare, b.endedShare);
  EXPECT_EQ(a.seconds, b.seconds);
  ASSERT_EQ(a.error.size(), 2U);
  EXPECT_TRUE(std::isinf(a.error[0].estimate));
  EXPECT_FALSE(a.error[0].rmse);
  EXPECT_EQ(a.error[1].rmse, b.error[1].rmse);
}

TEST_F(CheckpointFile, ThatIsCutOffOrDamagedIsRefused) {
  writeCheckpoint(file_, some());
  const std::string whole = bytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write(whole.substr(0, size));
    ASSERT_NE(refusal(), "") << size << " bytes";
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    write(damaged);
    ASSERT_NE(refusal(), "") << "byte " << at;
  }
  write(whole + "x");
  EXPECT_NE(refusal(), "");
}

TEST_F(CheckpointFile, OfAnotherKindOrVersionIsRefusedInItsOwnWords) {
  EXPECT_NE(refusal().find("is no file"), std::string::npos);
  write("glTF and something");
  EXPECT_NE(refusal().find("is no picture under way"), std::string::npos) << refusal();
  writeCheckpoint(file_, some());
  std::string other = bytes();
  other[14] = '2';
  write(other);
  EXPECT_NE(refusal().find("another version"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace whittle::test
