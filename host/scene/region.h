// A rectangle of a picture.
#pragma once

#include <cstdint>

namespace whittle {

/// Pixels, counted from the picture's top left.
struct Region {
  int x = 0, y = 0;
  int width = 0, height = 0;

  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  }
  bool operator==(const Region&) const = default;
};

/// Whether it has pixels, and all of them belong to a picture of this size.
constexpr bool liesWithin(const Region& r, int width, int height) {
  return r.x >= 0 && r.y >= 0 && r.width >= 1 && r.height >= 1 && r.width <= width && r.height <= height &&
         r.x <= width - r.width && r.y <= height - r.height;
}

}  // namespace whittle
