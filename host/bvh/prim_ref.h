// What the builder sorts: the box of a triangle and its index, 32 bytes, and the four-lane boxes it reduces
// them to. Read and written by the builder's files of this folder only; nothing of it survives the build.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

namespace whittle {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 splat4(float v) { return Float4{v, v, v, v}; }

/// An axis-aligned box in lanes 0..2; lane 3 holds anything. Empty to begin with.
struct Box4 {
  Float4 lo = splat4(std::numeric_limits<float>::infinity());
  Float4 hi = splat4(-std::numeric_limits<float>::infinity());

  void grow(Float4 p) {
    lo = min4(lo, p);
    hi = max4(hi, p);
  }
  void grow(const Box4& b) {
    lo = min4(lo, b.lo);
    hi = max4(hi, b.hi);
  }
};

/// Half the surface area, in double: coordinates of 1e38 squared do not overflow,
/// those of 1e-38 do not vanish.
inline double halfArea(const Box4& b) {
  const double x = static_cast<double>(b.hi[0]) - static_cast<double>(b.lo[0]);
  const double y = static_cast<double>(b.hi[1]) - static_cast<double>(b.lo[1]);
  const double z = static_cast<double>(b.hi[2]) - static_cast<double>(b.lo[2]);
  return x * (y + z) + y * z;
}

/// Half areas of three boxes, lane k for box k, of edges multiplied by `scale`. NaN
/// or infinite for empty boxes.
inline Float4 halfAreas(const Box4 (&box)[3], Float4 scale) {
  const Float4 a = box[0].hi - box[0].lo, b = box[1].hi - box[1].lo, c = box[2].hi - box[2].lo;
  // Scaled only here: lane 3 of a, b, c may be a denormal, which is slow to multiply.
  const Float4 x = Float4{a[0], b[0], c[0], 0} * scale;
  const Float4 y = Float4{a[1], b[1], c[1], 0} * scale;
  const Float4 z = Float4{a[2], b[2], c[2], 0} * scale;
  return x * (y + z) + y * z;
}

/// 1 / the longest edge: areas relative to the node neither overflow nor vanish in float.
inline Float4 relativeScale(const Box4& box) {
  const Float4 d = box.hi - box.lo;
  return splat4(1 / std::max({d[0], d[1], d[2]}));
}

/// One triangle on its way into a leaf: its box, and its index as the bits of lane 3 of `lo`.
struct PrimRef {
  Float4 lo, hi;

  std::uint32_t index() const { return std::bit_cast<std::uint32_t>(lo[3]); }
  void setIndex(std::uint32_t i) { lo[3] = std::bit_cast<float>(i); }

  /// Twice the centre of the box; lane 3 is 0 (the index, read as a number, would be a slow denormal).
  /// Overflows to infinity beyond 1.7e38, which the builder takes for an axis without a usable split.
  Float4 centroid2() const {
    const Int4 bits = std::bit_cast<Int4>(lo) & Int4{-1, -1, -1, 0};
    return std::bit_cast<Float4>(bits) + hi;
  }
};
static_assert(sizeof(PrimRef) == 32);

}  // namespace whittle
