// Radiance pictures written by hand, byte by byte: every order of scanlines, every encoding, every exposure.
#include "image/radiance_file.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "image/temporary_folder.h"
#include "scene/input_error.h"

namespace whittle {
namespace {

std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span(text)); }

std::string header(const std::string& resolution, const std::string& more = "") {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n" + more + "\n" + resolution + "\n";
}

/// A flat pixel of red v·2⁻⁷ (exponent 129 is 2¹; mantissas are in 256ths), v < 256.
std::string redPixel(int v) { return {static_cast<char>(v), 0, 0, static_cast<char>(129)}; }

std::string readingErrorOf(const std::string& file) {
  try {
    decodeRadiance(bytesOf(file), "sky.hdr");
  } catch (const InputError& e) {
    return e.what();
  }
  return "no InputError";
}

/// The picture that is meant, 3 wide and 2 high, column x and row y (from the top) hold 16·(y·3 + x) + 8.
int meant(int x, int y) { return 16 * (y * 3 + x) + 8; }

struct Order {
  const char* resolution;
  /// The first stored pixel, the second of the first scanline, the first of the second scanline: (x, y).
  std::array<int, 6> begins;
};

/// filefmts.pdf: "-Y N +X M" is from the top down and from left to right; X first: scanlines are columns.
constexpr std::array<Order, 8> kOrders{{{"-Y 2 +X 3", {0, 0, 1, 0, 0, 1}},
                                        {"-Y 2 -X 3", {2, 0, 1, 0, 2, 1}},
                                        {"+Y 2 -X 3", {2, 1, 1, 1, 2, 0}},
                                        {"+Y 2 +X 3", {0, 1, 1, 1, 0, 0}},
                                        {"+X 3 -Y 2", {0, 0, 0, 1, 1, 0}},
                                        {"+X 3 +Y 2", {0, 1, 0, 0, 1, 1}},
                                        {"-X 3 +Y 2", {2, 1, 2, 0, 1, 1}},
                                        {"-X 3 -Y 2", {2, 0, 2, 1, 1, 0}}}};

TEST(Radiance, EveryOrderOfScanlinesIsTheSamePicture) {
  for (const Order& order : kOrders) {
    const auto& b = order.begins;
    const int fastX = b[2] - b[0], fastY = b[3] - b[1], slowX = b[4] - b[0], slowY = b[5] - b[1];
    const bool rows = slowY != 0;
    std::string file = header(order.resolution);
    for (int i = 0; i < (rows ? 2 : 3); ++i)
      for (int j = 0; j < (rows ? 3 : 2); ++j)
        file += redPixel(meant(b[0] + i * slowX + j * fastX, b[1] + i * slowY + j * fastY));
    const FloatImage image = decodeRadiance(bytesOf(file), "a.hdr");
    ASSERT_EQ(image.width, 3) << order.resolution;
    ASSERT_EQ(image.height, 2) << order.resolution;
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x)
        EXPECT_EQ(image.pixels[(y * 3 + x) * 3], static_cast<float>(meant(x, y)) / 128.0F)
            << order.resolution << ", " << x << ", " << y;
  }
}

TEST(Radiance, ExposuresAndCorrectionsAreDividedOut) {
  const std::string pixel{static_cast<char>(128), 64, 32, static_cast<char>(129)};  // (1, 0.5, 0.25)
  const FloatImage plain = decodeRadiance(bytesOf(header("-Y 1 +X 1") + pixel), "a.hdr");
  EXPECT_EQ(plain.pixels, (std::vector<float>{1, 0.5F, 0.25F}));
  const std::string lines =
      "EXPOSURE=2.0\nVIEW=-vtv\nEXPOSURE= 4e0\n\tEXPOSURE=9\nCOLORCORR= 1 2 0.5\nCOLORCORR=1 1 4\n";
  const FloatImage exposed = decodeRadiance(bytesOf(header("-Y 1 +X 1", lines) + pixel), "a.hdr");
  EXPECT_EQ(exposed.pixels, (std::vector<float>{1.0F / 8, 0.5F / 16, 0.25F / 16}))
      << "by 8, 16 and 16; an indented line is history";
}

TEST(Radiance, ReadsBothRunLengthEncodings) {
  // New: 2 2, the width in two bytes, then each component; above 128 a run, else so many bytes.
  std::string fresh = header("-Y 1 +X 8") + std::string{2, 2, 0, 8};
  fresh += std::string{3, 10, 20, 30, static_cast<char>(128 + 5), 40};       // red
  fresh += std::string{static_cast<char>(128 + 8), 0};                       // green
  fresh += std::string{static_cast<char>(128 + 8), 7};                       // blue
  fresh += std::string{static_cast<char>(128 + 8), static_cast<char>(136)};  // 2⁰
  const FloatImage a = decodeRadiance(bytesOf(fresh), "a.hdr");
  const std::array<float, 8> red{10, 20, 30, 40, 40, 40, 40, 40};
  for (std::size_t x = 0; x < 8; ++x) {
    EXPECT_EQ(a.pixels[x * 3], red[x]);
    EXPECT_EQ(a.pixels[x * 3 + 1], 0.0F);
    EXPECT_EQ(a.pixels[x * 3 + 2], 7.0F);
  }
  // Old: mantissas of 1 repeat the pixel before; a second count in a row is 256 times as much.
  std::string old = header("-Y 1 +X 300") + redPixel(64) + std::string{1, 1, 1, 43} + std::string{1, 1, 1, 1};
  const FloatImage b = decodeRadiance(bytesOf(old), "b.hdr");
  for (std::size_t x = 0; x < 300; ++x) EXPECT_EQ(b.pixels[x * 3], 0.5F) << x;
}

TEST(Radiance, AnExponentOfNoughtIsBlack) {
  const FloatImage image = decodeRadiance(bytesOf(header("-Y 1 +X 1") + std::string{9, 9, 9, 0}), "a.hdr");
  EXPECT_EQ(image.pixels, (std::vector<float>{0, 0, 0}));
}

TEST(Radiance, RefusesWhatIsBrokenInOneLineWithTheName) {
  const std::string good = header("-Y 2 +X 8");
  struct Case {
    std::string file;
    const char* says;
  };
  const std::vector<Case> cases{
      {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + redPixel(1), "32-bit_rle_xyze"},
      {header("-Y 1 +X 1", "EXPOSURE=0\n") + redPixel(1), "EXPOSURE=0"},
      {header("-Y 1 +X 1", "EXPOSURE=two\n") + redPixel(1), "EXPOSURE=two"},
      {header("-Y 1 +X 1", "COLORCORR=1 2\n") + redPixel(1), "COLORCORR=1 2"},
      {header("-Y 1 +Y 1") + redPixel(1), "-Y 1 +Y 1"},
      {header("-Y 0 +X 1") + redPixel(1), "-Y 0 +X 1"},
      {header("-Y 65537 +X 1") + redPixel(1), "too many"},
      {header("-Y 65536 +X 65536") + redPixel(1), "too many"},
      {header("-Y 60000 +X 16000") + redPixel(1), "cut off"},
      {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", "cut off"},
      {good + std::string{2, 2, 0, 9} + std::string(8, 0), "another length"},
      {good + std::string{2, 2, 0, 8, static_cast<char>(128 + 9), 0, 0, 0}, "leaves its scanline"},
      {good + std::string{2, 2, 0, 8, 0, 0, 0, 0}, "leaves its scanline"},
      {good + std::string{1, 1, 1, 8, 0, 0, 0, 0}, "leaves its scanline"},
      {good + std::string{5, 5, 5, 5, 5, 5, 5, 5, 5}, "cut off"},
  };
  for (const Case& c : cases) {
    const std::string error = readingErrorOf(c.file);
    EXPECT_EQ(error.rfind("sky.hdr: ", 0), 0U) << error;
    EXPECT_NE(error.find(c.says), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

/// No byte of a small picture, changed or cut away, does more than give another picture or a refusal.
TEST(Radiance, SurvivesAnyOneByte) {
  std::string file = header("-Y 2 +X 9", "EXPOSURE=2\n");
  for (int row = 0; row < 2; ++row) {
    file += std::string{2, 2, 0, 9};
    for (int component = 0; component < 4; ++component)
      file += std::string{static_cast<char>(128 + 5), 100, 4, 1, 2, 3, 4};
  }
  ASSERT_EQ(readingErrorOf(file), "no InputError");
  for (std::size_t at = 0; at < file.size(); ++at) {
    EXPECT_NE(readingErrorOf(file.substr(0, at)), "no InputError") << "cut at " << at;
    for (const int other : {0, 1, 2, 10, 127, 128, 129, 255}) {
      std::string changed = file;
      changed[at] = static_cast<char>(other);
      readingErrorOf(changed);
    }
  }
}

TEST(Radiance, IsWhatReadFloatImageFindsWhateverTheName) {
  const TemporaryFolder folder;
  for (const char* name : {"a.hdr", "a.pic", "a.exr"}) {
    std::ofstream(folder / name, std::ios::binary) << header("+Y 2 +X 1") << redPixel(64) << redPixel(128);
    EXPECT_EQ(readFloatImage(folder / name).pixels, (std::vector<float>{1, 0, 0, 0.5F, 0, 0})) << name;
  }
}

}  // namespace
}  // namespace whittle
