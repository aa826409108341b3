// How many nodes, leaves and triangles does a ray visit in Whittle's eight-wide tree, and how many in one
// that Embree's builder makes (rtcBuildBVH: eight children, blocks of
// four triangles)? The same plain walk counts in both: the nearest child first, what lies behind the hit left
// out; any hit takes children as they stand. Beside it how many of the packets of sixteen rays would go
// together. Tab-separated lines to standard output. usage: visits [--rays N] SCENE.glb ...
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "bench/query_runner.h"
#include "bvh/bvh8.h"
#include "gltf/loader.h"

namespace whittle {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kPacket = 16, kBlock = 4;  // rays of our packets; triangles of Embree's blocks
constexpr float kSpread = 0.35F;                 // PACKET_SPREAD of the kernels

/// Nodes as Whittle has them, triangles of leaves in `order`.
struct WideTree {
  std::vector<Bvh8Node> nodes;
  std::vector<std::uint32_t> order;
};

WideTree ourTree(const TriTree& tree) {
  const Bvh8 wide = buildBvh8(tree);
  return {{wide.nodes.begin(), wide.nodes.end()}, tree.order};
}

/// What Embree's builder is given and gives back: nodes on the heap, and then one array.
struct EmbreeNode {
  RTCBounds box[8];
  EmbreeNode* child[8] = {};
  std::vector<std::uint32_t> triangles;  // of a leaf
  unsigned count = 0;
};

void* makeInner(RTCThreadLocalAllocator, unsigned count, void*) {
  auto* node = new EmbreeNode;
  node->count = count;
  return node;
}

void takeChildren(void* node, void** children, unsigned count, void*) {
  for (unsigned k = 0; k < count; ++k)
    static_cast<EmbreeNode*>(node)->child[k] = static_cast<EmbreeNode*>(children[k]);
}

void takeBounds(void* node, const RTCBounds** boxes, unsigned count, void*) {
  for (unsigned k = 0; k < count; ++k) static_cast<EmbreeNode*>(node)->box[k] = *boxes[k];
}

void* makeLeaf(RTCThreadLocalAllocator, const RTCBuildPrimitive* primitives, std::size_t count, void*) {
  auto* node = new EmbreeNode;
  for (std::size_t i = 0; i < count; ++i) node->triangles.push_back(primitives[i].primID);
  return node;
}

/// Appends the subtree of an inner node, which it deletes; returns the node's index.
std::int32_t flatten(EmbreeNode* from, WideTree& out) {
  const auto index = static_cast<std::int32_t>(out.nodes.size());
  out.nodes.emplace_back();
  for (unsigned k = 0; k < 8; ++k) {
    const bool there = k < from->count;
    const RTCBounds b = there ? from->box[k] : RTCBounds{kInfinity,  kInfinity,  kInfinity,  0,
                                                         -kInfinity, -kInfinity, -kInfinity, 0};
    const float lo[3] = {b.lower_x, b.lower_y, b.lower_z}, hi[3] = {b.upper_x, b.upper_y, b.upper_z};
    std::int32_t child = 0;
    if (there && from->child[k]->count > 0) {
      child = flatten(from->child[k], out);
    } else if (there) {
      const std::vector<std::uint32_t>& own = from->child[k]->triangles;
      child = ~static_cast<std::int32_t>(out.order.size() << 3U | (own.size() - 1));
      out.order.insert(out.order.end(), own.begin(), own.end());
      delete from->child[k];
    }
    Bvh8Node& node = out.nodes[static_cast<std::size_t>(index)];
    for (int a = 0; a < 3; ++a) node.lo[a][k] = lo[a], node.hi[a][k] = hi[a];
    node.child[k] = child;
  }
  delete from;
  return index;
}

/// `triangles`: those that can be hit.
WideTree embreeTree(const Scene& scene, const std::vector<std::uint32_t>& triangles) {
  std::vector<RTCBuildPrimitive> boxes;
  for (const std::uint32_t i : triangles) {
    const Triangle& t = scene.triangles[i];
    const glm::vec3 a = scene.positions[t.v0], b = scene.positions[t.v1], c = scene.positions[t.v2];
    const glm::vec3 lo = glm::min(a, glm::min(b, c)), hi = glm::max(a, glm::max(b, c));
    boxes.push_back({lo.x, lo.y, lo.z, 0, hi.x, hi.y, hi.z, i});
  }
  const RTCDevice device = rtcNewDevice("");
  const RTCBVH bvh = rtcNewBVH(device);
  RTCBuildArguments args = rtcDefaultBuildArguments();
  args.maxBranchingFactor = 8;
  args.sahBlockSize = kBlock;
  args.minLeafSize = kBlock;
  args.maxLeafSize = 8;
  args.bvh = bvh;
  args.primitives = boxes.data();
  args.primitiveCount = args.primitiveArrayCapacity = boxes.size();
  args.createNode = makeInner;
  args.setNodeChildren = takeChildren;
  args.setNodeBounds = takeBounds;
  args.createLeaf = makeLeaf;
  WideTree tree;
  flatten(static_cast<EmbreeNode*>(rtcBuildBVH(&args)), tree);
  rtcReleaseBVH(bvh);
  rtcReleaseDevice(device);
  return tree;
}

struct Visits {
  double nodes = 0, leaves = 0, blocks = 0, triangles = 0;
};

/// The distance of a hit, or infinite (Möller, Trumbore 1997: only counted with).
float meet(const Scene& scene, std::uint32_t index, const glm::vec3& o, const glm::vec3& d) {
  const Triangle& t = scene.triangles[index];
  const glm::vec3 a = scene.positions[t.v0], ab = scene.positions[t.v1] - a, ac = scene.positions[t.v2] - a;
  const glm::vec3 p = glm::cross(d, ac);
  const float det = glm::dot(ab, p);
  const glm::vec3 from = o - a, q = glm::cross(from, ab);
  const float u = glm::dot(from, p) / det, v = glm::dot(d, q) / det, at = glm::dot(ac, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && at > 0 ? at : kInfinity;
}

/// A child that waits, and where it is entered.
struct Waiting {
  float entry;
  std::int32_t child;
};

void walk(const Scene& scene, const WideTree& tree, const RaySet& rays, std::size_t i, bool nearest,
          Visits& sum) {
  const glm::vec3 o(rays.o[0][i], rays.o[1][i], rays.o[2][i]), d = rays.direction(i), inverse = 1.0F / d;
  float t = nearest ? kInfinity : rays.length[i];
  std::vector<Waiting> stack{{0, 0}};
  while (!stack.empty()) {
    const Waiting next = stack.back();
    stack.pop_back();
    if (next.entry > t) continue;
    if (next.child < 0) {
      const auto packed = static_cast<std::uint32_t>(~next.child);
      const std::uint32_t count = (packed & 7U) + 1;
      sum.leaves += 1, sum.triangles += count, sum.blocks += std::ceil(count / static_cast<double>(kBlock));
      for (std::uint32_t k = 0; k < count; ++k)
        t = std::min(t, meet(scene, tree.order[(packed >> 3U) + k], o, d));
      if (!nearest && t < rays.length[i]) return;
      continue;
    }
    const Bvh8Node& node = tree.nodes[static_cast<std::size_t>(next.child)];
    sum.nodes += 1;
    const std::size_t below = stack.size();
    for (int k = 0; k < 8; ++k) {
      float enter = 0, leave = t;
      for (int a = 0; a < 3; ++a) {
        const float lo = (node.lo[a][k] - o[a]) * inverse[a], hi = (node.hi[a][k] - o[a]) * inverse[a];
        enter = std::max(enter, std::min(lo, hi)), leave = std::min(leave, std::max(lo, hi));
      }
      if (node.lo[0][k] <= node.hi[0][k] && enter <= leave) stack.push_back({enter, node.child[k]});
    }
    if (nearest)
      std::sort(stack.begin() + static_cast<std::ptrdiff_t>(below), stack.end(),
                [](const Waiting& a, const Waiting& b) { return a.entry > b.entry; });
    else
      std::reverse(stack.begin() + static_cast<std::ptrdiff_t>(below), stack.end());
  }
}

/// The share of packets of which all rays go together, as nextGroup in kernels/lib/search has it.
double together(const RaySet& rays) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + kPacket <= rays.size(); i += kPacket) {
    bool same = true;
    for (const std::vector<float>& d : rays.d)
      for (std::size_t k = i; k < i + kPacket; ++k)
        same = same && d[k] * d[i] > 0 && std::abs(d[k] - d[i]) <= kSpread;
    count += same ? 1 : 0;
  }
  return static_cast<double>(count * kPacket) / static_cast<double>(rays.size());
}

void count(const Scene& scene, const std::string& name, const WideTree& ours, const WideTree& embree,
           const RaySet& rays, bool nearest) {
  if (rays.size() == 0) return;
  Visits sums[2];
  for (std::size_t i = 0; i < rays.size(); ++i) {
    walk(scene, ours, rays, i, nearest, sums[0]);
    walk(scene, embree, rays, i, nearest, sums[1]);
  }
  fmt::print("{}\t{}\t{}\t{:.2f}", name, rays.kind, nearest ? "nearest" : "any", together(rays));
  for (const Visits& v : sums)
    for (const double n : {v.nodes, v.leaves, v.blocks, v.triangles})
      fmt::print("\t{:.2f}", n / static_cast<double>(rays.size()));
  fmt::print("\n");
  std::fflush(stdout);
}

void measure(Compute& compute, const std::string& file, std::size_t n) {
  Notices notices;
  const Scene scene = loadGltf(file, {}, notices);
  const std::string name = std::filesystem::path(file).stem().string();
  std::vector<glm::uvec3> corners;
  for (const Triangle& t : scene.triangles) corners.emplace_back(t.v0, t.v1, t.v2);
  const TriTree tree = buildTriTree(scene.positions, corners);
  const WideTree ours = ourTree(tree), embree = embreeTree(scene, tree.order);
  QueryRunner kernel(compute, scene, tree, queryKernels().front());
  const auto hitsOf = [&](const RaySet& rays) {
    kernel.load(rays);
    kernel.nearest();
    return kernel.hits();
  };
  const RaySet eye = eyeRays(scene, n);
  const std::vector<QueryHit> seen = hitsOf(eye);
  const RaySet mirror = mirrorRays(scene, eye, seen, "mirror1");
  count(scene, name, ours, embree, eye, true);
  count(scene, name, ours, embree, shadowRays(scene, eye, seen), false);
  count(scene, name, ours, embree, mirror, true);
  if (mirror.size() > 0)
    count(scene, name, ours, embree, mirrorRays(scene, mirror, hitsOf(mirror), "mirror2"), true);
  count(scene, name, ours, embree, refractedRays(scene, eye, seen), true);
  count(scene, name, ours, embree, cosineRays(scene, eye, seen), true);
  count(scene, name, ours, embree, cosineRays(scene, eye, seen), false);
  count(scene, name, ours, embree, uniformRays(scene, n), true);
}

}  // namespace
}  // namespace whittle

int main(int argc, char** argv) {
  std::size_t rays = std::size_t{1} << 17;
  try {
    whittle::Compute compute(whittle::selectDevice(whittle::listDevices(), ""));
    fmt::print("scene\trays\tquery\tpackets together");
    for (const char* tree : {"", "Embree's "})
      for (const char* what : {"nodes", "leaves", "blocks of 4", "triangles"})
        fmt::print("\t{}{}", tree, what);
    fmt::print("\n");
    for (int i = 1; i < argc; ++i) {
      if (std::string_view(argv[i]) == "--rays" && i + 1 < argc)
        rays = static_cast<std::size_t>(std::max(1, atoi(argv[++i])));
      else
        whittle::measure(compute, argv[i], rays);
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "visits: {}\n", e.what());
    return 1;
  }
}
