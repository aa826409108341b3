// buildTriTree: from triangles to boxes, through the builder, to one array of nodes.
// Reads positions and corner indices; writes a TriTree.
#include "bvh/tri_tree.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bvh/chunks.h"
#include "bvh/prim_ref.h"
#include "bvh/tri_tree_builder.h"
#include "bvh/uninitialized.h"

namespace whittle {

namespace {

constexpr std::size_t kMaxTriangles = std::size_t{1} << 27;  // what a leaf's encoding can address

bool finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// False for a triangle that no ray can hit: a corner is not finite, or two corners are the same point.
bool hittable(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return finite(a) && finite(b) && finite(c) && a != b && b != c && c != a;
}

PrimRef makeRef(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, std::uint32_t index) {
  // + 0 turns -0 into 0: otherwise which zero survives a minimum would depend on the order of reduction.
  const glm::vec3 lo = glm::min(glm::min(a, b), c) + 0.0F;
  const glm::vec3 hi = glm::max(glm::max(a, b), c) + 0.0F;
  PrimRef ref{{lo.x, lo.y, lo.z, 0}, {hi.x, hi.y, hi.z, 0}};
  ref.setIndex(index);
  return ref;
}

/// Fills `refs` with the triangles that can be hit, in order, and returns their range and bounds.
BuildRange makeRefs(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                    std::span<PrimRef> refs) {
  std::vector<BuildRange> parts(chunkCount(triangles.size()));
  forEachChunk(triangles.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    BuildRange part;
    part.begin = part.end = static_cast<std::uint32_t>(begin);
    for (std::size_t i = begin; i < end; ++i) {
      const glm::uvec3 t = triangles[i];
      const glm::vec3 &a = positions[t.x], &b = positions[t.y], &c = positions[t.z];
      if (!hittable(a, b, c)) continue;
      const PrimRef ref = makeRef(a, b, c, static_cast<std::uint32_t>(i));
      part.box.grow({ref.lo, ref.hi});
      part.centroids.grow(ref.centroid2());
      refs[part.end++] = ref;
    }
    parts[chunk] = part;
  });
  BuildRange all;
  for (const BuildRange& part : parts) {
    if (all.end != part.begin) {
      std::copy(refs.begin() + part.begin, refs.begin() + part.end, refs.begin() + all.end);
    }
    all.end += part.size();
    all.box.grow(part.box);
    all.centroids.grow(part.centroids);
  }
  return all;
}

/// Where the nodes of a subtree go.
struct Place {
  const Subtree* tree;
  std::int32_t base;
};

/// Appends the places of a subtree and of its parts, depth-first, and tells it where its parts are, counted
/// from its own first node; returns how many nodes there are then.
std::int32_t placeNodes(Subtree& tree, std::int32_t base, std::vector<Place>& places) {
  places.push_back({&tree, base});
  std::int32_t end = base + static_cast<std::int32_t>(tree.nodes.size());
  for (int k = 0; k < 2; ++k) {
    if (!tree.parts[k]) continue;
    tree.nodes[0].child[k] = end - base;
    end = placeNodes(*tree.parts[k], end, places);
  }
  return end;
}

UninitializedVector<TreeNode> oneArray(std::unique_ptr<Subtree> top) {
  std::vector<Place> places;
  UninitializedVector<TreeNode> nodes(static_cast<std::size_t>(placeNodes(*top, 0, places)));
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
    const std::int32_t base = places[i].base;
    std::transform(places[i].tree->nodes.begin(), places[i].tree->nodes.end(), nodes.begin() + base,
                   [&](TreeNode node) {
                     for (std::int32_t& child : node.child) child += child >= 0 ? base : 0;
                     return node;
                   });
  });
  return nodes;
}

}  // namespace

TriTree buildTriTree(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                     const BuildOptions& options) {
  if (triangles.size() > kMaxTriangles)
    throw std::length_error(
        fmt::format("{} triangles are more than a tree can hold: {}", triangles.size(), kMaxTriangles));
  UninitializedVector<PrimRef> refs(triangles.size());
  const BuildRange all = makeRefs(positions, triangles, refs);
  TriTree tree;
  tree.order.resize(all.size());
  const TriTreeBuilder builder({refs.data(), all.size()}, tree.order, options);
  std::unique_ptr<Subtree> top = builder.build(all);
  UninitializedVector<PrimRef>().swap(refs);  // an assignment from {} would keep the memory
  tree.depth = top->depth;
  tree.nodes = oneArray(std::move(top));
  return tree;
}

}  // namespace whittle
