// PNG and JPEG without the codec: every kind of picture that is decoded here has the texels that OpenImageIO
// gives, what is unusual or damaged is left to it, and what is written it reads back.
#include "image/plain_images.h"

#include <gtest/gtest.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <tbb/global_control.h>
#include <zlib.h>

#include <fstream>
#include <random>

#include "image/png_writer.h"
#include "image/temporary_folder.h"
#include "scene/input_error.h"

namespace whittle {
namespace {

using Codes = std::vector<std::uint8_t>;
using FileBytes = std::vector<std::byte>;

Codes noise(std::size_t count, unsigned seed) {
  std::minstd_rand dice(seed);
  Codes codes(count);
  // Slow waves under the noise, so that every filter and every length of a match occurs.
  for (std::size_t i = 0; i < count; ++i)
    codes[i] = static_cast<std::uint8_t>(i / 7 + (dice() % 8 == 0 ? dice() % 256 : 0));
  return codes;
}

/// What OpenImageIO writes, in memory.
FileBytes encoded(
    const char* format, int width, int height, int channels, const Codes& codes,
    const std::function<void(OIIO::ImageSpec&)>& set = [](OIIO::ImageSpec&) {}) {
  OIIO::Filesystem::IOVecOutput memory;
  auto out = OIIO::ImageOutput::create(format);
  OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  set(spec);
  EXPECT_TRUE(out && out->set_ioproxy(&memory) && out->open("picture", spec) &&
              out->write_image(OIIO::TypeDesc::UINT8, codes.data()) && out->close());
  const auto bytes = std::as_bytes(std::span(memory.buffer()));
  return {bytes.begin(), bytes.end()};
}

/// What it reads, as RGBA.
Codes readByLibrary(const FileBytes& bytes, const char* format) {
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  auto in = OIIO::ImageInput::create(format);
  OIIO::ImageSpec spec, hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  if (!in || !in->set_ioproxy(&memory) || !in->open("picture", spec, hints)) return {};
  Codes own(static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels), rgba;
  EXPECT_TRUE(in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, own.data()));
  const int n = spec.nchannels;
  for (std::size_t i = 0; i < own.size(); i += n)
    for (int c = 0; c < 4; ++c)
      rgba.push_back(c == 3 ? (n % 2 == 0 ? own[i + n - 1] : 255) : own[n < 3 ? i : i + c]);
  return rgba;
}

TEST(PlainImages, PngHasTheTexelsThatTheLibraryGives) {
  for (const int channels : {1, 2, 3, 4}) {
    const FileBytes bytes = encoded("png", 37, 29, channels, noise(37 * 29 * channels, 5));
    const auto image = decodePlainImage(bytes, "picture");
    ASSERT_TRUE(image) << channels;
    EXPECT_EQ(image->width, 37);
    EXPECT_EQ(image->height, 29);
    EXPECT_EQ(image->texels, readByLibrary(bytes, "png")) << channels;
  }
}

TEST(PlainImages, JpegHasTheTexelsThatTheLibraryGives) {
  for (const int channels : {1, 3})
    for (const char* subsampling : {"4:4:4", "4:2:0", "4:2:2"}) {
      const FileBytes bytes =
          encoded("jpeg", 61, 43, channels, noise(61 * 43 * channels, 6), [&](OIIO::ImageSpec& spec) {
            spec.attribute("jpeg:subsampling", subsampling);
            spec.attribute("jpeg:progressive", std::string_view(subsampling) == "4:2:2" ? 1 : 0);
          });
      const auto image = decodePlainImage(bytes, "picture");
      ASSERT_TRUE(image) << channels << subsampling;
      EXPECT_EQ(image->texels, readByLibrary(bytes, "jpeg")) << channels << subsampling;
    }
}

void put(FileBytes& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::byte>(value >> shift));
}

void putChunk(FileBytes& out, const std::string& type, const Codes& data) {
  put(out, static_cast<std::uint32_t>(data.size()));
  Codes checked(type.begin(), type.end());
  checked.insert(checked.end(), data.begin(), data.end());
  for (const std::uint8_t byte : checked) out.push_back(static_cast<std::byte>(byte));
  put(out, static_cast<std::uint32_t>(crc32(0, checked.data(), static_cast<uInt>(checked.size()))));
}

/// A PNG by hand: `rows` with the filters' numbers in front, compressed; `chunks` between header and data.
FileBytes pngOf(std::uint8_t width, std::uint8_t height, std::uint8_t bits, std::uint8_t colours,
                const Codes& rows, const std::vector<std::pair<std::string, Codes>>& chunks = {},
                std::uint8_t interlace = 0) {
  FileBytes out;
  for (const int byte : {0x89, 'P' + 0, 'N' + 0, 'G' + 0, 13, 10, 26, 10})
    out.push_back(static_cast<std::byte>(byte));
  putChunk(out, "IHDR", {0, 0, 0, width, 0, 0, 0, height, bits, colours, 0, 0, interlace});
  for (const auto& [type, data] : chunks) putChunk(out, type, data);
  Codes packed(compressBound(rows.size()));
  uLongf size = packed.size();
  EXPECT_EQ(compress(packed.data(), &size, rows.data(), rows.size()), Z_OK);
  packed.resize(size);
  putChunk(out, "IDAT", packed);
  putChunk(out, "IEND", {});
  return out;
}

TEST(PlainImages, UndoesEveryFilter) {
  // Grey, three wide; each row by hand from section 9 of the specification.
  const Codes rows{0, 10, 20,  30,  // none
                   1, 5,  250, 7,   // left: + 0, 5, 255
                   2, 1,  2,   3,   // up: + 5, 255, 6
                   3, 10, 1,   2,   // half of left and up: + 3, 7, 8
                   4, 1,  1,   1};  // Paeth, here up: + 13, 8, 10
  const auto image = decodePlainImage(pngOf(3, 5, 8, 0, rows), "picture");
  ASSERT_TRUE(image);
  const Codes grey{10, 20, 30, 5, 255, 6, 6, 1, 9, 13, 8, 10, 14, 9, 11};
  for (std::size_t i = 0; i < grey.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(image->texels[4 * i + c], grey[i]) << i;
    EXPECT_EQ(image->texels[4 * i + 3], 255) << i;
  }
}

TEST(PlainImages, LooksColoursUpInAPalette) {
  const Codes palette{1, 2, 3, 40, 50, 60, 70, 80, 90}, alpha{128, 0};
  const FileBytes bytes = pngOf(3, 2, 8, 3, {0, 2, 1, 0, 0, 0, 1, 2}, {{"PLTE", palette}, {"tRNS", alpha}});
  const auto image = decodePlainImage(bytes, "picture");
  ASSERT_TRUE(image);
  const Codes rgba{70, 80, 90, 255, 40, 50, 60, 0, 1,  2,  3,  128,
                   1,  2,  3,  128, 40, 50, 60, 0, 70, 80, 90, 255};
  EXPECT_EQ(image->texels, rgba);
  EXPECT_EQ(readByLibrary(bytes, "png"), rgba);
  // An index that has no colour.
  EXPECT_FALSE(decodePlainImage(pngOf(1, 1, 8, 3, {0, 3}, {{"PLTE", palette}}), "picture"));
}

TEST(PlainImages, LeavesTheUnusualToTheCodec) {
  const Codes row{0, 1, 2, 3, 4, 5, 6};
  EXPECT_TRUE(decodePlainImage(pngOf(2, 1, 8, 2, row), "picture"));
  EXPECT_FALSE(decodePlainImage(pngOf(2, 1, 8, 2, row, {{"tRNS", {0, 1, 0, 2, 0, 3}}}), "picture"));
  EXPECT_FALSE(decodePlainImage(pngOf(2, 1, 8, 2, row, {}, 1), "picture")) << "interlaced";
  EXPECT_FALSE(decodePlainImage(pngOf(1, 1, 16, 2, row), "picture")) << "16 bits";
  EXPECT_FALSE(decodePlainImage(pngOf(8, 1, 1, 0, {0, 1}), "picture")) << "1 bit";
  EXPECT_FALSE(decodePlainImage(pngOf(2, 1, 8, 3, row), "picture")) << "no palette";
  EXPECT_FALSE(decodePlainImage(pngOf(2, 2, 8, 2, row), "picture")) << "a row is missing";
  EXPECT_FALSE(decodePlainImage(pngOf(1, 1, 8, 2, row), "picture")) << "too much";
  EXPECT_FALSE(decodePlainImage(pngOf(2, 1, 8, 2, {5, 1, 2, 3, 4, 5, 6}), "picture")) << "no such filter";
  EXPECT_FALSE(decodePlainImage(pngOf(0, 1, 8, 2, {0}), "picture")) << "no width";
  EXPECT_FALSE(decodePlainImage(encoded("bmp", 4, 4, 3, noise(48, 1)), "picture"));
}

TEST(PlainImages, LeavesADamagedJpegToTheCodec) {
  FileBytes bytes = encoded("jpeg", 64, 64, 3, noise(64 * 64 * 3, 3));
  ASSERT_TRUE(decodePlainImage(bytes, "picture"));
  FileBytes half(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2));
  EXPECT_FALSE(decodePlainImage(half, "picture"));
  half.resize(20);
  EXPECT_FALSE(decodePlainImage(half, "picture"));
}

/// Far more than one band, of rows that do not divide it.
CodeImage largePicture(int channels) {
  return {701, 523, channels, noise(static_cast<std::size_t>(701) * 523 * channels, 9)};
}

TEST(PngWriter, WritesWhatTheLibraryAndWeRead) {
  for (const int channels : {3, 4}) {
    for (const CodeImage& image : {CodeImage{1, 1, channels, noise(channels, 2)}, largePicture(channels)}) {
      const FileBytes bytes = encodePng(image, {{"key", "a value"}});
      const Codes rgba = readByLibrary(bytes, "png");
      ASSERT_EQ(rgba.size(), image.codes.size() / channels * 4);
      for (std::size_t i = 0; i < rgba.size(); ++i) {
        const std::size_t c = i % 4;
        const int expected = c == 3 && channels == 3 ? 255 : image.codes[i / 4 * channels + c];
        ASSERT_EQ(rgba[i], expected) << i;
      }
      const auto own = decodePlainImage(bytes, "picture");
      ASSERT_TRUE(own);
      EXPECT_EQ(own->texels, rgba);
    }
  }
}

TEST(PngWriter, WritesTheSameBytesOnAnyNumberOfThreads) {
  const CodeImage image = largePicture(3);
  const FileBytes several = encodePng(image, {});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(encodePng(image, {}), several);
}

TEST(PngWriter, FiltersMakeASlopeSmall) {
  // Rows alike, each pixel one more than its left neighbour: filtered to zeros, 300 kB of which deflate to a
  // few.
  CodeImage image{400, 256, 3, {}};
  for (int i = 0; i < 400 * 256 * 3; ++i) image.codes.push_back(static_cast<std::uint8_t>(i / 3 % 400));
  EXPECT_LT(encodePng(image, {}).size(), 3000U);
}

}  // namespace
}  // namespace whittle
