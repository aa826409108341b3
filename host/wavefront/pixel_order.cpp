// Morton order over 4×2 tiles; tiles outside the region are skipped.
#include "wavefront/pixel_order.h"

#include <algorithm>

namespace whittle {
namespace {

/// Every second bit of v, packed.
std::uint32_t evenBits(std::uint64_t v) {
  std::uint32_t out = 0;
  for (int bit = 0; bit < 32; ++bit) out |= static_cast<std::uint32_t>((v >> (2 * bit)) & 1U) << bit;
  return out;
}

/// The tile at (x0, y0) of the region.
void appendTile(std::vector<std::uint32_t>& order, std::uint32_t x0, std::uint32_t y0, const Region& region) {
  const auto left = static_cast<std::uint32_t>(region.x), top = static_cast<std::uint32_t>(region.y);
  const auto width = static_cast<std::uint32_t>(region.width),
             height = static_cast<std::uint32_t>(region.height);
  for (std::uint32_t y = y0; y < std::min(y0 + 2, height); ++y)
    for (std::uint32_t x = x0; x < std::min(x0 + 4, width); ++x)
      order.push_back((top + y) << 16 | (left + x));
}

}  // namespace

std::vector<std::uint32_t> makePixelOrder(const Region& region) {
  std::vector<std::uint32_t> order;
  order.reserve(region.pixels());
  const std::uint32_t columns = (static_cast<std::uint32_t>(region.width) + 3) / 4,
                      rows = (static_cast<std::uint32_t>(region.height) + 1) / 2;
  // Squares of 64×64 tiles row by row, a Morton curve inside each: no long walk over tiles outside
  // a wide picture.
  constexpr std::uint32_t kSide = 64;
  for (std::uint32_t by = 0; by < rows; by += kSide)
    for (std::uint32_t bx = 0; bx < columns; bx += kSide)
      for (std::uint64_t code = 0; code < std::uint64_t{kSide} * kSide; ++code) {
        // Down first: two tiles are a square of 4×4 pixels.
        const std::uint32_t tx = bx + evenBits(code >> 1), ty = by + evenBits(code);
        if (tx < columns && ty < rows) appendTile(order, tx * 4, ty * 2, region);
      }
  return order;
}

}  // namespace whittle
