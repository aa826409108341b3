// The eight-wide tree holds what the two-wide tree holds: every triangle once, in boxes that contain it,
// within bounds.
#include "bvh/bvh8.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <string_view>

#include "support/random_scenes.h"

namespace whittle {
namespace {

struct Walk {
  std::vector<int> seen;             ///< how often a position of TriTree::order lies in a leaf
  std::vector<std::uint8_t> places;  ///< as leafPlaces says
  std::size_t nodes = 0, leaves = 0;
  int depth = 0;
};

/// Corners of all leaves; each float is handed over once.
std::vector<float> leavesOf(const Bvh8& wide, const TriTree& tree, const test::TriangleMesh& mesh) {
  std::vector<float> all;
  const auto cornersOf = [&](std::uint32_t triangle) {
    const glm::uvec3& t = mesh.triangles[triangle];
    return std::array{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
  };
  eachLeafPart(wide, tree, cornersOf, [&](std::size_t first, std::span<const float> part) {
    ASSERT_EQ(first, all.size());
    all.insert(all.end(), part.begin(), part.end());
  });
  EXPECT_EQ(all.size(), leafFloats(tree));
  std::vector<float> inPlace(leafFloats(tree), -1.0F);
  makeLeaves(wide, tree, cornersOf, inPlace);
  EXPECT_EQ(inPlace, all);
  return all;
}

bool contains(const Bvh8Node& n, int k, float x, float y, float z) {
  return n.lo[0][k] <= x && x <= n.hi[0][k] && n.lo[1][k] <= y && y <= n.hi[1][k] && n.lo[2][k] <= z &&
         z <= n.hi[2][k];
}

/// Visits everything below `index`; `boxes`: every box on the way must contain each corner.
void walk(const Bvh8& wide, const TriTree& tree, const test::TriangleMesh& mesh,
          const std::vector<float>& corners, std::int32_t index,
          std::vector<std::pair<std::int32_t, int>>& boxes, Walk& w) {
  ++w.nodes;
  w.depth = std::max(w.depth, static_cast<int>(boxes.size()) + 1);
  const Bvh8Node& node = wide.nodes.at(static_cast<std::size_t>(index));
  for (int k = 0; k < 8; ++k) {
    if (!(node.lo[0][k] <= node.hi[0][k])) continue;
    boxes.emplace_back(index, k);
    if (node.child[k] >= 0) {
      ASSERT_GT(node.child[k], index) << "a cycle";
      walk(wide, tree, mesh, corners, node.child[k], boxes, w);
    } else {
      const auto packed = static_cast<std::uint32_t>(~node.child[k]);
      const std::uint32_t first = packed >> 3U, count = (packed & 7U) + 1;
      ++w.leaves;
      for (std::uint32_t lane = 0; lane < count; ++lane) {
        const std::uint32_t t = tree.order.at(first + lane);
        ++w.seen.at(first + lane);
        EXPECT_EQ(w.places.at(first + lane), lane + 8 * (count - 1));
        for (int corner = 0; corner < 3; ++corner) {
          const glm::vec3 p = mesh.positions[mesh.triangles[t][corner]];
          for (int a = 0; a < 3; ++a)
            EXPECT_EQ(corners.at(9 * first + static_cast<std::uint32_t>(3 * corner + a) * count + lane),
                      p[a]);
          for (const auto& [n, c] : boxes)
            ASSERT_TRUE(contains(wide.nodes[static_cast<std::size_t>(n)], c, p.x, p.y, p.z));
        }
      }
    }
    boxes.pop_back();
  }
}

void expectWhole(const test::TriangleMesh& mesh, const std::string& name, const BuildOptions& options = {}) {
  SCOPED_TRACE(name);
  const TriTree tree = buildTriTree(mesh.positions, mesh.triangles, options);
  const Bvh8 wide = buildBvh8(tree);
  Walk w;
  w.seen.resize(tree.order.size());
  w.places = leafPlaces(wide, tree);
  EXPECT_EQ(w.places.size(), tree.order.size());
  std::vector<std::pair<std::int32_t, int>> boxes;
  walk(wide, tree, mesh, leavesOf(wide, tree, mesh), 0, boxes, w);
  for (std::size_t i = 0; i < w.seen.size(); ++i) ASSERT_EQ(w.seen[i], 1) << "position " << i;
  EXPECT_EQ(w.nodes, wide.nodes.size());
  EXPECT_EQ(w.depth, wide.depth);
  EXPECT_EQ(w.leaves, wide.leaves);
}

TEST(Bvh8, HoldsEveryTriangleOnce) {
  for (const std::size_t count : {0U, 1U, 2U, 7U, 8U, 9U, 63U, 1000U, 20000U, 50000U})
    expectWhole(test::randomSoup(count, 0.1F, 41 + count), std::to_string(count));
}

/// Leaves of eight, the last of what is left.
TEST(Bvh8, LeavesWithoutATree) {
  for (const std::size_t count : {0U, 1U, 7U, 8U, 9U, 64U, 65U, 1000U}) {
    SCOPED_TRACE(count);
    const test::TriangleMesh mesh = test::randomSoup(count, 0.1F, 91);
    TriTree order;
    for (std::uint32_t i = 0; i < count; ++i)
      order.order.push_back(static_cast<std::uint32_t>(count) - 1 - i);
    const Bvh8 wide = buildLeaves(order);
    const std::vector<float> corners = leavesOf(wide, order, mesh);
    const std::vector<std::uint8_t> places = leafPlaces(wide, order);
    EXPECT_EQ(wide.leaves, (count + 7) / 8);
    ASSERT_EQ(places.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t lane = i % 8, first = i - lane, size = std::min<std::size_t>(8, count - first);
      EXPECT_EQ(places[i], lane + 8 * (size - 1)) << i;
      const glm::vec3 p = mesh.positions[mesh.triangles[order.order[i]].z];
      EXPECT_EQ(corners[9 * first + 8 * size + lane], p.z) << i;
    }
  }
}

TEST(Bvh8, LongLeavesAreSplit) {
  test::TriangleMesh alike;
  for (int i = 0; i < 1000; ++i) alike.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  BuildOptions sixteen;
  sixteen.maxLeafTriangles = 16;
  expectWhole(alike, "a thousand alike", sixteen);
  expectWhole(test::randomSoup(500, 5.0F, 7), "overlapping", sixteen);
}

/// Areas of the largest overflow a float, those of the smallest vanish.
TEST(Bvh8, ExtremeScales) {
  for (const float scale : {1e18F, 3e38F, 1e-18F, 1e-30F, 1e-37F, 1e-44F}) {
    test::TriangleMesh mesh = test::randomSoup(3000, 0.1F, 8);
    for (glm::vec3& p : mesh.positions) p = glm::clamp(p, -1.0F, 1.0F) * scale;
    expectWhole(mesh, std::to_string(scale));
  }
}

TEST(Bvh8, SameForAnyNumberOfThreadsAndEveryRun) {
  // Large enough for many tasks.
  const auto mesh = test::randomSoup(100000, 0.01F, 11);
  const TriTree tree = buildTriTree(mesh.positions, mesh.triangles);
  const auto bytes = [](const auto& v) {
    return std::string_view(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(v[0]));
  };
  const Bvh8 first = buildBvh8(tree);
  const std::vector<float> corners = leavesOf(first, tree, mesh);
  for (const std::size_t threads : {1U, 2U, 3U}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const Bvh8 again = buildBvh8(tree);
    EXPECT_TRUE(bytes(first.nodes) == bytes(again.nodes)) << threads;
    EXPECT_EQ(leavesOf(again, tree, mesh), corners) << threads;
  }
}

/// Half-empty nodes are what the collapse is there to avoid: opening the child of the largest box until there
/// are eight leaves 4.1 children in a node of a height field.
TEST(Bvh8, MostLanesAreTaken) {
  const auto mesh = test::randomSoup(20000, 0.02F, 5);
  const TriTree tree = buildTriTree(mesh.positions, mesh.triangles);
  const Bvh8 wide = buildBvh8(tree);
  const double children = static_cast<double>(wide.nodes.size() - 1 + wide.leaves);
  EXPECT_GE(children / static_cast<double>(wide.nodes.size()), 5.0);
}

}  // namespace
}  // namespace whittle
