// Noise over the unit square that repeats without a seam. Sums, products and square roots of hashed integers:
// the same bits on every machine.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace generator {

/// Value noise (Perlin and Hoffert 1989) of `cells` lattice cells in each direction, in [0, 1).
double noise(glm::dvec2 uv, glm::ivec2 cells, std::uint32_t series);

/// A sum of octaves, each with twice the cells and `gain` times the weight of the one before, in [0, 1).
double fractalNoise(glm::dvec2 uv, glm::ivec2 cells, std::uint32_t series, int octaves, double gain = 0.5);

/// One point in each of the cells (Worley 1996): distances to the nearest two, in cells, and a number that
/// names the nearest.
struct CellHit {
  double nearest = 0, second = 0;
  std::uint32_t id = 0;
};
CellHit cellNoise(glm::dvec2 uv, glm::ivec2 cells, std::uint32_t series);

/// 0 up to `low`, 1 from `high`, smooth between.
double smoothStep(double low, double high, double v);

}  // namespace generator
