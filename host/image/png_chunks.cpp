// Walks PNG chunks: length, type, data, CRC-32 of type and data, all big-endian.
#include "image/png_chunks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "image/byte_order.h"
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

/// One chunk, whole, in front of what follows it.
struct Chunk {
  std::string_view type;
  std::span<const std::byte> data;
  bool isIntact = false;  ///< its checksum matches
  std::size_t bytes = 0;  ///< with its frame
};

/// The chunk that `rest` begins with; empty where it is cut off.
std::optional<Chunk> firstChunk(std::span<const std::byte> rest) {
  const std::size_t length = rest.size() < kFrameBytes ? 0 : bigEndian(rest.first(4));
  if (rest.size() < kFrameBytes + length) return std::nullopt;
  return Chunk{{reinterpret_cast<const char*>(rest.data()) + 4, 4},
               rest.subspan(8, length),
               crc32(rest.subspan(4, 4 + length)) == bigEndian(rest.subspan(8 + length, 4)),
               kFrameBytes + length};
}

}  // namespace

std::vector<std::byte> texelChunks(std::span<const std::byte> bytes, const std::string& name) {
  constexpr std::array<std::string_view, 5> kKept{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  std::vector<std::byte> out(bytes.begin(), bytes.begin() + kSignatureBytes);
  out.reserve(bytes.size());
  std::string_view type;
  for (std::span<const std::byte> rest = bytes.subspan(kSignatureBytes); type != "IEND";) {
    const std::optional<Chunk> chunk = firstChunk(rest);
    if (!chunk) {
      throw InputError(
          fmt::format("{}: cannot be decoded: the PNG is cut off at byte {}", name, bytes.size()));
    }
    type = chunk->type;
    if (std::find(kKept.begin(), kKept.end(), type) != kKept.end()) {
      if (!chunk->isIntact) {
        throw InputError(
            fmt::format("{}: cannot be decoded: the PNG's {} chunk is damaged (checksum)", name, type));
      }
      out.insert(out.end(), rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(chunk->bytes));
    }
    rest = rest.subspan(chunk->bytes);
  }
  return out;
}

std::optional<double> gammaExponent(std::span<const std::byte> bytes) {
  constexpr std::array<std::string_view, 3> kGoBefore{"sRGB", "iCCP", "cICP"};
  constexpr double kUnit = 100000, kUsual = 1 / 2.2, kNear = 0.002;
  std::optional<double> exponent;
  for (std::span<const std::byte> rest = bytes.subspan(kSignatureBytes);;) {
    const std::optional<Chunk> chunk = firstChunk(rest);
    if (!chunk || chunk->type == "IDAT" || chunk->type == "IEND") return exponent;
    if (chunk->isIntact) {
      if (std::find(kGoBefore.begin(), kGoBefore.end(), chunk->type) != kGoBefore.end()) return std::nullopt;
      if (chunk->type == "gAMA" && chunk->data.size() == 4) {
        const double gamma = bigEndian(chunk->data.first(4)) / kUnit;
        if (gamma > 0 && std::abs(gamma - kUsual) > kNear) exponent = 1 / gamma;
      }
    }
    rest = rest.subspan(chunk->bytes);
  }
}

}  // namespace whittle
