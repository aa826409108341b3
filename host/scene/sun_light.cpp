// See sun_light.h. Transmittances: Preetham, Shirley, Smits 1999, A.1, without the bands of water and oxygen,
// which lie beyond 690 nm. What is scattered down: Bird and Hulstrom 1981, here for each wavelength. The sun
// above the air: a black body of 5772 K (IAU 2015) of 133.3 klx (Darula, Kittler, Gueymard 2005). Observer:
// the fit of Wyman, Sloan, Shirley 2013. Twilight: the fit of Seidelmann 1992, Explanatory Supplement to the
// Astronomical Almanac, to measured illuminances.
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

double opticalDepthOfHaze(double turbidity, double um) {
  return (0.04608 * turbidity - 0.04586) * std::pow(um, -1.3);
}
double opticalDepthOfAir(double um) { return 0.008735 * std::pow(um, -4.08); }

/// What is left of the light at sunset when the sun stands this far below the horizon; 1 above it.
double twilight(double elevation) {
  if (elevation >= 0.0) return 1.0;
  const double x = elevation / 90.0, sunset = 2.88;
  const double lg = elevation > -5.0 ? sunset + x * (21.81 + x * (-258.11 - x * 858.36))
                                     : 2.70 + x * (12.17 + x * (-431.69 - x * 1899.83));
  return std::pow(10.0, lg - sunset);
}

/// How much of the sun's disk stands above the horizon: the air lifts it by 34', and its radius is 16'.
double visibleDisk(double elevation) {
  const double up = std::clamp((elevation * 60.0 + 34.0) / 16.0, -1.0, 1.0);
  return 0.5 + (up * std::sqrt(1.0 - up * up) + std::asin(up)) / std::numbers::pi;
}

/// Of the way through the air, in that of a sun overhead (Kasten 1966).
double airMass(double elevation) {
  return 1.0 / (std::sin(elevation * std::numbers::pi / 180.0) + 0.15 * std::pow(elevation + 3.885, -1.253));
}

}  // namespace

Daylight daylightOf(const Sky& sky) {
  constexpr double kOzone = 0.35;                                      // cm
  constexpr double kDownOfHaze = 0.84, kDownOfAir = 0.5, kSoot = 0.1;  // of what is scattered, absorbed
  const double elevation = std::max(sky.elevation, 0.0);
  const double m = airMass(elevation);
  const double sine = std::sin(elevation * std::numbers::pi / 180.0);
  const double deep = 1.0 / (1.0 - m + std::pow(m, 1.02));
  Daylight light;
  double above = 0.0, down = 0.0;
  for (int nm = kFirst; nm <= kLast; nm += kStep) {
    const glm::dvec3 seen = observer(nm) * sunAbove(nm);
    const double um = nm * 1e-3;
    const double ofAir = std::exp(-opticalDepthOfAir(um) * m);
    const double ofHaze = std::exp(-opticalDepthOfHaze(sky.turbidity, um) * m);
    const double ofOzone = std::exp(-ozone(nm) * kOzone * m);
    above += seen.y;
    light.sun += seen * (ofAir * ofHaze * ofOzone);
    const double kept = 1.0 - kSoot * (1.0 - m + std::pow(m, 1.06)) * (1.0 - ofHaze);
    down += seen.y * ofOzone * kept *
            (kDownOfAir * (1.0 - ofAir) + kDownOfHaze * std::max(0.0, 1.0 - ofHaze / kept));
  }
  light.sun *= kSolarIlluminance / above * visibleDisk(sky.elevation);
  light.sky = kSolarIlluminance * sine * deep * down / above + kSunsetSky * twilight(sky.elevation);
  return light;
}

double hazeBefore(const Sky& sky, double height, double down) {
  // Both thin out with height as an exponential: these are the heights where 1/e of each is left (Nishita,
  // Sirai, Tadamura, Nakamae 1993), m.
  constexpr double kHeightOfHaze = 1200.0, kHeightOfAir = 7994.0, kGreen = 0.55;  // µm
  const double each = opticalDepthOfHaze(sky.turbidity, kGreen) / kHeightOfHaze +
                      opticalDepthOfAir(kGreen) / kHeightOfAir;  // 1/m at the ground
  // Koschmieder 1924. What lies right below is what the ground's colour is measured on: no air is before it.
  return 1.0 - std::exp(-each * height * (1.0 / down - 1.0));
}

glm::dvec3 linearFromXyz(const glm::dvec3& xyz) {
  static const glm::dmat3 rows(3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570);
  return xyz * rows;
}

}  // namespace whittle
