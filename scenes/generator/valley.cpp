// A valley in the morning: land that rain has shaped, woods of one tree placed hundreds of times, meadows of
// one tuft of grass placed thousands of times.
#include <cmath>

#include "hash.h"
#include "scenes.h"
#include "shapes/plants.h"
#include "shapes/terrain.h"

namespace generator {
namespace {

constexpr TerrainSpec kLand{.squares = 320, .side = 260, .relief = 55, .droplets = 90000};
constexpr std::uint32_t kWoods = 13000, kMeadow = 13010;

/// Where the camera stands, metres.
constexpr double kEyeX = -22, kEyeZ = 104;

void addWoods(GltfBuilder& scene, const Terrain& land) {
  int wood[2], leaves[2];
  const int bark = scene.addMaterial(matte("bark", {0.09, 0.065, 0.045}));
  for (std::uint32_t kind = 0; kind < 2; ++kind) {
    Tree tree = growTree(
        {.height = 7, .trunkRadius = 0.17, .levels = 4, .children = 4, .series = 12000 + 100 * kind});
    MaterialSpec leaf =
        matte("leaves", kind == 0 ? glm::dvec3(0.20, 0.30, 0.06) : glm::dvec3(0.50, 0.30, 0.06));
    leaf.doubleSided = true;
    wood[kind] = scene.addMesh("wood", scene.addGeometry(std::move(tree.wood)), bark);
    leaves[kind] =
        scene.addMesh("leaves", scene.addGeometry(std::move(tree.leaves)), scene.addMaterial(leaf));
  }
  int count = 0;
  for (std::uint32_t i = 0; count < 200; ++i) {
    const double x = 250 * (unitValue(kWoods, i) - 0.5), z = 235 * (unitValue(kWoods + 1, i) - 0.62);
    const bool isNearEye = std::hypot(x - kEyeX, z - kEyeZ) < 14;
    if (land.normalAt(x, z).y < 0.82 || isNearEye) continue;
    const std::uint32_t kind = i % 4 == 0 ? 1 : 0;
    const Placement place{.position = {x, land.heightAt(x, z), z},
                          .scale = 0.7 + 0.6 * unitValue(kWoods + 2, i),
                          .turnY = 360 * unitValue(kWoods + 3, i)};
    scene.placeMesh(wood[kind], place);
    scene.placeMesh(leaves[kind], place);
    ++count;
  }
}

void addMeadow(GltfBuilder& scene, const Terrain& land) {
  MaterialSpec blade = matte("grass", {0.30, 0.34, 0.09});
  blade.doubleSided = true;
  const int tuft =
      scene.addMesh("tuft", scene.addGeometry(makeTuft(36, 0.42, 0.28, 14000)), scene.addMaterial(blade));
  for (std::uint32_t i = 0; i < 6000; ++i) {
    const double far = 1.5 + 40 * unitValue(kMeadow, i) * unitValue(kMeadow + 1, i),
                 angle = 2.4 * (unitValue(kMeadow + 2, i) - 0.5);
    const double x = kEyeX + far * std::sin(angle), z = kEyeZ - far * std::cos(angle);
    scene.placeMesh(tuft, {.position = {x, land.heightAt(x, z) - 0.02, z},
                           .scale = 0.6 + 0.7 * unitValue(kMeadow + 3, i),
                           .turnY = 360 * unitValue(kMeadow + 4, i)});
  }
}

}  // namespace

void buildValley(GltfBuilder& scene) {
  const Terrain land(kLand);
  MaterialSpec earth = matte("earth", glm::dvec3(1));
  scene.add("land", meshOf(land, kLand), scene.addMaterial(earth));
  addWoods(scene, land);
  addMeadow(scene, land);
  scene.addLight({.name = "sun",
                  .type = "directional",
                  .color = {1, 0.80, 0.55},
                  .intensity = 4.5,
                  .position = {-7, 3.6, 2.5},
                  .target = {0, 0, 0}});
  scene.addLight({.name = "sky",
                  .type = "directional",
                  .color = {0.5, 0.68, 1},
                  .intensity = 0.8,
                  .position = {1, 6, 3},
                  .target = {0, 0, 0},
                  .castsShadows = false});
  scene.setBackground({0.50, 0.62, 0.80});
  const double ground = land.heightAt(kEyeX, kEyeZ);
  scene.addCamera("camera", {kEyeX, ground + 7, kEyeZ}, {-6, ground - 1, 40}, 34);
}

}  // namespace generator
