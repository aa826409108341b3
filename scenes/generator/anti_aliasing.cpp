// Anti-aliasing: squares that shrink to less than a pixel at the horizon and a fan of bars thinner than a
// pixel against the sky.
#include "png.h"
#include "scenes.h"

namespace generator {
namespace {

Mesh makeBarFan(int bars) {
  Mesh mesh;
  const glm::dvec3 hub(0, 0.1, 0);
  for (int i = 0; i < bars; ++i) {
    const double angle = glm::radians(8.0 + 164.0 * i / (bars - 1));
    const glm::dvec3 along(std::cos(angle), std::sin(angle), 0), across(-along.y, along.x, 0);
    addQuad(mesh, hub + 0.4 * along - 0.006 * across, 2.2 * along, 0.012 * across);
  }
  mesh.uv0.clear();
  mesh.tangents.clear();
  return mesh;
}

}  // namespace

void buildAntiAliasing(GltfBuilder& scene) {
  const std::vector<std::uint8_t> checkers{235, 235, 225, 255, 35,  45,  60,  255,
                                           35,  45,  60,  255, 235, 235, 225, 255};
  MaterialSpec squares = matte("squares", glm::dvec3(1));
  squares.baseColorTexture.image = scene.addImage("checkers", encodePng(2, 2, checkers), /*nearest=*/true);
  Mesh plane;
  addQuad(plane, {-300, 0, 10}, {600, 0, 0}, {0, 0, -600}, {300, 300});
  plane.tangents.clear();
  scene.add("plane", std::move(plane), scene.addMaterial(squares));
  MaterialSpec ink = matte("ink", {0.02, 0.02, 0.03});
  ink.doubleSided = true;
  scene.add("fan of bars", makeBarFan(33), scene.addMaterial(ink));
  const int sphere = scene.addGeometry(makeUnitSphere());
  scene.place("ball", sphere, scene.addMaterial(matte("red", {0.75, 0.1, 0.07})),
              {.position = {-2.6, 0.7, 0.2}, .scale = 0.7});
  scene.place("mirror ball", sphere, scene.addMaterial(mirror("silver", glm::dvec3(0.9))),
              {.position = {2.6, 0.7, 0.2}, .scale = 0.7});
  scene.addLight(
      {.name = "sun", .type = "directional", .intensity = 2.4, .position = {-3, 6, 5}, .target = {0, 0, 0}});
  scene.addLight({.name = "sky",
                  .type = "directional",
                  .color = {0.7, 0.8, 1},
                  .intensity = 0.35,
                  .position = {2, 6, 3},
                  .target = {0, 0, 0},
                  .castsShadows = false});
  scene.setBackground({0.42, 0.6, 0.85});
  scene.addCamera("camera", {0, 1.3, 6}, {0, 1.15, 0}, 36);
}

}  // namespace generator
