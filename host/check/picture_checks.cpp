// Small whole pictures: searches against each other and inside a closed mesh, shading in one lane against
// eight, and both against double precision.
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "check/device_check.h"
#include "programs/kernel_programs.h"
#include "reference/reference.h"
#include "render/renderer.h"

namespace whittle {
namespace {

constexpr std::uint32_t kRings = 8, kSectors = 16;

/// A closed mesh around `centre`.
void addBall(Scene& scene, std::uint32_t material, const glm::vec3& centre, float radius) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (std::uint32_t ring = 0; ring <= kRings; ++ring)
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
      const float down = std::numbers::pi_v<float> * static_cast<float>(ring) / kRings,
                  round = 2.0F * std::numbers::pi_v<float> * static_cast<float>(sector) / kSectors;
      const bool isPole = ring == 0 || ring == kRings;  // one point, or the mesh is not closed
      const float across = isPole ? 0.0F : std::sin(down);
      scene.positions.push_back(
          centre + radius * glm::vec3(across * std::cos(round), std::cos(down), across * std::sin(round)));
    }
  for (std::uint32_t ring = 0; ring < kRings; ++ring)
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
      const std::uint32_t right = (sector + 1) % kSectors, a = first + ring * kSectors, b = a + kSectors;
      scene.triangles.push_back({a + sector, a + right, b + right, material});
      scene.triangles.push_back({a + sector, b + right, b + sector, material});
    }
}

/// Matte floor, mirror ball, glass ball, a lamp; the camera looks at them from some way off.
Scene testScene() {
  Scene scene;
  scene.materials.resize(3);
  scene.materials[0].metallic = 0;
  scene.materials[0].baseColor = {0.6F, 0.5F, 0.4F, 1};
  scene.materials[0].doubleSided = true;
  scene.materials[1].roughness = 0;
  scene.materials[2].metallic = 0;
  scene.materials[2].roughness = 0;
  scene.materials[2].transmission = 1;
  scene.materials[2].volume = true;
  scene.positions = {{-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}};
  scene.triangles = {{0, 2, 1, 0}, {0, 3, 2, 0}};
  addBall(scene, 1, {-1.1F, 1, 0}, 1);
  addBall(scene, 2, {1.1F, 1.1F, 0.5F}, 1);
  scene.lights.emplace_back();
  scene.lights[0].position = {1, 5, 3};
  scene.lights[0].intensity = glm::vec3(60);
  scene.background.radiance = glm::vec3(0.3F, 0.4F, 0.6F);
  scene.cameras.emplace_back();
  scene.cameras[0].position = {0, 1.2F, 5};
  return scene;
}

Settings testSettings() {
  Settings settings;
  settings.width = 64;
  settings.height = 48;
  settings.bounces = 4;
  return settings;
}

/// On a context of its own, as a render has it.
RenderResult draw(const Compute& compute, const Scene& scene, const Settings& settings) {
  OpenDevice device{Compute(compute.device())};
  RenderHooks hooks;
  hooks.device = &device;
  return render(scene, settings, hooks);
}

std::size_t differentPixels(const FloatImage& a, const FloatImage& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < a.pixels.size(); i += 3)
    for (std::size_t c = i; c < i + 3; ++c)
      if (std::bit_cast<std::uint32_t>(a.pixels[c]) != std::bit_cast<std::uint32_t>(b.pixels[c])) {
        ++count;
        break;
      }
  return count;
}

}  // namespace

std::vector<Finding> checkSearches(Compute& compute) {
  // Every triangle twice: none may be missed, and of two the first is meant.
  Scene scene;
  scene.materials.emplace_back();
  scene.materials[0].doubleSided = true;
  addBall(scene, 0, {3, 2, -1}, 1.5F);
  const std::size_t once = scene.triangles.size();
  scene.triangles.insert(scene.triangles.end(), scene.triangles.begin(), scene.triangles.end());
  scene.cameras.emplace_back();
  scene.cameras[0].position = {3.1F, 2.2F, -1.05F};
  scene.cameras[0].yfov = 2.6F;
  Settings settings = testSettings();
  settings.width = settings.height = 200;
  settings.aovs = true;
  settings.search = Search::Tree;
  const RenderResult inside = draw(compute, scene, settings);
  const std::vector<float>& primitive = inside.aovs.at("primitive").pixels;
  std::size_t leaks = 0, later = 0;
  for (const float p : primitive) {
    leaks += p < 0.0F;
    later += p >= static_cast<float>(once);
  }
  const Scene whole = testScene();
  Settings array = testSettings(), tree = array;
  array.search = Search::Array;
  tree.search = Search::Tree;
  return {comparedFinding("watertight", leaks, primitive.size(), "met", "light leaks where triangles touch"),
          comparedFinding("lowest of equal triangles", later, primitive.size(), "the first",
                          "pictures differ from other devices' where triangles coincide"),
          comparedFinding(
              "tree against every triangle",
              differentPixels(draw(compute, whole, array).radiance, draw(compute, whole, tree).radiance),
              static_cast<std::size_t>(array.width) * array.height, "each other", "surfaces are missing")};
}

std::vector<Finding> checkShading(Compute& compute) {
  const Scene scene = testScene();
  const Settings settings = testSettings();
  const RenderResult own = draw(compute, scene, settings);
  std::vector<Finding> findings;
  const auto pixels = static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
  if (compute.device().suitsPackets()) {
    Settings single = settings;
    single.lanes = Lanes::One;
    findings.push_back(comparedFinding(
        "one lane against eight", differentPixels(own.radiance, draw(compute, scene, single).radiance),
        pixels, "each other", "the picture depends on what lies beside a pixel"));
  } else {
    findings.push_back({"one lane against eight", Verdict::Right, "one lane alone is used", ""});
  }
  const FloatImage right = renderReference(scene, settings).radiance;
  // Where a ray runs along an edge, float and double may choose different sides: at 1 % of the pixels of
  // balls with as few triangles as these at the most. Elsewhere eight bounces of rounding, 1e-5 each, leave a
  // factor of ten.
  std::size_t far = 0;
  for (std::size_t i = 0; i < right.pixels.size(); ++i)
    far += !(std::fabs(own.radiance.pixels[i] - right.pixels[i]) <= 1e-3F * (right.pixels[i] + 0.1F));
  Finding finding = comparedFinding("picture against double precision", far <= pixels / 100 ? 0 : far,
                                    3 * pixels, "double precision", "pictures are wrong");
  if (finding.verdict == Verdict::Right && far > 0)
    finding.seen += ", but for " + std::to_string(far) + " at edges";
  findings.push_back(std::move(finding));
  return findings;
}

}  // namespace whittle
