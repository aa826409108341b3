// More than 2^24 triangles, and buffers beyond 2^32 bytes: no index passes through a float or 24 bits, no
// offset through 32. A small tree is taken apart and its nodes and triangles laid to the far end of buffers
// as large as the largest scene's. What is not allocated: those buffers are reserved, some 5 GB each, but
// nothing between their first and last pages is ever written, so a CPU device gives them no memory. A device
// that has its own memory would, and a sanitizer shadows all of it: there the test is left out.
#include <gtest/gtest.h>

#include "scene/byte_counts.h"
#include "support/record.h"
#include "support/search_bench.h"

namespace whittle {
namespace {

using test::SearchBench;
using test::SearchForm;
using test::searchForms;
using test::SearchLab;
using test::TestRay;

constexpr std::size_t kMaxTriangles = std::size_t{1} << 27;  // what a leaf can address

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// A buffer of `count` elements of which only the first of `head` and the last of `tail` are ever written.
template <typename T>
Buffer sparse(Compute& compute, const std::string& name, std::size_t count, const std::vector<T>& head,
              const std::vector<T>& tail) {
  const Buffer buffer = compute.allocate(name, count * sizeof(T));
  const auto put = [&](std::size_t at, const std::vector<T>& from) {
    if (!from.empty())
      clTry("writing '" + name + "'", [&] {
        compute.queue().enqueueWriteBuffer(buffer.handle, CL_TRUE, at * sizeof(T), from.size() * sizeof(T),
                                           from.data());
      });
  };
  put(0, head);
  put(count - tail.size(), tail);
  return buffer;
}

template <typename T>
std::vector<T> contents(Compute& compute, const Buffer& buffer) {
  std::vector<T> values(buffer.bytes / sizeof(T));
  compute.read(buffer, 0, buffer.bytes, values.data());
  return values;
}

/// Primitive indices as the last triangles of a scene have them. Neighbours are the same number as floats.
template <typename T>
std::uint32_t moved(T index, std::size_t by) {
  return static_cast<std::uint32_t>(static_cast<std::size_t>(index) + by);
}

/// Nodes beyond 2^32 bytes, triangles up to the last that a leaf can name.
void moveBvh2(Compute& compute, SearchBench& bench) {
  auto nodes = contents<TreeNode>(compute, bench.deviceScene.nodes);
  auto triangles = contents<device::DeviceTriangle>(compute, bench.deviceScene.triangles);
  const auto corners = contents<float>(compute, bench.deviceScene.leaves);
  triangles.pop_back();  // the sentinel: every child is there
  const std::size_t nodeCount = (std::size_t{1} << 26) + 5 + nodes.size(), byNodes = nodeCount - nodes.size(),
                    byTriangles = kMaxTriangles - triangles.size();
  static_assert(sizeof(TreeNode) << 26 >= std::size_t{1} << 32);
  for (TreeNode& n : nodes)
    for (std::int32_t& c : n.child) {
      const auto leaf = static_cast<std::uint32_t>(~c);
      c = c >= 0 ? static_cast<std::int32_t>(moved(c, byNodes))
                 : static_cast<std::int32_t>(~(moved(leaf >> 4U, byTriangles) << 4U | (leaf & 15U)));
    }
  for (device::DeviceTriangle& t : triangles) t.primitive = moved(t.primitive, byTriangles);
  bench.firstTriangle = static_cast<std::uint32_t>(byTriangles);
  bench.deviceScene.triangleCount = static_cast<std::uint32_t>(kMaxTriangles);
  bench.deviceScene.nodes = sparse(compute, "nodes", nodeCount, {nodes[0]}, nodes);
  bench.deviceScene.leaves = sparse(compute, "leaves", 9 * byTriangles + corners.size(), {}, corners);
  bench.deviceScene.triangles = sparse(compute, "triangles", kMaxTriangles, {}, triangles);
}

/// Nodes beyond 2^32 bytes and 2^24 of them, leaves beyond 2^32 bytes; they hold the last triangles.
void moveBvh8(Compute& compute, SearchBench& bench) {
  auto nodes = contents<Bvh8Node>(compute, bench.deviceScene.bvh8Nodes);
  auto triangles = contents<device::DeviceTriangle>(compute, bench.deviceScene.triangles);
  const auto leaves = contents<float>(compute, bench.deviceScene.leaves);
  triangles.pop_back();  // the sentinel, which nothing here points to
  const std::size_t byNodes = (std::size_t{1} << 24) + 3, byTriangles = kMaxTriangles - triangles.size();
  static_assert(kMaxTriangles * 9 * sizeof(float) > std::size_t{1} << 32);
  for (Bvh8Node& n : nodes)
    for (int k = 0; k < 8; ++k) {
      std::int32_t& c = n.child[k];
      const auto leaf = static_cast<std::uint32_t>(~c);
      if (!(n.lo[0][k] <= n.hi[0][k])) continue;
      c = c >= 0 ? static_cast<std::int32_t>(moved(c, byNodes))
                 : static_cast<std::int32_t>(~(moved(leaf >> 3U, byTriangles) << 3U | (leaf & 7U)));
    }
  for (device::DeviceTriangle& t : triangles) t.primitive = moved(t.primitive, byTriangles);
  bench.firstTriangle = static_cast<std::uint32_t>(byTriangles);
  bench.deviceScene.bvh8Nodes = sparse(compute, "bvh8Nodes", byNodes + nodes.size(), {nodes[0]}, nodes);
  bench.deviceScene.leaves = sparse(compute, "leaves", 9 * byTriangles + leaves.size(), {}, leaves);
  bench.deviceScene.triangles = sparse(compute, "triangles", kMaxTriangles, {}, triangles);
}

TEST(IndexRange, ExactAtTheFarEndOfTheLargestScene) {
  SearchLab lab;
  const DeviceInfo& device = lab.compute.device();
  if (device.kind != "cpu" || kSanitized) GTEST_SKIP() << "memory that is not written would be taken";
  constexpr std::size_t corners = kMaxTriangles * 9 * sizeof(float),
                        records = kMaxTriangles * sizeof(device::DeviceTriangle);
  if (device.largestBuffer < corners || device.globalMemory < 2 * corners + records)
    GTEST_SKIP() << formatBytes(device.largestBuffer) << " in one buffer, "
                 << formatBytes(device.globalMemory) << " in all: too little for the largest scene";
  // Each triangle twice in a row: which of the two counts is decided by indices that are one apart.
  test::TriangleMesh mesh = test::heightField(40, 61), twice = mesh;
  twice.triangles.clear();
  for (const glm::uvec3& t : mesh.triangles) twice.triangles.insert(twice.triangles.end(), {t, t});
  const Scene scene = test::sceneOf(twice);
  test::Rng rng(62);
  std::vector<TestRay> rays;
  for (int i = 0; i < 2003; ++i) {
    const glm::vec3 o = rng.inBox(1) + glm::vec3(0, 1.5F, 0), at = rng.inBox(1);
    rays.push_back({o, glm::normalize(glm::vec3(at.x, 0, at.z) - o)});
  }
  const std::vector<float> lengths(rays.size(), 1.5F);
  for (const SearchForm& form : searchForms()) {
    if (form.search == Search::Array) continue;  // would walk over all 2^27
    SCOPED_TRACE(form.name);
    SearchBench bench(lab, scene, form);
    const auto expected = bench.nearest(rays);
    const auto expectedBlocked = bench.occluded(rays, lengths);
    if (form.lanes != Lanes::One)
      moveBvh8(lab.compute, bench);
    else
      moveBvh2(lab.compute, bench);
    EXPECT_GT(bench.firstTriangle, 1U << 24U);
    const auto hits = bench.nearest(rays);
    std::size_t different = 0, met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      different += !(hits[i] == expected[i]);
      met += hits[i].primitive >= 0;
      if (hits[i].primitive >= 0) {
        EXPECT_EQ(hits[i].primitive % 2, 0) << "the second of two alike";
      }
    }
    test::recordCount("34",
                      fmt::format("the last of 2^27 triangles, buffers beyond 2^32 bytes, {}", form.name),
                      "the triangles and distances of a small scene", different, rays.size(), "rays");
    EXPECT_GT(met, rays.size() / 2);
    EXPECT_EQ(bench.occluded(rays, lengths), expectedBlocked);
  }
}

}  // namespace
}  // namespace whittle
