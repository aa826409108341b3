// The nearest hit found by walking the tree equals the nearest of all triangles, both in double precision.
#include <gtest/gtest.h>

#include <optional>

#include "bvh/tree_check.h"

namespace whittle::test {
namespace {

struct Ray {
  glm::dvec3 origin, direction;
};

struct Hit {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = ~0U;
};

/// Möller & Trumbore 1997. Both sides.
std::optional<double> intersect(const TriangleMesh& mesh, std::uint32_t triangle, const Ray& ray) {
  const glm::uvec3 v = mesh.triangles[triangle];
  const glm::dvec3 p0(mesh.positions[v.x]);
  const glm::dvec3 e1 = glm::dvec3(mesh.positions[v.y]) - p0, e2 = glm::dvec3(mesh.positions[v.z]) - p0;
  const glm::dvec3 p = glm::cross(ray.direction, e2);
  const double det = glm::dot(e1, p);
  if (det == 0) return std::nullopt;
  const glm::dvec3 s = ray.origin - p0, q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / det, w = glm::dot(ray.direction, q) / det;
  const double t = glm::dot(e2, q) / det;
  if (u < 0 || w < 0 || u + w > 1 || t <= 0) return std::nullopt;
  return t;
}

void consider(const TriangleMesh& mesh, std::uint32_t triangle, const Ray& ray, Hit& hit) {
  const std::optional<double> t = intersect(mesh, triangle, ray);
  if (t && (*t < hit.t || (*t == hit.t && triangle < hit.triangle))) hit = {*t, triangle};
}

Hit bruteForce(const TriangleMesh& mesh, const Ray& ray) {
  Hit hit;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) consider(mesh, i, ray, hit);
  return hit;
}

/// Slabs, widened by a relative 1e-12: far above double's rounding of them, far below what would hide
/// a wrong box.
bool meetsBox(const TreeNode& node, int k, const Ray& ray, double tMax) {
  double t0 = 0, t1 = tMax;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1 / ray.direction[axis];
    double a = (node.lo[k][axis] - ray.origin[axis]) * inverse;
    double b = (node.hi[k][axis] - ray.origin[axis]) * inverse;
    if (a > b) std::swap(a, b);
    t0 = std::max(t0, a);
    t1 = std::min(t1, b);
  }
  return t0 <= t1 + 1e-12 * std::abs(t1) + 1e-12;
}

Hit throughTree(const TriTree& tree, const TriangleMesh& mesh, const Ray& ray) {
  Hit hit;
  std::vector<std::int32_t> stack{0};
  while (!stack.empty()) {
    const TreeNode& node = tree.nodes[static_cast<std::size_t>(stack.back())];
    stack.pop_back();
    for (int k = 0; k < 2; ++k) {
      if (absentChild(node, k) || !meetsBox(node, k, ray, hit.t)) continue;
      if (node.child[k] >= 0) {
        stack.push_back(node.child[k]);
        continue;
      }
      const LeafRange leaf = leafRange(node.child[k]);
      for (std::size_t i = 0; i < leaf.count; ++i) consider(mesh, tree.order[leaf.first + i], ray, hit);
    }
  }
  return hit;
}

TEST(TriTreeHit, EqualsBruteForce) {
  Rng rng(20);
  for (const TriangleMesh& mesh :
       {randomSoup(2000, 0.2F, 21), heightField(30, 22), longThinTriangles(2000, 1.0F, 23),
        closedSphere({0, 0, 0}, 0.9F, 20, 30)}) {
    const TriTree tree = build(mesh);
    int hits = 0;
    for (int i = 0; i < 1000; ++i) {
      const Ray ray{rng.inBox(1.5F), rng.direction()};
      const Hit expected = bruteForce(mesh, ray), found = throughTree(tree, mesh, ray);
      ASSERT_EQ(found.triangle, expected.triangle);
      ASSERT_EQ(found.t, expected.t);
      hits += expected.triangle != ~0U ? 1 : 0;
    }
    EXPECT_GT(hits, 100);  // the comparison must not be of misses alone
  }
}

TEST(TriTreeHit, LowestIndexOfIdenticalTriangles) {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  mesh.triangles.assign(1000, {0, 1, 2});
  const Hit hit = throughTree(build(mesh), mesh, {{0.1, 0.1, 2}, {0, 0, -1}});
  EXPECT_EQ(hit.triangle, 0U);
  EXPECT_EQ(hit.t, 2);
}

TEST(TriTreeHit, RaysIntoAClosedSphereAlwaysHit) {
  const TriangleMesh mesh = closedSphere({0.3F, -0.2F, 0.1F}, 1, 40, 60);
  const TriTree tree = build(mesh);
  Rng rng(24);
  for (int i = 0; i < 2000; ++i) {
    const Ray ray{rng.inBox(0.3F), rng.direction()};
    const Hit hit = throughTree(tree, mesh, ray);
    // The inscribed polyhedron lies within the sphere, no deeper than 1 - cos² of half the larger mesh angle.
    const double radius = glm::length(ray.origin + hit.t * ray.direction - glm::dvec3(0.3F, -0.2F, 0.1F));
    ASSERT_LT(radius, 1 + 1e-6);  // float vertices
    ASSERT_GT(radius, 0.99);
  }
}

}  // namespace
}  // namespace whittle::test
