// Rays from inside closed meshes of every size at every place meet something, in every form of the search,
// nearest hit and any hit: in random directions, along the axes, and aimed at edges and vertices. Half a
// minute's worth would not fit the suite: WHITTLE_LEAK_RAYS=1e8 sets how many rays each form gets
// (experiments/run leaks).
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "support/closed_meshes.h"
#include "support/search_bench.h"

namespace whittle {
namespace {

using test::ClosedMesh;
using test::SearchBench;
using test::SearchForm;
using test::searchForms;
using test::SearchLab;
using test::TestHit;
using test::TestRay;

constexpr double kShortRun = 2e5;              // rays of each form in the suite
constexpr std::size_t kShortBatch = 2048 + 3;  // rays of each mesh there; not a multiple of eight
constexpr std::size_t kLongBatch = 65536 - 5;

struct LeakCount {
  std::size_t rays = 0, leaks = 0;
  double seconds = 0;
};

glm::vec3 target(const ClosedMesh& m, bool vertex, test::Rng& rng) {
  const glm::uvec3 t = m.mesh.triangles[rng.bits() % m.mesh.triangles.size()];
  const int corner = static_cast<int>(rng.bits() % 3);
  const glm::vec3 a = m.mesh.positions[t[corner]], b = m.mesh.positions[t[(corner + 1) % 3]];
  return vertex ? a : glm::mix(a, b, rng.unit());
}

std::vector<TestRay> raysFromInside(const ClosedMesh& m, std::size_t count, test::Rng& rng) {
  std::vector<TestRay> rays;
  rays.reserve(count);
  while (rays.size() < count) {
    const glm::vec3 o = m.inside[rng.bits() % m.inside.size()];
    glm::vec3 d = rng.direction();
    const auto kind = rng.bits() % 8;
    if (kind == 0) {
      d = glm::vec3(rng.bits() & 1U ? 0.0F : -0.0F);
      d[static_cast<int>(rng.bits() % 3)] = rng.bits() & 1U ? 1.0F : -1.0F;
    } else if (kind < 5) {
      d = glm::vec3(glm::normalize(glm::dvec3(target(m, kind == 1, rng)) - glm::dvec3(o)));
    }
    rays.push_back({o, d});
  }
  return rays;
}

std::string describe(const ClosedMesh& m, std::uint64_t index, const TestRay& r) {
  return fmt::format("mesh {} ({}, {} triangles), from ({:a}, {:a}, {:a}) along ({:a}, {:a}, {:a})", index,
                     m.name, m.mesh.triangles.size(), r.o.x, r.o.y, r.o.z, r.d.x, r.d.y, r.d.z);
}

void countLeaks(SearchLab& lab, const SearchForm& form, const ClosedMesh& m, std::uint64_t index,
                const std::vector<TestRay>& rays, LeakCount& count) {
  const auto start = std::chrono::steady_clock::now();
  SearchBench bench(lab, test::sceneOf(m.mesh), form);
  const auto hits = bench.nearest(rays);
  const auto occluded = bench.occluded(rays, std::vector<float>(rays.size(), 1e30F));
  count.rays += rays.size();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].primitive >= 0 && occluded[i]) continue;
    if (++count.leaks > 3) continue;
    ADD_FAILURE() << form.name << (hits[i].primitive < 0 ? ", nearest: " : ", any hit: ")
                  << describe(m, index, rays[i]);
  }
  count.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(Leaks, NoRayLeavesAClosedMesh) {
  const char* asked = std::getenv("WHITTLE_LEAK_RAYS");
  const double total = asked ? std::strtod(asked, nullptr) : kShortRun;
  ASSERT_TRUE(total >= 1 && total <= 1e12) << "WHITTLE_LEAK_RAYS=" << asked;
  const std::size_t batch = total > 10 * kShortRun ? kLongBatch : kShortBatch;
  SearchLab lab;
  std::vector<LeakCount> counts(searchForms().size());
  for (std::uint64_t index = 0; static_cast<double>(counts[0].rays) < total; ++index) {
    const ClosedMesh mesh = test::randomClosedMesh(index);
    ASSERT_FALSE(test::hasSeam(mesh.mesh)) << index;
    test::Rng rng(index);
    const auto rays = raysFromInside(mesh, batch, rng);
    for (std::size_t f = 0; f < searchForms().size(); ++f)
      countLeaks(lab, searchForms()[f], mesh, index, rays, counts[f]);
  }
  for (std::size_t f = 0; f < searchForms().size(); ++f) {
    const LeakCount& c = counts[f];
    EXPECT_EQ(c.leaks, 0U) << searchForms()[f].name << " of " << c.rays << " rays";
    // The lines that experiments/checks/leaks.sh collects.
    if (asked) fmt::print("leaks\t{}\t{}\t{}\t{:.1f}\n", searchForms()[f].name, c.rays, c.leaks, c.seconds);
  }
}

/// What the meshes promise: every edge belongs to two triangles.
TEST(Leaks, TheMeshesAreClosed) {
  for (std::uint64_t index = 0; index < 120; ++index) {
    const ClosedMesh m = test::randomClosedMesh(index);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const glm::uvec3& t : m.mesh.triangles)
      for (int k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
    for (const auto& [edge, uses] : edges) ASSERT_EQ(uses, 2) << m.name << " " << index;
    ASSERT_GE(m.mesh.triangles.size(), 12U);
    ASSERT_FALSE(m.inside.empty());
  }
}

}  // namespace
}  // namespace whittle
