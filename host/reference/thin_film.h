// Interference in a film over a surface: Belcour and Barla, "A Practical Extension to Microfacet Theory for
// the Modeling of Varying Iridescence", 2017, as KHR_materials_iridescence simplifies it.
#pragma once

#include "reference/vec.h"

namespace whittle::reference {

struct ThinFilm {
  double share = 0;      ///< of the surface that has one
  double index = 1.3;    ///< of refraction, at least 1
  double thickness = 0;  ///< nm

  /// What a surface reflects, as linear sRGB, `plain` where it has no film; f0: its own at normal incidence.
  Vec3 over(const Vec3& plain, const Vec3& f0, double cosine) const;
};

/// The same where a film is all over it, not yet within [0, 1].
Vec3 filmReflectance(const ThinFilm& film, const Vec3& f0, double cosine);

}  // namespace whittle::reference
