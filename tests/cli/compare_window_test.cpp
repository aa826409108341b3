// A reference and a region in the window: what is seen, code for code, and what is traced.
#include "image/image_io.h"
#include "window_fixture.h"

namespace whittle::test {
namespace {

class CompareWindowTest : public WindowTest {
 protected:
  /// What the window shows is comparable with files: one exposure for all.
  static std::vector<std::string> small(std::vector<std::string> more = {}) {
    std::vector<std::string> args = kSmall;
    args.insert(args.end(), {"--exposure", "0"});
    args.insert(args.end(), more.begin(), more.end());
    return args;
  }

  void renderTo(const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> args{
        "render", scene("cornell_box.glb"), "-o", name + ".exr", "-o", name + ".png", "--quiet"};
    const auto settings = small(std::move(more));
    args.insert(args.end(), settings.begin(), settings.end());
    const Outcome run = runWhittle(args, {folder_.path(), {}});
    ASSERT_EQ(run.status, 0) << run.err;
  }

  static constexpr const char* kPlace =
      "print window.pictureX\nprint window.pictureY\nprint window.pictureWidth\n";
  /// Where the picture lies in a screenshot.
  struct Place {
    int x = 0, y = 0, scale = 0;
    explicit Place(const Outcome& run)
        : x(static_cast<int>(printed(run, "window.pictureX"))),
          y(static_cast<int>(printed(run, "window.pictureY"))),
          scale(static_cast<int>(printed(run, "window.pictureWidth")) / 160) {}
  };

  /// Pixels of the shot, columns [from, to) of the window's within the picture, that are not those of
  /// `picture`.
  static std::size_t different(const Codes& shot, const Place& place, const Codes& picture, int from,
                               int to) {
    std::size_t count = 0;
    for (int y = 0; y < 90 * place.scale; ++y)
      for (int x = from; x < to; ++x)
        count += shot.at(place.x + x, place.y + y) != picture.at(x / place.scale, y / place.scale);
    return count;
  }
};

TEST_F(CompareWindowTest, SplitInTheMiddleIsLeftTheOneAndRightTheOther) {
  renderTo("own");
  renderTo("other", {"--bounces", "1"});
  ASSERT_NE(read("own.png").bytes, read("other.png").bytes);
  for (const char* reference : {"other.exr", "other.png"}) {
    const Outcome run =
        play(std::string("wait compared\nscreenshot split.png\nset compare flip\nscreenshot flip.png\n"
                         "key b\nscreenshot off.png\n") +
                 kPlace + "quit\n",
             small({"--compare", reference}));
    ASSERT_EQ(run.status, 0) << run.err;
    const Place place(run);
    ASSERT_GE(place.scale, 1);
    const Codes own = read("own.png"), other = read("other.png");
    const int middle = 80 * place.scale, width = 160 * place.scale;
    // A line one pixel wide on each side.
    EXPECT_EQ(different(read("split.png"), place, own, 0, middle - 1), 0U) << reference;
    EXPECT_EQ(different(read("split.png"), place, other, middle + 1, width), 0U) << reference;
    EXPECT_EQ(different(read("flip.png"), place, other, 0, width), 0U) << reference;
    EXPECT_EQ(different(read("off.png"), place, own, 0, width), 0U) << reference;
  }
}

TEST_F(CompareWindowTest, FiguresAreThoseOfTheCommand) {
  renderTo("own");
  renderTo("other", {"--bounces", "1"});
  for (const char* kind : {".exr", ".png"}) {
    const std::string other = std::string("other") + kind;
    const Outcome command =
        runWhittle({"compare", std::string("own") + kind, other, "--json"}, {folder_.path(), {}});
    ASSERT_EQ(command.status, 0) << command.err;
    const auto expected = nlohmann::json::parse(command.out);
    const Outcome run =
        play("wait refined\ncompare " + other +
                 "\nwait compared\nprint compare.rmse\nprint compare.relMse\nprint compare.maxAbs\n"
                 "print compare.flip\nprint compare.differingPixels\nexpect compare.mode == split\n",
             small());
    ASSERT_EQ(run.status, 0) << run.err;
    for (const char* figure : {"rmse", "relMse", "maxAbs", "flip", "differingPixels"}) {
      const double value = expected[figure];
      EXPECT_NEAR(printed(run, std::string("compare.") + figure), value, 1e-6 * value)
          << other << ' ' << figure;
    }
  }
}

TEST_F(CompareWindowTest, ThePictureIsNowhereFromItself) {
  const Outcome run =
      play(std::string("wait refined\nkey k\nset compare difference\nwait compared\n"
                       "expect compare.rmse == 0\nexpect compare.maxAbs == 0\nexpect compare.flip == 0\n"
                       "expect compare.differingPixels == 0\nscreenshot none.png\n") +
               kPlace +
               "set compare-error relative\nwait compared\nexpect compare.relMse == 0\nset "
               "bounces 1\nwait compared\nexpect compare.differingPixels > 100\nscreenshot "
               "some.png\nset reference kept.exr\nwait 0.3\nexpect compare.differingPixels > 100\n",
           small());
  ASSERT_EQ(run.status, 0) << run.err;
  const Place place(run);
  const Codes shot = read("none.png");
  std::size_t lit = 0;
  for (int y = 0; y < 90 * place.scale; ++y)
    for (int x = 0; x < 160 * place.scale; ++x)
      lit += shot.at(place.x + x, place.y + y) != std::array<std::uint8_t, 3>{0, 0, 0};
  EXPECT_EQ(lit, 0U);
}

/// Who switches it on and off sees the same pixel at the same place.
TEST_F(CompareWindowTest, TheScaleOfTheDifferenceMovesNothing) {
  const std::string places = std::string(kPlace) + "print window.pictureHeight\n";
  for (const char* size : {"1280 720", "1280 420"}) {  // room below the picture, and none
    const Outcome run =
        play(fmt::format("resize {}\nwait refined\nwait 0.2\n{}key k\nset bounces 1\nset compare difference\n"
                         "wait compared\nwait 0.2\nscreenshot difference.png\n{}",
                         size, places, places),
             small());
    ASSERT_EQ(run.status, 0) << run.err;
    const std::size_t half = run.out.size() / 2;
    EXPECT_EQ(run.out.substr(0, half), run.out.substr(half)) << run.out;
  }
}

TEST_F(CompareWindowTest, TheLineIsDraggedAndTheCameraStays) {
  expectPlayed(
      "wait refined\nkey k\nwait compared\nexpect compare.split == 0.5\ndrag 80 45 40 45\nexpect "
      "compare.split > 0.24\n"
      "expect compare.split < 0.26\nexpect view.finished == true\nexpect view.explainedRays == 0\n"
      "drag 120 45 130 45\nexpect compare.split < 0.26\nwait refined\nexpect compare.mode == split\n");
}

TEST_F(CompareWindowTest, AReferenceOfAnotherSizeIsSaidAndNothingIsLost) {
  renderTo("own");
  renderTo("small", {"--width", "80", "--height", "45"});
  expectPlayed(
      "wait refined\ncompare own.exr\nwait compared\nexpect compare.reference == own.exr\ncompare "
      "small.exr\nwait 0.5\n"
      "expect view.messages > 0\nexpect compare.reference == own.exr\nexpect compare.current == true\n"
      "set width 80\nset height 45\nwait refined\nexpect compare.problem != none\ncompare small.exr\nwait "
      "compared\n"
      "expect compare.reference == small.exr\ncompare nothing.exr\nwait 0.5\nexpect compare.reference == "
      "small.exr\n",
      small());
  const Outcome run = play("wait refined\nset compare split\n", small());
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("line 2: compare: there is no reference"), std::string::npos) << run.err;
}

TEST_F(CompareWindowTest, OnlyARegionIsRenderedAnew) {
  renderTo("before");
  renderTo("after", {"--bounces", "1"});
  const Outcome run =
      play(std::string("wait refined\nkey Ctrl+B\ndrag 40.5 20.5 99.5 59.5\nwait refined\n"
                       "expect stats.settings.crop == 40,20,60,40\nexpect stats.rays.primary == 9600\n"
                       "set bounces 1\nwait refined\nscreenshot region.png\n") +
               kPlace +
               "set bounces 3\ndrag 20 70 24 70\nwait refined\nexpect stats.rays.primary == 9600\n"
               "key Escape\nwait refined\nexpect stats.settings.crop == null\n"
               "expect stats.rays.primary == 57600\nkey Ctrl+B\nkey Escape\ndrag 40 20 50 "
               "20\nwait refined\nexpect stats.settings.crop == null\n",
           small());
  ASSERT_EQ(run.status, 0) << run.err;
  const Place place(run);
  const Codes shot = read("region.png"), before = read("before.png"), after = read("after.png");
  std::size_t wrongInside = 0, wrongOutside = 0;
  const auto lies = [&](int x, int y, int by) {  // within so many of the window's pixels around the region
    return x >= 40 * place.scale - by && x < 100 * place.scale + by && y >= 20 * place.scale - by &&
           y < 60 * place.scale + by;
  };
  for (int y = 0; y < 90 * place.scale; ++y)
    for (int x = 0; x < 160 * place.scale; ++x) {
      const auto code = shot.at(place.x + x, place.y + y);
      if (lies(x, y, 0))
        wrongInside += code != after.at(x / place.scale, y / place.scale);
      else if (!lies(x, y, 2))  // its edge
        wrongOutside += code != before.at(x / place.scale, y / place.scale);
    }
  EXPECT_EQ(wrongInside, 0U);
  EXPECT_EQ(wrongOutside, 0U);
}

/// As `render --crop` writes it, though what surrounds it was rendered with other settings.
TEST_F(CompareWindowTest, ARegionIsSavedAlone) {
  expectPlayed(
      "wait refined\nset bounces 1\nwait refined\nkey Ctrl+B\ndrag 40.5 20.5 99.5 59.5\nset bounces 3\n"
      "wait refined\nkey Ctrl+S\nwait 0.2\n",
      small());
  renderTo("crop", {"--crop", "40,20,60,40"});
  const std::string saved = "cornell_box-crop-40,20,60,40-001";
  ASSERT_EQ(read("crop.png").width, 60);
  EXPECT_EQ(read(saved + ".png").bytes, read("crop.png").bytes);
  const FloatImage is = readFloatImage(folder_ / (saved + ".exr")),
                   wanted = readFloatImage(folder_ / "crop.exr");
  EXPECT_EQ(is.pixels, wanted.pixels);
  const auto file = OIIO::ImageInput::open((folder_ / (saved + ".exr")).string());
  ASSERT_TRUE(file);
  EXPECT_EQ(file->spec().x, 40);
  EXPECT_EQ(file->spec().y, 20);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cornell_box-001.png"));
}

}  // namespace
}  // namespace whittle::test
