// Which channels of a file are the picture, where it lies in its window, and how its samples encode light.
// The files are written through OpenImageIO, as other programs write them.
#include <gtest/gtest.h>
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <fstream>
#include <random>

#include "image/image_io.h"
#include "image/temporary_folder.h"
#include "scene/input_error.h"
#include "support/mutation.h"

namespace whittle {
namespace {

using Names = std::vector<std::string>;

/// A part of 2×1 pixels whose channel c holds c + 1 in the first pixel and −(c + 1) in the second.
OIIO::ImageSpec partOf(const Names& channels, const std::string& name = "") {
  OIIO::ImageSpec spec(2, 1, static_cast<int>(channels.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = channels;
  if (!name.empty()) spec.attribute("oiio:subimagename", name);
  return spec;
}

std::vector<float> valuesOf(const OIIO::ImageSpec& spec) {
  std::vector<float> values;
  for (const float sign : {1.0F, -1.0F})
    for (int c = 0; c < spec.nchannels; ++c) values.push_back(sign * static_cast<float>(c + 1));
  return values;
}

/// Writes one part or several and reads the picture; what it says where it is refused.
struct Written {
  const TemporaryFolder folder;
  FloatImage image;
  std::string error;

  explicit Written(std::vector<OIIO::ImageSpec> parts) {
    const std::string file = (folder / "a.exr").string();
    auto out = OIIO::ImageOutput::create(file);
    if (!out->open(file, static_cast<int>(parts.size()), parts.data()))
      throw std::runtime_error(out->geterror());
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (p > 0 && !out->open(file, parts[p], OIIO::ImageOutput::AppendSubimage))
        throw std::runtime_error(out->geterror());
      if (!out->write_image(OIIO::TypeDesc::FLOAT, valuesOf(parts[p]).data()))
        throw std::runtime_error(out->geterror());
    }
    out->close();
    try {
      image = readFloatImage(file);
    } catch (const InputError& e) {
      error = e.what();
    }
  }

  /// The channels of the first pixel, numbered from 1 as they were written.
  std::vector<float> chosen() const {
    if (!error.empty()) return {};
    return {image.pixels.begin(), image.pixels.begin() + image.channels};
  }
};

struct Choice {
  Names channels;
  std::vector<float> right;
};

TEST(Channels, AreChosenByName) {
  const std::vector<Choice> choices{
      {{"R", "G", "B"}, {1, 2, 3}},
      {{"A", "B", "G", "R"}, {4, 3, 2}},
      {{"Z", "A", "R", "G", "B"}, {3, 4, 5}},
      {{"AO.R", "AO.G", "AO.B", "R", "G", "B"}, {4, 5, 6}},
      {{"zz.R", "zz.G", "zz.B", "B", "R", "G"}, {5, 6, 4}},
      {{"env.R", "env.G", "env.B"}, {1, 2, 3}},
      {{"View.env.B", "View.env.G", "View.env.R", "View.env.A", "Z"}, {3, 2, 1}},
      {{"env.red", "env.green", "env.blue", "depth.Z"}, {1, 2, 3}},
      {{"r", "g", "b"}, {1, 2, 3}},
      {{"Y"}, {1}},
      {{"Y", "A"}, {1}},
      {{"Z", "Y", "A"}, {2}},
      {{"sky.Y", "Z"}, {1}},
      {{"Z"}, {1}},
      {{"primitive.V"}, {1}},
      {{"normal.X", "normal.Y", "normal.Z"}, {1, 2, 3}},
      {{"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "Z"}, {1, 2, 3}},
      {{"R", "G", "B", "Z", "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z"},
       {1, 2, 3}},
  };
  for (const Choice& choice : choices) {
    const Written file({partOf(choice.channels)});
    EXPECT_EQ(file.chosen(), choice.right) << testing::PrintToString(choice.channels) << file.error;
    if (file.error.empty()) {
      EXPECT_EQ(file.image.pixels.back(), -choice.right.back());
    }
  }
}

TEST(Channels, AChoiceThatIsNoneIsRefusedWithTheNames) {
  struct Case {
    Names channels, says;
  };
  const std::vector<Case> cases{
      {{"day.R", "day.G", "day.B", "night.R", "night.G", "night.B"}, {"several layers", "day, night"}},
      {{"a.X", "a.Y", "a.Z", "b.X", "b.Y", "b.Z"}, {"several layers", "a, b"}},
      {{"R", "G"}, {"no layer has R, G and B", "R, G"}},
      {{"u.R", "u.G", "v.B"}, {"no layer has R, G and B", "u.R"}},
  };
  for (const Case& c : cases) {
    const Written file({partOf(c.channels)});
    EXPECT_NE(file.error.find("a.exr: "), std::string::npos) << file.error;
    EXPECT_EQ(file.error.find('\n'), std::string::npos) << file.error;
    for (const auto& word : c.says) EXPECT_NE(file.error.find(word), std::string::npos) << file.error;
  }
}

TEST(Channels, PartsAreLayersToo) {
  const Written second({partOf({"Z"}, "depth"), partOf({"B", "G", "R"}, "sky")});
  EXPECT_EQ(second.chosen(), (std::vector<float>{3, 2, 1})) << second.error;
  const Written unnamed({partOf({"R", "G", "B"}, "diffuse"), partOf({"A", "R", "G", "B"}, "rgba")});
  EXPECT_EQ(unnamed.chosen(), (std::vector<float>{2, 3, 4})) << unnamed.error;
  const Written two({partOf({"R", "G", "B"}, "day"), partOf({"R", "G", "B"}, "night")});
  EXPECT_NE(two.error.find("day, night"), std::string::npos) << two.error;
  const Written prefixed({partOf({"Z"}, "z"), partOf({"env.R", "env.G", "env.B"}, "env")});
  EXPECT_EQ(prefixed.chosen(), (std::vector<float>{1, 2, 3})) << prefixed.error;
}

/// A data window of 2×3 at (x, y) in a display window of 4×4 at (10, 20); texel i holds 1 + i.
FloatImage windowed(int x, int y) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(2, 3, 1, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"Y"};
  spec.x = x, spec.y = y;
  spec.full_x = 10, spec.full_y = 20, spec.full_width = 4, spec.full_height = 4;
  const std::vector<float> values{1, 2, 3, 4, 5, 6};
  const std::string file = (folder / "a.exr").string();
  auto out = OIIO::ImageOutput::create(file);
  EXPECT_TRUE(out->open(file, spec) && out->write_image(OIIO::TypeDesc::FLOAT, values.data()) &&
              out->close());
  return readFloatImage(file);
}

TEST(Window, DataLieInTheirPlaceAndTheRestIsBlack) {
  const FloatImage inside = windowed(11, 21);
  EXPECT_EQ(inside.width, 4);
  EXPECT_EQ(inside.height, 4);
  EXPECT_EQ(inside.pixels, (std::vector<float>{0, 0, 0, 0,  //
                                               0, 1, 2, 0,  //
                                               0, 3, 4, 0,  //
                                               0, 5, 6, 0}));
}

TEST(Window, OverscanIsCutOff) {
  EXPECT_EQ(windowed(9, 19).pixels, (std::vector<float>{4, 0, 0, 0,  //
                                                        6, 0, 0, 0,  //
                                                        0, 0, 0, 0,  //
                                                        0, 0, 0, 0}));
  EXPECT_EQ(windowed(13, 22).pixels, (std::vector<float>{0, 0, 0, 0,  //
                                                         0, 0, 0, 0,  //
                                                         0, 0, 0, 1,  //
                                                         0, 0, 0, 3}));
  for (const auto& [x, y] : {std::pair{-100, 21}, {14, 21}, {11, 24}, {11, 17}})
    EXPECT_EQ(windowed(x, y).pixels, std::vector<float>(16, 0.0F)) << x << ", " << y;
}

TEST(Window, WidePicturesOfThreeChannelsToo) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(3, 1, 3, OIIO::TypeDesc::HALF);
  spec.x = -1, spec.full_x = 0, spec.full_width = 2, spec.full_height = 1;
  const std::vector<float> values{1, 2, 3, 4, 5, 6, 7, 8, 9};
  const std::string file = (folder / "a.exr").string();
  auto out = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(out->open(file, spec) && out->write_image(OIIO::TypeDesc::FLOAT, values.data()) &&
              out->close());
  EXPECT_EQ(readFloatImage(file).pixels, (std::vector<float>{4, 5, 6, 7, 8, 9}));
}

using Chunks = std::vector<char>;

/// A grey PNG with the codes 0, 128 and 255 and these chunks behind its header.
FloatImage pngWith(const TemporaryFolder& folder, const Chunks& chunks) {
  const std::string file = (folder / "a.png").string();
  const std::vector<std::uint8_t> codes{0, 128, 255};
  auto out = OIIO::ImageOutput::create(file);
  EXPECT_TRUE(out->open(file, OIIO::ImageSpec(3, 1, 1, OIIO::TypeDesc::UINT8)) &&
              out->write_image(OIIO::TypeDesc::UINT8, codes.data()) && out->close());
  std::ifstream in(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  in.close();
  EXPECT_EQ(bytes.find("gAMA"), std::string::npos) << "the writer adds none by itself";
  bytes.insert(8 + 25, chunks.data(), chunks.size());  // signature and IHDR
  std::ofstream(file, std::ios::binary) << bytes;
  return readFloatImage(file);
}

// Checksums by zlib's crc32.
const Chunks kLinear{0, 0, 0, 4, 'g', 'A', 'M', 'A', 0, 1, '\x86', '\xa0', '\x31', '\xe8', '\x96', '\x5f'};
const Chunks kSquare{0, 0, 0, 4, 'g', 'A', 'M', 'A', 0, 0, '\xc3', 'P', 0, '\x99', '\xb5', 52};
const Chunks kUsual{0, 0, 0, 4, 'g', 'A', 'M', 'A', 0, 0, '\xb1', '\x8f', 11, '\xfc', 'a', 5};
const Chunks kSrgb{0, 0, 0, 1, 's', 'R', 'G', 'B', 0, '\xae', '\xce', 28, '\xe9'};

TEST(Png, SamplesAreLightAsItsChunksSay) {
  const TemporaryFolder folder;
  const double code = 128 / 255.0, srgb = std::pow((code + 0.055) / 1.055, 2.4);
  Chunks linearButSrgb = kLinear, damaged = kLinear;
  linearButSrgb.insert(linearButSrgb.end(), kSrgb.begin(), kSrgb.end());
  damaged.back() ^= 1;
  const std::vector<std::pair<Chunks, double>> cases{{{}, srgb},     {kLinear, code}, {kSquare, code * code},
                                                     {kUsual, srgb}, {kSrgb, srgb},   {linearButSrgb, srgb},
                                                     {damaged, srgb}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const FloatImage image = pngWith(folder, cases[i].first);
    ASSERT_EQ(image.channels, 1);
    EXPECT_EQ(image.pixels[0], 0.0F) << i;
    EXPECT_NEAR(image.pixels[1], cases[i].second, 1e-7) << i;
    EXPECT_EQ(image.pixels[2], 1.0F) << i;
  }
}

TEST(Png, OursSayThatTheyAreSrgb) {
  const TemporaryFolder folder;
  writeCodes(folder / "a.png", {1, 1, 3, std::vector<std::uint8_t>{128, 128, 128}}, {});
  std::ifstream in(folder / "a.png", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  EXPECT_NE(bytes.find("sRGB"), std::string::npos);
}

/// Pictures with something wrong in them are read, or refused in one line.
TEST(Damaged, PicturesAreReadOrRefusedInOneLine) {
  const TemporaryFolder folder;
  std::mt19937 random(3);
  FloatImage image{24, 16, 3, {}};
  for (int i = 0; i < 24 * 16 * 3; ++i) image.pixels.push_back(static_cast<float>(random() % 1000));
  writeExr(folder / "a.exr", image, {{"key", "value"}});
  writeCodes(folder / "a.png", {24, 16, 3, std::vector<std::uint8_t>(24 * 16 * 3, 77)}, {});
  const Written parts({partOf({"R", "G", "B"}, "one"), partOf({"Z", "left.R", "left.G", "left.B"}, "two")});
  std::string radiance = "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 9\n";
  for (int row = 0; row < 4; ++row) {
    radiance += std::string{2, 2, 0, 9};
    for (int component = 0; component < 4; ++component)
      radiance += std::string{static_cast<char>(128 + 5), 100, 4, 1, 2, 3, 4};
  }
  const std::vector<std::string> files{test::fileText(folder / "a.exr"), test::fileText(folder / "a.png"),
                                       test::fileText(parts.folder / "a.exr"), radiance};
  int read = 0, refused = 0;
  for (int i = 0; i < test::mutations(); ++i) {
    std::ofstream(folder / "b.exr", std::ios::binary)
        << test::mutated(files[random() % files.size()], random);
    try {
      const FloatImage got = readFloatImage(folder / "b.exr");
      EXPECT_EQ(got.pixels.size(), static_cast<std::size_t>(got.width) * got.height * got.channels);
      ++read;
    } catch (const InputError& e) {
      const std::string text = e.what();
      EXPECT_EQ(text.rfind((folder / "b.exr").string() + ": ", 0), 0U) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      ++refused;
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace whittle
