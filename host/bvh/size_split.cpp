// One pass that fills bins, one sweep over them.
#include "bvh/size_split.h"

namespace whittle {

SizeSplit bestSizeSplit(std::span<const PrimRef> refs, double whole) {
  Box4 box[kSizeBins];
  std::uint32_t count[kSizeBins] = {};
  const SizeTest test{whole, 0};
  for (const PrimRef& ref : refs) {
    const int bin = test.binOf(ref);
    box[bin].grow({ref.lo, ref.hi});
    ++count[bin];
  }
  Box4 smaller[kSizeBins];  // of bins i and higher
  for (int i = kSizeBins - 1; i > 0; --i) {
    smaller[i] = box[i];
    if (i + 1 < kSizeBins) smaller[i].grow(smaller[i + 1]);
  }
  SizeSplit best, split;
  double bestCost = std::numeric_limits<double>::infinity();
  for (int i = 1; i < kSizeBins; ++i) {
    split.bin = i;
    split.large.grow(box[i - 1]);
    split.largeCount += count[i - 1];
    split.small = smaller[i];
    split.smallCount = static_cast<std::uint32_t>(refs.size()) - split.largeCount;
    if (split.largeCount == 0 || split.smallCount == 0 || !(split.cost() < bestCost)) continue;
    best = split;
    bestCost = split.cost();
  }
  return best;
}

}  // namespace whittle
