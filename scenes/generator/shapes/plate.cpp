// Edges are the outline, drawn in by the quarter of a circle below and above; faces are triangulated between
// the outlines that remain.
#include "shapes/plate.h"

#include <algorithm>

#include "shapes/skin.h"
#include "shapes/triangulate.h"

namespace generator {
namespace {

glm::dvec3 onGround(glm::dvec2 p, double y) { return {p.x, y, -p.y}; }

void addEdges(Mesh& mesh, const Outline& outline, const PlateSpec& spec) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const std::size_t count = outline.points.size();
  const int rings = 2 * (spec.bevelSteps + 1);
  for (int ring = 0; ring < rings; ++ring) {
    const bool isAbove = ring > spec.bevelSteps;
    // From the face below (0) to the wall, and from the wall to the face above.
    const int step = isAbove ? ring - spec.bevelSteps - 1 : spec.bevelSteps - ring;
    const glm::dvec2 arc = onCircle(step, 4 * spec.bevelSteps);  // cosine: outwards, sine: up or down
    const double draw = spec.bevel * (1 - arc.x), lift = spec.bevel * (1 - arc.y);
    const double y = isAbove ? spec.height - lift : lift;
    for (std::size_t i = 0; i <= count; ++i) {
      const OutlinePoint& p = outline.points[i % count];
      addVertex(mesh, {.position = onGround(p.position - draw * p.normal, y),
                       .normal = onGround(arc.x * p.normal, isAbove ? arc.y : -arc.y),
                       .tangent = onGround({-p.normal.y, p.normal.x}, 0),
                       .uv = {p.position.x / spec.textureSize, -p.position.y / spec.textureSize}});
    }
  }
  sewRings(mesh, first, static_cast<std::uint32_t>(rings), static_cast<std::uint32_t>(count) + 1);
}

void addFace(Mesh& mesh, const std::vector<std::vector<glm::dvec2>>& loops, const PlateSpec& spec,
             bool isAbove) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& loop : loops) {
    for (const glm::dvec2 p : loop) {
      addVertex(mesh, {.position = onGround(p, isAbove ? spec.height : 0),
                       .normal = {0, isAbove ? 1 : -1, 0},
                       .tangent = {1, 0, 0},
                       .uv = {p.x / spec.textureSize, -p.y / spec.textureSize}});
      // Below, n × t points along +Z, which is down in the picture.
      if (!isAbove) mesh.tangents.back().w = -1;
    }
  }
  for (auto [a, b, c] : triangulate(loops)) {
    if (!isAbove) std::swap(b, c);
    mesh.indices.insert(mesh.indices.end(), {first + a, first + b, first + c});
  }
}

}  // namespace

Plate makePlate(const PlateSpec& spec) {
  Plate plate;
  std::vector<std::vector<glm::dvec2>> loops{inset(spec.outline, spec.bevel)};
  addEdges(plate.edges, spec.outline, spec);
  for (const Outline& hole : spec.holes) {
    loops.push_back(inset(hole, spec.bevel));
    addEdges(plate.edges, hole, spec);
  }
  addFace(plate.faces, loops, spec, true);
  addFace(plate.faces, loops, spec, false);
  return plate;
}

Mesh joined(const Plate& plate) {
  Mesh mesh = plate.edges;
  append(mesh, plate.faces);
  return mesh;
}

Mesh makeRoundedBox(glm::dvec3 low, glm::dvec3 high, double radius) {
  constexpr double kRoom = 1.02;  // corners of the faces keep a radius, however small
  PlateSpec spec;
  spec.outline = rectangleOutline({low.x, -high.z}, {high.x, -low.z}, kRoom * radius);
  spec.height = high.y - low.y;
  spec.bevel = radius;
  Mesh mesh = joined(makePlate(spec));
  for (glm::vec3& p : mesh.positions) p.y += static_cast<float>(low.y);
  return mesh;
}

}  // namespace generator
