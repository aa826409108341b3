// A hash of 32-bit integers (shifts and multiplications): the same numbers on every machine.
#pragma once

#include <cstdint>

namespace generator {

inline std::uint32_t mix(std::uint32_t v) {
  v ^= v >> 16U;
  v *= 0x7feb352dU;
  v ^= v >> 15U;
  v *= 0x846ca68bU;
  return v ^ v >> 16U;
}

/// The i-th of a series of fixed values in [0, 1).
inline double unitValue(std::uint32_t series, std::uint32_t i) { return mix(i + mix(series)) * 0x1p-32; }

}  // namespace generator
