// Rendering on a thread of its own, on a device that fails now and then.
#include "view/live_render.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "analysis/feature.h"
#include "cl/error.h"
#include "support/pictures.h"

namespace whittle::test {
namespace {

using view::LiveRender;
using view::Request;

/// What a lost device makes of the call that waits for it.
constexpr const char* kLost = "waiting for shade: clFinish failed with CL_OUT_OF_RESOURCES (-5)";

/// Whoever is woken is on the render's thread, in the middle of a render: what he throws comes from where the
/// device's own errors come from.
class FailingDevice {
 public:
  enum class When { Never, BeforeTheFirstLaunch, BetweenTwoPasses };

  FailingDevice() : live_([this] { woken(); }, {}, testKernelFolder()) { ready_ = true; }

  void failOnce(When when) { when_ = when; }
  LiveRender& live() { return live_; }
  /// Until the request has its picture, or has failed.
  void wait(std::uint64_t request) {
    for (int i = 0; i < 12000; ++i) {
      const view::Shown shown = live_.shown();
      if ((shown.finished && shown.request == request) || !live_.progress().error.empty()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << "waited for two minutes";
  }

 private:
  void woken() {
    if (!ready_) return;
    const When when = when_;
    const bool isRendering = live_.progress().doing == kLastPhase;
    if (when == When::Never || !isRendering) return;
    if (when == When::BetweenTwoPasses && wakes_++ < 1) return;  // the phase itself
    when_ = When::Never;
    wakes_ = 0;
    throw ClError(kLost);
  }

  std::atomic<bool> ready_{false};
  std::atomic<When> when_{When::Never};
  int wakes_ = 0;
  LiveRender live_;
};

class LostDevice : public testing::TestWithParam<FailingDevice::When> {};

TEST_P(LostDevice, IsOpenedAgainForTheNextRequest) {
  const auto scene = std::make_shared<Scene>(ownScene("cornell_box"));
  Settings settings = onTestDevice(wholeSettings(3));
  settings.raysPerPixel = 4;
  const Request request{scene, std::make_shared<const Appearance>(appearanceOf(*scene)), scene->cameras[0],
                        settings, false};
  const FloatImage expected = render(*scene, settings, testHooks()).radiance;
  FailingDevice device;
  const std::uint64_t first = device.live().ask(request);
  device.wait(first);
  ASSERT_EQ(device.live().progress().error, "");
  EXPECT_EQ(differingPixels(device.live().shown().result->radiance, expected), 0U);

  device.failOnce(GetParam());
  Request other = request;
  other.settings.bounces = 2;
  device.wait(device.live().ask(other));
  EXPECT_EQ(device.live().progress().error, kLost);
  const view::Shown left = device.live().shown();
  ASSERT_TRUE(left.result) << "the picture before stays, or the passes so far";
  EXPECT_FALSE(left.finished && left.request != first);

  const std::uint64_t last = device.live().ask(request);
  device.wait(last);
  const view::Shown shown = device.live().shown();
  EXPECT_EQ(device.live().progress().error, "");
  EXPECT_TRUE(device.live().progress().work.device) << "opened again";
  EXPECT_EQ(shown.request, last);
  EXPECT_EQ(differingPixels(shown.result->radiance, expected), 0U);
}

INSTANTIATE_TEST_SUITE_P(Times, LostDevice,
                         testing::Values(FailingDevice::When::BeforeTheFirstLaunch,
                                         FailingDevice::When::BetweenTwoPasses));

/// Moves that follow each other faster than pictures: each would end the one before, and none be seen.
TEST(LiveRender, ACoarsePictureUnderWayIsFinishedThoughANewerOneIsAskedFor) {
  const auto scene = std::make_shared<Scene>(ownScene("cornell_box"));
  Settings settings = onTestDevice(smallSettings(2));
  // More than a tenth of a second of two cores; where a sanitizer makes it slower, fewer pixels are.
  settings.width = WHITTLE_SLOWER > 1 ? 640 : 2560, settings.height = settings.width * 9 / 16;
  settings.raysPerPixel = 2;
  Request request{scene, std::make_shared<const Appearance>(appearanceOf(*scene)), scene->cameras[0],
                  settings, true};
  std::atomic<bool> isMoving{false};
  std::atomic<std::uint64_t> first{0}, second{0}, coarseOfFirst{0};
  LiveRender* rendering = nullptr;
  LiveRender live(
      [&] {
        if (!isMoving) return;
        while (first == 0) std::this_thread::yield();  // with one processor the picture may be there first
        const view::Shown shown = rendering->shown();
        if (shown.coarse && shown.request == first) ++coarseOfFirst;
        if (second == 0 && rendering->progress().doing == kLastPhase) second = rendering->ask(request);
      },
      {}, testKernelFolder());
  rendering = &live;
  const auto waitFor = [&](std::uint64_t number) {
    for (int i = 0; i < 12000; ++i) {
      const view::Shown shown = live.shown();
      if (shown.finished && shown.request == number) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << "waited for two minutes: " << live.progress().error;
  };
  waitFor(live.ask(request));  // compiles
  const auto rest = [] { std::this_thread::sleep_for(std::chrono::milliseconds(100)); };
  rest();
  bool comesCoarse = false;
  const std::uint64_t slow = live.ask(request);
  while (!live.shown().finished || live.shown().request != slow) {
    comesCoarse |= live.shown().coarse;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (!comesCoarse) GTEST_SKIP() << "this machine is so fast that full pictures come first";
  rest();
  isMoving = true;
  first = live.ask(request);
  while (second == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  waitFor(second);
  EXPECT_GT(coarseOfFirst, 0U);
}

/// Its search begins every eye ray anew, so a window without one would be slower than `render`.
TEST(LiveRender, ANearPlaneIsCompiledForTheFirstCameraThatCutsSomething) {
  const auto scene = std::make_shared<Scene>(ownScene("cornell_box"));
  FailingDevice device;
  Request request{scene, std::make_shared<const Appearance>(appearanceOf(*scene)), scene->cameras[0],
                  onTestDevice(smallSettings(2)), false};
  const auto rendered = [&](const char* what) {
    device.wait(device.live().ask(request));
    EXPECT_EQ(device.live().progress().error, "") << what;
    auto shown = device.live().shown();
    RenderHooks hooks = testHooks();
    hooks.camera = &request.camera;
    Settings all = request.settings;
    all.keepFeatures = bitOf(Feature::NEAR_PLANE);
    EXPECT_EQ(differingPixels(shown.result->radiance, render(*scene, all, hooks).radiance), 0U) << what;
    return shown.result->stats;
  };
  EXPECT_FALSE(uses(rendered("nothing before it"), "near plane"));
  const Camera before = request.camera;
  request.camera.znear = glm::length(before.position);  // the box is about the origin
  const auto hasForced = [](const Stats& stats) {
    return std::any_of(stats.featuresForced.begin(), stats.featuresForced.end(),
                       [](const std::string& text) { return contains(text, "near plane"); });
  };
  EXPECT_TRUE(hasForced(rendered("half of it before it")));
  request.camera = before;
  EXPECT_TRUE(hasForced(rendered("and back"))) << "to and fro compiles nothing";
  EXPECT_EQ(device.live().progress().work.programs, 0);
}

}  // namespace
}  // namespace whittle::test
