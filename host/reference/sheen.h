// Sheen of fibres that stand up from a surface: Conty Estevez and Kulla, "Production Friendly Microfacet
// Sheen BRDF", 2017, as KHR_materials_sheen has it.
#pragma once

#include "reference/vec.h"

namespace whittle::reference {

struct Sheen {
  Vec3 color{0};
  double roughness = 0;  ///< perceptual

  bool isThere() const { return maxComponent(color) > 0; }
};

/// Distribution times visibility of white fibres, 1/sr; cosines to the normal of w_o, w_i and the direction
/// halfway.
double fibreLobe(double roughness, double cosO, double cosI, double cosH);

/// What they scatter of light that comes at that angle: the lobe's integral, as README.md interpolates it.
double fibreAlbedo(double roughness, double cosine);

/// The integral itself.
double integratedFibreAlbedo(double roughness, double cosine);

}  // namespace whittle::reference
