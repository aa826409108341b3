// Walks PNG chunks: length, type, data, CRC-32 of type and data, all big-endian.
#include "image/png_chunks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "scene/input_error.h"

namespace whittle {
namespace {

constexpr std::size_t kSignatureBytes = 8;
constexpr std::size_t kFrameBytes = 12;  // length, type and checksum around the data

constexpr std::array<std::uint32_t, 256> makeCrcTable() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t crc = i;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? 0xedb88320U ^ (crc >> 1U) : crc >> 1U;
    table[i] = crc;
  }
  return table;
}
constexpr std::array<std::uint32_t, 256> kCrcTable = makeCrcTable();

std::uint32_t crc32(std::span<const std::byte> bytes) {
  std::uint32_t crc = ~0U;
  for (const std::byte b : bytes)
    crc = kCrcTable[(crc ^ std::to_integer<std::uint32_t>(b)) & 0xffU] ^ (crc >> 8U);
  return ~crc;
}

std::uint32_t bigEndian(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8U | std::to_integer<std::uint32_t>(bytes[i]);
  return value;
}

}  // namespace

std::vector<std::byte> texelChunks(std::span<const std::byte> bytes, const std::string& name) {
  constexpr std::array<std::string_view, 5> kKept{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  std::vector<std::byte> out(bytes.begin(), bytes.begin() + kSignatureBytes);
  out.reserve(bytes.size());
  std::string type;
  for (std::span<const std::byte> rest = bytes.subspan(kSignatureBytes); type != "IEND";) {
    const std::size_t length = rest.size() < kFrameBytes ? 0 : bigEndian(rest);
    if (rest.size() < kFrameBytes + length) {
      throw InputError(
          fmt::format("{}: cannot be decoded: the PNG is cut off at byte {}", name, bytes.size()));
    }
    type.assign(reinterpret_cast<const char*>(rest.data()) + 4, 4);
    if (std::find(kKept.begin(), kKept.end(), type) != kKept.end()) {
      if (crc32(rest.subspan(4, 4 + length)) != bigEndian(rest.subspan(8 + length))) {
        throw InputError(
            fmt::format("{}: cannot be decoded: the PNG's {} chunk is damaged (checksum)", name, type));
      }
      out.insert(out.end(), rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(kFrameBytes + length));
    }
    rest = rest.subspan(kFrameBytes + length);
  }
  return out;
}

}  // namespace whittle
