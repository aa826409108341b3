// The model behind the window: what its thread does not do, and what changes of a setting do not do again.
#include "view/viewer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "image/tone_map.h"
#include "scene/input_error.h"
#include "support/pictures.h"

namespace whittle::test {
namespace {

/// With the balls in it.
constexpr Region kRegion{8, 6, 16, 10};

/// A viewer of the Cornell box. The codes' thread waits at `gate` while that is closed.
class ViewerTest : public testing::Test {
 protected:
  ViewerTest() {
    Settings settings = onTestDevice(wholeSettings(2));
    settings.width = 32, settings.height = 18;
    view::Services services;
    services.load = [](const std::filesystem::path&, Settings&, std::vector<std::string>&) {
      return ownScene("cornell_box");
    };
    services.checkPicture = [](const Settings&) {};
    services.set = [](Settings& s, const std::string& id, const std::string& text) {
      if (id == "exposure") s.exposure = std::stof(text);
      if (id == "bounces") s.bounces = std::stoi(text);
      if (id == "crop") s.crop = text == "none" ? std::nullopt : std::optional(kRegion);
    };
    services.stops = [](const FloatImage&, const Scene&, const Settings& s) {
      return s.exposure.value_or(0);
    };
    services.codes = [this](const FloatImage& light, const Scene&, const Settings& s) {
      coder_ = std::this_thread::get_id();
      ++coded_;
      while (!isOpen_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::vector<std::uint8_t> rgba;
      for (const std::uint8_t code : toneMap(light, *s.exposure)) {
        rgba.push_back(code);
        if (rgba.size() % 4 == 3) rgba.push_back(255);
      }
      return rgba;
    };
    services.readReference = [](const std::filesystem::path&) -> view::Reference {
      throw InputError("none");
    };
    services.wake = [] {};
    if (const auto folder = testKernelFolder()) services.kernelFolder = *folder;
    viewer_ = std::make_unique<view::Viewer>(std::move(services), settings, "cornell_box.glb");
  }
  ~ViewerTest() override { isOpen_ = true; }

  /// Updates the viewer as a window does, until that holds.
  template <typename Condition>
  void updateUntil(const Condition& holds) {
    const auto start = std::chrono::steady_clock::now();
    while (!holds() && std::chrono::steady_clock::now() - start < std::chrono::minutes(2)) {
      viewer_->update();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ASSERT_TRUE(holds()) << "waited for two minutes";
  }
  bool isRefined() const { return viewer_->isFinished() && viewer_->hasNewestCodes(); }

  std::atomic<bool> isOpen_{true};
  std::atomic<int> coded_{0};
  std::atomic<std::thread::id> coder_{};
  std::unique_ptr<view::Viewer> viewer_;
};

TEST_F(ViewerTest, CodesAreMadeOnAnotherThreadWhichTheWindowDoesNotWaitFor) {
  updateUntil([&] { return isRefined(); });
  EXPECT_NE(coder_.load(), std::this_thread::get_id());
  const auto before = viewer_->picture();
  isOpen_ = false;
  const int coded = coded_;
  ASSERT_EQ(viewer_->set("exposure", "2"), "");
  updateUntil([&] { return coded_ > coded; });
  viewer_->update();  // returns though the codes' thread is held
  EXPECT_FALSE(viewer_->hasNewestCodes());
  EXPECT_EQ(viewer_->picture().serial, before.serial) << "the picture before stays";
  isOpen_ = true;
  updateUntil([&] { return viewer_->hasNewestCodes(); });
  EXPECT_NE(viewer_->picture().codes, before.codes);
}

TEST_F(ViewerTest, ExposureTracesNothing) {
  updateUntil([&] { return isRefined(); });
  const RenderResult* const traced = viewer_->result();
  const auto before = viewer_->picture().codes;
  for (const char* stops : {"1", "-1", "3"}) {
    ASSERT_EQ(viewer_->set("exposure", stops), "");
    EXPECT_TRUE(viewer_->isFinished());
    updateUntil([&] { return viewer_->hasNewestCodes(); });
    EXPECT_EQ(viewer_->result(), traced) << "no other result was made";
    EXPECT_NE(viewer_->picture().codes, before);
  }
  ASSERT_EQ(viewer_->set("exposure", "0"), "");
  updateUntil([&] { return viewer_->hasNewestCodes(); });
  EXPECT_EQ(viewer_->picture().codes, before);
}

/// What lies around a region is of the picture before, and in its place the codes are those of the region.
TEST_F(ViewerTest, AroundARegionThePictureBeforeStays) {
  updateUntil([&] { return isRefined(); });
  const FloatImage whole = viewer_->result()->radiance;
  ASSERT_EQ(viewer_->set("crop", "some"), "");
  ASSERT_EQ(viewer_->set("bounces", "1"), "");
  updateUntil([&] { return isRefined(); });
  const FloatImage& now = viewer_->result()->radiance;
  ASSERT_EQ(now.width, whole.width);
  int inside = 0, outside = 0;
  for (int y = 0; y < now.height; ++y)
    for (int x = 0; x < now.width; ++x) {
      const std::size_t at = 3 * (static_cast<std::size_t>(y) * now.width + x);
      const bool isInside =
          x >= kRegion.x && x < kRegion.x + kRegion.width && y >= kRegion.y && y < kRegion.y + kRegion.height;
      const bool differs = !std::equal(&now.pixels[at], &now.pixels[at] + 3, &whole.pixels[at]);
      (isInside ? inside : outside) += differs;
    }
  EXPECT_EQ(outside, 0);
  EXPECT_GT(inside, 0) << "one bounce is another picture there";
}

}  // namespace
}  // namespace whittle::test
