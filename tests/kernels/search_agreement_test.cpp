// The forms of the search (one ray or sixteen, array or tree) give the same bits on random
// scenes, the triangle that exact arithmetic finds, and any-hit answers that agree with the nearest hit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/record.h"
#include "support/search_bench.h"

namespace whittle {
namespace {

using test::SearchBench;
using test::searchForms;
using test::SearchLab;
using test::TestHit;
using test::TestRay;

/// Rays of every kind: coherent bundles from an eye, incoherent ones, some from far away, some
/// along the axes.
std::vector<TestRay> mixedRays(std::size_t count, std::uint64_t seed) {
  test::Rng rng(seed);
  std::vector<TestRay> rays;
  for (std::size_t i = 0; i < count; ++i) {
    switch (i / 8 % 4) {
      case 0:
        rays.push_back({{0, 0.5F, 4}, glm::normalize(glm::vec3(rng.inBox(0.3F).x, rng.inBox(0.3F).y, -1))});
        break;
      case 1:
        rays.push_back({rng.inBox(1), rng.direction()});
        break;
      case 2: {
        const glm::vec3 o = 1000.0F * rng.direction();
        rays.push_back({o, glm::normalize(rng.inBox(1) - o)});
        break;
      }
      default: {
        glm::vec3 d(0.0F);
        d[static_cast<int>(rng.bits() % 3)] = rng.bits() & 1U ? 1.0F : -1.0F;
        rays.push_back({rng.inBox(1.5F), d});
      }
    }
  }
  return rays;
}

/// All forms agree bit by bit; returns the answers.
std::vector<TestHit> agreedHits(SearchLab& lab, const Scene& scene, const std::vector<TestRay>& rays) {
  std::vector<TestHit> expected;
  for (const auto& form : searchForms()) {
    SearchBench bench(lab, scene, form);
    const auto hits = bench.nearest(rays);
    if (expected.empty()) expected = hits;
    std::size_t different = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (hits[i] == expected[i]) continue;
      if (++different <= 3)
        ADD_FAILURE() << form.name << " ray " << i << ": triangle " << hits[i].primitive << " t " << hits[i].t
                      << " and not " << expected[i].primitive << " t " << expected[i].t;
    }
    EXPECT_EQ(different, 0U) << form.name << " of " << rays.size();
    // Any hit: at half and twice the nearest distance, and on it exactly (which is not before it).
    std::vector<float> lengths(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i)
      lengths[i] = std::isinf(hits[i].t) ? 1e30F : hits[i].t * (i % 3 == 0 ? 0.5F : i % 3 == 1 ? 2.0F : 1.0F);
    const auto occluded = bench.occluded(rays, lengths);
    std::size_t disagree = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) disagree += occluded[i] != (hits[i].t < lengths[i]);
    EXPECT_EQ(disagree, 0U) << form.name << ": any-hit against nearest";
  }
  return expected;
}

struct Case {
  const char* name;
  test::TriangleMesh mesh;
};

TEST(SearchAgreement, RandomScenes) {
  SearchLab lab;
  const Case cases[] = {{"soup", test::randomSoup(2000, 0.1F, 1)},
                        {"large triangles", test::randomSoup(300, 1.0F, 2)},
                        {"slivers", test::longThinTriangles(1000, 1.0F, 3)},
                        {"height field", test::heightField(24, 4)},
                        {"sphere", test::closedSphere({0, 0, 0}, 1.0F, 16, 32)}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const Scene scene = test::sceneOf(c.mesh);
    const auto rays = mixedRays(2003, 7);  // not a multiple of eight
    const auto hits = agreedHits(lab, scene, rays);
    std::size_t wrong = 0, hit = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hit += hits[i].primitive >= 0;
      const std::string verdict = test::judge(scene, rays[i], hits[i]);
      if (verdict.empty()) continue;
      if (++wrong <= 3) ADD_FAILURE() << "ray " << i << ": " << verdict;
    }
    EXPECT_EQ(wrong, 0U) << "against exact arithmetic";
    EXPECT_GT(hit, rays.size() / 10) << "the rays must meet something to say anything";
    EXPECT_LT(hit, rays.size());
  }
}

/// Packets whose rays run two or three ways, mixed lane by lane and in every proportion, as behind a mirror
/// that bends. Each way widens to `spread`, so that its rays part again in front of small triangles.
std::vector<TestRay> raysOfSomeWays(float spread, std::uint64_t seed) {
  constexpr int kPacket = 16;
  test::Rng rng(seed);
  std::vector<TestRay> rays;
  for (int packet = 0; packet < 120; ++packet) {
    const int ways = 2 + packet % 2, ofFirst = packet % (kPacket + 1);
    const glm::vec3 o[3] = {3.0F * rng.direction(), 3.0F * rng.direction(), 3.0F * rng.direction()};
    for (int lane = 0; lane < kPacket; ++lane) {
      const int way =
          lane * 7 % kPacket < ofFirst ? 0 : 1 + lane % (ways - 1);  // 7: the lanes of a way lie apart
      const glm::vec3 from = o[way] + rng.inBox(0.1F);
      rays.push_back({from, glm::normalize(spread * rng.inBox(1) - o[way])});
    }
  }
  return rays;
}

TEST(SearchAgreement, PacketsThatRunSomeWays) {
  SearchLab lab;
  const Case cases[] = {{"soup", test::randomSoup(4000, 0.05F, 5)},
                        {"large triangles", test::randomSoup(200, 1.0F, 6)},
                        {"sphere", test::closedSphere({0, 0, 0}, 1.0F, 64, 128)}};
  for (const Case& c : cases)
    for (const float spread : {0.02F, 0.3F, 1.0F}) {
      SCOPED_TRACE(fmt::format("{}, spread {}", c.name, spread));
      const auto rays = raysOfSomeWays(spread, 11);
      const auto hits = agreedHits(lab, test::sceneOf(c.mesh), rays);
      const auto met =
          std::count_if(hits.begin(), hits.end(), [](const TestHit& h) { return h.primitive >= 0; });
      EXPECT_GT(met, static_cast<std::ptrdiff_t>(rays.size() / 10));
    }
}

/// Gravel of millimetres on a plain a hundred kilometres wide. The plain's corners round to as much as
/// the gravel is high: its t alone may lie before its box, and which is nearer would depend on whether
/// the box is culled.
TEST(SearchAgreement, GravelOnAPlain) {
  SearchLab lab;
  test::Rng rng(91);
  test::TriangleMesh mesh;
  mesh.add({-1.1e5F, 0, -1.3e5F}, {1.2e5F, 0, -0.9e5F}, {0.1e5F, 0, 1.3e5F});
  for (int k = 0; k < 15000; ++k) {
    const glm::vec3 at = rng.inBox(3) * glm::vec3(1, 0.001F, 1), flat(1, 0.05F, 1);
    mesh.add(at, at + rng.inBox(0.06F) * flat, at + rng.inBox(0.06F) * flat);
  }
  std::vector<TestRay> rays;
  for (int k = 0; k < 4003; ++k) {
    const glm::vec3 eye(0.1F, 1.7F, -4.0F), at = rng.inBox(3) * glm::vec3(1, 0, 1);
    rays.push_back({eye, glm::normalize(at - eye)});
  }
  const Scene scene = test::sceneOf(mesh);
  const auto hits = agreedHits(lab, scene, rays);
  std::size_t gravel = 0;
  double worst = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    gravel += hits[i].primitive > 0;
    if (hits[i].primitive == 0)
      worst = std::max(worst, std::abs(double{rays[i].o.y} / -double{rays[i].d.y} / double{hits[i].t} - 1));
  }
  EXPECT_GT(gravel, rays.size() / 10);
  EXPECT_LT(gravel, rays.size());
  // Clamped, t is a difference, a reciprocal and a product. Where the plain lies across the ray's largest
  // axis its corners are as near as the hit: then t is a sum of weights, with eight roundings on the way (two
  // in the area, two in its quotient, one in a weight's product, two in the sum, one in the distance along
  // the axis).
  EXPECT_LT(worst, 8 * 0x1p-24);
}

TEST(SearchAgreement, FewTrianglesAndFewRays) {
  SearchLab lab;
  test::TriangleMesh one;
  one.add({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  for (const auto& mesh :
       {test::TriangleMesh{}, one, test::randomSoup(5, 1.0F, 5), test::randomSoup(17, 1.0F, 6)}) {
    for (const std::size_t count : {1U, 2U, 7U, 8U, 9U, 15U, 129U}) {
      SCOPED_TRACE(fmt::format("{} triangles, {} rays", mesh.triangles.size(), count));
      const Scene scene = test::sceneOf(mesh);
      auto rays = mixedRays(count, 8);
      rays.back() = {{0, 0, 3}, {0, 0, -1}};
      const auto hits = agreedHits(lab, scene, rays);
      for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(test::judge(scene, rays[i], hits[i]), "");
      if (mesh.triangles.empty()) {
        EXPECT_EQ(hits.back().primitive, -1);
      }
      if (mesh.triangles.size() == 1) {
        EXPECT_EQ(hits.back(), (TestHit{3.0F, 0.25F, 0.5F, 0}));
      }
    }
  }
}

/// The same triangle again and again: the lowest index wins in every form, whatever the order of the leaves.
TEST(SearchAgreement, OfEqualHitsTheLowestIndexWins) {
  SearchLab lab;
  test::TriangleMesh mesh;
  mesh.add({-3, -3, -1}, {3, -3, -1}, {0, 3, -1});
  for (int i = 0; i < 10000; ++i) mesh.add({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  const Scene scene = test::sceneOf(mesh);
  test::Rng rng(9);
  std::vector<TestRay> rays;
  for (int i = 0; i < 203; ++i) {
    const glm::vec3 o(rng.between(-0.1F, 0.1F), rng.between(-0.1F, 0.1F), i % 2 ? 2.0F : -0.5F);
    rays.push_back({o, glm::normalize(glm::vec3(rng.between(-0.1F, 0.1F), 0.05F, i % 2 ? -1 : 1))});
  }
  std::size_t others = 0;
  for (const TestHit& hit : agreedHits(lab, scene, rays)) others += hit.primitive != 1;
  test::recordCount("7", "the same triangle 10 000 times, all forms", "the lowest index wins", others,
                    rays.size(), "rays");
}

}  // namespace
}  // namespace whittle
