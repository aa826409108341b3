// Where nodes and meshes lie: what a scene lists that is no root, and meshes too far from their own origin
// for floats.
#include <gtest/gtest.h>

#include "gltf/builder.h"

namespace whittle {
namespace {

using test::corner;
using test::expectNear;
using test::GltfBuilder;
using test::Json;
using test::mentions;

/// A node at x = 1 and, below it, one at y = 2 from there with a triangle; the scene lists `roots`
/// of the two.
GltfBuilder parentAndChild(const Json& roots) {
  GltfBuilder b;
  b.node({{"translation", {1, 0, 0}}, {"children", {1}}}, false);
  b.node({{"mesh", b.triangleMesh()}, {"translation", {0, 2, 0}}, {"name", "hand"}}, false);
  b.json["scenes"][0]["nodes"] = roots;
  return b;
}

TEST(GltfSceneRoots, AChildAmongThemIsDrawnOnceInItsPlace) {
  for (const Json& roots : {Json{0, 1}, Json{1, 0}}) {
    GltfBuilder b = parentAndChild(roots);
    const Scene scene = b.load();
    ASSERT_EQ(scene.triangles.size(), 1U) << roots;
    expectNear(corner(scene, 0, 0), {1, 2, 0}, 0);
    EXPECT_TRUE(mentions(b.notices.warnings, "node 1 \"hand\", a child of node 0: it is drawn once"))
        << roots;
  }
}

TEST(GltfSceneRoots, AChildWithoutItsParentIsDrawnWhereItsParentPutsIt) {
  GltfBuilder b = parentAndChild({1});
  const Scene scene = b.load();
  ASSERT_EQ(scene.triangles.size(), 1U);
  expectNear(corner(scene, 0, 0), {1, 2, 0}, 0);
}

TEST(GltfSceneRoots, EveryNodeOfAChainIsDrawnOnceAndOneWarningCountsThem) {
  constexpr int kNodes = 20000;
  GltfBuilder b;
  const int mesh = b.triangleMesh();
  for (int i = 0; i < kNodes; ++i) {
    Json node{{"mesh", mesh}};
    if (i + 1 < kNodes) node["children"] = {i + 1};
    b.node(node);
  }
  EXPECT_EQ(b.load().triangles.size(), static_cast<std::size_t>(kNodes));
  ASSERT_EQ(b.notices.warnings.size(), 1U);
  EXPECT_TRUE(mentions(b.notices.warnings,
                       "(and 19998 more)"));  // all but the first root and the child that is named
}

TEST(GltfSceneRoots, TheSameRootTwiceStaysAnError) {
  GltfBuilder b = parentAndChild({0, 0});
  EXPECT_NE(b.error().find("the scene lists node 0 twice"), std::string::npos);
}

/// A triangle whose legs are `size` long, at `x`.
int triangleAt(GltfBuilder& b, float x, float size, const std::string& name) {
  const int mesh = b.mesh({{"attributes", {{"POSITION", b.vec3({x, 0, 0, x + size, 0, 0, x, size, 0})}}}});
  b.json["meshes"][static_cast<std::size_t>(mesh)]["name"] = name;
  return mesh;
}

TEST(GltfPrecision, MeshesFarFromTheirOwnOriginAreNamedWithWhatIsLost) {
  GltfBuilder b;
  b.node({{"mesh", triangleAt(b, 4999992, 8, "terrain")}});
  b.load();
  ASSERT_EQ(b.notices.warnings.size(), 1U);
  // 5e6 lies between 2^22 and 2^23: floats there are 2^-1 apart. The box is 8 x 8 m: 0.5 / 11.31 = 4.4 %.
  EXPECT_TRUE(
      mentions(b.notices.warnings,
               "positions of meshes[0] \"terrain\" lie up to 5000000 m from the mesh's own origin: single "
               "precision keeps them to 0.5 m there, 4.4 % of the mesh's size"))
      << b.notices.warnings[0];
}

TEST(GltfPrecision, TheWorstIsNamedAndTheOthersCounted) {
  GltfBuilder b;
  b.node({{"mesh", triangleAt(b, 1e6F, 16, "far")}});
  b.node({{"mesh", triangleAt(b, 1e7F, 16, "farther")}});
  const int twice = triangleAt(b, 1e6F, 32, "large");
  b.node({{"mesh", twice}});
  b.node({{"mesh", twice}});
  b.load();
  ASSERT_EQ(b.notices.warnings.size(), 1U);
  EXPECT_TRUE(mentions(b.notices.warnings, "\"farther\"")) << b.notices.warnings[0];
  EXPECT_TRUE(mentions(b.notices.warnings, "(2 more like it)")) << b.notices.warnings[0];
}

TEST(GltfPrecision, NothingIsSaidWhereNobodySeesIt) {
  GltfBuilder b;
  // At 1000 m floats are 2^-14 m apart: of the 1.41 m of this box 4e-5.
  b.node({{"mesh", triangleAt(b, 1000, 1, "near")}});
  // As large as it is far away.
  b.node({{"mesh", triangleAt(b, 0, 8e6F, "continent")}});
  // The node's place is the program's business, which computes in double.
  b.node({{"mesh", triangleAt(b, 0, 1, "moved")}, {"translation", {5e6, 0, 0}}});
  // Integers are exact: at 60 000 floats would be 2^-8 apart, of a box of 1.41 three parts in a thousand.
  const int grid =
      b.accessor(b.view(std::vector<std::uint16_t>{60000, 0, 0, 0, 60001, 0, 0, 0, 60000, 1, 0, 0}, 8),
                 "VEC3", test::kUshort, 3);
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", grid}}}})}});
  // Points are not drawn.
  Json points{{"mode", 0}, {"attributes", {{"POSITION", b.vec3({5e6F, 0, 0, 5e6F + 8, 0, 0})}}}};
  b.node({{"mesh", b.mesh(points)}});
  b.load();
  EXPECT_TRUE(b.notices.warnings.empty()) << b.notices.warnings[0];
}

}  // namespace
}  // namespace whittle
