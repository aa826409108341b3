// Kernels against the reference, pixel by pixel. Single precision moves a ray by some 1e-7 of its way; where
// that takes it across an edge (of an object, a shadow, a texel, of something seen in a mirror) the two may
// differ by anything. Such a pixel must be explained: the reference itself must jump as far when eye rays and
// lights are moved as little.
#pragma once

#include <string>

#include "reference/reference.h"
#include "render/renderer.h"

namespace whittle::test {

struct Agreement {
  RenderResult kernel;
  ReferenceResult reference;
  std::size_t pixels = 0;
  std::size_t differentHits = 0;  ///< another primitive at another depth
  std::size_t outliers = 0;       ///< differ by more than 1e-3 of the mean radiance, or in what they hit
  std::size_t unexplained = 0;    ///< outliers where the reference does not jump
  double mean = 0;                ///< radiance of the reference, over pixels and channels
  double rmse = 0;                ///< over the pixels that are no outliers
  double rmseSameHit = 0;         ///< over all pixels that hit the same
  std::uint64_t looseImpulse = 0, looseShadow = 0;  ///< rays that come or go when rays and lights are moved
};

/// Renders both ways. What each pixel hits is asked of the whole kernels, whose bits must be those of the
/// kernels that the settings ask for.
Agreement compareWithReference(const Scene& scene, Settings settings);

/// What is asked of every scene: the same hits but for one pixel, at most `outliers` on edges, each
/// explained but for `unexplained`, the rest within 1e-4 of the mean, and the same number of rays but for
/// those of the outliers.
void expectAgreement(const Agreement& agreement, const std::string& name, std::size_t outliers,
                     std::size_t unexplained = 0);

}  // namespace whittle::test
