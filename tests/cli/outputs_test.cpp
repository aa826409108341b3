// What a render leaves behind: whole files with their metadata, or nothing.
#include <gtest/gtest.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include "image/image_io.h"
#include "run_whittle.h"

namespace whittle::test {
namespace {

using Names = std::vector<std::string>;

/// One render that leaves all it can, for the cases that only look at what is there.
struct EveryOutput {
  const Folder folder;
  const Outcome run =
      runWhittle(smallRender({"-o", "a.png", "-o", "a.exr", "--output", "a.jpg", "--aov", "depth=d.exr",
                              "--aov", "normal=n.exr", "--bounces", "3", "--stats", "s.json"}),
                 {folder.path(), {}});
};
const EveryOutput& everyOutput() {
  static const EveryOutput made;
  return made;
}

TEST(Outputs, EachFormatIsWrittenWholeAndReadable) {
  const auto& [folder, run] = everyOutput();
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.names(), (Names{"a.exr", "a.jpg", "a.png", "d.exr", "n.exr", "s.json"}));
  for (const char* name : {"a.png", "a.exr", "a.jpg", "d.exr", "n.exr"}) {
    const FloatImage image = readFloatImage(folder / name);
    EXPECT_EQ(image.width, 32) << name;
    EXPECT_EQ(image.height, 24) << name;
    EXPECT_EQ(image.channels, name == std::string("d.exr") ? 1 : 3) << name;
    EXPECT_NE(run.out.find(std::string("wrote ") + name), std::string::npos) << run.out;
  }
}

TEST(Outputs, WithoutAnyThePictureIsNamedAfterTheScene) {
  const Folder folder;
  const Outcome run = runWhittle(smallRender({}), {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.names(), Names{"cornell_box.png"});
}

/// Every fourth value of a file of four channels, as it stands there: colours of .png are not divided by it.
std::vector<float> rgbaOf(const std::filesystem::path& file) {
  OIIO::ImageSpec asTheyAre;
  asTheyAre.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(file.string(), &asTheyAre);
  EXPECT_TRUE(input && input->spec().nchannels == 4) << file;
  if (!input || input->spec().nchannels != 4) return {};
  EXPECT_EQ(input->spec().alpha_channel, 3) << file;
  std::vector<float> values(static_cast<std::size_t>(input->spec().width) * input->spec().height * 4);
  EXPECT_TRUE(input->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, values.data()));
  return values;
}

/// A picture that is half there: .exr holds radiance that is multiplied by alpha, .png colours that are not.
TEST(Outputs, AlphaIsAFourthChannel) {
  const Folder folder;
  const std::vector<std::string> args{"-o",         "a.exr", "-o",         "a.png", "--aov",  "all=all.exr",
                                      "--exposure", "0",     "--tone-map", "none",  "--alpha"};
  for (const char* command : {"render", "reference"}) {
    std::vector<std::string> all{command, scene("nested_glass.glb"), "--width", "32", "--height",
                                 "18",    "--rays-per-pixel",        "4"};
    all.insert(all.end(), args.begin(), args.end());
    const Outcome run = runWhittle(all, {folder.path(), {}});
    ASSERT_EQ(run.status, 0) << run.err;
    const std::vector<float> radiance = rgbaOf(folder / "a.exr"), codes = rgbaOf(folder / "a.png");
    ASSERT_EQ(radiance.size(), codes.size());
    std::size_t clear = 0, partly = 0, solid = 0;
    for (std::size_t p = 0; p < radiance.size(); p += 4) {
      const float alpha = radiance[p + 3];
      EXPECT_NEAR(codes[p + 3], alpha, 0.5 / 255 + 1e-6);
      ++(alpha == 0 ? clear : alpha == 1 ? solid : partly);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_FALSE(alpha == 0 && radiance[p + c] != 0) << "the background is left out";
        const double v = alpha > 0 ? std::clamp(radiance[p + c] / alpha, 0.0F, 1.0F) : 0;
        const double code = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
        EXPECT_NEAR(codes[p + c], code, 0.5 / 255 + 1e-5) << "pixel " << p / 4;
      }
    }
    EXPECT_GT(clear, 0U);
    EXPECT_GT(partly, 0U);
    EXPECT_GT(solid, 0U);
    const auto layers = OIIO::ImageInput::open((folder / "all.exr").string());
    ASSERT_TRUE(layers);
    const Names& names = layers->spec().channelnames;
    EXPECT_NE(std::find(names.begin(), names.end(), "A"), names.end());
  }
}

/// Against a reference with the background in it the error would be that of the background.
TEST(Outputs, AlphaMustBeThatOfTheReference) {
  const Folder folder;
  ASSERT_EQ(runWhittle(smallRender({"-o", "whole.exr"}), {folder.path(), {}}).status, 0);
  ASSERT_EQ(runWhittle(smallRender({"-o", "cut.exr", "--alpha"}), {folder.path(), {}}).status, 0);
  const auto said = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"-o", "a.exr", "--quiet"});
    return runWhittle(smallRender(more), {folder.path(), {}}).err;
  };
  EXPECT_NE(said({"--reference", "whole.exr", "--alpha"}).find("no alpha channel"), std::string::npos);
  EXPECT_NE(said({"--reference", "cut.exr"}).find("has an alpha channel"), std::string::npos);
  EXPECT_EQ(said({"--reference", "cut.exr", "--alpha"}), "");
  EXPECT_EQ(said({"--reference", "whole.exr"}), "");
  EXPECT_EQ(said({"--alpha"}), "");
}

TEST(Outputs, AlphaHasNoPlaceInAJpeg) {
  const Folder folder;
  const Outcome run = runWhittle(smallRender({"-o", "a.png", "-o", "b.jpg", "--alpha"}), {folder.path(), {}});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--alpha: b.jpg"), std::string::npos) << run.err;
  EXPECT_TRUE(folder.names().empty());
}

TEST(Outputs, ExrCarriesSettingsAndRayCounts) {
  const auto& [folder, run] = everyOutput();
  ASSERT_EQ(run.status, 0) << run.err;
  const auto input = OIIO::ImageInput::open((folder / "a.exr").string());
  ASSERT_TRUE(input);
  const auto settings = nlohmann::json::parse(input->spec().get_string_attribute("whittle:settings"));
  EXPECT_EQ(settings["bounces"], 3);
  EXPECT_EQ(settings["width"], 32);
  EXPECT_EQ(input->spec().get_string_attribute("whittle:scene"), "cornell_box.glb");
  const auto rays = readJson(folder / "s.json")["rays"];
  const auto expected = "primary " + rays["primary"].dump() + " impulse " + rays["impulse"].dump() +
                        " shadow " + rays["shadow"].dump();
  EXPECT_EQ(input->spec().get_string_attribute("whittle:rays"), expected);
  EXPECT_EQ(input->spec().get_string_attribute("whittle:raysPerPixel"), "least 1 mean 1 most 1");
  EXPECT_GE(std::stod(input->spec().get_string_attribute("whittle:renderSeconds")), 0.0);
}

TEST(Outputs, ReferenceWritesTheSameKinds) {
  const Folder folder;
  const Outcome run = runWhittle({"reference", scene(), "--width", "8", "--height", "6", "-o", "r.exr", "-o",
                                  "r.png", "--aov", "primitive=p.exr", "--stats", "s.json"},
                                 {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.names(), (Names{"p.exr", "r.exr", "r.png", "s.json"}));
  EXPECT_EQ(readJson(folder / "s.json")["rays"]["primary"], 48);  // 8·6
}

TEST(Outputs, QuietPrintsNothing) {
  const Folder folder;
  const Outcome run = runWhittle(smallRender({"-o", "a.png", "--quiet"}), {folder.path(), {}});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "");
}

TEST(Outputs, AwayFromATerminalThereIsNoProgressAndNoDriverNoise) {
  const Folder folder;
  const Outcome run = runWhittle(smallRender({"-o", "a.png"}), {folder.path(), {}});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out.find('\r'), std::string::npos);
  EXPECT_EQ(run.out.find('\033'), std::string::npos);
}

/// A file-size limit of 512 bytes stands in for a full disk: the write of the picture fails, later than
/// all checks. The reference writes through the same code as render and has no kernel compiler that
/// would stumble first.
TEST(Outputs, ADiskThatFillsUpLeavesTheOldPictureAndNothingElse) {
  const Folder folder;
  const std::string command =
      "exec \"$WHITTLE\" reference " + scene() + " --width 32 --height 24 -o a.exr --bounces ";
  ASSERT_EQ(runShell(command + "1", {folder.path(), {}}).status, 0);
  const std::string before = readText(folder / "a.exr");
  ASSERT_GT(before.size(), 512U);
  const Outcome run = runShell("ulimit -f 1; " + command + "2", {folder.path(), {}});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("whittle: a.exr: cannot be written"), std::string::npos) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(folder.names(), Names{"a.exr"});
  EXPECT_EQ(readText(folder / "a.exr"), before);
}

TEST(Outputs, StatisticsToAFullDeviceFail) {
  const Folder folder;
  const Outcome run = runWhittle(smallRender({"--stats", "/dev/full"}), {folder.path(), {}});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("/dev/full: cannot be written: No space left on device"), std::string::npos)
      << run.err;
  EXPECT_TRUE(folder.names().empty());
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full")) << "the device was replaced";
}

TEST(Outputs, AMinusIsStandardOutputAndNothingElseGoesThere) {
  const Folder folder;
  const Outcome run =
      runWhittle(smallRender({"--stats", "-", "--profile", "-o", "a.exr"}), {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["rays"]["primary"], 32 * 24);
  EXPECT_EQ(run.err.rfind("stage ", 0), 0U) << "the table goes to standard error then: " << run.err;
  EXPECT_EQ(folder.names(), Names{"a.exr"});
}

TEST(Outputs, AMinusAddsToTheFileThatStandardOutputIs) {
  const Outcome run = runShell(
      "log=$(mktemp); (echo first; \"$WHITTLE\" render \"" + scene() +
      "\" --width 32 --height 24 --quiet --stats -; echo last) >\"$log\"; head -n 1 \"$log\"; tail -n 1 "
      "\"$log\"; wc -l <\"$log\"; rm \"$log\"");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out.rfind("first\nlast\n", 0), 0U) << run.out;
  EXPECT_GT(std::stoi(run.out.substr(11)), 100) << "the statistics are between them";
}

TEST(Outputs, APictureThatNoDeviceHoldsIsRefusedBeforeAnythingIsAllocated) {
  const std::string scene = std::string(WHITTLE_SCENES) + "/shadow.glb";
  const std::vector<std::string> size{"--width", "65535", "--height", "65535"};
  const auto with = [&](std::vector<std::string> args) {
    args.insert(args.end(), size.begin(), size.end());
    return args;
  };
  const Folder folder;
  const Outcome render = runWhittle(with({"render", scene, "-o", "a.png"}), {folder.path(), {}});
  EXPECT_EQ(render.status, 2);
  EXPECT_NE(render.err.find("a picture of 65535×65535 would take "), std::string::npos) << render.err;
  const Outcome allowed =
      runWhittle(with({"render", scene, "-o", "a.png", "--memory-limit", "900T"}), {folder.path(), {}});
  EXPECT_EQ(allowed.status, 1) << "the device has no more than it has";
  EXPECT_NE(allowed.err.find("65535×65535"), std::string::npos) << allowed.err;
  EXPECT_TRUE(folder.names().empty());
  const Outcome info = runWhittle(with({"info", scene}));
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_NE(info.out.find("65535×65535"), std::string::npos) << info.out;
}

TEST(Outputs, StatisticsGoToStandardOutputToo) {
  const Outcome run = runWhittle(smallRender({"--stats", "/dev/stdout", "--quiet"}));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["rays"]["primary"], 32 * 24);
}

TEST(Outputs, AFullStandardOutputIsAFailure) {
  const Outcome run = runShell("\"$WHITTLE\" devices >/dev/full");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("standard output"), std::string::npos) << run.err;
}

TEST(Outputs, AnInterruptedRenderLeavesNothing) {
  for (const int number : {SIGINT, SIGTERM}) {
    const Folder folder;
    // Millions of samples: minutes of work, so that the signal comes while it renders.
    Process process(smallRender({"-o", "a.exr", "--stats", "s.json", "--rays-per-pixel", "1000000"}),
                    {folder.path(), {}});
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    process.signal(number);
    const Outcome run = process.finish();
    EXPECT_EQ(run.status, -number);
    EXPECT_EQ(run.err, "whittle: interrupted, nothing written\n");
    EXPECT_TRUE(folder.names().empty());
  }
}

}  // namespace
}  // namespace whittle::test
