// Fresnel reflectance of dielectrics and metals in double precision.
#include "reference/fresnel.h"

#include <algorithm>

namespace whittle::reference {
namespace {

double sinSquaredBeyond(double cosI, double eta) { return std::max(0.0, 1 - cosI * cosI) / (eta * eta); }

double schlickWeight(double cosine) { return std::pow(std::clamp(1 - cosine, 0.0, 1.0), 5); }

}  // namespace

bool totallyReflected(double cosI, double eta) { return !(sinSquaredBeyond(cosI, eta) < 1); }

double dielectricReflectance(double cosI, double eta) {
  if (eta == 1) return 0;
  if (totallyReflected(cosI, eta)) return 1;
  const double cosT = std::sqrt(1 - sinSquaredBeyond(cosI, eta));
  const double rs = (cosI - eta * cosT) / (cosI + eta * cosT);
  const double rp = (eta * cosI - cosT) / (eta * cosI + cosT);
  return 0.5 * (rs * rs + rp * rp);
}

Vec3 schlick(const Vec3& f0, const Vec3& f90, double cosine) {
  return f0 + (f90 - f0) * schlickWeight(cosine);
}

TintedFresnel::TintedFresnel(double ior_, double specular, const Vec3& specularColor)
    : ior(ior_),
      r0(square((ior_ - 1) / (ior_ + 1))),
      f0(glm::min(r0 * specularColor, Vec3(1)) * specular),
      f90(specular) {}

Vec3 TintedFresnel::reflectance(double cosI, double eta) const {
  const bool admitsNothing = r0 >= 1;  // ior 0: its own reflectance is 1 at every angle and gives no rise
  if (!admitsNothing && eta != 1 && totallyReflected(cosI, eta)) return Vec3(1);
  const double rise =
      admitsNothing ? schlickWeight(cosI) : (dielectricReflectance(cosI, eta) - r0) / (1 - r0);
  return glm::clamp(f0 + (f90 - f0) * rise, 0.0, 1.0);  // dense dielectrics dip below r0 on the way up
}

}  // namespace whittle::reference
