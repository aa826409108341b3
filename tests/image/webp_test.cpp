// WebP with alpha: colours are those that were stored.
#include <gtest/gtest.h>

#include "image/image_io.h"
#include "scene/input_error.h"
#ifdef WHITTLE_WEBP
#include <webp/encode.h>

#include <fstream>
#include <random>

#include "image/temporary_folder.h"
#include "support/mutation.h"
#endif

namespace whittle {
namespace {

#ifndef WHITTLE_WEBP

TEST(Webp, NotBuiltIsSaid) {
  const std::string start = "RIFF....WEBPVP8L";
  try {
    decodeImage(std::as_bytes(std::span(start)), "a.webp");
    ADD_FAILURE() << "it was decoded";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("built without libwebp-dev"), std::string::npos) << e.what();
  }
}

#else

constexpr std::size_t kRiff = 12;  ///< bytes that tell the format

/// 4 × 3 pixels, half of them translucent, some clear.
std::vector<std::uint8_t> pixels() {
  std::vector<std::uint8_t> rgba;
  for (unsigned i = 0; i < 12; ++i)
    for (const unsigned c : {i * 20, 255 - i * 9, 40 + i, i % 3 * 127})
      rgba.push_back(static_cast<std::uint8_t>(c));
  return rgba;
}

std::vector<std::byte> losslessWebp(const std::vector<std::uint8_t>& rgba, int width, int height) {
  WebPConfig config;
  WebPPicture picture;
  EXPECT_TRUE(WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, 100) && WebPPictureInit(&picture));
  config.lossless = config.exact = 1;  // colours below alpha 0 as well
  picture.use_argb = 1;
  picture.width = width;
  picture.height = height;
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  EXPECT_TRUE(WebPPictureImportRGBA(&picture, rgba.data(), 4 * width) && WebPEncode(&config, &picture));
  WebPPictureFree(&picture);
  const auto* begin = reinterpret_cast<const std::byte*>(writer.mem);
  std::vector<std::byte> bytes(begin, begin + writer.size);
  WebPMemoryWriterClear(&writer);
  return bytes;
}

TEST(Webp, ColoursAreNotMultipliedByAlpha) {
  const auto rgba = pixels();
  const auto bytes = losslessWebp(rgba, 4, 3);
  const Image image = decodeImage(bytes, "a.webp");
  EXPECT_EQ(image.width, 4);
  EXPECT_EQ(image.height, 3);
  EXPECT_EQ(image.texels, rgba);
  EXPECT_FALSE(image.isDeep());
  const TemporaryFolder folder;
  std::ofstream(folder / "a.webp", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  EXPECT_EQ(readImage(folder / "a.webp").texels, rgba) << "from a file";
}

TEST(Webp, DamagedOnesAreRefused) {
  const auto whole = losslessWebp(pixels(), 4, 3);
  const auto refused = [](std::vector<std::byte> bytes) {
    try {
      decodeImage(bytes, "a.webp");
    } catch (const InputError& e) {
      return std::string(e.what()).starts_with("a.webp: ");
    }
    return false;
  };
  for (std::size_t length = 12; length + 2 < whole.size(); ++length)
    EXPECT_TRUE(refused({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)})) << length;
}

/// EXT_texture_webp: textures should not contain animations.
TEST(Webp, AnimatedOnesAreRefusedByName) {
  const std::string file("RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\x02\0\0\0\x03\0\0\x02\0\0", 30);
  try {
    decodeImage(std::as_bytes(std::span(file)), "a.webp");
    ADD_FAILURE() << "it was decoded";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "a.webp: is an animated WebP, which Whittle does not read");
  }
}

TEST(Webp, MutatedOnesAreDecodedOrRefused) {
  const auto whole = losslessWebp(pixels(), 4, 3);
  std::mt19937 random(6);
  for (int i = 0; i < test::mutations(); ++i) {
    auto bytes = whole;
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes)
      bytes[kRiff + random() % (bytes.size() - kRiff)] = static_cast<std::byte>(random() & 0xff);
    try {
      const Image image = decodeImage(bytes, "a.webp");
      EXPECT_EQ(image.texels.size(),
                4U * static_cast<unsigned>(image.width) * static_cast<unsigned>(image.height));
    } catch (const InputError& e) {
      EXPECT_TRUE(std::string(e.what()).starts_with("a.webp: ")) << e.what();
    }
  }
}

#endif

}  // namespace
}  // namespace whittle
