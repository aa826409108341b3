// Refraction: a glass ball turns what is behind it upside down, a thick slanting plate breaks the striped
// poles behind it sideways, and in a wedge of green glass the light that crosses more of it comes out darker.
#include "scenes.h"

namespace generator {
namespace {

void addStage(GltfBuilder& scene) {
  const int light = scene.addMaterial(matte("light", glm::dvec3(0.78)));
  const int dark = scene.addMaterial(matte("dark", {0.25, 0.3, 0.38}));
  scene.add("light squares", makeCheckers(14, 20, 0.5, 0), light);
  scene.add("dark squares", makeCheckers(14, 20, 0.5, 1), dark);
}

/// Poles in alternating colours, one ring for each quarter metre.
void addPoles(GltfBuilder& scene) {
  const int cream = scene.addMaterial(matte("cream", {0.8, 0.77, 0.68}));
  const int orange = scene.addMaterial(matte("orange", {0.78, 0.26, 0.07}));
  const int ring = scene.addGeometry(makeCylinder(0.07, 0.25, 32));
  for (int pole = 0; pole < 7; ++pole) {
    for (int i = 0; i < 8; ++i) {
      scene.place("pole", ring, (pole + i) % 2 == 0 ? orange : cream,
                  {.position = {-2.7 + 0.9 * pole, 0.25 * i, -1.3}});
    }
  }
}

/// A wedge with its thin end left, its fronts outwards.
Mesh makeWedge(double width, double height, double depth) {
  Mesh mesh;
  const glm::dvec3 y(0, height, 0), tip(0, 0, 0), front(width, 0, depth / 2), back(width, 0, -depth / 2);
  addQuad(mesh, tip, front - tip, y);
  addQuad(mesh, front, back - front, y);
  addQuad(mesh, back, tip - back, y);
  mesh.uv0.clear();
  mesh.tangents.clear();
  for (const double level : {0.0, height}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::dvec3 p : {tip, front, back}) {
      mesh.positions.emplace_back(p + glm::dvec3(0, level, 0));
      mesh.normals.emplace_back(0, level > 0 ? 1 : -1, 0);
    }
    const std::uint32_t second = first + (level > 0 ? 1 : 2);
    mesh.indices.insert(mesh.indices.end(), {first, second, 2 * first + 3 - second});
  }
  return mesh;
}

}  // namespace

void buildRefraction(GltfBuilder& scene) {
  addStage(scene);
  addPoles(scene);
  const int clear = scene.addMaterial(glass("clear glass", 1.5));
  scene.place("glass ball", scene.addGeometry(makeUnitSphere()), clear,
              {.position = {-1.35, 0.72, 0.5}, .scale = 0.7});
  Mesh plate;
  addBox(plate, {-0.65, 0.02, -0.25}, {0.65, 1.5, 0.25});
  plate.uv0.clear();
  plate.tangents.clear();
  scene.place("thick plate", scene.addGeometry(std::move(plate)), clear,
              {.position = {0.3, 0, 0.1}, .turnY = -35});
  MaterialSpec green = glass("green glass", 1.5);
  green.attenuationColor = {0.25, 0.75, 0.4};
  green.attenuationDistance = 0.5;
  scene.place("wedge", scene.addGeometry(makeWedge(1.1, 1.1, 0.7)), scene.addMaterial(green),
              {.position = {1.12, 0.02, 0.45}, .turnY = -20});
  scene.addLight({.name = "key", .intensity = 60, .position = {-3, 5, 4}});
  scene.addLight({.name = "fill", .intensity = 14, .position = {3, 3, 5}, .castsShadows = false});
  scene.setBackground({0.5, 0.6, 0.75});
  scene.addCamera("camera", {0, 1.35, 5.6}, {0, 0.75, 0}, 32);
}

}  // namespace generator
