// See emitters.h; formulas: README.md, "Direct light".
#include "reference/emitters.h"

#include <algorithm>
#include <array>
#include <utility>

#include "kernels/shared/layout.h"

namespace whittle::reference {
namespace {

using Corners = std::array<Vec3, 3>;

double areaOf(const Corners& p) { return glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / 2; }

Corners seenFrom(const Corners& p, const Vec3& point) {
  return {glm::normalize(p[0] - point), glm::normalize(p[1] - point), glm::normalize(p[2] - point)};
}

/// The tangent of half a spherical triangle's area is the first over the second (Van Oosterom, Strackee
/// 1983).
Vec2 halfTangent(const Corners& d) {
  return {std::abs(glm::dot(d[0], glm::cross(d[1], d[2]))),
          1 + glm::dot(d[0], d[1]) + glm::dot(d[1], d[2]) + glm::dot(d[2], d[0])};
}

/// What a triangle brings, for each of its radiance, roughly.
double received(const Corners& d, const Vec3& n) {
  const Vec2 t = halfTangent(d);
  const auto arctangent = [](double x) { return x / (1 + static_cast<double>(0.28F) * x * x); };
  const double half = t.x > std::abs(t.y) ? kPi / 2 - arctangent(t.y / t.x)
                      : t.y < 0           ? kPi + arctangent(t.x / t.y)
                                          : arctangent(t.x / t.y);
  double cosines = 0;
  for (const Vec3& w : {d[0], d[1], d[2], glm::normalize(d[0] + d[1] + d[2])})
    cosines += std::max(0.0, glm::dot(n, w));
  return 2 * half * cosines / 4;
}

struct Candidate {
  const Emitter* emitter = nullptr;
  double weight = 0;
};

Candidate candidateFor(const TriangleIndex& triangles, const std::vector<Emitter>& emitters,
                       const Surfel& lit, double u) {
  const auto drawn = std::find_if(emitters.begin(), emitters.end() - 1,
                                  [&](const Emitter& e) { return u < static_cast<double>(e.until); });
  const Corners p = triangles.corners(drawn->triangle);
  const bool isBehind = glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[0] - lit.position) > 0;
  const double weight = received(seenFrom(p, lit.position), lit.n) / (2 * areaOf(p));
  const bool shines = (drawn->twoSided || !isBehind) && weight > 0 && std::isfinite(weight);
  return {&*drawn, shines ? weight : 0};
}

/// One of a few by its weight, which becomes the mean of theirs over its own, and where in its share u lies;
/// those of one emitter have one share.
std::pair<Candidate, double> chosenFor(const TriangleIndex& triangles, const std::vector<Emitter>& emitters,
                                       const Surfel& lit, double offset, double u) {
  std::array<Candidate, EMITTER_CANDIDATES> all;
  double sum = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = candidateFor(triangles, emitters, lit, (static_cast<double>(i) + offset) / all.size());
    sum += all[i].weight;
  }
  const double wanted = u * sum;
  double before = 0;
  for (auto first = all.begin(); first != all.end();) {
    const auto end =
        std::find_if(first, all.end(), [&](const Candidate& c) { return c.emitter != first->emitter; });
    const double share = first->weight * static_cast<double>(end - first);
    const bool isLast = std::all_of(end, all.end(), [](const Candidate& c) { return c.weight == 0; });
    if (share > 0 && (isLast || wanted < before + share))
      return {{first->emitter, sum / static_cast<double>(all.size()) / first->weight},
              std::clamp((wanted - before) / share, 0.0, 1.0)};
    before += share;
    first = end;
  }
  return {};
}

/// Of the point where the direction meets the triangle's plane.
Vec3 weightsAlong(const Corners& p, const Vec3& from, const Vec3& w) {
  const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0], across = glm::cross(e1, e2);
  const Vec3 q = from + glm::dot(across, p[0] - from) / glm::dot(across, w) * w - p[0];
  const double b1 = std::clamp(glm::dot(glm::cross(q, e2), across) / glm::dot(across, across), 0.0, 1.0);
  const double b2 = std::clamp(glm::dot(glm::cross(e1, q), across) / glm::dot(across, across), 0.0, 1 - b1);
  return {1 - b1 - b2, b1, b2};
}

/// What of `v` is across the unit vector `axis`, as long as that.
Vec3 besides(const Vec3& v, const Vec3& axis) { return glm::normalize(v - glm::dot(v, axis) * axis); }

}  // namespace

Vec3 directionInto(const Corners& corners, double solidAngle, const Vec2& u) {
  const auto& [a, b, c] = corners;
  const Vec3 towardsB = besides(b, a), towardsC = besides(c, a);
  const double sine = glm::length(glm::cross(towardsB, towardsC)), cosine = glm::dot(towardsB, towardsC);
  // Of the part's area less the angle at a.
  const double angle = u.x * solidAngle - std::atan2(sine, cosine), s = std::sin(angle), t = std::cos(angle);
  const double x = t - cosine, y = s + sine * glm::dot(a, b);
  const double q = std::clamp(((y * t - x * s) * cosine - y) / ((y * s + x * t) * sine), -1.0, 1.0);
  const Vec3 end = u.x > 0 ? q * a + std::sqrt(1 - q * q) * towardsC : a;
  const double z = 1 - u.y * (1 - glm::dot(end, b));
  return z * b + std::sqrt(std::max(0.0, 1 - z * z)) * besides(end, b);
}

LightSample sampleEmitter(const Scene& scene, const Settings& settings, const TriangleIndex& triangles,
                          const std::vector<Emitter>& emitters, const Surfel& lit, double offset,
                          const Vec2& at) {
  const LightSample nothing{Vec3(0), 0, Vec3(0)};
  if (emitters.empty()) return nothing;
  const auto [chosen, within] = chosenFor(triangles, emitters, lit, offset, at.x);
  if (!(chosen.weight > 0)) return nothing;
  const Vec2 u(within, at.y);
  const Corners p = triangles.corners(chosen.emitter->triangle), d = seenFrom(p, lit.position);
  const Vec2 half = halfTangent(d);
  const double solidAngle = 2 * std::atan2(half.x, half.y), root = std::sqrt(u.x);
  const bool isWide = solidAngle >= LEAST_SOLID_ANGLE && solidAngle <= MOST_SOLID_ANGLE;
  const Vec3 weights = isWide ? weightsAlong(p, lit.position, directionInto(d, solidAngle, u))
                              : Vec3(1 - root, root * (1 - u.y), root * u.y);
  const Vec3 towards = weights.x * p[0] + weights.y * p[1] + weights.z * p[2] - lit.position;
  const double distance = glm::length(towards);
  if (!(distance > 0)) return nothing;
  const Ray ray{lit.position, towards / distance};
  const Surfel there =
      makeSurfel(scene, settings, triangles, ray, {chosen.emitter->triangle, distance, weights});
  const double facing = -glm::dot(there.facing, ray.direction);
  if (!(facing > 0)) return {ray.direction, distance, Vec3(0)};
  const double end = distance + 2 * (lit.rayOffset - std::max(lit.rayOffset, there.rayOffset) / facing);
  const double share = isWide ? solidAngle / areaOf(p) : facing / square(distance);
  return {ray.direction, end,
          there.alpha * there.emission *
              (chosen.weight * static_cast<double>(chosen.emitter->inverseDensity) * share)};
}

}  // namespace whittle::reference
