// The kernels' rays beside the reference's: the same on every pixel of scenes where they should be, and
// parted at the right ray where the two were given different scenes.
#include "render/tree_comparison.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "reference/blockers.h"
#include "reference/reference.h"
#include "render/explanation.h"
#include "render/render_session.h"
#include "support/pictures.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

using What = Parting::What;

Settings comparedSettings(int bounces, int samples = 1) {
  Settings settings = wholeSettings(bounces);
  settings.width = 24, settings.height = 14;
  settings.raysPerPixel = samples;
  return onTestDevice(settings);
}

std::string partingOf(const RayTree& kernels, const RayTree& reference, const Scene& scene) {
  const TreeComparison c = compareTrees(kernels, reference);
  return verdict(kernels, {reference, c}, scene);
}

/// What light does through mirrors, glass, textures, layers and shadows.
class SameTrees : public testing::TestWithParam<const char*> {};

TEST_P(SameTrees, OnEveryPixelAndTheirSumsAreTheReferencesPicture) {
  const Scene scene = ownScene(GetParam());
  Settings settings = comparedSettings(6);
  settings.width = 16, settings.height = 9;
  const ReferenceResult picture = renderReference(scene, settings);
  RenderSession session;
  RayCounts counted;
  for (int y = 0; y < settings.height; ++y)
    for (int x = 0; x < settings.width; ++x) {
      const RayTree kernels = session.explain(scene, settings, x, y, testHooks()).at(0);
      const RayTree reference = referenceTrees(scene, settings, x, y).at(0);
      EXPECT_FALSE(compareTrees(kernels, reference).parting)
          << x << "," << y << ": " << partingOf(kernels, reference, scene);
      const std::size_t at = 3 * static_cast<std::size_t>(y * settings.width + x);
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(static_cast<float>(reference.radiance[c]), picture.radiance.pixels[at + c])
            << x << "," << y;
      EXPECT_LE(glm::length(sumOf(reference) - reference.radiance), 1e-13 * glm::length(reference.radiance));
      ++counted.primary;
      counted.impulse += reference.rays.size() - 1;
      for (const RayRecord& ray : reference.rays) {
        counted.shadow += ray.shadows.size();
        for (const EndedRecord& e : ray.ended) counted.bounces += e.throughput;
      }
    }
  EXPECT_EQ(counted.primary, picture.rays.primary);
  EXPECT_EQ(counted.impulse, picture.rays.impulse);
  EXPECT_EQ(counted.shadow, picture.rays.shadow);
  const double ended = picture.rays.bounces + picture.rays.straight + picture.rays.cutOff;
  EXPECT_NEAR(counted.bounces, ended, 1e-12 * ended) << "all that ended";
}

INSTANTIATE_TEST_SUITE_P(Scenes, SameTrees,
                         testing::Values("cornell_box", "mirror", "nested_glass", "textured"));

TEST(TreeComparison, EachSampleHasItsOwnTree) {
  const Scene scene = ownScene("nested_glass");
  const Settings settings = comparedSettings(4, 3);
  RenderSession session;
  const auto kernels = session.explain(scene, settings, 12, 7, testHooks());
  const auto reference = referenceTrees(scene, settings, 12, 7);
  ASSERT_EQ(reference.size(), 3U);
  EXPECT_EQ(referenceTrees(scene, settings, 12, 7, nullptr, 2).size(), 2U);
  glm::dvec3 mean(0);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_FALSE(compareTrees(kernels[i], reference[i]).parting)
        << partingOf(kernels[i], reference[i], scene);
    mean += reference[i].radiance / 3.0;
  }
  const auto picture = renderReference(scene, settings).radiance.pixels;
  for (int c = 0; c < 3; ++c) EXPECT_EQ(static_cast<float>(mean[c]), picture[3 * (7 * 24 + 12) + c]);
}

/// A camera that looks down at a mirror, below a glowing ceiling.
Scene mirrorScene(float reflectance) {
  Scene scene;
  addFloor(scene, mirror(glm::vec3(reflectance)), 0, true, 4);
  addFloor(scene, emitter({1, 2, 3}), 3, false, 4);
  scene.cameras = {lookingDown()};
  return scene;
}

/// Parts the kernels of one scene from the reference of another.
struct Compared {
  Compared(const Scene& kernelsScene, const Scene& referenceScene, int bounces)
      : kernels(RenderSession().explain(kernelsScene, comparedSettings(bounces), 12, 7, testHooks()).at(0)),
        reference(referenceTrees(referenceScene, comparedSettings(bounces), 12, 7).at(0)),
        comparison(compareTrees(kernels, reference)) {}

  RayTree kernels, reference;
  TreeComparison comparison;
};

void expectParting(const Compared& c, std::size_t ray, What what) {
  ASSERT_TRUE(c.comparison.parting);
  EXPECT_EQ(c.comparison.parting->ray, ray);
  EXPECT_EQ(static_cast<int>(c.comparison.parting->what), static_cast<int>(what));
}

TEST(TreeComparison, TellsAnotherMirrorAtTheRayThatItSends) {
  const Scene scene = mirrorScene(0.5F);
  const Compared c(scene, mirrorScene(0.625F), 2);
  expectParting(c, 1, What::Throughput);
  const Beside beside{c.reference, c.comparison};
  const auto eye = rayLines(c.kernels, 0, scene, &beside), reflected = rayLines(c.kernels, 1, scene, &beside);
  EXPECT_TRUE(std::none_of(eye.begin(), eye.end(), [](const RayLine& line) { return line.parts; }));
  const auto found =
      std::find_if(reflected.begin(), reflected.end(), [](const RayLine& l) { return l.parts; });
  ASSERT_NE(found, reflected.end());
  EXPECT_EQ(found->text, "    reference: throughput 0.625 0.625 0.625");
  EXPECT_EQ((found - 1)->text, "  throughput 0.5 0.5 0.5");
  EXPECT_EQ(verdict(c.kernels, beside, scene),
            "reference: 0.625 1.25 1.875; the kernels 0.5 1 1.5; parted at ray [1]: another throughput");
}

TEST(TreeComparison, TellsAnotherHit) {
  const Scene scene = mirrorScene(0.5F);
  Scene moved = scene;
  for (std::size_t i = 4; i < 8; ++i) moved.positions[i].y += 0.01F;  // the ceiling
  expectParting(Compared(scene, moved, 2), 1, What::Hit);
  Scene lower = scene;
  for (std::size_t i = 0; i < 4; ++i) lower.positions[i].y -= 0.01F;
  expectParting(Compared(scene, lower, 2), 0, What::Hit);
}

TEST(TreeComparison, TellsOtherEmission) {
  Scene scene = mirrorScene(0.5F), brighter = scene;
  brighter.materials[1].emission.b *= 1.01F;
  expectParting(Compared(scene, brighter, 2), 1, What::Local);
}

/// Two lamps above a floor, and a screen whose edge passes before the second one, or not.
Scene screenScene(float edge) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, 4);
  const std::uint32_t screen = addMaterial(scene, lambert(glm::vec3(0)));
  addQuad(scene, screen, {edge, 2, -4}, {0, 0, 8}, {4, 0, 0});
  scene.lights = {pointLight({-2, 3, 0}, 10), pointLight({2, 3, 0}, 10)};
  scene.lights[1].name = "second";
  scene.cameras = {lookingDown()};
  return scene;
}

TEST(TreeComparison, TellsAShadowRayThatIsBlockedInOneAlone) {
  const Scene free = screenScene(3), blocked = screenScene(1);
  for (const bool swapped : {false, true}) {
    const Compared c(swapped ? blocked : free, swapped ? free : blocked, 1);
    expectParting(c, 0, What::Shadow);
    EXPECT_EQ(c.comparison.parting->light, 1U);
    const Beside beside{c.reference, c.comparison};
    const std::string text = verdict(c.kernels, beside, free);
    EXPECT_NE(text.find("parted at ray [0]: the shadow ray to \"second\""), std::string::npos) << text;
    int told = 0;
    for (const RayLine& line : rayLines(c.kernels, 0, free, &beside))
      if (line.parts && line.text.find("shadow ray to \"second\"") != std::string::npos) {
        ++told;
        EXPECT_EQ(line.text.find("blocked") != std::string::npos, !swapped) << line.text;
      }
    EXPECT_EQ(told, 1);
  }
}

TEST(TreeComparison, TellsWhatBlocksAShadowRay) {
  Scene scene = screenScene(1);
  scene.materials[1].name = "screen";
  scene.lights[0].intensity = {10, 0, 0};
  Compared c(scene, scene, 1);
  findBlockers(scene, c.kernels);
  std::string told;
  for (const RayLine& line : rayLines(c.kernels, 0, scene)) told += line.text + "\n";
  EXPECT_NE(told.find("shadow ray to \"second\", "), std::string::npos) << told;
  EXPECT_NE(told.find("blocked by \"screen\", triangle "), std::string::npos) << told;
  EXPECT_NE(told.find(" 0 0 arrives"), std::string::npos)
      << "all of the red lamp, which has nothing else: " << told;
}

TEST(TreeComparison, TellsRaysThatOneAloneHas) {
  Scene clear = mirrorScene(0.5F);
  clear.materials[0] = glass(1.5F, false);
  Scene opaque = clear;
  opaque.materials[0].transmission = 0;
  const Compared missing(clear, opaque, 2);
  ASSERT_TRUE(missing.comparison.parting);
  EXPECT_EQ(static_cast<int>(missing.comparison.parting->what), static_cast<int>(What::Missing));
  const std::size_t straight = missing.comparison.parting->ray;
  EXPECT_EQ(static_cast<int>(passageOf(missing.kernels.rays[straight], missing.kernels.rays[0])),
            static_cast<int>(Passage::Straight));
  const Compared additional(opaque, clear, 2);
  expectParting(additional, 0, What::Additional);
  ASSERT_EQ(additional.comparison.alone.size(), 1U);
  const Beside beside{additional.reference, additional.comparison};
  const auto lines = rayLines(additional.kernels, 0, opaque, &beside);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const RayLine& l) {
    return l.text.rfind("    reference: straight on, ", 0) == 0;
  }));
}

/// The quad's other triangle, met in the diagonal.
TEST(TreeComparison, ATriangleThatSharesTheEdgeIsTheSameHit) {
  RayTree a;
  a.rays.resize(1);
  a.rays[0].hit = HitRecord{0, 0, 0.5, 0, {1, 2, 3}, {0, 1, 0}};
  RayTree b = a;
  b.rays[0].hit->primitive = 1;
  EXPECT_FALSE(compareTrees(a, b).parting);
  b.rays[0].hit->normal = {0, 0.8, 0.6};
  EXPECT_TRUE(compareTrees(a, b).parting) << "round a corner";
  b.rays[0].hit.reset();
  EXPECT_TRUE(compareTrees(a, b).parting);
}

TEST(TreeComparison, TheTextAndTheJsonHaveBoth) {
  const Scene scene = mirrorScene(0.5F);
  const Settings settings = comparedSettings(2);
  const Compared c(scene, mirrorScene(0.625F), 2), same(scene, scene, 2);
  const Explanation parted{12, 7, {c.kernels}, {c.reference}},
      agreed{12, 7, {same.kernels}, {same.reference}};
  const std::string text = explanationText(parted, scene, settings),
                    plain = explanationText(agreed, scene, settings);
  EXPECT_NE(text.find("      reference: throughput 0.625 0.625 0.625\n"), std::string::npos) << text;
  EXPECT_EQ(plain.find("    reference:"), std::string::npos) << plain;
  EXPECT_NE(plain.find("reference: 0.5 1 1.5; the kernels 0.5 1 1.5; no difference beyond rounding\n"),
            std::string::npos)
      << plain;
  const auto sample = explanationToJson(parted, scene)["samples"][0];
  EXPECT_EQ(sample["reference"]["rays"].size(), 2U);
  EXPECT_EQ(sample["reference"]["rays"][1]["throughput"][0], 0.625);
  EXPECT_EQ(sample["reference"]["partners"], nlohmann::ordered_json::array({0, 1}));
  EXPECT_EQ(sample["reference"]["parting"]["ray"], 1);
  EXPECT_EQ(explanationToJson(agreed, scene)["samples"][0]["reference"]["parting"], nullptr);
  EXPECT_FALSE(explanationToJson({12, 7, {c.kernels}, {}}, scene)["samples"][0].contains("reference"));
}

}  // namespace
}  // namespace whittle::test
