// The scene's place, and meshes that lie far from their own origin.
#include "gltf/origin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "gltf/accessor.h"
#include "gltf/mesh.h"

namespace whittle::gltf {

namespace {

/// Where the shown meshes lie.
Extent extentOf(const Document& document, const Hierarchy& hierarchy, Extents& extents) {
  Extent all;
  for (const int node : hierarchy.shown) {
    const int mesh = document.nodes[at(node)].mesh;
    if (mesh < 0) continue;
    const int skin = document.nodes[at(node)].skin;
    if (skin >= 0) {  // lies where its joints do, not where its node does
      for (const int joint : document.model.skins[at(skin)].joints)
        all.grow(glm::dvec3(hierarchy.toWorld[at(joint)][3]));
      continue;
    }
    const glm::dmat4& toWorld = hierarchy.toWorld[at(node)];
    for (const auto& primitive : document.model.meshes[at(mesh)].primitives) {
      const auto found = primitive.attributes.find("POSITION");
      if (found == primitive.attributes.end()) continue;
      const Extent& local = extents.of(found->second);
      if (local.isEmpty()) continue;
      for (int corner = 0; corner < 8; ++corner) {
        glm::dvec4 p(1.0);
        for (int a = 0; a < 3; ++a) p[a] = (corner >> a & 1 ? local.hi : local.lo)[a];
        all.grow(glm::dvec3(toWorld * p));
      }
    }
  }
  return all;
}

/// How coarse the floats of a mesh's positions are.
struct Coarseness {
  int mesh = -1;
  double farthest = 0.0;  ///< the largest coordinate, in the mesh's own space
  double step = 0.0;      ///< from it to the next float
  double size = 0.0;      ///< diagonal of the mesh's box

  double share() const { return size > 0.0 ? step / size : 0.0; }
};

/// From a number to the next float away from 0.
double floatStep(double value) {
  constexpr int kFraction = 23;  // bits of a float behind the leading one
  return value > 0.0 ? std::ldexp(1.0, std::ilogb(value) - kFraction) : 0.0;
}

/// Integers are exact: what their grid loses, its writer has chosen.
Coarseness coarsenessOf(const Document& document, int mesh, Extents& extents) {
  Coarseness found{mesh};
  Extent whole;
  for (const auto& primitive : document.model.meshes[at(mesh)].primitives) {
    if (!isDrawable(primitive)) continue;
    const int accessor = primitive.attributes.at("POSITION");
    const Extent& extent = extents.of(accessor);
    whole.grow(extent);
    if (isFloat(accessorAt(document, accessor))) found.farthest = std::max(found.farthest, extent.farthest());
  }
  found.step = floatStep(found.farthest);
  found.size = whole.diagonal();
  return found;
}

}  // namespace

glm::dvec3 originFor(const Document& document, const Hierarchy& hierarchy, Extents& extents) {
  constexpr double kFar = 64;  // of its size: rounding is a 260 000th of the size there
  const Extent extent = extentOf(document, hierarchy, extents);
  if (extent.isEmpty()) return glm::dvec3(0.0);
  const glm::dvec3 centre = extent.centre();
  const double size = extent.diagonal();
  if (!(glm::length(centre) > kFar * size)) return glm::dvec3(0.0);
  // The place of the first node that lies about where the scene does, so that a scene that was moved as a
  // whole comes out as before.
  for (const int node : hierarchy.shown) {
    const glm::dvec3 place(hierarchy.toWorld[at(node)][3]);
    if (glm::length(place - centre) <= kFar * size) return place;
  }
  return glm::round(centre);
}

void warnOfCoarsePositions(const Document& document, const Hierarchy& hierarchy, Extents& extents,
                           Notices& notices) {
  // A mesh that fills a thousand pixels is off by a tenth of one, and a surface of as many triangles is rough
  // by three degrees: from there on one sees it.
  constexpr double kVisible = 1e-4;
  std::set<int> meshes;
  for (const int node : hierarchy.shown) meshes.insert(document.nodes[at(node)].mesh);
  Coarseness worst;
  int others = -1;
  for (const int mesh : meshes) {
    if (mesh < 0) continue;
    const Coarseness found = coarsenessOf(document, mesh, extents);
    if (!(found.share() > kVisible)) continue;
    ++others;
    if (found.share() > worst.share()) worst = found;
  }
  if (others < 0) return;
  notices.warn(fmt::format(
      "the positions of meshes[{}]{} lie up to {:.0f} m from the mesh's own origin: single precision "
      "keeps them to {:.3g} m there, {:.2g} % of the mesh's size{}",
      worst.mesh, quotedName(document.model.meshes[at(worst.mesh)].name), worst.farthest, worst.step,
      100.0 * worst.share(), others > 0 ? fmt::format(" ({} more like it)", others) : ""));
}

}  // namespace whittle::gltf
