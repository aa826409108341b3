// A Cornell-like box whose back and front walls are mirrors, turned a little against each other so that
// the row of pictures bends; every bounce adds one room.
#include "room.h"
#include "scenes.h"

namespace generator {

void buildMirrorBox(GltfBuilder& scene) {
  const int white = scene.addMaterial(matte("white", glm::dvec3(0.74)));
  const int red = scene.addMaterial(matte("red", {0.62, 0.06, 0.05}));
  const int green = scene.addMaterial(matte("green", {0.13, 0.46, 0.1}));
  const int silver = scene.addMaterial(mirror("mirror", glm::dvec3(0.92, 0.95, 0.94)));
  addRoom(scene, {-1.6, 0, -1.4}, {1.6, 2, 2.6}, {red, green, white, white, white, silver});
  Mesh glassPane;
  addQuad(glassPane, {-1.35, 0.2, -1.38}, {2.7, 0, 0.03}, {0, 1.6, 0.04});
  scene.add("mirror", std::move(glassPane), silver);
  addCeilingLamp(scene, {0, 1.995, 0.2}, 0.8, 0.6, 4, 5.6);
  scene.addLight({.name = "fill", .intensity = 1.2, .position = {0, 1.2, 2.3}, .castsShadows = false});
  scene.addLight({.name = "fill behind", .intensity = 0.35, .position = {0, 1, -1.2}, .castsShadows = false});

  const int sphere = scene.addGeometry(makeUnitSphere());
  const int blue = scene.addMaterial(matte("blue", {0.08, 0.2, 0.62}));
  const int yellow = scene.addMaterial(matte("yellow", {0.8, 0.55, 0.06}));
  scene.place("blue ball", sphere, blue, {.position = {-0.75, 0.35, -0.3}, .scale = 0.35});
  scene.place("yellow ball", sphere, yellow, {.position = {0.8, 0.22, 0.3}, .scale = 0.22});
  Mesh block;
  addBox(block, {-0.2, 0, -0.2}, {0.2, 0.8, 0.2});
  const int geometry = scene.addGeometry(std::move(block));
  scene.place("block", geometry, white, {.position = {0.75, 0, -0.7}, .turnY = 30});
  scene.addCamera("camera", {-0.35, 1.25, 2.3}, {0.1, 0.85, -1.4}, 44);
}

}  // namespace generator
