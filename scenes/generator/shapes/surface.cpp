// Slopes of the function are differences over a small part of a square.
#include "shapes/surface.h"

#include <algorithm>

#include "shapes/skin.h"

namespace generator {
namespace {

/// How far the function moves along `step`, one-sided at a border in v.
glm::dvec3 slope(const SurfaceSpec& spec, glm::dvec2 at, glm::dvec2 step) {
  const auto inside = [](glm::dvec2 uv) { return glm::dvec2(uv.x, std::clamp(uv.y, 0.0, 1.0)); };
  return spec.position(inside(at + step)) - spec.position(inside(at - step));
}

}  // namespace

Mesh makeSurface(const SurfaceSpec& spec) {
  Mesh mesh;
  const glm::dvec2 cell(1.0 / spec.columns, 1.0 / spec.rows), small = 0.05 * cell;
  for (int row = 0; row <= spec.rows; ++row) {
    for (int column = 0; column <= spec.columns; ++column) {
      const glm::dvec2 uv(spec.isRound && column == spec.columns ? 0 : column * cell.x, row * cell.y);
      // Where a row is a point nothing moves along u: a little beside it something does.
      const glm::dvec2 beside(uv.x, std::clamp(uv.y, small.y, 1 - small.y));
      const glm::dvec3 along = slope(spec, beside, {small.x, 0}), up = slope(spec, uv, {0, small.y});
      addVertex(mesh, {spec.position(uv),
                       glm::cross(along, up),
                       along,
                       {column * cell.x * spec.repeat.x, (1 - uv.y) * spec.repeat.y}});
      if (spec.color) mesh.colors.emplace_back(glm::vec4(glm::vec3(spec.color(uv)), 1.0F));
    }
  }
  const auto rings = static_cast<std::uint32_t>(spec.rows) + 1,
             columns = static_cast<std::uint32_t>(spec.columns) + 1;
  sewRings(mesh, 0, rings, columns);
  return mesh;
}

}  // namespace generator
