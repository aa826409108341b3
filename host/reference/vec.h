// Double-precision vectors and the few helpers the reference needs beside glm.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace whittle::reference {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;

inline constexpr double kPi = 3.14159265358979323846;

inline double square(double x) { return x * x; }

inline bool isFinite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

inline double maxComponent(const Vec3& v) { return std::fmax(v.x, std::fmax(v.y, v.z)); }

inline bool anyPositive(const Vec3& v) { return v.x > 0 || v.y > 0 || v.z > 0; }
/// Nothing that could be seen. NaN is not dark: it must reach the film, to be counted.
inline bool isDark(const Vec3& v) { return v.x <= 0 && v.y <= 0 && v.z <= 0; }

/// Two unit vectors across an axis (unit) and each other: Duff et al., "Building an Orthonormal Basis,
/// Revisited", JCGT 2017.
struct Basis {
  Vec3 right, up;
};
inline Basis basisAbout(const Vec3& axis) {
  const double side = axis.z < 0 ? -1 : 1, a = -1 / (side + axis.z), b = axis.x * axis.y * a;
  return {Vec3(1 + side * axis.x * axis.x * a, side * b, -side * axis.x),
          Vec3(b, side + axis.y * axis.y * a, -axis.y)};
}

/// Rec. 709 luminance of linear RGB.
inline double luminance(const Vec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

}  // namespace whittle::reference
