// Nested dielectrics: a glass ball with a hollow, in it a ball of glass, in that a heart of something denser.
// Both branches leave every surface, so the tree of rays grows as far as the bounces let it. `ior` is the
// ratio across each interface, front side first.
#include "scenes.h"

namespace generator {

void buildNestedGlass(GltfBuilder& scene) {
  const int light = scene.addMaterial(matte("light", glm::dvec3(0.75)));
  const int dark = scene.addMaterial(matte("dark", {0.1, 0.18, 0.35}));
  scene.add("light squares", makeCheckers(12, 20, 0.6, 0), light);
  scene.add("dark squares", makeCheckers(12, 20, 0.6, 1), dark);

  const Mesh ball = makeSphere(1, 72, 36);
  const int outside = scene.addGeometry(ball), inside = scene.addGeometry(insideOut(ball));
  MaterialSpec tinted = glass("rose glass 1.5", 1.5);
  tinted.attenuationColor = {0.9, 0.45, 0.4};
  tinted.attenuationDistance = 0.8;
  const int clear = scene.addMaterial(glass("glass 1.5", 1.5));
  const int rose = scene.addMaterial(tinted);
  const int dense = scene.addMaterial(glass("2.4 in 1.5", 1.6));
  const int waterToGlass = scene.addMaterial(glass("1.5 around 1.33", 1.5 / 1.33));

  const glm::dvec3 center(0, 1.02, 0);
  scene.place("shell", outside, clear, {.position = center, .scale = 1});
  scene.place("wall of the hollow", inside, clear, {.position = center, .scale = 0.82});
  scene.place("ball in the hollow", outside, rose, {.position = center, .scale = 0.55});
  scene.place("dense heart", outside, dense, {.position = center, .scale = 0.25});

  scene.place("glass with a bubble", outside, rose, {.position = {-1.9, 0.62, 0.2}, .scale = 0.6});
  scene.place("bubble", inside, rose, {.position = {-1.9, 0.7, 0.2}, .scale = 0.3});
  scene.place("glass full of water", outside, clear, {.position = {1.9, 0.62, 0.2}, .scale = 0.6});
  scene.place("water", inside, waterToGlass, {.position = {1.9, 0.62, 0.2}, .scale = 0.5});
  scene.addLight({.name = "key", .intensity = 50, .position = {-3, 5, 3}});
  scene.addLight({.name = "fill", .intensity = 12, .position = {3, 3, 5}, .castsShadows = false});
  scene.setBackground({0.55, 0.65, 0.8});
  scene.addCamera("camera", {0, 1.6, 6}, {0, 0.85, 0}, 30);
}

}  // namespace generator
