// Images of 16 bits: slots of linear values keep them.
#include <gtest/gtest.h>

#include <array>

#include "gltf/builder.h"

namespace whittle {
namespace {

using test::GltfBuilder;
using test::Json;

std::string bigEndian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
          static_cast<char>(value)};
}

/// CRC-32 as PNG has it (ISO 3309), bit by bit.
std::uint32_t crcOf(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffU;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1U ? 0xedb88320U : 0U);
  }
  return ~crc;
}

std::string chunk(const std::string& type, const std::string& data) {
  return bigEndian(static_cast<std::uint32_t>(data.size())) + type + data + bigEndian(crcOf(type + data));
}

/// A PNG of one row of RGB in 16 bits, its zlib stream stored.
std::string png16(const std::vector<std::array<std::uint16_t, 3>>& texels) {
  std::string row(1, '\0');  // no filter
  for (const auto& texel : texels)
    for (const std::uint16_t c : texel) row += {static_cast<char>(c >> 8), static_cast<char>(c & 0xff)};
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (const char c : row) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto low = static_cast<char>(row.size() & 0xff), high = static_cast<char>(row.size() >> 8);
  const std::string stored{
      '\x78', '\x01', '\x01', low, high, static_cast<char>(~low), static_cast<char>(~high)};
  const std::string header = bigEndian(static_cast<std::uint32_t>(texels.size())) + bigEndian(1) +
                             std::string("\x10\x02\0\0\0", 5);  // 16 bits, RGB
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", stored + row + bigEndian(b << 16 | a)) +
         chunk("IEND", "");
}

/// A triangle whose material has this image in the slots named.
Scene withImage(const std::string& png, const std::vector<std::string>& slots) {
  GltfBuilder b;
  b.push("images",
         {{"bufferView", b.view(std::vector<char>(png.begin(), png.end()))}, {"mimeType", "image/png"}});
  b.push("textures", {{"source", 0}});
  Json material;
  for (const std::string& slot : slots) material[Json::json_pointer(slot)]["index"] = 0;
  b.material(material);
  b.node({{"mesh",
           b.triangleMesh({{"material", 0}, {"attributes", {{"TEXCOORD_0", b.vec2({0, 0, 1, 0, 0, 1})}}}})}});
  Scene scene = b.load();
  EXPECT_EQ(scene.images.size(), 1U);
  return scene;
}

using Deep = std::vector<std::uint16_t>;
const std::string kNormal = "/normalTexture", kColour = "/pbrMetallicRoughness/baseColorTexture";

TEST(GltfDeepImages, KeepSixteenBitsWhereLinearValuesAreRead) {
  const std::string png = png16({{32768, 32769, 65535}, {1, 0, 300}});
  // 300 / 257 rounds to 1.
  const std::vector<std::uint8_t> eightBits{128, 128, 255, 255, 0, 0, 1, 255};
  for (const char* slot : {"/normalTexture", "/pbrMetallicRoughness/metallicRoughnessTexture",
                           "/extensions/KHR_materials_specular/specularTexture",
                           "/extensions/KHR_materials_transmission/transmissionTexture"}) {
    const Scene scene = withImage(png, {slot});
    EXPECT_EQ(scene.images.at(0).deepTexels, (Deep{32768, 32769, 65535, 65535, 1, 0, 300, 65535})) << slot;
    EXPECT_EQ(scene.images.at(0).texels, eightBits) << slot;
  }
  EXPECT_TRUE(withImage(png, {kNormal, kColour}).images.at(0).isDeep());
  const Scene colours = withImage(png, {kColour});
  EXPECT_FALSE(colours.images.at(0).isDeep());
  EXPECT_EQ(colours.images.at(0).texels, eightBits);
}

TEST(GltfDeepImages, EightBitsWrittenAsSixteenStayEight) {
  // Each a multiple of 257: k/255 to the last digit.
  const Scene scene = withImage(png16({{257, 128 * 257, 65535}}), {kNormal});
  EXPECT_FALSE(scene.images.at(0).isDeep());
  EXPECT_EQ(scene.images.at(0).texels, (std::vector<std::uint8_t>{1, 128, 255, 255}));
}

}  // namespace
}  // namespace whittle
