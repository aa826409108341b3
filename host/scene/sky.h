// Which sky surrounds the scene. What it looks like is in sky_model.h.
#pragma once

namespace whittle {

/// A clear sky with its sun.
struct Sky {
  double elevation = 45.0;  ///< of the sun, degrees above the horizon, [kLowestSun, 90]
  double azimuth = 0.0;     ///< of the sun, degrees from +Z towards +X, as --orbit counts
  double turbidity =
      3.0;  ///< haze: all of the air over its molecules alone; [kLeastTurbidity, kMostTurbidity]
  bool operator==(const Sky&) const = default;
};

inline constexpr double kLeastTurbidity = 1.7, kMostTurbidity = 10.0;
inline constexpr double kLowestSun = -6.0;  ///< the end of civil twilight: below it stars and the moon count

/// Written so that NaN is out of range.
constexpr bool isInRange(const Sky& s) {
  return s.elevation >= kLowestSun && s.elevation <= 90.0 && s.azimuth >= -1e18 && s.azimuth <= 1e18 &&
         s.turbidity >= kLeastTurbidity && s.turbidity <= kMostTurbidity;
}

/// What is asked for instead of the file's sky.
struct SkyChoice {
  bool isNone = false;  ///< no sky, whatever the file says
  Sky sky;
  bool operator==(const SkyChoice&) const = default;
};

}  // namespace whittle
