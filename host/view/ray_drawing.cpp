// See ray_drawing.h.
#include "view/ray_drawing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/camera.h"

namespace whittle::view {
namespace {

class Projection {
 public:
  Projection(const Camera& camera, double aspect)
      : camera_(camera), half_(halfHeight(camera, aspect)), aspect_(aspect) {}

  /// The part of a line before the camera; nothing: all of it lies behind.
  std::optional<DrawnRay> operator()(glm::dvec3 from, glm::dvec3 to) const {
    constexpr double kNear = 1e-4;  // of the line's length
    const double least = kNear * std::max(1e-9, glm::length(to - from));
    if (!camera_.orthographic) {
      const double a = depth(from), b = depth(to);
      if (a < least && b < least) return std::nullopt;
      if (a < least) from += (to - from) * ((least - a) / (b - a));
      if (b < least) to += (from - to) * ((least - b) / (a - b));
    }
    DrawnRay drawn;
    place(from, drawn.x0, drawn.y0);
    place(to, drawn.x1, drawn.y1);
    return drawn;
  }

 private:
  double depth(const glm::dvec3& p) const {
    return glm::dot(p - glm::dvec3(camera_.position), glm::dvec3(camera_.forward));
  }
  void place(const glm::dvec3& p, double& x, double& y) const {
    const glm::dvec3 at = p - glm::dvec3(camera_.position);
    const double scale = camera_.orthographic ? 1.0 : 1.0 / depth(p);
    x = 0.5 + 0.5 * glm::dot(at, glm::dvec3(camera_.right)) * scale / (half_ * aspect_);
    y = 0.5 - 0.5 * glm::dot(at, glm::dvec3(camera_.up)) * scale / half_;
  }

  const Camera& camera_;
  double half_, aspect_;
};

Line lineOf(const RayRecord& ray, const RayTree& tree) {
  if (ray.parent < 0) return Line::Eye;
  switch (passageOf(ray, tree.rays[static_cast<std::size_t>(ray.parent)])) {
    case Passage::Reflected:
      return Line::Reflected;
    case Passage::Refracted:
      return Line::Refracted;
    case Passage::Straight:
      break;
  }
  return Line::Straight;
}

}  // namespace

std::vector<DrawnRay> drawnRays(const RayTree& tree, const Scene& scene, const Camera& camera,
                                double aspect) {
  const Bounds box = boundsOf(scene);
  const double size = glm::length(box.hi - box.lo);
  const Projection project(camera, aspect);
  std::vector<DrawnRay> drawn;
  const auto add = [&](Line line, const glm::dvec3& from, const glm::dvec3& to, std::size_t ray) {
    if (auto d = project(from, to)) {
      d->line = line, d->ray = ray;
      drawn.push_back(*d);
    }
  };
  for (std::size_t i = 0; i < tree.rays.size(); ++i) {
    const RayRecord& ray = tree.rays[i];
    const glm::dvec3 end = ray.hit ? ray.hit->position : ray.origin + size * ray.direction;
    const Line line = lineOf(ray, tree);
    // What goes straight on starts where its parent started.
    const bool isOn = line == Line::Straight && ray.parent >= 0;
    const RayRecord& parent = tree.rays[static_cast<std::size_t>(std::max(ray.parent, 0))];
    const glm::dvec3 from = line == Line::Eye ? end : isOn && parent.hit ? parent.hit->position : ray.origin;
    add(line, from, end, i);
    for (const ShadowRecord& s : ray.shadows) {
      const double length = std::isfinite(s.length) ? s.length : size;
      add(s.arrived == glm::dvec3(0) ? Line::Blocked : Line::Shadow, s.origin,
          s.origin + length * s.direction, i);
    }
  }
  return drawn;
}

std::optional<glm::dvec2> placeInPicture(const glm::dvec3& point, const Camera& camera, double aspect) {
  const auto drawn = Projection(camera, aspect)(point, point);
  return drawn ? std::optional(glm::dvec2(drawn->x0, drawn->y0)) : std::nullopt;
}

}  // namespace whittle::view
