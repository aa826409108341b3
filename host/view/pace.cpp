// See pace.h.
#include "view/pace.h"

namespace whittle::view {
namespace {

/// What the first ray of a full picture may take where it comes first: with what stands before and behind it,
/// something is seen within a tenth of a second.
constexpr double kSoonEnough = 0.08;
constexpr int kLeastDivisor = 4, kLargestDivisor = 16;

}  // namespace

int Pace::divisor(double pixels, bool wasCutShort) const {
  const double full = full_ * pixels;
  const bool isKnown = full > 0;
  if (isKnown && full <= kSoonEnough && !wasCutShort) return 1;
  int divisor = kLeastDivisor;
  while (divisor < kLargestDivisor && coarse_ * pixels / (divisor * divisor) > kFinishedWithin) divisor *= 2;
  return divisor;
}

}  // namespace whittle::view
