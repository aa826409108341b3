// A diner of chrome and neon after the rain, at dusk. Metres; its parts are in diner/.
#include "diner/street.h"
#include "scenes.h"

namespace generator {
namespace {

glm::dvec3 inDiner(glm::dvec3 at) { return within(kDiner, {.position = at}).position; }

void addStreetLights(GltfBuilder& scene) {
  const glm::dvec3 sodium(1, 0.68, 0.36), tungsten(1, 0.78, 0.52);
  // The lamp over the bicycle.
  scene.addLight({.name = "street lamp",
                  .type = "spot",
                  .color = sodium,
                  .intensity = 95,
                  .position = {-3.60, 3.36, 1.05},
                  .target = {-2.9, 0, 2.6},
                  .innerCone = glm::radians(18.0),
                  .outerCone = glm::radians(48.0)});
  // What the diner's lamps throw out of its windows.
  for (const double x : {-3.0, 3.0})
    scene.addLight(
        {.name = "diner", .color = tungsten, .intensity = 24, .position = inDiner({x, 2.05, -1.6})});
  // Neon lights what is near it.
  scene.addLight({.name = "sign",
                  .color = {1, 0.16, 0.12},
                  .intensity = 7,
                  .position = inDiner({0, 4.0, 1.4}),
                  .castsShadows = false});
  scene.addLight({.name = "eaves",
                  .color = {0.75, 0.35, 0.75},
                  .intensity = 5,
                  .position = inDiner({-3.5, 2.5, 2.8}),
                  .castsShadows = false});
  scene.addLight({.name = "eaves",
                  .color = {0.55, 0.45, 0.95},
                  .intensity = 5,
                  .position = inDiner({3.5, 2.5, 2.8}),
                  .castsShadows = false});
  // A lamp on this side of the street, over the table.
  scene.addLight({.name = "near lamp",
                  .type = "spot",
                  .color = sodium,
                  .intensity = 34,
                  .position = {1.9, 2.9, 8.3},
                  .target = {0.35, 0.72, 6.8},
                  .innerCone = glm::radians(12.0),
                  .outerCone = glm::radians(24.0)});
  scene.addLight({.name = "far lamp",
                  .type = "spot",
                  .color = {0.85, 0.88, 1},
                  .intensity = 24,
                  .position = {-4.2, 3.0, 8.6},
                  .target = {-1.8, 0.5, 4.5},
                  .innerCone = glm::radians(10.0),
                  .outerCone = glm::radians(22.0),
                  .castsShadows = false});
  scene.addLight({.name = "sky",
                  .type = "directional",
                  .color = {0.42, 0.55, 1},
                  .intensity = 0.8,
                  .position = {0, 20, 0},
                  .target = {-2, 0, -4},
                  .castsShadows = false});
}

}  // namespace

void buildDiner(GltfBuilder& scene) {
  const Street street{{scene, {}}, addStreetFinishes(scene)};
  const Street diner = street.at(kDiner);
  addDiner(diner);
  addInside(diner);
  addSigns(diner);
  addPavement(street);
  addLampPosts(street);
  addBicycle(street);
  addCafeTable(street);
  addUmbrella(street);
  addHouses(street);
  addStreetLights(scene);
  scene.setBackground({0.03, 0.045, 0.11});
  scene.addCamera("camera", {-1.2, 1.36, 9.4}, {0.35, 1.62, -2}, 36);
}

}  // namespace generator
