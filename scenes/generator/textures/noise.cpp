// Lattices that wrap around.
#include "textures/noise.h"

#include <algorithm>
#include <cmath>

#include "hash.h"

namespace generator {
namespace {

int wrapped(int i, int n) { return (i % n + n) % n; }

std::uint32_t hashAt(glm::ivec2 at, glm::ivec2 cells, std::uint32_t series) {
  const auto x = static_cast<std::uint32_t>(wrapped(at.x, cells.x));
  const auto y = static_cast<std::uint32_t>(wrapped(at.y, cells.y));
  return mix(x + mix(y + mix(series)));
}

}  // namespace

double noise(glm::dvec2 uv, glm::ivec2 cells, std::uint32_t series) {
  const glm::dvec2 p = uv * glm::dvec2(cells), corner = glm::floor(p), t = p - corner;
  const glm::dvec2 f = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
  const glm::ivec2 at(corner);
  const auto value = [&](int dx, int dy) { return hashAt(at + glm::ivec2(dx, dy), cells, series) * 0x1p-32; };
  const double above = value(0, 0) + f.x * (value(1, 0) - value(0, 0));
  const double below = value(0, 1) + f.x * (value(1, 1) - value(0, 1));
  return above + f.y * (below - above);
}

double fractalNoise(glm::dvec2 uv, glm::ivec2 cells, std::uint32_t series, int octaves, double gain) {
  double sum = 0, weight = 1, weights = 0;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * noise(uv, cells, series + static_cast<std::uint32_t>(octave));
    weights += weight;
    weight *= gain;
    cells *= 2;
  }
  return sum / weights;
}

CellHit cellNoise(glm::dvec2 uv, glm::ivec2 cells, std::uint32_t series) {
  const glm::dvec2 p = uv * glm::dvec2(cells);
  const glm::ivec2 at(glm::floor(p));
  CellHit hit{9, 9, 0};
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      const glm::ivec2 cell = at + glm::ivec2(dx, dy);
      const std::uint32_t id = hashAt(cell, cells, series);
      const glm::dvec2 point = glm::dvec2(cell) + glm::dvec2(id * 0x1p-32, mix(id) * 0x1p-32);
      const double distance = glm::length(point - p);
      if (distance < hit.nearest) {
        hit = {distance, hit.nearest, id};
      } else {
        hit.second = std::min(hit.second, distance);
      }
    }
  }
  return hit;
}

double smoothStep(double low, double high, double v) {
  const double t = std::clamp((v - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace generator
