// Finds the triangles a ray meets: a small double-precision bounding volume hierarchy (binned surface
// area heuristic, Wald 2007) and its twin that tries every triangle. Reads Scene's positions and
// triangles, and nothing else.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "reference/triangle_test.h"
#include "scene/scene.h"

namespace whittle::reference {

struct Hit {
  std::uint32_t triangle;
  double t;
  Vec3 barycentric;
};

struct Box {
  Vec3 lo{std::numeric_limits<double>::infinity()};
  Vec3 hi{-std::numeric_limits<double>::infinity()};

  void grow(const Vec3& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  void grow(const Box& b) {
    lo = glm::min(lo, b.lo);
    hi = glm::max(hi, b.hi);
  }
  double halfArea() const {
    const Vec3 e = hi - lo;
    return e.x * e.y + e.y * e.z + e.z * e.x;
  }
};

/// Degenerate and non-finite triangles are left out of both searches. Holds a reference to the scene.
class TriangleIndex {
 public:
  explicit TriangleIndex(const Scene& scene);
  /// Finds nothing and takes no memory: for what asks for corners alone.
  static TriangleIndex ofCorners(const Scene& scene) { return TriangleIndex(&scene); }

  /// Calls visit(hit) for triangles met at 0 < t <= tMax, in no particular order; visit returns the new tMax
  /// (negative: enough). Triangles that a shrunken tMax excludes may be visited or not.
  template <class Visit>
  void visitHits(const Ray& ray, double tMax, Visit visit) const;
  /// The same by trying every triangle.
  template <class Visit>
  void visitHitsBruteForce(const Ray& ray, double tMax, Visit visit) const;

  /// Nearest hit, of equal distances the lowest triangle index. accept(hit) says
  /// whether a hit counts (alpha masks).
  template <class Accept>
  std::optional<Hit> nearestHit(const Ray& ray, Accept accept) const;
  std::optional<Hit> nearestHit(const Ray& ray) const {
    return nearestHit(ray, [](const Hit&) { return true; });
  }
  std::optional<Hit> nearestHitBruteForce(const Ray& ray) const;

  std::array<Vec3, 3> corners(std::uint32_t triangle) const;

 private:
  explicit TriangleIndex(const Scene* scene) : scene_(scene) {}

  struct Node {
    Box box;
    /// Leaf: first entry of order_; inner: index of the left child, the right one follows.
    std::uint32_t first = 0;
    std::uint32_t count = 0;  ///< triangles of a leaf; 0: inner node
  };
  struct Entry {
    Box box;
    Vec3 centre;
    std::uint32_t triangle;
  };
  struct BoxRay;

  void build(std::vector<Entry>& entries, std::uint32_t node, std::uint32_t begin, std::uint32_t end,
             int depth);
  /// The visitor's work on one triangle, shared by both searches.
  template <class Visit>
  void visitTriangle(const ShearedRay& ray, std::uint32_t triangle, double& tMax, Visit& visit) const;

  const Scene* scene_;
  std::vector<Node> nodes_;
  std::atomic<std::uint32_t> nodeCount_{1};
  std::vector<std::uint32_t> order_;
};

/// A ray prepared for boxes. Every box is grown by `slack`, which bounds the rounding of the triangle test,
/// so that the tree never loses a hit that the triangle test would report.
struct TriangleIndex::BoxRay {
  BoxRay(const Ray& ray, const Box& scene);
  /// Whether the ray meets the box at some 0 <= t <= tMax; `tNear` is where.
  bool meets(const Box& box, double tMax, double& tNear) const;

  Vec3 origin, inverse;
  bool parallel[3];  ///< the direction has no component along this axis
  double slack;      ///< metres
};

template <class Visit>
void TriangleIndex::visitTriangle(const ShearedRay& ray, std::uint32_t triangle, double& tMax,
                                  Visit& visit) const {
  const auto found = intersect(ray, corners(triangle));
  if (found && found->t <= tMax) tMax = visit(Hit{triangle, found->t, found->barycentric});
}

template <class Visit>
void TriangleIndex::visitHits(const Ray& ray, double tMax, Visit visit) const {
  if (order_.empty()) return;
  const ShearedRay sheared(ray);
  const BoxRay boxRay(ray, nodes_[0].box);
  std::uint32_t stack[128];  // build() bounds the depth
  int size = 0;
  double tNear;
  if (boxRay.meets(nodes_[0].box, tMax, tNear)) stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (!boxRay.meets(node.box, tMax, tNear)) continue;  // tMax may have shrunk since
    if (node.count > 0) {
      for (std::uint32_t i = 0; i < node.count && tMax >= 0; ++i) {
        visitTriangle(sheared, order_[node.first + i], tMax, visit);
      }
      continue;
    }
    double tLeft, tRight;
    const bool left = boxRay.meets(nodes_[node.first].box, tMax, tLeft);
    const bool right = boxRay.meets(nodes_[node.first + 1].box, tMax, tRight);
    const std::uint32_t nearer = node.first + (left && right && tRight < tLeft ? 1 : 0);
    if (left && right) {
      stack[size++] = nearer == node.first ? node.first + 1 : node.first;
      stack[size++] = nearer;
    } else if (left || right) {
      stack[size++] = left ? node.first : node.first + 1;
    }
  }
}

template <class Visit>
void TriangleIndex::visitHitsBruteForce(const Ray& ray, double tMax, Visit visit) const {
  const ShearedRay sheared(ray);
  for (const std::uint32_t triangle : order_) {
    if (tMax < 0) return;
    visitTriangle(sheared, triangle, tMax, visit);
  }
}

template <class Accept>
std::optional<Hit> TriangleIndex::nearestHit(const Ray& ray, Accept accept) const {
  std::optional<Hit> best;
  double tMax = std::numeric_limits<double>::infinity();
  visitHits(ray, tMax, [&](const Hit& hit) {
    const bool nearer = !best || hit.t < best->t || (hit.t == best->t && hit.triangle < best->triangle);
    if (nearer && accept(hit)) {
      best = hit;
      tMax = hit.t;
    }
    return tMax;
  });
  return best;
}

}  // namespace whittle::reference
