// How much of the light a boundary reflects: the exact equations for dielectrics, KHR_materials_ior and
// KHR_materials_specular, and Schlick's approximation for metals.
#pragma once

#include "reference/vec.h"

namespace whittle::reference {

/// Unpolarised reflectance of a dielectric. cosI in [0,1] is measured in the medium the light comes from,
/// eta is the index beyond over the index here. 1 at total reflection; 0 where eta is exactly 1; 1 where
/// eta is 0.
double dielectricReflectance(double cosI, double eta);

/// Whether no refracted direction exists.
bool totallyReflected(double cosI, double eta);

/// f0 at normal incidence, f90 at grazing incidence.
Vec3 schlick(const Vec3& f0, const Vec3& f90, double cosine);

/// The dielectric's reflectance tinted by KHR_materials_specular.
struct TintedFresnel {
  TintedFresnel(double ior, double specular, const Vec3& specularColor);

  Vec3 reflectance(double cosI, double eta) const;

  double ior;
  double r0;  ///< of the plain dielectric
  Vec3 f0, f90;
};

}  // namespace whittle::reference
