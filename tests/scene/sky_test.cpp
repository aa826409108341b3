// The sky: its distribution and colours against the paper's formulas, written out again here; what it and the
// sun send down against what others measured; and what a scene gets of it.
#include "scene/sky_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace whittle {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180.0;

struct Seen {
  double x, y, luminance;
};

Seen chromaticityOf(const glm::dvec3& rgb) {
  // sRGB to XYZ, IEC 61966-2-1.
  const double x = 0.4124 * rgb.x + 0.3576 * rgb.y + 0.1805 * rgb.z;
  const double y = 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
  const double z = 0.0193 * rgb.x + 0.1192 * rgb.y + 0.9505 * rgb.z;
  return {x / (x + y + z), y / (x + y + z), y};
}

double luminanceOf(const glm::dvec3& rgb) { return chromaticityOf(rgb).luminance; }

/// Perez' distribution with the paper's tables of coefficients: slope and intercept in turbidity.
double perez(const double (&table)[5][2], double t, double theta, double gamma) {
  double k[5];
  for (int i = 0; i < 5; ++i) k[i] = table[i][0] * t + table[i][1];
  return (1 + k[0] * std::exp(k[1] / std::cos(theta))) *
         (1 + k[2] * std::exp(k[3] * gamma) + k[4] * std::pow(std::cos(gamma), 2));
}

/// x, y, and the luminance over that of the zenith: formulas 3 and 4 and appendix A.2 of the paper, to its
/// own four digits.
Seen paper(double t, double thetaSun, double theta, double gamma) {
  constexpr double ofY[5][2]{
      {0.1787, -1.4630}, {-0.3554, 0.4275}, {-0.0227, 5.3251}, {0.1206, -2.5771}, {-0.0670, 0.3703}};
  constexpr double ofX[5][2]{
      {-0.0193, -0.2592}, {-0.0665, 0.0008}, {-0.0004, 0.2125}, {-0.0641, -0.8989}, {-0.0033, 0.0452}};
  constexpr double ofSmallY[5][2]{
      {-0.0167, -0.2608}, {-0.0950, 0.0092}, {-0.0079, 0.2102}, {-0.0441, -1.6537}, {-0.0109, 0.0529}};
  const double s = thetaSun, s2 = s * s, s3 = s2 * s, t2 = t * t;
  const double x = t2 * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
                   t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
                   (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886);
  const double y = t2 * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) +
                   t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
                   (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688);
  const auto over = [&](const double(&table)[5][2]) {
    return perez(table, t, theta, gamma) / perez(table, t, 0, thetaSun);
  };
  return {x * over(ofX), y * over(ofSmallY), over(ofY)};
}

/// Unit, from angles: down from the zenith, and about it from +Z towards +X.
glm::dvec3 along(double theta, double about) {
  return {std::sin(theta) * std::sin(about), std::cos(theta), std::sin(theta) * std::cos(about)};
}

TEST(Sky, HasTheDistributionAndTheColoursOfThePaper) {
  for (const double turbidity : {2.0, 3.0, 6.0})
    for (const double elevation : {10.0, 45.0, 75.0}) {
      const double thetaSun = (90 - elevation) * kDegree;
      const SkyModel sky({elevation, 30, turbidity});
      const double zenith = luminanceOf(sky.radiance({0, 1, 0}));
      for (const double theta : {0.0, 25.0, 60.0, 85.0})
        for (const double about : {0.0, 50.0, 130.0, 180.0}) {
          SCOPED_TRACE(testing::Message() << "turbidity " << turbidity << ", sun " << elevation << "°, at "
                                          << theta << "°, " << about << "° beside it");
          const double cosine = std::sin(theta * kDegree) * std::sin(thetaSun) * std::cos(about * kDegree) +
                                std::cos(theta * kDegree) * std::cos(thetaSun);
          const Seen right = paper(turbidity, thetaSun, theta * kDegree, std::acos(std::min(1.0, cosine)));
          const Seen seen = chromaticityOf(sky.radiance(along(theta * kDegree, (30 + about) * kDegree)));
          // sRGB's matrix and its published inverse agree to four digits.
          EXPECT_NEAR(seen.x, right.x, 2e-4);
          EXPECT_NEAR(seen.y, right.y, 2e-4);
          EXPECT_NEAR(seen.luminance / zenith, right.luminance, 1e-3 * right.luminance);
        }
    }
}

/// The clear sky of the IES (Gillette, Pierpoint, Treado 1984): fits of measured illuminance, lx.
double iesSun(double elevation) { return 127.5e3 * std::exp(-0.21 / std::sin(elevation * kDegree)); }
double iesSky(double elevation) { return 800 + 15.5e3 * std::sqrt(std::sin(elevation * kDegree)); }

TEST(Sky, SunAndSkySendDownWhatIsMeasuredOnClearDays) {
  for (const double elevation : {15.0, 30.0, 45.0, 60.0, 75.0}) {
    const Daylight light = daylightOf({elevation, 0, 2});
    // The fits have one clear day for all places; its sun is that of turbidity 2. The sky of the same days
    // differs more than their sun.
    EXPECT_NEAR(light.sun.y / iesSun(elevation), 1, 0.06) << elevation;
    EXPECT_NEAR(light.sky / iesSky(elevation), 1, 0.4) << elevation;
    const double ratio = light.sun.y * std::sin(elevation * kDegree) / light.sky;
    const double measured = iesSun(elevation) * std::sin(elevation * kDegree) / iesSky(elevation);
    EXPECT_NEAR(ratio / measured, 1, 0.4) << elevation;
  }
}

TEST(Sky, SendsDownNoMoreThanArrives) {
  for (const double turbidity : {1.7, 2.0, 4.0, 10.0})
    for (double elevation = 0; elevation <= 90; elevation += 2.5) {
      const Daylight light = daylightOf({elevation, 0, turbidity});
      const double sine = std::sin(elevation * kDegree);
      EXPECT_LT(light.sun.y * sine + light.sky, 133.3e3 * sine + 801) << elevation << ", " << turbidity;
      EXPECT_GT(light.sky, 799) << elevation << ", " << turbidity;
    }
}

/// What the map sends onto a level surface: W/m², linear sRGB.
glm::dvec3 irradianceOf(const Background& b) {
  glm::dvec3 sum(0);
  for (int row = 0; row < b.height / 2; ++row) {
    const double theta = (row + 0.5) / b.height * kPi;
    const double weight = std::cos(theta) * std::sin(theta) * (kPi / b.height) * (2 * kPi / b.width);
    for (int column = 0; column < b.width; ++column)
      for (int c = 0; c < 3; ++c)
        sum[c] +=
            weight * static_cast<double>(b.map[3 * (static_cast<std::size_t>(row) * b.width + column) + c]);
  }
  return sum;
}

TEST(Sky, AddsAMapAndASunThatBelongTogether) {
  for (const double turbidity : {1.7, 3.0, 10.0})
    for (const double elevation : {0.0, 5.0, 40.0, 90.0}) {
      SCOPED_TRACE(testing::Message() << "turbidity " << turbidity << ", sun " << elevation << "°");
      Scene scene;
      scene.lights.resize(1);
      const Sky sky{elevation, 200, turbidity};
      addSky(scene, sky);
      ASSERT_EQ(scene.lights.size(), 2U);
      const Light& sun = scene.lights[1];
      EXPECT_EQ(sun.kind, LightKind::Directional);
      const glm::dvec3 towards = along((90 - elevation) * kDegree, 200 * kDegree);
      EXPECT_NEAR(glm::length(glm::dvec3(sun.direction) + towards), 0, 1e-6);
      const Background& b = scene.background;
      EXPECT_TRUE(b.hasSun);
      for (const float v : b.map) ASSERT_TRUE(std::isfinite(v) && v >= 0.0F);
      // Some of the ground is dark at no hour, and it has the light of both: π L = albedo (E_sky + E_sun
      // sin).
      const glm::dvec3 level = irradianceOf(b),
                       ofSun = glm::dvec3(sun.intensity) * std::sin(elevation * kDegree);
      const double lux = daylightOf(sky).sky;
      const double luminous = luminanceOf(level) * kLumensPerWatt;
      // Colours beyond sRGB are cut: with a low sun in haze that adds to the luminance.
      EXPECT_NEAR(luminous / lux, 1, turbidity > 5 ? 0.02 : 5e-3);
      const float* const below = &b.map[b.map.size() - 3];
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<double>(below[c]), kGroundAlbedo / kPi * (level[c] + ofSun[c]),
                    5e-3 * static_cast<double>(below[c]))
            << "rows are no Gauss points";
    }
}

/// As kernels and reference look it up: bilinear between the middles of texels.
glm::dvec3 lookedUp(const Background& b, const glm::dvec3& d) {
  const double u = 0.5 + std::atan2(d.x, -d.z) / (2 * kPi), v = std::acos(d.y) / kPi;
  const double x = u * b.width - 0.5, y = v * b.height - 0.5;
  const double fx = x - std::floor(x), fy = y - std::floor(y);
  glm::dvec3 sum(0);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const int column = (static_cast<int>(std::floor(x)) + i + b.width) % b.width;
      const int row = std::clamp(static_cast<int>(std::floor(y)) + j, 0, b.height - 1);
      const float* const rgb = &b.map[3 * (static_cast<std::size_t>(row) * b.width + column)];
      sum += (i ? fx : 1 - fx) * (j ? fy : 1 - fy) * glm::dvec3(rgb[0], rgb[1], rgb[2]);
    }
  return sum;
}

TEST(Sky, TheMapIsFineEnough) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit;
  for (const double elevation : {2.0, 30.0, 80.0}) {
    const Sky sky{elevation, 77, 2.0};
    const SkyModel model(sky);
    Scene scene;
    addSky(scene, sky);
    double worst = 0, squares = 0;
    constexpr int kDirections = 20000;
    for (int i = 0; i < kDirections; ++i) {
      // A row above the horizon, where the ground begins to blend in.
      const double y = std::lerp(std::sin(0.5 * kDegree), 1.0, unit(random));
      const glm::dvec3 d = along(std::acos(y), 2 * kPi * unit(random));
      const double right = luminanceOf(model.radiance(d));
      const double off = std::abs(luminanceOf(lookedUp(scene.background, d)) / right - 1);
      worst = std::max(worst, off);
      squares += off * off;
    }
    // Where curves bend by κ a texel of width h is off by h²κ/8. The glow about the sun has a cusp instead:
    // its slope, 2.3 per radian, times a quarter of a texel's 0.35° and the glow's share of what is seen
    // there.
    EXPECT_LT(worst, 0.004) << elevation;
    EXPECT_LT(std::sqrt(squares / kDirections), 1e-4) << elevation;
  }
}

TEST(Sky, SunsAreRedInTheEveningAndTheZenithIsBlueAtNoon) {
  const glm::dvec3 noon = SkyModel({60, 0, 3}).sunIrradiance(), evening = SkyModel({1, 0, 3}).sunIrradiance();
  EXPECT_GT(noon.y, 0.8 * noon.x) << "nearly white";
  EXPECT_GT(evening.x, 3 * evening.y);
  EXPECT_LT(luminanceOf(evening), 0.05 * luminanceOf(noon));
  const glm::dvec3 zenith = SkyModel({60, 0, 3}).radiance({0, 1, 0});
  EXPECT_GT(zenith.z, 2 * zenith.x);
  const SkyModel dusk({1, 0, 3});
  const glm::dvec3 glow = dusk.radiance(along(88 * kDegree, 0));
  EXPECT_GT(glow.x, 2 * glow.z);
  for (double elevation = 0, last = 0; elevation <= 90; elevation += 1) {
    const double sun = luminanceOf(SkyModel({elevation, 0, 3}).sunIrradiance());
    EXPECT_GT(sun, last) << elevation;
    last = sun;
  }
}

TEST(Sky, DuskIsAsBrightAsItIsMeasured) {
  // Clear evenings after the Glossary of Meteorology of the American Meteorological Society: 585 to 410 lx
  // when the sun's upper limb sets, 3.5 to 2 lx at the end of civil twilight. The fit's own error is 0.02 in
  // the logarithm, 5 %.
  const auto lux = [](double elevation) { return daylightOf({elevation, 0, 3}).sky; };
  EXPECT_GT(lux(-50.0 / 60), 410);
  EXPECT_LT(lux(-50.0 / 60), 585);
  EXPECT_GT(lux(-6), 2);
  EXPECT_LT(lux(-6), 3.5 * 1.05);
  for (double elevation = 0; elevation > kLowestSun; elevation -= 0.05) {
    EXPECT_LT(lux(elevation - 0.05), lux(elevation)) << elevation;
    EXPECT_GT(lux(elevation - 0.05), 0.9 * lux(elevation))
        << elevation << ": no step; a degree halves it or more";
  }
}

TEST(Sky, TheSunSetsWhenTheAirNoLongerLiftsIt) {
  const auto sun = [](double elevation) { return daylightOf({elevation, 0, 3}).sun.y; };
  // 34' of refraction, 16' of radius: whole at -18', half at -34', gone at -50'.
  EXPECT_DOUBLE_EQ(sun(-18.0 / 60), sun(0));
  EXPECT_NEAR(sun(-34.0 / 60) / sun(0), 0.5, 1e-9);
  EXPECT_GT(sun(-49.0 / 60), 0);
  EXPECT_EQ(sun(-51.0 / 60), 0);
  for (const double elevation : {-0.5, -3.0}) {
    Scene scene;
    addSky(scene, {elevation, 200, 3});
    ASSERT_EQ(scene.lights.size(), elevation > -0.84 ? 1U : 0U);
    for (const Light& light : scene.lights) EXPECT_EQ(light.direction.y, 0.0F) << "none from below";
    for (const float v : scene.background.map) ASSERT_TRUE(std::isfinite(v) && v >= 0.0F);
    EXPECT_NEAR(
        luminanceOf(irradianceOf(scene.background)) * kLumensPerWatt / daylightOf({elevation, 0, 3}).sky, 1,
        5e-3);
    // The evening side is the brighter one.
    const SkyModel dusk({elevation, 200, 3});
    EXPECT_GT(luminanceOf(dusk.radiance(along(85 * kDegree, 200 * kDegree))),
              3 * luminanceOf(dusk.radiance(along(85 * kDegree, 20 * kDegree))));
  }
}

/// What is left of a contrast at the distance of the meteorological range: 2 % (Koschmieder).
TEST(Sky, HazeTakesTheGroundAway) {
  for (const double turbidity : {2.0, 3.0, 10.0}) {
    const Sky sky{30, 120, turbidity};
    const SkyModel model(sky);
    const glm::dvec3 ground = model.radiance({0, -1, 0});
    // Vertical optical depths at 550 nm, and the heights that they stand for.
    const double each = (0.04608 * turbidity - 0.04586) * std::pow(0.55, -1.3) / 1200 +
                        0.008735 * std::pow(0.55, -4.08) / 7994;
    const double range = std::log(50) / each, down = kEyeHeight / (range + kEyeHeight);
    const auto below = [&](double sine) { return along(kPi / 2 + std::asin(sine), 77 * kDegree); };
    const glm::dvec3 horizon = model.radiance(along(kPi / 2 - 1e-9, 77 * kDegree));
    EXPECT_NEAR(glm::distance(model.radiance(below(1e-9)), horizon) / glm::length(horizon), 0, 1e-5)
        << "no edge at the horizon";
    const glm::dvec3 left = (model.radiance(below(down)) - horizon) / (ground - horizon);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(left[c], 0.02, 1e-6) << turbidity;
  }
}

TEST(Sky, AzimuthTurnsAboutTheVertical) {
  // 90° beside the sun at azimuth 0 is what lies 90° beside one at 135.
  const glm::dvec3 a = SkyModel({20, 0, 4}).radiance(along(70 * kDegree, 90 * kDegree));
  const glm::dvec3 b = SkyModel({20, 135 - 720, 4}).radiance(along(70 * kDegree, 225 * kDegree));
  EXPECT_NEAR(glm::length(a - b) / glm::length(a), 0, 1e-10);
}

TEST(Sky, LimitsHold) {
  EXPECT_TRUE(isInRange(Sky{-6, 0, kLeastTurbidity}));
  EXPECT_TRUE(isInRange(Sky{90, -1e6, kMostTurbidity}));
  for (const Sky& out : {Sky{-6.1, 0, 3}, Sky{90.1, 0, 3}, Sky{45, NAN, 3}, Sky{NAN, 0, 3}, Sky{45, 0, 1.69},
                         Sky{45, 0, 10.1}, Sky{45, INFINITY, 3}})
    EXPECT_FALSE(isInRange(out));
}

}  // namespace
}  // namespace whittle
