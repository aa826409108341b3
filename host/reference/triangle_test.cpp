// The ray-triangle test in double precision. Differences of products are Kahan's (two fma), whose sign is
// never wrong: Jeannerod, Louvet, Muller, "Further analysis of Kahan's algorithm for the accurate
// computation of 2x2 determinants", 2013.
#include "reference/triangle_test.h"

#include <cmath>
#include <utility>

namespace whittle::reference {
namespace {

/// a·b − c·d.
double differenceOfProducts(double a, double b, double c, double d) {
  const double cd = c * d;
  const double error = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + error;
}

/// The corners where the ray runs along +z from the origin.
std::array<Vec3, 3> sheared(const ShearedRay& ray, const std::array<Vec3, 3>& corners) {
  std::array<Vec3, 3> c;
  for (int i = 0; i < 3; ++i) {
    const Vec3 p = corners[i] - ray.origin;
    c[i] = Vec3(p[ray.kx] - ray.shear.x * p[ray.kz], p[ray.ky] - ray.shear.y * p[ray.kz],
                ray.shear.z * p[ray.kz]);
  }
  return c;
}

/// Twice the area that the ray spans with the edge across from corner i.
double acrossEdge(const std::array<Vec3, 3>& c, int i) {
  const Vec3 &p = c[(i + 2) % 3], &q = c[(i + 1) % 3];
  return differenceOfProducts(p.x, q.y, p.y, q.x);
}

}  // namespace

ShearedRay::ShearedRay(const Ray& ray) : origin(ray.origin) {
  const Vec3 size = glm::abs(ray.direction);
  kz = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  kx = (kz + 1) % 3;
  ky = (kz + 2) % 3;
  if (ray.direction[kz] < 0) std::swap(kx, ky);  // keeps the winding
  shear = Vec3(ray.direction[kx], ray.direction[ky], 1.0) / ray.direction[kz];
}

bool ownsHit(const ShearedRay& ray, const std::array<Vec3, 3>& corners) {
  const auto c = sheared(ray, corners);
  double area = 0;
  for (int i = 0; i < 3; ++i) area += acrossEdge(c, i);
  for (int i = 0; i < 3; ++i) {
    if (acrossEdge(c, i) != 0) continue;
    const Vec3 &p = c[(i + 2) % 3], &q = c[(i + 1) % 3];
    const double side = p.y != q.y ? p.y - q.y : q.x - p.x;  // of a ray moved by (e, e²)
    if ((side > 0) != (area > 0)) return false;
  }
  return true;
}

std::optional<TriangleHit> intersect(const ShearedRay& ray, const std::array<Vec3, 3>& corners) {
  const auto c = sheared(ray, corners);
  const double u = acrossEdge(c, 0), v = acrossEdge(c, 1), w = acrossEdge(c, 2);
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return std::nullopt;
  const double det = u + v + w;
  if (det == 0) return std::nullopt;
  const double t = (u * c[0].z + v * c[1].z + w * c[2].z) / det;
  if (!(t > 0 && std::isfinite(t))) return std::nullopt;
  return TriangleHit{t, Vec3(u, v, w) / det};
}

}  // namespace whittle::reference
