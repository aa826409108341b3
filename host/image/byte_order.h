// Numbers as files hold them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace whittle {

/// The most significant byte first; of at most four bytes.
inline std::uint32_t bigEndian(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (const std::byte b : bytes) value = value << 8U | std::to_integer<std::uint32_t>(b);
  return value;
}

/// The least significant byte first; of at most four bytes.
inline std::uint32_t littleEndian(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8U | std::to_integer<std::uint32_t>(bytes[i]);
  return value;
}

}  // namespace whittle
