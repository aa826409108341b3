// Makes the rays of each kind, from the camera and from hits.
#include "bench/ray_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "wavefront/pixel_order.h"

namespace whittle {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A hash of (index, dimension) to [0, 1): the same rays on every run (lowbias32, Wellons 2018).
float hashUnit(std::size_t index, std::uint32_t dimension) {
  auto v = static_cast<std::uint32_t>(index) * 2654435769U + dimension * 0x85ebca6bU + 1U;
  v ^= v >> 16U;
  v *= 0x7feb352dU;
  v ^= v >> 15U;
  v *= 0x846ca68bU;
  v ^= v >> 16U;
  return static_cast<float>(v >> 8U) * 0x1p-24F;
}

glm::dvec3 sphereDirection(double u, double v) {
  const double z = 1 - 2 * u, r = std::sqrt(std::max(0.0, 1 - z * z)), phi = 2 * std::numbers::pi * v;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// A surface as a ray met it: point, normal towards the ray's origin, distance that rounding asks for.
struct Surface {
  glm::dvec3 point, normal;
  double rayOffset;
};

Surface surfaceAt(const Scene& scene, const QueryHit& hit, const glm::dvec3& along) {
  const Triangle& t = scene.triangles[static_cast<std::size_t>(hit.triangle)];
  const glm::dvec3 p0(scene.positions[t.v0]), p1(scene.positions[t.v1]), p2(scene.positions[t.v2]);
  const double b1 = hit.b1, b2 = hit.b2;
  Surface s;
  s.point = (1 - b1 - b2) * p0 + b1 * p1 + b2 * p2;
  s.normal = glm::normalize(glm::cross(p1 - p0, p2 - p0));
  if (glm::dot(s.normal, along) > 0) s.normal = -s.normal;
  const glm::dvec3 size = glm::max(glm::abs(p0), glm::max(glm::abs(p1), glm::abs(p2)));
  s.rayOffset = std::max(0x1p-20 * std::max({size.x, size.y, size.z}), 1e-30);
  return s;
}

/// Calls `each`(index, surface, incoming direction) for every hit with a usable normal.
template <typename Each>
void forHits(const Scene& scene, const RaySet& from, const std::vector<QueryHit>& hits, const Each& each) {
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].triangle < 0) continue;
    const glm::dvec3 d(from.direction(i));
    const Surface s = surfaceAt(scene, hits[i], d);
    if (std::isfinite(s.normal.x + s.normal.y + s.normal.z)) each(i, s, d);
  }
}

struct Box {
  glm::dvec3 lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};
};

Box boxOf(const Scene& scene) {
  Box box;
  for (const Triangle& t : scene.triangles)
    for (const std::uint32_t v : {t.v0, t.v1, t.v2}) {
      box.lo = glm::min(box.lo, glm::dvec3(scene.positions[v]));
      box.hi = glm::max(box.hi, glm::dvec3(scene.positions[v]));
    }
  return box;
}

/// With half of its longest side instead of each that is a thousandth of it or less.
Box withoutFlatSides(Box box) {
  const glm::dvec3 size = box.hi - box.lo;
  const double longest = std::max({size.x, size.y, size.z});
  for (int a = 0; a < 3; ++a)
    if (size[a] <= 1e-3 * longest) {
      const double missing = 0.5 * longest - size[a];
      box.lo[a] -= 0.5 * missing, box.hi[a] += 0.5 * missing;
    }
  return box;
}

glm::dvec3 lightPosition(const Scene& scene) {
  for (const Light& light : scene.lights)
    if (typeOf(light.kind).isPlaced) return glm::dvec3(light.position);
  const Box box = boxOf(scene);
  const glm::dvec3 size = box.hi - box.lo;
  return 0.5 * (box.lo + box.hi) +
         glm::dvec3(0.2 * size.x, 0.5 * size.y + 0.5 * glm::length(size), 0.3 * size.z);
}

}  // namespace

void RaySet::add(const glm::vec3& from, const glm::vec3& along, float far) {
  for (int a = 0; a < 3; ++a) {
    o[a].push_back(from[a]);
    d[a].push_back(along[a]);
  }
  length.push_back(far);
}

RaySet eyeRays(const Scene& scene, std::size_t count) {
  RaySet rays{"eye", {}, {}, {}};
  const auto width =
      static_cast<std::uint32_t>(std::clamp(std::sqrt(static_cast<double>(count) * 16 / 9), 1.0, 65535.0));
  const auto height = static_cast<std::uint32_t>(std::clamp<std::size_t>(count / width, 1, 65535));
  const Camera& camera = scene.cameras.front();
  const glm::dvec3 right(camera.right), up(camera.up), forward(camera.forward), position(camera.position);
  const double half = camera.orthographic ? camera.ymag : std::tan(0.5 * static_cast<double>(camera.yfov));
  for (const std::uint32_t packed :
       makePixelOrder({0, 0, static_cast<int>(width), static_cast<int>(height)})) {
    const double x = (2 * ((packed & 0xffffU) + 0.5) - width) / height,
                 y = 1 - 2 * ((packed >> 16U) + 0.5) / height;
    const glm::dvec3 offset = half * (x * right + y * up);
    if (camera.orthographic)
      rays.add(glm::vec3(position + offset), camera.forward, kInfinity);
    else
      rays.add(camera.position, glm::vec3(glm::normalize(offset + forward)), kInfinity);
  }
  return rays;
}

RaySet shadowRays(const Scene& scene, const RaySet& from, const std::vector<QueryHit>& hits) {
  RaySet rays{"shadow", {}, {}, {}};
  const glm::dvec3 light = lightPosition(scene);
  forHits(scene, from, hits, [&](std::size_t, const Surface& s, const glm::dvec3&) {
    const glm::dvec3 o = s.point + s.normal * s.rayOffset, to = light - o;
    const double length = glm::length(to);
    if (length > 0) rays.add(glm::vec3(o), glm::vec3(to / length), static_cast<float>(length));
  });
  return rays;
}

RaySet mirrorRays(const Scene& scene, const RaySet& from, const std::vector<QueryHit>& hits,
                  const std::string& kind) {
  RaySet rays{kind, {}, {}, {}};
  forHits(scene, from, hits, [&](std::size_t, const Surface& s, const glm::dvec3& d) {
    rays.add(glm::vec3(s.point + s.normal * s.rayOffset),
             glm::vec3(glm::normalize(glm::reflect(d, s.normal))), kInfinity);
  });
  return rays;
}

RaySet refractedRays(const Scene& scene, const RaySet& from, const std::vector<QueryHit>& hits) {
  RaySet rays{"refraction", {}, {}, {}};
  forHits(scene, from, hits, [&](std::size_t, const Surface& s, const glm::dvec3& d) {
    const glm::dvec3 in = glm::refract(d, s.normal, 1 / 1.5);
    const bool total = in == glm::dvec3(0);
    rays.add(glm::vec3(s.point + s.normal * (total ? s.rayOffset : -s.rayOffset)),
             glm::vec3(glm::normalize(total ? glm::reflect(d, s.normal) : in)), kInfinity);
  });
  return rays;
}

RaySet cosineRays(const Scene& scene, const RaySet& from, const std::vector<QueryHit>& hits) {
  RaySet rays{"cosine", {}, {}, {}};
  forHits(scene, from, hits, [&](std::size_t i, const Surface& s, const glm::dvec3&) {
    const glm::dvec3 d =
        glm::normalize(s.normal * (1 + 1e-9) + sphereDirection(hashUnit(i, 0), hashUnit(i, 1)));
    rays.add(glm::vec3(s.point + s.normal * s.rayOffset), glm::vec3(d), kInfinity);
  });
  return rays;
}

RaySet uniformRays(const Scene& scene, std::size_t count) {
  RaySet rays{"uniform", {}, {}, {}};
  if (scene.triangles.empty()) return rays;
  const Box box = withoutFlatSides(boxOf(scene));
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 u(hashUnit(i, 2), hashUnit(i, 3), hashUnit(i, 4));
    rays.add(glm::vec3(box.lo + u * (box.hi - box.lo)),
             glm::vec3(sphereDirection(hashUnit(i, 5), hashUnit(i, 6))), kInfinity);
  }
  return rays;
}

}  // namespace whittle
