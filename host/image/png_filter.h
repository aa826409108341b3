// What a PNG's filters take a byte of a row for, from the bytes beside it (PNG, third edition, section 9).
#pragma once

#include <cstdlib>

namespace whittle {

inline constexpr int kPngFilters = 5;

/// Filter 4: of the three the one nearest to left + up - corner; of equal ones the first.
inline int paeth(int left, int up, int corner) {
  const int toLeft = std::abs(up - corner), toUp = std::abs(left - corner),
            toCorner = std::abs(left + up - 2 * corner);
  if (toLeft <= toUp && toLeft <= toCorner) return left;
  return toUp <= toCorner ? up : corner;
}

/// `left`, `up` and `corner` (left of `up`) are bytes, 0 where there are none.
inline int predict(int filter, int left, int up, int corner) {
  switch (filter) {
    case 1:
      return left;
    case 2:
      return up;
    case 3:
      return (left + up) / 2;
    case 4:
      return paeth(left, up, corner);
    default:
      return 0;
  }
}

}  // namespace whittle
