// buildTriTree: from triangles to boxes, through the builder, to one array of nodes.
// Reads positions and corner indices; writes a TriTree.
#include "bvh/tri_tree.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <stdexcept>

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

std::size_t countNodes(const Subtree& tree) {
  std::size_t count = tree.nodes.size();
  for (const auto& part : tree.parts) count += part ? countNodes(*part) : 0;
  return count;
}

/// Appends a subtree depth-first and frees it; returns the index of its first node.
std::int32_t append(std::unique_ptr<Subtree> tree, std::vector<TreeNode>& nodes) {
  const auto base = static_cast<std::int32_t>(nodes.size());
  for (TreeNode node : tree->nodes) {
    for (std::int32_t& child : node.child) child += child >= 0 ? base : 0;
    nodes.push_back(node);
  }
  for (int k = 0; k < 2; ++k) {
    if (!tree->parts[k]) continue;
    const std::int32_t child = append(std::move(tree->parts[k]), nodes);
    nodes[static_cast<std::size_t>(base)].child[k] = child;
  }
  return base;
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
  tree.nodes.reserve(countNodes(*top));
  adviseLargePages(tree.nodes.data(), tree.nodes.capacity() * sizeof(TreeNode));
  append(std::move(top), tree.nodes);
  return tree;
}

}  // namespace whittle
