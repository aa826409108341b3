// See sun_light.h. Transmittances: Preetham, Shirley, Smits 1999, A.1, without the bands of water and oxygen,
// which lie beyond 690 nm. What is scattered down: Bird and Hulstrom 1981, here for each wavelength. The sun
// above the air: a black body of 5772 K (IAU 2015) of 133.3 klx (Darula, Kittler, Gueymard 2005). Observer:
// the fit of Wyman, Sloan, Shirley 2013.
#include "scene/sun_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <numbers>

namespace whittle {
namespace {

constexpr double kSolarIlluminance = 133.3e3;  ///< lx, above the air
/// What is left of the sky when the sun stands on the horizon, lx (clear sky of the IES, 1984): the plane
/// layers of the formulas leave nothing.
constexpr double kSunsetSky = 800.0;
constexpr int kFirst = 380, kLast = 780, kStep = 5;  ///< nm

/// A bell whose halves differ; `left` and `right` are standard deviations, nm.
double bell(double nm, double middle, double left, double right) {
  const double x = (nm - middle) / (nm < middle ? left : right);
  return std::exp(-0.5 * x * x);
}

/// x̄, ȳ, z̄ of the CIE 1931 observer.
glm::dvec3 observer(double nm) {
  return {1.056 * bell(nm, 599.8, 37.9, 31.0) + 0.362 * bell(nm, 442.0, 16.0, 26.7) -
              0.065 * bell(nm, 501.1, 20.4, 26.2),
          0.821 * bell(nm, 568.8, 46.9, 40.5) + 0.286 * bell(nm, 530.9, 16.3, 31.1),
          1.217 * bell(nm, 437.0, 11.8, 36.0) + 0.681 * bell(nm, 459.0, 26.0, 13.8)};
}

/// Planck's law at 5772 K, in any unit.
double sunAbove(double nm) {
  const double hcOverKT = 1.438777e7 / 5772.0;  // nm
  return std::pow(nm / 500.0, -5.0) / (std::exp(hcOverKT / nm) - 1.0);
}

/// Absorption of ozone in the visible, 1/cm every 50 nm from 450 on (Leckner 1978); linear in between.
double ozone(double nm) {
  constexpr std::array kEach{0.003, 0.03, 0.085, 0.125, 0.067, 0.023, 0.009};
  const double at = (nm - 450.0) / 50.0;
  if (at <= 0.0) return kEach.front() * std::max(0.0, 1.0 + at);
  const auto i = std::min(static_cast<std::size_t>(at), kEach.size() - 2);
  return std::max(0.0, std::lerp(kEach[i], kEach[i + 1], at - static_cast<double>(i)));
}

/// Of the way through the air, in that of a sun overhead (Kasten 1966).
double airMass(double elevation) {
  return 1.0 / (std::sin(elevation * std::numbers::pi / 180.0) + 0.15 * std::pow(elevation + 3.885, -1.253));
}

}  // namespace

Daylight daylightOf(const Sky& sky) {
  constexpr double kOzone = 0.35;                                      // cm
  constexpr double kDownOfHaze = 0.84, kDownOfAir = 0.5, kSoot = 0.1;  // of what is scattered, absorbed
  const double m = airMass(sky.elevation);
  const double haze = 0.04608 * sky.turbidity - 0.04586;
  const double sine = std::sin(sky.elevation * std::numbers::pi / 180.0);
  const double deep = 1.0 / (1.0 - m + std::pow(m, 1.02));
  Daylight light;
  double above = 0.0, down = 0.0;
  for (int nm = kFirst; nm <= kLast; nm += kStep) {
    const glm::dvec3 seen = observer(nm) * sunAbove(nm);
    const double um = nm * 1e-3;
    const double ofAir = std::exp(-0.008735 * std::pow(um, -4.08) * m);
    const double ofHaze = std::exp(-haze * std::pow(um, -1.3) * m);
    const double ofOzone = std::exp(-ozone(nm) * kOzone * m);
    above += seen.y;
    light.sun += seen * (ofAir * ofHaze * ofOzone);
    const double kept = 1.0 - kSoot * (1.0 - m + std::pow(m, 1.06)) * (1.0 - ofHaze);
    down += seen.y * ofOzone * kept *
            (kDownOfAir * (1.0 - ofAir) + kDownOfHaze * std::max(0.0, 1.0 - ofHaze / kept));
  }
  light.sun *= kSolarIlluminance / above;
  light.sky = kSolarIlluminance * sine * deep * down / above + kSunsetSky;
  return light;
}

glm::dvec3 linearFromXyz(const glm::dvec3& xyz) {
  static const glm::dmat3 rows(3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570);
  return xyz * rows;
}

}  // namespace whittle
