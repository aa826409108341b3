// The tree against the search of every triangle: the same triangle at the same distance, to the last bit.
#include "reference/triangle_index.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random_scenes.h"

namespace whittle::test {
namespace {

using reference::Ray;
using reference::TriangleIndex;
using reference::Vec3;

Scene sceneOf(const TriangleMesh& mesh) {
  Scene scene;
  scene.positions = mesh.positions;
  scene.materials.emplace_back();
  for (const glm::uvec3& t : mesh.triangles) scene.triangles.push_back({t.x, t.y, t.z, 0});
  return scene;
}

/// Returns whether the ray hit anything.
bool expectSameHit(const TriangleIndex& index, const Ray& ray) {
  const auto tree = index.nearestHit(ray), all = index.nearestHitBruteForce(ray);
  EXPECT_EQ(tree.has_value(), all.has_value());
  if (tree && all) {
    EXPECT_EQ(tree->triangle, all->triangle);
    EXPECT_EQ(tree->t, all->t);
  }
  // Every hit, not only the nearest: what shadow rays ask for.
  const auto collect = [](std::vector<std::uint32_t>& into) {
    return [&into](const reference::Hit& hit) {
      into.push_back(hit.triangle);
      return 10.0;
    };
  };
  std::vector<std::uint32_t> found, expected;
  index.visitHits(ray, 10.0, collect(found));
  index.visitHitsBruteForce(ray, 10.0, collect(expected));
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(found, expected);
  return all.has_value();
}

void expectSameHits(const Scene& scene, std::uint64_t seed, int count) {
  const TriangleIndex index(scene);
  Rng rng(seed);
  int hits = 0;
  for (int i = 0; i < count; ++i) {
    Ray ray{Vec3(rng.inBox(1.5F)), glm::normalize(Vec3(rng.direction()))};
    if (i % 4 == 1) ray.direction = glm::normalize(Vec3(rng.inBox(1)) - ray.origin);
    if (i % 4 == 2) {  // along an axis, and from the plane of a vertex
      const int axis = i / 4 % 3;
      ray.direction = Vec3(0);
      ray.direction[axis] = i % 8 < 4 ? 1 : -1;
      if (i % 16 < 8) ray.direction[(axis + 1) % 3] = -0.0;
      ray.origin[(axis + 1) % 3] = scene.positions[rng.bits() % scene.positions.size()][(axis + 1) % 3];
    }
    if (i % 4 == 3)
      ray.direction = glm::normalize(Vec3(scene.positions[rng.bits() % scene.positions.size()]) - ray.origin);
    hits += expectSameHit(index, ray);
    if (testing::Test::HasFailure()) FAIL() << "ray " << i;
  }
  EXPECT_GT(hits, count / 20) << "too few hits to tell";
}

TEST(TriangleIndex, AgreesOnRandomTriangles) {
  for (const std::size_t count : {1, 2, 5, 30, 1000}) {
    const Scene scene = sceneOf(randomSoup(count, count < 100 ? 1.5F : 0.3F, count));
    expectSameHits(scene, count, 4000);
  }
}

TEST(TriangleIndex, AgreesOnSlivers) { expectSameHits(sceneOf(longThinTriangles(2000, 2, 5)), 6, 3000); }

TEST(TriangleIndex, AgreesOnAHeightField) { expectSameHits(sceneOf(heightField(24, 3)), 4, 4000); }

TEST(TriangleIndex, AgreesOnAGridOfAxisAlignedQuads) {
  TriangleMesh mesh;  // coordinates that rays and boxes share exactly
  for (int i = -4; i < 4; ++i) {
    for (int j = -4; j < 4; ++j) {
      const float x = 0.25F * static_cast<float>(i), z = 0.25F * static_cast<float>(j);
      mesh.add({x, 0, z}, {x, 0, z + 0.25F}, {x + 0.25F, 0, z});
      mesh.add({x, z, 0.5F}, {x + 0.25F, z, 0.5F}, {x, z + 0.25F, 0.5F});
    }
  }
  const Scene scene = sceneOf(mesh);
  expectSameHits(scene, 8, 4000);
  const TriangleIndex index(scene);
  for (int i = -8; i <= 8; ++i) {  // down on every corner and edge, and inside the planes themselves
    for (int j = -8; j <= 8; ++j) {
      const double x = 0.125 * i, z = 0.125 * j;
      expectSameHit(index, {Vec3(x, 1, z), Vec3(0, -1, 0)});
      expectSameHit(index, {Vec3(x, 0, z), Vec3(0, 0, 1)});
      expectSameHit(index, {Vec3(x, 0, z), glm::normalize(Vec3(1, 0, 1))});
    }
  }
}

TEST(TriangleIndex, FindsTheLowestOfDuplicates) {
  TriangleMesh mesh;
  for (int i = 0; i < 10000; ++i) mesh.add({-1, 0, -1}, {-1, 0, 1}, {1, 0, 0});
  const Scene scene = sceneOf(mesh);
  const TriangleIndex index(scene);
  const auto hit = index.nearestHit({Vec3(0, 1, 0), Vec3(0, -1, 0)});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, 0U);
  EXPECT_EQ(hit->t, 1);
}

TEST(TriangleIndex, LeavesDegenerateTrianglesOut) {
  TriangleMesh mesh;
  mesh.add({-1113.45F, 0, 0}, {-1113.45F, 1, 1}, {-1113.45F, 2, 2});  // collinear
  mesh.add({0, 0, 0}, {0, 0, 0}, {1, 0, 0});
  mesh.add({0, std::nanf(""), 0}, {0, 1, 0}, {1, 0, 0});
  const Scene scene = sceneOf(mesh);
  const TriangleIndex index(scene);
  for (int i = 0; i <= 20; ++i) {
    EXPECT_FALSE(index.nearestHit({Vec3(0, 0.1 * i, 0.1 * i), Vec3(-1, 0, 0)}));
  }
  EXPECT_FALSE(index.nearestHit({Vec3(0.5, 1, 0), Vec3(0, -1, 0)}));
  const Scene empty;
  EXPECT_FALSE(TriangleIndex(empty).nearestHit({Vec3(0), Vec3(0, 0, 1)}));
}

TEST(TriangleIndex, AClosedSphereFarAwayHasNoCracks) {
  const glm::vec3 centre(148376, 1234, -223423);
  const Scene scene = sceneOf(closedSphere(centre, 300, 100, 200));
  const TriangleIndex index(scene);
  Rng rng(1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 origin = Vec3(centre) + 50.0 * Vec3(rng.inBox(1));
    Vec3 direction(rng.direction());
    if (i % 2) direction = Vec3(scene.positions[rng.bits() % scene.positions.size()]) - origin;
    ASSERT_TRUE(index.nearestHit({origin, glm::normalize(direction)})) << "ray " << i;
  }
}

TEST(TriangleIndex, HitsOnlyAhead) {
  TriangleMesh mesh;
  mesh.add({-1, 0, -1}, {-1, 0, 1}, {2, 0, 0});
  const Scene scene = sceneOf(mesh);
  const TriangleIndex index(scene);
  EXPECT_FALSE(index.nearestHit({Vec3(0, 1, 0), Vec3(0, 1, 0)}));
  EXPECT_FALSE(index.nearestHit({Vec3(0, 0, 0), Vec3(0, 1, 0)})) << "t = 0";
  EXPECT_TRUE(index.nearestHit({Vec3(0, -1e-9, 0), Vec3(0, 1, 0)}));
}

TEST(TriangleIndex, BarycentricsRebuildThePoint) {
  Rng rng(12);
  const Scene scene = sceneOf(randomSoup(200, 0.5F, 2));
  const TriangleIndex index(scene);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray{Vec3(rng.inBox(1.5F)), glm::normalize(Vec3(rng.direction()))};
    const auto hit = index.nearestHit(ray);
    if (!hit) continue;
    ++hits;
    const auto p = index.corners(hit->triangle);
    const Vec3 point = hit->barycentric[0] * p[0] + hit->barycentric[1] * p[1] + hit->barycentric[2] * p[2];
    // Grazing hits stretch the rounding along the ray: compare across it.
    const Vec3 off = point - ray.origin;
    EXPECT_LT(glm::length(glm::cross(off, ray.direction)), 1e-12);
  }
  EXPECT_GT(hits, 200);
}

}  // namespace
}  // namespace whittle::test
