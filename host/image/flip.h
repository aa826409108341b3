// FLIP: how different two pictures look when one flips between them (Andersson et al. 2020, "FLIP: A
// Difference Evaluator for Alternating Images", HPG). The version for pictures on an ordinary (LDR) screen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace whittle {

/// The paper's default viewer: 0.7 m from a 0.7 m wide screen of 3840 pixels.
inline constexpr double kFlipPixelsPerDegree = 67.0;

/// FLIP for each pixel, in [0, 1], of two sRGB pictures of width·height·3 bytes.
/// Symmetric in its two pictures.
std::vector<double> flipMap(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, int width,
                            int height);

/// Its mean, rows summed in order.
double flipMean(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, int width, int height);

}  // namespace whittle
