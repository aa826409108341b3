// See blue_noise.h. Void and cluster: Ulichney 1993, on a torus, in whole numbers.
#include "image/blue_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace whittle {
namespace {

constexpr int kSide = kThresholdSide, kCells = kSide * kSide;

/// On the torus; x and y not negative.
std::size_t cellAt(int x, int y) {
  const auto column = static_cast<std::size_t>(x % kSide), row = static_cast<std::size_t>(y % kSide);
  return row * kSide + column;
}

/// How close each cell is to those that are set: a sum of Gaussians about them.
class Crowd {
 public:
  Crowd() : near_(kCells), isSet_(kCells, false), closeness_(kCells, 0) {
    constexpr double kDeviation = 1.5, kOne = 1 << 24;  // cells; whole numbers have one order everywhere
    for (int i = 0; i < kCells; ++i) {
      const int dx = std::min(i % kSide, kSide - i % kSide), dy = std::min(i / kSide, kSide - i / kSide);
      near_[static_cast<std::size_t>(i)] =
          std::llround(kOne * std::exp(-(dx * dx + dy * dy) / (2.0 * kDeviation * kDeviation)));
    }
  }

  bool isSet(int cell) const { return isSet_[static_cast<std::size_t>(cell)]; }
  void set(int cell, bool isSet) {
    isSet_[static_cast<std::size_t>(cell)] = isSet;
    const int x = cell % kSide, y = cell / kSide;
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) {
        const std::int64_t n = near_[cellAt(i - x + kSide, j - y + kSide)];
        closeness_[cellAt(i, j)] += isSet ? n : -n;
      }
  }
  /// The set cell that others crowd most, or the free one that is farthest from all; the first of equals.
  int tightest() const { return best(true); }
  int emptiest() const { return best(false); }

 private:
  int best(bool ofSet) const {
    int found = -1;
    for (int i = 0; i < kCells; ++i) {
      if (isSet(i) != ofSet) continue;
      const auto now = closeness_[static_cast<std::size_t>(i)];
      const auto most = found < 0 ? 0 : closeness_[static_cast<std::size_t>(found)];
      if (found < 0 || (ofSet ? now > most : now < most)) found = i;
    }
    return found;
  }

  std::vector<std::int64_t> near_;
  std::vector<bool> isSet_;
  std::vector<std::int64_t> closeness_;
};

/// A tenth of the cells, moved one by one from where they crowd to where there are none.
Crowd evenStart(int& count) {
  Crowd crowd;
  count = 0;
  std::uint32_t state = 1;
  while (count < kCells / 10) {
    state = state * 1664525U + 1013904223U;
    const int cell = static_cast<int>(state >> 20) % kCells;
    if (crowd.isSet(cell)) continue;
    crowd.set(cell, true);
    ++count;
  }
  for (;;) {
    const int from = crowd.tightest();
    crowd.set(from, false);
    const int to = crowd.emptiest();
    crowd.set(to, true);
    if (to == from) return crowd;
  }
}

std::array<double, kCells> makeThresholds() {
  std::array<double, kCells> thresholds{};
  const auto rank = [&](int cell, int of) {
    thresholds[static_cast<std::size_t>(cell)] = (of + 0.5) / kCells;
  };
  int count = 0;
  const Crowd start = evenStart(count);
  Crowd fewer = start;
  for (int r = count - 1; r >= 0; --r) {
    const int cell = fewer.tightest();
    fewer.set(cell, false);
    rank(cell, r);
  }
  Crowd more = start;
  for (int r = count; r < kCells; ++r) {
    const int cell = more.emptiest();
    more.set(cell, true);
    rank(cell, r);
  }
  return thresholds;
}

}  // namespace

double orderedThreshold(int x, int y) {
  static const std::array<double, kCells> kThresholds = makeThresholds();
  return kThresholds[cellAt(x, y)];
}

}  // namespace whittle
