// sRGB (IEC 61966-2-1): its curve both ways, and the nearest 8-bit code of a linear value without a power for
// each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace whittle {

/// In double; v in [0, 1].
double srgbEncode(double v);
double srgbDecode(double v);

class SrgbCodes {
 public:
  /// What becomes of a value half way between two codes: the upper one, or the even one. What rounding of a
  /// mean is off by counts as half way for `ToEven`: the curve begins straight, and means of two codes lie
  /// there.
  enum class Halves { Up, ToEven };

  explicit SrgbCodes(Halves halves);

  /// The nearest code; linear values of 0 and more, beyond 1 it is 255.
  std::uint8_t codeOf(double linear) const {
    std::size_t code = first_[linear < 1.0 ? static_cast<std::size_t>(linear * kCells) : kCells];
    while (code < 255 && ends_[code] <= linear) ++code;
    return static_cast<std::uint8_t>(code);
  }

 private:
  static constexpr std::size_t kCells = 4096;
  std::array<double, 255> ends_{};  ///< [i] the linear value from which on code i + 1 is nearer
  std::array<std::uint8_t, kCells + 1>
      first_{};  ///< [k] the code of k / kCells, a few below others of its cell
};

}  // namespace whittle
