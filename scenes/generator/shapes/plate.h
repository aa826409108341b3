// Plates: an outline with holes, extruded, with rounded edges. Wheels, bridges of a clockwork, boards, boxes.
#pragma once

#include "mesh.h"
#include "shapes/outline.h"

namespace generator {

/// A plate lies on y = 0 and is `height` thick. The outline's x and y run along +X and -Z, so that what is
/// counter-clockwise on paper is so from above. All edges are rounded with the radius `bevel`, which is at
/// most half the height and less than the radius of any corner that bulges out.
struct PlateSpec {
  Outline outline;
  std::vector<Outline> holes{};  ///< clockwise: reversed()
  double height = 1;
  double bevel = 0.1;
  int bevelSteps = 4;
  /// Size of the square of the top that a texture covers, in the mesh's unit; uv0 (0, 0) is at the origin.
  double textureSize = 1;
};

/// Face above and below, and the edges around, for two materials. Together they are watertight.
struct Plate {
  Mesh faces, edges;
};

Plate makePlate(const PlateSpec& spec);

/// Both in one mesh.
Mesh joined(const Plate& plate);

/// A box with rounded edges: a plate of a rounded rectangle.
Mesh makeRoundedBox(glm::dvec3 low, glm::dvec3 high, double radius);

}  // namespace generator
