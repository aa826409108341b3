// --crop and --pixel: files of a region's size, with its place where the format has one.
#include <gtest/gtest.h>
#include <OpenImageIO/imageio.h>

#include "run_whittle.h"

namespace whittle::test {
namespace {

struct Picture {
  OIIO::ImageSpec spec;
  std::vector<float> values;
  float at(int x, int y, int c) const {
    return values[(static_cast<std::size_t>(y) * spec.width + x) * spec.nchannels + c];
  }
};

/// Its data window.
Picture read(const std::filesystem::path& file) {
  auto in = OIIO::ImageInput::open(file.string());
  if (!in) {
    ADD_FAILURE() << file << " is not there";
    return {};
  }
  Picture picture{in->spec(), {}};
  picture.values.resize(picture.spec.image_pixels() * picture.spec.nchannels);
  in->read_image(0, 0, 0, picture.spec.nchannels, OIIO::TypeDesc::FLOAT, picture.values.data());
  return picture;
}

void renderTo(const Folder& folder, std::vector<std::string> more) {
  more.emplace_back("--quiet");
  const Outcome run = runWhittle(smallRender(std::move(more)), {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
}

TEST(Crop, FilesHaveItsSizeAndItsPlace) {
  const Folder folder;
  renderTo(folder, {"-o", "whole.exr", "-o", "whole.png", "--exposure", "0", "--aov", "all=layers.exr"});
  renderTo(folder, {"-o", "part.exr", "-o", "part.png", "--exposure", "0", "--aov", "all=part_layers.exr",
                    "--aov", "depth=depth.exr", "--crop", "5,7,11,9"});
  for (const auto& [partName, wholeName] :
       {std::pair("part.exr", "whole.exr"), std::pair("part.png", "whole.png"),
        std::pair("part_layers.exr", "layers.exr")}) {
    const Picture part = read(folder / partName), whole = read(folder / wholeName);
    ASSERT_EQ(part.spec.width, 11) << partName;
    ASSERT_EQ(part.spec.height, 9) << partName;
    ASSERT_EQ(part.spec.channelnames, whole.spec.channelnames);
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 11; ++x)
        for (int c = 0; c < part.spec.nchannels; ++c) {
          // What a packet of rays costs depends on which rays it has.
          if (part.spec.channelnames[static_cast<std::size_t>(c)].starts_with("cost.")) continue;
          ASSERT_EQ(part.at(x, y, c), whole.at(5 + x, 7 + y, c)) << partName << ' ' << x << ',' << y;
        }
  }
  for (const char* name : {"part.exr", "part_layers.exr", "depth.exr"}) {
    const OIIO::ImageSpec spec = read(folder / name).spec;
    EXPECT_EQ(spec.x, 5) << name;
    EXPECT_EQ(spec.y, 7) << name;
    EXPECT_EQ(spec.full_x, 0) << name;
    EXPECT_EQ(spec.full_y, 0) << name;
    EXPECT_EQ(spec.full_width, 32) << name;
    EXPECT_EQ(spec.full_height, 24) << name;
  }
}

TEST(Crop, SharesArePixelsRounded) {
  const Folder folder;
  for (const char* region : {"8,6,16,12", "0.25,0.25,0.5,0.5", "25%,25%,50%,50%", "0.26,24%,49.9%,0.51"}) {
    renderTo(folder, {"--stats", "stats.json", "--crop", region});
    EXPECT_EQ(readJson(folder / "stats.json")["settings"]["crop"], "8,6,16,12") << region;
  }
  renderTo(folder, {"--stats", "stats.json"});
  EXPECT_TRUE(readJson(folder / "stats.json")["settings"]["crop"].is_null());
}

TEST(Crop, APixelIsARegion) {
  const Folder folder;
  renderTo(folder, {"-o", "whole.exr"});
  renderTo(folder, {"-o", "pixel.exr", "--stats", "stats.json", "--pixel", "31,23"});
  const Picture whole = read(folder / "whole.exr"), pixel = read(folder / "pixel.exr");
  ASSERT_EQ(pixel.values.size(), 3U);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(pixel.at(0, 0, c), whole.at(31, 23, c));
  EXPECT_EQ(readJson(folder / "stats.json")["rays"]["primary"], 1);
}

TEST(Crop, OfTheReferenceTheSamePartCounts) {
  const Folder folder;
  renderTo(folder, {"-o", "whole.exr"});
  renderTo(folder, {"--stats", "stats.json", "--crop", "3,3,9,5", "--reference", "whole.exr"});
  const auto stats = readJson(folder / "stats.json");
  ASSERT_FALSE(stats["error"].empty());
  EXPECT_EQ(stats["error"].back()["rmse"], 0.0);
}

TEST(Crop, TheSizeMayComeFromTheCamera) {
  const Folder folder;
  const Outcome run = runWhittle(
      {"render", scene(), "--width", "32", "--crop", "50%,50%,50%,50%", "-o", "a.png"}, {folder.path(), {}});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("16×9 at 16,9 of 32×18"), std::string::npos) << run.out;
}

TEST(Crop, OfAHugePictureFitsIntoLittleMemory) {
  const Folder folder;
  const std::vector<std::string> huge{"render",  scene(), "--width", "30000",          "--height", "20000",
                                      "--quiet", "-o",    "a.exr",   "--memory-limit", "1G"};
  const Outcome whole = runWhittle(huge, {folder.path(), {}});
  EXPECT_EQ(whole.status, 2) << whole.err;
  std::vector<std::string> part = huge;
  part.insert(part.end(), {"--crop", "15000,9000,100,100"});
  EXPECT_EQ(runWhittle(part, {folder.path(), {}}).status, 0);
  EXPECT_EQ(read(folder / "a.exr").spec.full_width, 30000);
}

}  // namespace
}  // namespace whittle::test
