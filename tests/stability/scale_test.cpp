// The same room in micrometres and in light-years, moved far from the origin, and through transforms that
// stretch, mirror or flatten.
#include "forms.h"
#include "gltf/builder.h"

namespace whittle::test {
namespace {

/// A room of about 4 m: matte floor, mirror, slab of tinted glass, a blocker under a lamp; times `scale`. The
/// lamp grows with the square and absorption shrinks, so that the radiance is the same at any scale.
Scene room(double scale) {
  const auto s = static_cast<float>(scale);
  Scene scene;
  addFloor(scene, lambert({0.6F, 0.5F, 0.4F}), 0, true, 2 * s);
  addQuad(scene, addMaterial(scene, mirror(glm::vec3(0.8F))), {-2 * s, 0, -2 * s}, {4 * s, 0, 0},
          {0, 3 * s, 0});
  Material tinted = glass(1.5F, true);
  tinted.sigma_a = glm::vec3(glm::dvec3(0.2, 0.5, 1) / scale);
  const std::uint32_t slab = addMaterial(scene, tinted);
  addQuad(scene, slab, {-1.5F * s, 0.5F * s, 0}, {s, 0, 0}, {0, s, 0});
  addQuad(scene, slab, {-1.5F * s, 0.5F * s, -0.25F * s}, {0, s, 0}, {s, 0, 0});
  addQuad(scene, addMaterial(scene, lambert(glm::vec3(0.7F))), {0.25F * s, s, -0.5F * s}, {0, 0, s},
          {s, 0, 0});
  scene.lights = {pointLight(glm::vec3(glm::dvec3(0.5, 2.5, 0.5) * scale), 1)};
  scene.lights[0].intensity = glm::vec3(glm::dvec3(8, 7, 6) * scale * scale);
  scene.background.radiance = {0.1F, 0.2F, 0.4F};
  scene.cameras = {rayCamera(glm::dvec3(0.3, 1.7, 3.1) * scale, {-0.1, -0.35, -1})};
  return scene;
}

struct Scale {
  const char* id;
  const char* name;
  double metres;
};

TEST(Scale, ARoomInMicrometresAndInLightYears) {
  const Settings settings = caseSettings(16, 9, 5);
  const ReferenceResult exact = renderReference(room(1), settings);
  for (const Scale& scale : {Scale{"O10", "1 m", 1},
                             {"O10", "1 nm", 1e-9},
                             {"O10", "1 um", 1e-6},
                             {"O11", "1 astronomical unit", 1.495978707e11},
                             {"O11", "1 light-year", 9.4607304725808e15}}) {
    SCOPED_TRACE(scale.name);
    const Views views = everyForm(room(scale.metres), settings);
    Worst worst;
    for (std::size_t i = 0; i < exact.radiance.pixels.size(); ++i)
      worst.relative(views.kernel.radiance.pixels[i], exact.radiance.pixels[i]);
    record({scale.id, fmt::format("a room with mirror, glass and shadow whose metre is {}", scale.name),
            "the radiance of the room in metres (double)", worst.result(), worst.error(), "relative", 2e-5});
  }
}

/// One triangle of each node in a row, `shift` metres apart, each emitting to its front, which looks up.
struct Transforms {
  GltfBuilder b;
  int mesh;
  Transforms() {
    const int glow = b.material(
        {{"emissiveFactor", {1, 1, 1}}, {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}}});
    const int p = b.vec3({-0.4F, 0, 0.4F, 0.4F, 0, 0.4F, 0, 0, -0.4F});
    mesh = b.mesh({{"attributes", {{"POSITION", p}}}, {"material", glow}});
  }
};

TEST(Scale, StretchedMirroredAndFlattenedNodes) {
  Transforms t;
  const Json scales[] = {{1, 1, 1}, {1, 1, 1e-6}, {-1, 1, 1}, {0, 1, 1}, {1, 1e-6, 1}, {1, 0, 1}};
  for (int i = 0; i < 6; ++i) t.b.node({{"mesh", t.mesh}, {"translation", {i, 0, 0}}, {"scale", scales[i]}});
  Scene scene = t.b.load();
  scene.lights.clear();
  scene.background.radiance = glm::vec3(0.125F);
  scene.cameras = {rowCamera(0, 1, 6, 2)};
  const Views views = everyForm(scene, caseSettings(6, 1));
  // Flattened to a line it is dropped; to its own plane it is what it was. Fronts stay fronts.
  const double expected[] = {1, 1, 1, 0.125, 1, 1};
  Worst worst;
  for (std::size_t i = 0; i < 6; ++i) worst.absolute(red(views.kernel.radiance, i), expected[i]);
  record({"12", "nodes scaled (1,1,1), (1,1,1e-6), (-1,1,1), (0,1,1), (1,1e-6,1), (1,0,1)",
          "each shows its front, (0,1,1) is dropped with a warning",
          fmt::format("{}; {} dropped, {} warning", worst.result(), scene.droppedTriangles,
                      t.b.notices.warnings.size()),
          worst.error() + std::abs(1.0 - static_cast<double>(scene.droppedTriangles)) +
              std::abs(1.0 - static_cast<double>(t.b.notices.warnings.size())),
          "absolute", 0});
}

/// Columns that differ by less than single precision can say: what comes out is a line, or as good as one.
TEST(Scale, ATransformThatIsSingularToRounding) {
  Transforms t;
  t.b.node({{"mesh", t.mesh}});
  for (const double apart : {1e-5, 1e-7, 1e-9, 1e-16}) {
    const double k = std::round(-std::log10(apart));
    t.b.node({{"mesh", t.mesh}, {"matrix", {1, 0, 1, 0, 0, 1, 0, 0, 1, 0, 1 + apart, 0, 4 * k, 0, 0, 1}}});
  }
  Scene scene = t.b.load();
  scene.lights.clear();
  scene.background.radiance = glm::vec3(0.125F);
  scene.cameras = {rowCamera(0, 1, 96, 2)};
  const Views views = everyForm(scene, caseSettings(96, 1));
  std::size_t wrong = red(views.kernel.radiance, 0) != 1.0;
  for (const float v : views.kernel.radiance.pixels) wrong += v != 1.0F && v != 0.125F;
  for (std::size_t i = 1; i < 12; ++i) wrong += red(views.kernel.radiance, i) != 0.125;
  recordCount("O9", "matrices whose columns differ by 1e-5 to 1e-16",
              "their triangle or the background, a sound neighbour untouched", wrong, 96, "pixels");
  for (const glm::vec3& n : scene.normals) EXPECT_TRUE(std::isfinite(n.x));
}

}  // namespace
}  // namespace whittle::test
