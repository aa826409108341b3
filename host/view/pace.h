// Which picture comes first of a request, so that something new is seen many times a second while a hand
// moves, and the full picture soon after it rests: decided by how long pictures took before.
#pragma once

namespace whittle::view {

class Pace {
 public:
  /// By how much the sides of the first picture are divided: 4, 8 or 16; 1: the full picture comes first.
  /// `pixels`: of the full one; `wasCutShort`: the request before ended without a picture, since this one
  /// came.
  int divisor(double pixels, bool wasCutShort) const;

  /// How long one sample for each pixel took, seconds.
  void tookCoarse(double pixels, double seconds) { coarse_ = seconds / pixels; }
  void tookFull(double pixels, double seconds) { full_ = seconds / pixels; }

 private:
  double coarse_ = 0, full_ = 0;  ///< seconds for a pixel; 0: not known yet
};

/// A coarse picture that a newer request finds under way is finished unless it has taken so long, seconds:
/// where moves follow each other faster than pictures, none would ever be seen otherwise.
inline constexpr double kFinishedWithin = 0.05;

}  // namespace whittle::view
