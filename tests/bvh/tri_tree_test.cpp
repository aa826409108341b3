// buildTriTree: trees are valid for ordinary and for hostile input, and the same for any number of threads.
#include "bvh/tri_tree.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <cstring>
#include <memory>

#include "bvh/tree_check.h"

namespace whittle::test {
namespace {

TEST(TriTree, RandomScenesGiveValidTrees) {
  EXPECT_EQ(checkTree(build(randomSoup(5000, 0.1F, 1)), randomSoup(5000, 0.1F, 1)), "");
  for (const TriangleMesh& mesh : {heightField(100, 2), longThinTriangles(5000, 0.5F, 3),
                                   closedSphere({1, 2, 3}, 0.5F, 30, 40), randomSoup(200000, 0.01F, 4)}) {
    EXPECT_EQ(checkTree(build(mesh), mesh), "");
  }
}

TEST(TriTree, LargerChildComesFirst) {
  const TriTree tree = build(longThinTriangles(3000, 0.5F, 7));
  for (const TreeNode& node : tree.nodes) {
    double area[2];
    for (int k = 0; k < 2; ++k) {
      const double x = double{node.hi[k][0]} - double{node.lo[k][0]};
      const double y = double{node.hi[k][1]} - double{node.lo[k][1]};
      const double z = double{node.hi[k][2]} - double{node.lo[k][2]};
      area[k] = x * y + y * z + z * x;
    }
    ASSERT_GE(area[0], area[1] * (1 - 1e-12));  // another order of double operations than the builder's
  }
}

TEST(TriTree, LeafSizesAreRespected) {
  const TriangleMesh mesh = randomSoup(3000, 0.5F, 5);
  for (const int maxLeaf : {1, 2, 3, 8, 16}) {
    for (const int bins : {2, 7, 32}) {
      EXPECT_EQ(checkTree(build(mesh, {maxLeaf, bins, 1.0F}), mesh, maxLeaf), "") << maxLeaf << ", " << bins;
    }
  }
  // Out of range: taken for the nearest legal value.
  EXPECT_EQ(checkTree(build(mesh, {100, 1000, 1.0F}), mesh, 16), "");
  EXPECT_EQ(checkTree(build(mesh, {0, 0, 1.0F}), mesh, 1), "");
}

/// Refused by number alone: the triangles are reserved memory that nobody reads or writes.
TEST(TriTree, MoreThanLeavesCanNameIsRefusedWithBothNumbers) {
  constexpr std::size_t kTooMany = (std::size_t{1} << 27) + 1;
  const std::unique_ptr<void, decltype(&std::free)> reserved(std::malloc(kTooMany * sizeof(glm::uvec3)),
                                                             &std::free);
  ASSERT_TRUE(reserved);
  try {
    buildTriTree({}, {static_cast<const glm::uvec3*>(reserved.get()), kTooMany});
    FAIL() << "it was built";
  } catch (const std::length_error& e) {
    EXPECT_STREQ(e.what(), "134217729 triangles are more than a tree can hold: 134217728");
  }
}

TEST(TriTree, NoTriangles) {
  const TriTree tree = buildTriTree({}, {});
  ASSERT_EQ(tree.nodes.size(), 1U);
  EXPECT_TRUE(tree.order.empty());
  EXPECT_EQ(tree.depth, 1);
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(tree.nodes[0].child[k], -1);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(tree.nodes[0].lo[k][axis], std::numeric_limits<float>::infinity());
      EXPECT_EQ(tree.nodes[0].hi[k][axis], -std::numeric_limits<float>::infinity());
    }
  }
}

TEST(TriTree, FewTriangles) {
  for (std::size_t n = 1; n <= 40; ++n) {
    const TriangleMesh mesh = randomSoup(n, 0.3F, n);
    const TriTree tree = build(mesh);
    EXPECT_EQ(checkTree(tree, mesh), "") << n;
    EXPECT_EQ(tree.order.size(), n);
  }
}

TEST(TriTree, BrokenTrianglesAreLeftOut) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  TriangleMesh mesh = randomSoup(20000, 0.1F, 6);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 31) mesh.positions[i].y = i % 2 ? kNan : -kInf;
  mesh.add({0, 0, 0}, {0, 0, 0}, {1, 0, 0});
  mesh.add({kInf, kInf, kInf}, {0, 0, 0}, {1, 0, 0});
  const TriTree tree = build(mesh);
  EXPECT_EQ(checkTree(tree, mesh), "");
  EXPECT_LT(tree.order.size(), mesh.triangles.size());
  EXPECT_GT(tree.order.size(), mesh.triangles.size() / 2);

  TriangleMesh broken;
  for (int i = 0; i < 10; ++i) broken.add({kNan, 0, 0}, {0, 1, 0}, {1, 0, 0});
  EXPECT_EQ(checkTree(build(broken), broken), "");
  EXPECT_TRUE(build(broken).order.empty());
}

TEST(TriTree, IdenticalTriangles) {
  for (const std::size_t n : {5U, 10000U, 1000000U}) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles.assign(n, {0, 1, 2});
    const TriTree tree = build(mesh);
    EXPECT_EQ(checkTree(tree, mesh), "") << n;
    // Median splits halve: no deeper than the levels that leaves of four need.
    EXPECT_LE(tree.depth, static_cast<int>(std::ceil(std::log2(static_cast<double>(n) / 4)))) << n;
  }
}

/// Triangle i is half as large as triangle i - 1, from `largest` down to 1e-35 metres and then again; all
/// share a corner.
TriangleMesh nestedAtCorner(std::size_t n, float largest) {
  TriangleMesh mesh;
  float s = largest;
  for (std::size_t i = 0; i < n; ++i) {
    mesh.add({0, 0, 0}, {s, 0, 0}, {0, s, s});
    s = s < 2e-35F ? largest : s / 2;
  }
  return mesh;
}

TEST(TriTree, DepthIsBoundedForNestedTriangles) {
  // Two bins can only take the largest size away from the 170 sizes: without the fallback to medians the
  // depth is at least that.
  for (const std::size_t n : {170U, 5000U, 100000U}) {
    const TriangleMesh mesh = nestedAtCorner(n, 1e16F);
    for (const int maxLeaf : {1, 4, 16}) {
      for (const int bins : {2, 16}) {
        const TriTree tree = build(mesh, {maxLeaf, bins, 1.0F});
        EXPECT_EQ(checkTree(tree, mesh, maxLeaf), "") << n << ", " << maxLeaf << ", " << bins;
      }
    }
  }
}

TEST(TriTree, ConcentricTrianglesAreSplitBySize) {
  // No centroid tells them apart. 128 sizes, halved five times: each leaf of four has consecutive sizes.
  TriangleMesh mesh;
  for (int i = 0; i < 128; ++i) {
    const float s = std::ldexp(1.0F, -(i * 37 % 128) / 2) * (i * 37 % 2 ? 0.75F : 1.0F);
    mesh.add({-s, -s, -s}, {s, s, -s}, {-s, s, s});
  }
  const TriTree tree = build(mesh);
  EXPECT_EQ(checkTree(tree, mesh), "");
  EXPECT_EQ(tree.depth, 5);
  for (std::size_t leaf = 0; leaf < 32; ++leaf) {
    float smallest = 1, largest = 0;
    for (std::size_t i = 4 * leaf; i < 4 * leaf + 4; ++i) {
      const float s = mesh.positions[mesh.triangles[tree.order[i]].y].x;
      smallest = std::min(smallest, s);
      largest = std::max(largest, s);
    }
    EXPECT_EQ(largest / smallest, 1 / 0.375F) << leaf;  // 1, 3/4, 1/2, 3/8
  }
}

TEST(TriTree, ExtremeScales) {
  for (const float scale : {1e18F, 1.8e18F, 3e38F, 1e-18F, 1e-30F, 1e-37F, 1e-44F}) {
    TriangleMesh mesh = randomSoup(3000, 0.1F, 8);
    for (glm::vec3& p : mesh.positions) p = glm::clamp(p, -1.0F, 1.0F) * scale;
    EXPECT_EQ(checkTree(build(mesh), mesh), "") << scale;
  }
}

TEST(TriTree, ScaleDoesNotChangeTheTree) {
  const TriangleMesh mesh = randomSoup(3000, 0.1F, 9);
  const TriTree tree = build(mesh);
  for (const float scale :
       {0x1p+60F, 0x1p-60F}) {  // powers of two: every decision is scaled without rounding
    TriangleMesh scaled = mesh;
    for (glm::vec3& p : scaled.positions) p *= scale;
    EXPECT_EQ(build(scaled).order, tree.order) << scale;
  }
}

TEST(TriTree, ExtremeAspect) {
  Rng rng(10);
  TriangleMesh mesh;
  for (int i = 0; i < 5000; ++i) {
    const glm::vec3 p{rng.between(-1e9F, 1e9F), rng.between(-1e-9F, 1e-9F), rng.between(-1, 1)};
    mesh.add(p, p + glm::vec3{1e12F, 0, 0}, p + glm::vec3{0, 1e-9F, 1});
    mesh.add({1e18F, p.y, 0}, {-1e18F, 0, p.z}, {0, 1e-30F, p.z});
  }
  EXPECT_EQ(checkTree(build(mesh), mesh), "");
}

/// The same bytes, node by node.
bool sameBytes(const TriTree& a, const TriTree& b) {
  return a.depth == b.depth && a.order == b.order && a.nodes.size() == b.nodes.size() &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(TreeNode)) == 0;
}

TEST(TriTree, SameForAnyNumberOfThreadsAndEveryRun) {
  // 300,000 triangles: above the size from which single splits run on several threads.
  TriangleMesh soup = randomSoup(300000, 0.01F, 11);
  for (std::size_t i = 0; i < soup.positions.size(); i += 5) soup.positions[i].x *= 0.0F;  // some are -0
  TriangleMesh same;
  same.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  same.triangles.assign(150000, {0, 1, 2});
  // Large enough for several threads to split by size: every plane leaves the huge ones beside the soup.
  TriangleMesh stadium = randomSoup(150000, 0.01F, 13);
  for (int i = 0; i < 9; ++i) stadium.append(randomSoup(1, 1000, 14 + static_cast<std::uint64_t>(i)));
  for (const TriangleMesh& mesh : {soup, heightField(300, 12), same, stadium}) {
    TriTree trees[4];
    for (const std::size_t threads : {1U, 2U, 3U}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      trees[threads] = build(mesh);
    }
    trees[0] = build(mesh);
    for (int i = 1; i < 4; ++i) EXPECT_TRUE(sameBytes(trees[0], trees[i])) << i;
    EXPECT_EQ(checkTree(trees[0], mesh), "");
  }
}

}  // namespace
}  // namespace whittle::test
