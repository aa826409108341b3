// A Cornell box, wider than tall so that it fills a 16:9 picture, with a mirror ball, a glass ball and a
// tall block.
#include "room.h"
#include "scenes.h"

namespace generator {

void buildCornellBox(GltfBuilder& scene) {
  const int white = scene.addMaterial(matte("white", glm::dvec3(0.74)));
  const int red = scene.addMaterial(matte("red", {0.62, 0.06, 0.05}));
  const int green = scene.addMaterial(matte("green", {0.13, 0.46, 0.1}));
  addRoom(scene, {-1.6, 0, -1.4}, {1.6, 2, 2.6}, {red, green, white, white, white, white});
  addCeilingLamp(scene, {0, 1.995, -0.1}, 0.8, 0.6, 4, 5.6);
  scene.addLight({.name = "fill", .intensity = 1.5, .position = {0, 1.2, 2.3}, .castsShadows = false});

  Mesh block;
  addBox(block, {-0.3, 0, -0.3}, {0.3, 1.2, 0.3});
  const int tall = scene.addGeometry(std::move(block));
  scene.place("tall block", tall, white, {.position = {-0.75, 0, -0.65}, .turnY = 20});
  const int sphere = scene.addGeometry(makeUnitSphere());
  const int silver = scene.addMaterial(mirror("silver", glm::dvec3(0.93)));
  scene.place("mirror ball", sphere, silver, {.position = {0.6, 0.5, -0.55}, .scale = 0.5});
  scene.place("glass ball", sphere, scene.addMaterial(glass("glass", 1.5)),
              {.position = {-0.1, 0.32, 0.1}, .scale = 0.32});
  scene.addCamera("camera", {0, 1.05, 2.5}, {0, 0.93, -1}, 48);
}

}  // namespace generator
