// See srgb.h.
#include "image/srgb.h"

#include <cmath>

namespace whittle {

double srgbEncode(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }
double srgbDecode(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

SrgbCodes::SrgbCodes(Halves halves) {
  constexpr double kTie = 1e-9;  // of a code; far above the rounding of doubles
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const double tie = halves == Halves::Up ? 0.0 : i % 2 == 0 ? kTie : -kTie;
    ends_[i] = srgbDecode((static_cast<double>(i) + 0.5 + tie) / 255.0);
  }
  std::size_t code = 0;
  for (std::size_t k = 0; k <= kCells; ++k) {
    while (code < 255 && ends_[code] <= static_cast<double>(k) / kCells) ++code;
    first_[k] = static_cast<std::uint8_t>(code);
  }
}

}  // namespace whittle
