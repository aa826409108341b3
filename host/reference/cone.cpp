// See cone.h; the formulas are README.md's, "Footprints".
#include "reference/cone.h"

#include <algorithm>

#include "scene/camera.h"

namespace whittle::reference {
namespace {

constexpr double kGrazing = 1.0 / 16;

double clampedCosine(const Vec3& a, const Vec3& b) { return std::max(std::abs(glm::dot(a, b)), kGrazing); }

std::array<Vec3, 3> cornersOf(const Scene& scene, std::uint32_t triangle) {
  const Triangle& t = scene.triangles[triangle];
  return {Vec3(scene.positions[t.v0]), Vec3(scene.positions[t.v1]), Vec3(scene.positions[t.v2])};
}

}  // namespace

Cone eyeCone(const Camera& camera, const Settings& settings, const Ray& ray, std::uint32_t sample) {
  const double aspect = static_cast<double>(settings.width) / settings.height;
  const double pixel = 2 * halfHeight(camera, aspect) / settings.height, share = 1 / std::sqrt(sample + 1.0);
  if (camera.orthographic) return {share * pixel, 0};
  const double cosine = std::max(0.0, glm::dot(ray.direction, Vec3(camera.forward)));
  return {0, share * pixel * std::pow(cosine, 1.5)};
}

double widthAt(const Cone& cone, double t) { return std::abs(cone.width + t * cone.spread); }

Cone afterImpulse(const Cone& cone, double width, const Surfel& surfel, const Vec3& direction,
                  const Impulse& impulse) {
  const double in = clampedCosine(surfel.n, direction), out = clampedCosine(surfel.n, impulse.w_i);
  const double turn = surfel.bend * width;  // of the normal, over the width of the cone
  const auto limited = [](double spread) { return std::clamp(spread, -1.0, 1.0); };
  if (glm::dot(surfel.n, impulse.w_i) > 0) {
    const double inPlane = 2 * turn / in, across = 2 * turn * in;
    return {width, limited(cone.spread + (inPlane + across) / 2)};
  }
  const double eta = 1 / (impulse.splits ? impulse.eta : surfel.eta);  // the index here over that beyond
  const double inPlane = eta * in / out * cone.spread - turn / in * (1 - eta * in / out);
  const double across = eta * cone.spread - turn * (out - eta * in);
  return {(width + width * out / in) / 2, limited((inPlane + across) / 2)};
}

double bendOf(const Scene& scene, std::uint32_t triangle) {
  if (scene.normals.empty()) return 0;
  const Triangle& t = scene.triangles[triangle];
  const std::array<Vec3, 3> n{Vec3(scene.normals[t.v0]), Vec3(scene.normals[t.v1]),
                              Vec3(scene.normals[t.v2])};
  if (std::any_of(n.begin(), n.end(), [](const Vec3& v) { return v == Vec3(0); })) return 0;
  // The divergence is the trace of (change of the normal) · (change of the place)⁻¹, the latter in the plane.
  const auto [p0, p1, p2] = cornersOf(scene, triangle);
  const Vec3 e1 = p1 - p0, e2 = p2 - p0, m1 = n[1] - n[0], m2 = n[2] - n[0];
  const double a = glm::dot(e1, e1), b = glm::dot(e1, e2), c = glm::dot(e2, e2), determinant = a * c - b * b;
  const double trace =
      (c * glm::dot(m1, e1) - b * (glm::dot(m1, e2) + glm::dot(m2, e1)) + a * glm::dot(m2, e2)) / determinant;
  return std::isfinite(trace) ? trace / 2 : 0;
}

Footprint footprintOf(const Scene& scene, const Ray& ray, std::uint32_t triangle, int uvSet, double width) {
  const auto& uvs = uvSet == 1 ? scene.uv1 : scene.uv0;
  if (uvs.empty()) return {};
  const auto corners = cornersOf(scene, triangle);
  const Vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0], n = glm::cross(e1, e2);
  const Triangle& t = scene.triangles[triangle];
  const Vec2 u0(uvs[t.v0]), u1(uvs[t.v1]), u2(uvs[t.v2]);
  const Basis across = basisAbout(ray.direction);
  const auto moved = [&](const Vec3& sideways) {
    // The step on the surface that a step sideways of the ray makes, as parts of the triangle's edges.
    const Vec3 step =
        width * (sideways - ray.direction * (glm::dot(sideways, n) / glm::dot(ray.direction, n)));
    const double b1 = glm::dot(glm::cross(step, e2), n) / glm::dot(n, n);
    const double b2 = glm::dot(glm::cross(e1, step), n) / glm::dot(n, n);
    return b1 * (u1 - u0) + b2 * (u2 - u0);
  };
  return {moved(across.right), moved(across.up)};
}

}  // namespace whittle::reference
