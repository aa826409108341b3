// Mirror: a framed flat mirror and a mirror ball show the coloured balls in front of them a second time.
#include "scenes.h"

namespace generator {
namespace {

void addFloor(GltfBuilder& scene) {
  scene.add("light squares", makeCheckers(16, 16, 0.8, 0),
            scene.addMaterial(matte("light", glm::dvec3(0.75))));
  scene.add("dark squares", makeCheckers(16, 16, 0.8, 1),
            scene.addMaterial(matte("dark", glm::dvec3(0.2, 0.22, 0.26))));
}

}  // namespace

void buildMirror(GltfBuilder& scene) {
  addFloor(scene);
  const int silver = scene.addMaterial(mirror("silver", glm::dvec3(0.94)));
  Mesh pane, frame;
  addQuad(pane, {-2.4, 0.12, -1.6}, {4.2, 0, -0.5}, {0, 2.5, 0});
  pane.uv0.clear();
  pane.tangents.clear();
  addQuad(frame, {-2.52, 0.0, -1.605}, {4.44, 0, -0.53}, {0, 2.74, 0});
  scene.add("mirror", std::move(pane), silver);
  scene.add("frame", std::move(frame), scene.addMaterial(matte("wood", {0.35, 0.2, 0.1})));

  const int sphere = scene.addGeometry(makeUnitSphere());
  const int red = scene.addMaterial(matte("red", {0.7, 0.08, 0.06}));
  const int blue = scene.addMaterial(matte("blue", {0.08, 0.2, 0.65}));
  const int yellow = scene.addMaterial(matte("yellow", {0.8, 0.55, 0.06}));
  scene.place("red ball", sphere, red, {.position = {-1.1, 0.45, 0}, .scale = 0.45});
  scene.place("blue ball", sphere, blue, {.position = {0.0, 0.3, 0.6}, .scale = 0.3});
  scene.place("yellow ball", sphere, yellow, {.position = {0.35, 0.25, -0.7}, .scale = 0.25});
  scene.place("mirror ball", sphere, silver, {.position = {2.1, 0.75, 0.1}, .scale = 0.75});
  scene.addLight({.name = "key", .intensity = 48, .position = {-2.5, 4.5, 3.5}});
  scene.addLight({.name = "fill", .intensity = 8, .position = {3, 3, 4}, .castsShadows = false});
  scene.addLight({.name = "fill behind", .intensity = 4, .position = {0, 3, -4}, .castsShadows = false});
  scene.setBackground({0.32, 0.45, 0.65});
  scene.addCamera("camera", {0.4, 1.7, 5.4}, {0.1, 0.85, -0.5}, 38);
}

}  // namespace generator
