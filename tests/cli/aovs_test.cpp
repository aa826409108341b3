// Auxiliary outputs as other programs look for them: channel names, floats, layers of one file.
#include <gtest/gtest.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>

#include "cli/aovs.h"
#include "image/image_io.h"
#include "run_whittle.h"

namespace whittle::test {
namespace {

using Names = std::vector<std::string>;

Names sorted(Names names) {
  std::sort(names.begin(), names.end());
  return names;
}

/// Channels of a file in alphabetical order; all of them 32-bit floats.
Names channelsOf(const std::filesystem::path& file) {
  const auto input = OIIO::ImageInput::open(file.string());
  EXPECT_TRUE(input) << file;
  if (!input) return {};
  EXPECT_EQ(input->spec().format, OIIO::TypeDesc::FLOAT);
  EXPECT_TRUE(input->spec().channelformats.empty()) << "all of one type";
  return sorted(input->spec().channelnames);
}

/// One channel of a layered file.
std::vector<float> channelOf(const std::filesystem::path& file, const std::string& name) {
  const auto input = OIIO::ImageInput::open(file.string());
  const OIIO::ImageSpec spec = input->spec();
  const auto at = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
  EXPECT_NE(at, spec.channelnames.end()) << name;
  std::vector<float> values(static_cast<std::size_t>(spec.width) * spec.height);
  const int c = static_cast<int>(at - spec.channelnames.begin());
  EXPECT_TRUE(input->read_image(0, 0, c, c + 1, OIIO::TypeDesc::FLOAT, values.data()));
  return values;
}

const Names kAll{"R",        "G",        "B",           "Z",
                 "albedo.R", "albedo.G", "albedo.B",    "normal.X",
                 "normal.Y", "normal.Z", "primitive.V", "samples.V",
                 "error.V",  "bounce.V", "cost.nodes",  "cost.triangles"};

struct EveryAov {
  const Folder folder;
  const Outcome run = runWhittle(smallRender({"-o",
                                              "a.exr",
                                              "--aov",
                                              "depth=depth.exr",
                                              "--aov",
                                              "normal=normal.exr",
                                              "--aov",
                                              "albedo=albedo.exr",
                                              "--aov",
                                              "primitive=primitive.exr",
                                              "--aov",
                                              "samples=samples.exr",
                                              "--aov",
                                              "error=error.exr",
                                              "--aov",
                                              "bounce=bounce.exr",
                                              "--aov",
                                              "cost=cost.exr",
                                              "--aov",
                                              "all=all.exr",
                                              "--rays-per-pixel",
                                              "2"}),
                                 {folder.path(), {}});
};
const EveryAov& everyAov() {
  static const EveryAov made;
  return made;
}

TEST(Aovs, HaveTheNamesThatCompositorsLookFor) {
  const auto& [folder, run] = everyAov();
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(channelsOf(folder / "depth.exr"), Names{"Z"});
  EXPECT_EQ(channelsOf(folder / "normal.exr"), (Names{"normal.X", "normal.Y", "normal.Z"}));
  EXPECT_EQ(channelsOf(folder / "albedo.exr"), (Names{"albedo.B", "albedo.G", "albedo.R"}));
  EXPECT_EQ(channelsOf(folder / "primitive.exr"), Names{"primitive.V"});
  EXPECT_EQ(channelsOf(folder / "samples.exr"), Names{"samples.V"});
  EXPECT_EQ(channelsOf(folder / "cost.exr"), (Names{"cost.nodes", "cost.triangles"}));
  EXPECT_EQ(channelsOf(folder / "a.exr"), (Names{"B", "G", "R"}));
  EXPECT_EQ(channelsOf(folder / "all.exr"), sorted(kAll));
}

TEST(Aovs, LayersHoldWhatTheFilesHold) {
  const auto& [folder, run] = everyAov();
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* file :
       {"depth", "normal", "albedo", "primitive", "samples", "error", "bounce", "cost", "a"}) {
    const Names names = file == std::string("a") ? Names{"R", "G", "B"} : cli::channelNamesOf(file);
    for (const auto& name : names) {
      const std::vector<float> layer = channelOf(folder / "all.exr", name),
                               alone = channelOf(folder / (std::string(file) + ".exr"), name);
      ASSERT_EQ(layer.size(), alone.size()) << name;
      for (std::size_t p = 0; p < layer.size(); ++p)
        ASSERT_EQ(std::memcmp(&layer[p], &alone[p], sizeof(float)), 0) << name << " of pixel " << p;
    }
  }
}

TEST(Aovs, ALayeredFileIsReadAsItsPicture) {
  const auto& [folder, run] = everyAov();
  ASSERT_EQ(run.status, 0) << run.err;
  const Outcome same = runWhittle({"compare", "all.exr", "a.exr", "--json"}, {folder.path(), {}});
  ASSERT_EQ(same.status, 0) << same.err;
  EXPECT_EQ(nlohmann::json::parse(same.out)["differingPixels"], 0);
  const Outcome aov = runWhittle({"compare", "normal.exr", "normal.exr", "--json"}, {folder.path(), {}});
  EXPECT_EQ(aov.status, 0) << aov.err;
}

TEST(Aovs, TheReferenceWritesThemToo) {
  const Folder folder;
  const Outcome run = runWhittle({"reference", scene(), "--width", "8", "--height", "6", "-o", "r.exr",
                                  "--aov", "all=all.exr", "--aov", "depth=d.exr"},
                                 {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(channelsOf(folder / "all.exr"), (Names{"B", "G", "R", "Z", "primitive.V"}));
  EXPECT_EQ(channelsOf(folder / "d.exr"), Names{"Z"});
}

TEST(Aovs, LayersAreInterleavedByName) {
  const FloatImage radiance{2, 1, 3, {1, 2, 3, 4, 5, 6}};
  Names names;
  const FloatImage all = cli::layered(
      radiance, {}, {{"depth", {2, 1, 1, {7, 8}}}, {"normal", {2, 1, 3, {9, 10, 11, 12, 13, 14}}}}, names);
  EXPECT_EQ(names, (Names{"R", "G", "B", "Z", "normal.X", "normal.Y", "normal.Z"}));
  EXPECT_EQ(all.channels, 7);
  EXPECT_EQ(all.pixels, (std::vector<float>{1, 2, 3, 7, 9, 10, 11, 4, 5, 6, 8, 12, 13, 14}));
  EXPECT_EQ(cli::layered(radiance, {2, 1, 1, {0.5F, 1}}, {}, names).pixels,
            (std::vector<float>{1, 2, 3, 0.5F, 4, 5, 6, 1}));
  EXPECT_EQ(names, (Names{"R", "G", "B", "A"}));
}

}  // namespace
}  // namespace whittle::test
