// Case 31: numbers that are no numbers, from a file or by hand. The picture stays finite, and something says
// how much of it was lost: the count of samples, or a warning at loading.
#include "forms.h"
#include "gltf/builder.h"

namespace whittle::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Left of x = 0 a wall hides the floor from the light: there nothing is spoilt. Nine pixels from x = −4
/// to 4.
Scene halfLit(const Material& floor, const glm::vec3& intensity) {
  Scene scene;
  addFloor(scene, floor, 0, true, 8);
  addQuad(scene, addMaterial(scene, lambert(glm::vec3(0.5F))), {-0.25F, 0, -8}, {0, 0, 16}, {0, 8, 0});
  scene.lights = {pointLight({2, 2, 0}, 1)};
  scene.lights[0].intensity = intensity;
  scene.cameras = {rowCamera(-4, 1, 9, 9)};
  return scene;
}

Material dim(const glm::vec3& colour) {
  Material m = lambert(colour);
  m.emission = glm::vec3(0.25F);
  return m;
}

/// The four pixels behind the wall show the floor's own emission; the others are black and counted.
void expectHalfPoisoned(const Scene& scene, const std::string& construction) {
  const Views views = everyForm(scene, caseSettings(9, 1));
  EXPECT_TRUE(allFinite(views.kernel.radiance)) << construction;
  EXPECT_EQ(views.kernel.stats.nonFinite, views.reference.nonFinite);
  std::size_t wrong = views.kernel.stats.nonFinite == 5 ? 0 : 1;
  for (std::size_t i = 0; i < 9; ++i) wrong += red(views.kernel.radiance, i) != (i < 4 ? 0.25 : 0.0);
  record({"31", construction, "finite; 5 of 9 samples black and counted, 4 in shadow as they were",
          fmt::format("{} counted, {} pixels otherwise", views.kernel.stats.nonFinite, wrong),
          static_cast<double>(wrong), "pixels", 0});
}

TEST(Poison, ALightThatIsNoNumber) {
  expectHalfPoisoned(halfLit(dim(glm::vec3(0.5F)), glm::vec3(kNan)),
                     "a light of NaN W/sr, half of the floor in shadow");
  expectHalfPoisoned(halfLit(dim(glm::vec3(0.5F)), {kNan, 1, 1}), "a light whose red alone is NaN");
  expectHalfPoisoned(halfLit(dim(glm::vec3(0.5F)), glm::vec3(INFINITY)), "a light of infinite W/sr");
}

TEST(Poison, AnAlbedoThatOverflows) {
  expectHalfPoisoned(halfLit(dim(glm::vec3(1e38F)), glm::vec3(1e6F)),
                     "albedo 1e38 under a light of 1e6 W/sr");
  expectHalfPoisoned(halfLit(dim(glm::vec3(kNan)), glm::vec3(1)), "an albedo of NaN");
}

TEST(Poison, EmissionAndBackgroundThatAreNoNumbers) {
  for (const float bad : {kNan, INFINITY}) {
    Scene scene;
    addFloor(scene, emitter(glm::vec3(bad)), 0, true, 2);
    scene.background.radiance = glm::vec3(0.5F);
    scene.cameras = {rowCamera(-4, 1, 9, 9)};
    const Views views = everyForm(scene, caseSettings(9, 1));
    std::size_t wrong = views.kernel.stats.nonFinite == views.reference.nonFinite ? 0 : 1;
    // Pixels 2 to 6 look at x = −2 … 2; the outermost lie on the edge and may see either.
    for (const std::size_t i : {0U, 1U, 7U, 8U}) wrong += red(views.kernel.radiance, i) != 0.5;
    for (const std::size_t i : {3U, 4U, 5U}) wrong += red(views.kernel.radiance, i) != 0.0;
    record({"31", fmt::format("a square that emits {}", bad),
            "black and counted where it is seen, the rest as it was",
            fmt::format("{} counted, {} wrong", views.kernel.stats.nonFinite, wrong),
            static_cast<double>(wrong), "pixels", 0});
  }
}

/// What a mirror and a pane make of colours that are no numbers: the sample counts, it does not just go dark.
TEST(Poison, AMirrorAndAPaneOfNaN) {
  for (const auto& [pane, all] : {std::pair{false, false}, {false, true}, {true, false}, {true, true}}) {
    Material bad = pane ? glass(1.5F, false) : mirror(glm::vec3(1));
    bad.baseColor = {kNan, all ? kNan : 1, all ? kNan : 1, 1};
    Scene scene;
    addFloor(scene, bad, 0, true, 8);
    scene.background.radiance = glm::vec3(1);
    scene.cameras = {rowCamera(0, 1, 3, 2)};
    const Views views = everyForm(scene, caseSettings(3, 1, 4));
    EXPECT_TRUE(allFinite(views.kernel.radiance));
    EXPECT_EQ(views.kernel.stats.nonFinite, views.reference.nonFinite);
    record({"31",
            fmt::format("a {} whose {} NaN, in uniform light", pane ? "pane" : "mirror",
                        all ? "colour is" : "red alone is"),
            "3 of 3 samples counted", fmt::format("{} counted", views.kernel.stats.nonFinite),
            3.0 - static_cast<double>(views.kernel.stats.nonFinite), "samples", 0});
  }
}

/// 1e39 is a number in JSON and none in single precision.
TEST(Poison, AFileWhoseLightOverflowsIsWarnedAbout) {
  GltfBuilder b;
  b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 1e39}},
                                                           {{"type", "point"}, {"intensity", 3}}};
  for (const int i : {0, 1}) b.node({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  const Scene scene = b.load();
  record({"31", "a file with a light of 1e39 cd beside one of 3",
          "the first left out, with a warning that names it",
          fmt::format("{} light kept, {} warning: {}", scene.lights.size(), b.notices.warnings.size(),
                      b.notices.warnings.empty() ? "" : b.notices.warnings[0]),
          (scene.lights.size() == 1 && mentions(b.notices.warnings, "light 0")) ? 0.0 : 1.0, "lights", 0});
}

/// Vertex colours are floats in the file's binary part, where anything can stand.
TEST(Poison, AFileWhoseVertexColoursAreNoNumbers) {
  GltfBuilder b;
  const int colours = b.floats("VEC4", 4, {kNan, kNan, kNan, 1, kNan, kNan, kNan, 1, kNan, kNan, kNan, 1});
  const int metal = b.material({{"pbrMetallicRoughness", {{"roughnessFactor", 0}}}});
  const int mesh = b.triangleMesh({{"attributes", {{"COLOR_0", colours}}}, {"material", metal}});
  b.node({{"mesh", mesh}});
  Scene scene = b.load();
  scene.background.radiance = glm::vec3(1);
  scene.cameras = {rayCamera({0.2, 0.2, 1}, {0, 0, -1})};
  const Views views = everyForm(scene, caseSettings(1, 1, 4));
  record({"31", "a file whose mirror has vertex colours of NaN", "a sample counted, or a warning at loading",
          fmt::format("{} counted, {} warnings", views.kernel.stats.nonFinite, b.notices.warnings.size()),
          views.kernel.stats.nonFinite > 0 || !b.notices.warnings.empty() ? 0.0 : 1.0, "samples", 0});
}

}  // namespace
}  // namespace whittle::test
