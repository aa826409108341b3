// See sky.h; formulas: README.md, "Direct light".
#include "reference/sky.h"

#include <algorithm>
#include <limits>

#include "reference/texture.h"

namespace whittle::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Choice {
  int index;
  double chance;
  double within;  ///< how far into its share, from 0 to 1
};

/// By shares of [0, 1) that end where the numbers say.
Choice choose(const float* ends, int count, double u) {
  u = std::min(u, 1 - 0x1p-24);
  const float* const own =
      std::find_if(ends, ends + count, [&](float end) { return u < static_cast<double>(end); });
  const double begin = own == ends ? 0.0 : static_cast<double>(own[-1]),
               chance = static_cast<double>(*own) - begin;
  return {static_cast<int>(own - ends), chance, (u - begin + 0x1p-25) / chance};
}

/// The inverse of the integral of what goes evenly from `first` at 0 to `last` at 1, over all of it.
double onSlope(double u, double first, double last) {
  if (first == last) return u;
  return (std::sqrt(glm::mix(square(first), square(last), u)) - first) / (last - first);
}

}  // namespace

LightSample sampleSky(const Background& background, const SkyTable& table, const Surfel& lit, const Vec2& u) {
  if (table.until.empty()) {
    const double height = std::sqrt(1 - std::min(u.x, 1 - 0x1p-24)), away = std::sqrt(1 - square(height));
    const auto [right, up] = basisAbout(lit.n);
    const Vec3 w_i = height * lit.n + away * (std::cos(2 * kPi * u.y) * right + std::sin(2 * kPi * u.y) * up);
    return {glm::normalize(w_i), kInfinity, kPi / height * Vec3(background.radiance)};
  }
  const int w = table.width, h = table.height;
  const Choice row = choose(table.until.data(), h + 1, u.y);
  const Choice column = choose(&table.until[h + 1 + std::size_t{1} * row.index * w], w, u.x);
  const int x = column.index, y = row.index;
  const auto at = [&](int right, int down) { return skyBrightness(background, x + right, y - 1 + down); };
  const double down = onSlope(row.within, at(0, 0) + at(1, 0), at(0, 1) + at(1, 1));
  const double left = glm::mix(at(0, 0), at(0, 1), down), right = glm::mix(at(1, 0), at(1, 1), down);
  const double across = onSlope(column.within, left, right), own = glm::mix(left, right, across);
  if (!(own > 0)) return {Vec3(0, 1, 0), kInfinity, Vec3(0)};
  const double top = kPi * std::max(0.0, y - 0.5) / h, bottom = kPi * std::min<double>(h, y + 0.5) / h;
  const double polar = glm::mix(top, bottom, down),
               turned = std::remainder(background.rotation, 360.0) / 360.0;
  const double around = 2 * kPi * ((x + 0.5 + across) / w - 0.5 - turned);
  const Vec3 w_i(std::sin(polar) * std::sin(around), std::cos(polar), -std::sin(polar) * std::cos(around));
  const double density = row.chance * column.chance * own / ((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / 4);
  const double size =
      std::sin(polar) * (bottom - top) * 2 * kPi / w;  // sr of the cell, were it all like this
  return {w_i, kInfinity, size / density * backgroundRadiance(background, w_i)};
}

}  // namespace whittle::reference
