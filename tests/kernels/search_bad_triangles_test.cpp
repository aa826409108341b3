// Triangles that cannot be hit change nothing: corners that are not finite or beyond what squares to a float,
// corners on one line, the same corner twice. In every form of the search the others are found as if those
// were absent.
#include <gtest/gtest.h>

#include "gltf/builder.h"
#include "support/record.h"
#include "support/search_bench.h"

namespace whittle {
namespace {

using test::SearchBench;
using test::searchForms;
using test::SearchLab;
using test::TestHit;
using test::TestRay;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// A bad triangle near p, of one of `kinds` kinds: those that a scene's triangle can be, then those that only
/// a file's can.
constexpr std::uint64_t kSceneKinds = 6, kFileKinds = 8;
std::array<glm::vec3, 3> badTriangle(std::uint64_t kind, const glm::vec3& p, test::Rng& rng) {
  const glm::vec3 a = p + rng.inBox(0.2F), b = p + rng.inBox(0.2F);
  glm::vec3 broken = a;
  switch (kind) {
    case 0:
      broken[static_cast<int>(rng.bits() % 3)] = kNan;
      return {p, broken, b};
    case 1:
      broken[static_cast<int>(rng.bits() % 3)] = rng.bits() & 1U ? kInf : -kInf;
      return {broken, p, b};
    case 2:
      return {glm::vec3(kNan), glm::vec3(kInf), glm::vec3(-kInf)};
    case 3:  // on one line, exactly: the middle one is half way between neighbours that are multiples of 1/64
    {
      const glm::vec3 from = glm::round(64.0F * p) / 64.0F, step = glm::round(8.0F * rng.inBox(1)) / 64.0F;
      return {from, from + step, from + 2.0F * step};
    }
    case 4:
      return {p, a, a};
    case 5:
      return {p, p, p};
    case 6:
      return {p, a, 2e18F * rng.direction() * 1.8F};
    default:
      return {p, glm::vec3(3e38F, -3e38F, 0), b};
  }
}

struct Mixture {
  test::TriangleMesh good, all;
  std::vector<std::int64_t> goodOf;  ///< by triangle of `all`: its index in `good`, -1 for a bad one
};

/// Every second triangle is bad, the first included.
Mixture mixtureOf(std::uint64_t kinds) {
  test::Rng rng(51);
  Mixture m;
  const auto soup = test::randomSoup(900, 0.2F, 50);
  for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
    const auto bad = badTriangle(i % kinds, rng.inBox(1), rng);
    m.all.add(bad[0], bad[1], bad[2]);
    const glm::vec3* p = &soup.positions[3 * i];
    m.goodOf.insert(m.goodOf.end(), {-1, static_cast<std::int64_t>(i)});
    m.all.add(p[0], p[1], p[2]);
  }
  // The same corner by the same index, not only at the same place.
  m.all.triangles.emplace_back(3, 4, 4);
  m.all.triangles.emplace_back(4, 4, 4);
  m.goodOf.insert(m.goodOf.end(), {-1, -1});
  m.good = soup;
  return m;
}

std::vector<TestRay> someRays() {
  test::Rng rng(52);
  std::vector<TestRay> rays;
  for (int i = 0; i < 2003; ++i) rays.push_back({rng.inBox(1.2F), rng.direction()});
  return rays;
}

void expectSameAnswers(SearchLab& lab, const Scene& good, const Scene& all,
                       const std::vector<std::int64_t>& goodOf) {
  const auto rays = someRays();
  const std::vector<float> lengths(rays.size(), 0.7F);
  for (const auto& form : searchForms()) {
    SearchBench expected(lab, good, form), found(lab, all, form);
    const auto a = expected.nearest(rays);
    auto b = found.nearest(rays);
    std::size_t different = 0, met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (b[i].primitive >= 0) b[i].primitive = goodOf.at(static_cast<std::size_t>(b[i].primitive));
      different += !(a[i] == b[i]);
      met += a[i].primitive >= 0;
    }
    test::recordCount("6",
                      fmt::format("NaN, Inf, 0 area, repeated corners between good triangles, {}", form.name),
                      "hits as if absent; the loader counts and warns", different, rays.size(), "rays");
    EXPECT_GT(met, rays.size() / 4) << "or there was nothing to find";
    EXPECT_EQ(expected.occluded(rays, lengths), found.occluded(rays, lengths)) << form.name << ", any hit";
  }
}

TEST(BadTriangles, AreAsIfAbsent) {
  SearchLab lab;
  const Mixture m = mixtureOf(kSceneKinds);
  expectSameAnswers(lab, test::sceneOf(m.good), test::sceneOf(m.all), m.goodOf);
}

/// A mesh as the loader reads it from a file.
Scene loaded(const test::TriangleMesh& mesh, test::GltfBuilder& file) {
  std::vector<float> positions;
  std::vector<std::uint32_t> corners;
  for (const glm::vec3& p : mesh.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
  for (const glm::uvec3& t : mesh.triangles) corners.insert(corners.end(), {t.x, t.y, t.z});
  file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", file.vec3(positions)}}},
                                 {"indices", file.indices<std::uint32_t>(corners)}})}});
  Scene scene = file.load();
  for (Material& m : scene.materials) m.doubleSided = true;  // the search's two sides are compared
  return scene;
}

/// Those with a coordinate beyond 1.8e18 never reach a search: the loader drops them, counts and says so.
TEST(BadTriangles, OfAFileAreDroppedCountedAndReported) {
  SearchLab lab;
  const Mixture m = mixtureOf(kFileKinds);
  test::GltfBuilder goodFile, wholeFile;
  const Scene good = loaded(m.good, goodFile), all = loaded(m.all, wholeFile);
  EXPECT_EQ(good.droppedTriangles, 0U);
  ASSERT_EQ(all.triangles.size(), m.good.triangles.size());
  EXPECT_EQ(all.droppedTriangles, m.all.triangles.size() - m.good.triangles.size());
  const auto said = [](const std::vector<std::string>& lines, const char* part) {
    return std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.find(part) != std::string::npos && line.find_first_of("123456789") == 0;
    });
  };
  EXPECT_EQ(said(wholeFile.notices.warnings, "not finite or beyond 1.8e+18"), 1);
  EXPECT_EQ(said(wholeFile.notices.notes, "of no area dropped"), 1);
  std::vector<std::int64_t> same(all.triangles.size());
  for (std::size_t i = 0; i < same.size(); ++i) same[i] = static_cast<std::int64_t>(i);
  expectSameAnswers(lab, good, all, same);
}

}  // namespace
}  // namespace whittle
