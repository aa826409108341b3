// Trees and grass, made once and placed many times.
#pragma once

#include "mesh.h"

namespace generator {

struct TreeSpec {
  double height = 7;  ///< metres
  double trunkRadius = 0.2;
  int levels = 4;    ///< of branches, the trunk among them
  int children = 5;  ///< of each branch
  std::uint32_t series = 12000;
};

/// Wood and leaves, for two materials. The trunk stands on the origin.
struct Tree {
  Mesh wood, leaves;
};

Tree growTree(const TreeSpec& spec);

/// A tuft of bent blades of grass, about `height` metres tall; seen from both sides.
Mesh makeTuft(int blades, double height, double radius, std::uint32_t series);

}  // namespace generator
