// Closed surfaces have no holes: rays from inside always hit, wherever the surface stands, through edges and
// corners and along the axes. In every form of the search; they give the same bits.
#include <gtest/gtest.h>

#include "support/record.h"
#include "support/search_bench.h"

namespace whittle {
namespace {

using test::SearchBench;
using test::SearchForm;
using test::searchForms;
using test::SearchLab;
using test::TestHit;
using test::TestRay;

std::size_t misses(const std::vector<TestHit>& hits) {
  return static_cast<std::size_t>(
      std::count_if(hits.begin(), hits.end(), [](const TestHit& h) { return h.primitive < 0; }));
}

/// The array forms get the first `arrayRays` alone: of large scenes they would take minutes.
void expectNoMiss(SearchLab& lab, const test::TriangleMesh& mesh, const std::vector<TestRay>& all,
                  std::size_t arrayRays, const char* id, const std::string& construction) {
  const Scene scene = test::sceneOf(mesh);
  for (const SearchForm& form : searchForms()) {
    std::vector<TestRay> rays = all;
    if (form.search == Search::Array) rays.resize(std::min(rays.size(), arrayRays));
    SearchBench bench(lab, scene, form);
    const auto hits = bench.nearest(rays);
    test::recordCount(id, fmt::format("{}, {}", construction, form.name), "every ray hits", misses(hits),
                      rays.size(), "rays");
    const auto occluded = bench.occluded(rays, std::vector<float>(rays.size(), 1e30F));
    EXPECT_EQ(std::count(occluded.begin(), occluded.end(), false), 0) << form.name << ", any hit";
  }
}

/// After Embree's watertight test: far from the origin a sphere's vertices snap to a grid and its triangles
/// are slivers.
TEST(Watertight, SphereFarFromTheOrigin) {
  SearchLab lab;
  const glm::vec3 centre(148376, 1234, -223423);
  for (const float radius : {2.0F, 1000.0F}) {
    SCOPED_TRACE(radius);
    test::Rng rng(11);
    std::vector<TestRay> rays;
    for (int i = 0; i < 100003; ++i) rays.push_back({centre + rng.inBox(0.3F * radius), rng.direction()});
    expectNoMiss(lab, test::closedSphere(centre, radius, 200, 200), rays, 203, "2",
                 fmt::format("from inside a sphere of {} m at (148376, 1234, -223423)", radius));
  }
}

/// Rays aimed at the middle of edges, at points along them and at vertices, from inside closed meshes.
TEST(Watertight, EdgeAndVertexShots) {
  SearchLab lab;
  for (const glm::vec3 centre : {glm::vec3(0), glm::vec3(100, -50, 3), glm::vec3(3000, 20000, -7)}) {
    SCOPED_TRACE(centre.x);
    const auto mesh = test::closedSphere(centre, 1.0F, 9, 17);
    test::Rng rng(12);
    std::vector<TestRay> rays;
    for (int i = 0; i < 20001; ++i) {
      const glm::uvec3 t = mesh.triangles[rng.bits() % mesh.triangles.size()];
      const int corner = static_cast<int>(rng.bits() % 3);
      const glm::vec3 a = mesh.positions[t[corner]], b = mesh.positions[t[(corner + 1) % 3]];
      const float along = i % 3 == 0 ? 0.0F : i % 3 == 1 ? 0.5F : rng.unit();
      const glm::vec3 o = centre + rng.inBox(0.4F);
      rays.push_back({o, glm::normalize(a + along * (b - a) - o)});
    }
    expectNoMiss(
        lab, mesh, rays, rays.size(), "3",
        fmt::format("aimed at edges and vertices of a ball at ({}, {}, {})", centre.x, centre.y, centre.z));
  }
}

/// Rays aimed at the corners and edges of triangles that have no neighbour to catch a miss: the tree must not
/// lose what the triangle test takes, nor find what it does not.
TEST(Watertight, TreeAndArrayAgreeAtOutermostCorners) {
  SearchLab lab;
  for (const float distance : {0.5F, 5.0F, 500.0F}) {
    SCOPED_TRACE(distance);
    const auto mesh = test::randomSoup(500, 0.05F, 15);
    const Scene scene = test::sceneOf(mesh);
    test::Rng rng(16);
    std::vector<TestRay> rays;
    for (int i = 0; i < 20001; ++i) {
      const glm::uvec3 t = mesh.triangles[rng.bits() % mesh.triangles.size()];
      const int corner = static_cast<int>(rng.bits() % 3);
      const glm::vec3 a = mesh.positions[t[corner]], b = mesh.positions[t[(corner + 1) % 3]];
      glm::vec3 away = rng.direction();
      if (i % 3 == 0) away[corner] *= std::pow(10.0F, rng.between(-9, 0));  // nearly along a face of the box
      if (i % 3 == 1) away[corner] = 0;
      const glm::vec3 o = a + distance * away;
      rays.push_back({o, glm::normalize(a + (i % 2 ? 0.0F : rng.unit()) * (b - a) - o)});
    }
    std::vector<TestHit> expected;
    for (const SearchForm& form : searchForms()) {
      const auto hits = SearchBench(lab, scene, form).nearest(rays);
      if (expected.empty()) expected = hits;
      std::size_t different = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) different += !(hits[i] == expected[i]);
      EXPECT_EQ(different, 0U) << form.name << " of " << rays.size();
    }
    EXPECT_GT(misses(expected), 1000U) << "about half of the shots at a lone corner go past it";
  }
}

/// Unit cubes on a grid, faces split in two: every ray below runs exactly along planes, edges and corners.
test::TriangleMesh cubeGrid(int side) {
  test::TriangleMesh mesh;
  test::Rng rng(13);
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) {
        if (rng.bits() % 3) continue;
        const glm::vec3 lo(x, y, z);
        for (int axis = 0; axis < 3; ++axis)
          for (int far = 0; far < 2; ++far) {
            glm::vec3 corner = lo, u(0), v(0);
            corner[axis] += static_cast<float>(far);
            u[(axis + 1) % 3] = 1, v[(axis + 2) % 3] = 1;
            mesh.add(corner, corner + u, corner + v);
            mesh.add(corner + u + v, corner + v, corner + u);
          }
      }
  return mesh;
}

/// Coordinates are small integers and halves, so the kernels' arithmetic is exact and so is the brute force
/// in double: the same triangle, lowest index first, is what must come out. Directions have +0 and -0.
TEST(AxisAligned, SameTrianglesAsExactArithmetic) {
  SearchLab lab;
  const Scene scene = test::sceneOf(cubeGrid(4));
  test::Rng rng(14);
  std::vector<TestRay> rays;
  for (int i = 0; i < 3001; ++i) {
    TestRay ray{};
    for (int a = 0; a < 3; ++a) {
      ray.o[a] = static_cast<float>(rng.bits() % 13) * 0.5F - 1.0F;
      ray.d[a] = rng.bits() & 1U ? 0.0F : -0.0F;
    }
    const int axis = static_cast<int>(rng.bits() % 3);
    ray.d[axis] = rng.bits() & 1U ? 1.0F : -1.0F;
    if (i % 3 == 2) ray.d[(axis + 1) % 3] = rng.bits() & 1U ? 0.5F : -1.0F;
    rays.push_back(ray);
  }
  std::vector<std::int64_t> expected;
  for (const TestRay& ray : rays) {
    const test::ExactHit* best = nullptr;
    const auto hits = test::exactHits(scene, ray, 0.0);
    for (const auto& h : hits)
      if (h.t > 0 && (!best || h.t < best->t)) best = &h;
    expected.push_back(best ? best->primitive : -1);
  }
  for (const SearchForm& form : searchForms()) {
    SearchBench bench(lab, scene, form);
    const auto hits = bench.nearest(rays);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].primitive == expected[i]) continue;
      if (++wrong <= 3)
        ADD_FAILURE() << form.name
                      << fmt::format(": from ({}, {}, {}) along ({}, {}, {}): {} and not {}", rays[i].o.x,
                                     rays[i].o.y, rays[i].o.z, rays[i].d.x, rays[i].d.y, rays[i].d.z,
                                     hits[i].primitive, expected[i]);
    }
    test::recordCount(
        "4", fmt::format("rays along axes and planes of a grid of cubes, directions ±0, {}", form.name),
        "the triangle of exact arithmetic", wrong, rays.size(), "rays");
  }
}

}  // namespace
}  // namespace whittle
