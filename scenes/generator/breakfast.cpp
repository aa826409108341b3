// A breakfast table by a window, early in June: silver, honey, bread and water in the first sun. Metres; its
// parts are in breakfast/.
#include "breakfast/table.h"
#include "scenes.h"

namespace generator {
namespace {

constexpr double kCentimetre = 1e-2;

void addBreakfastLights(GltfBuilder& scene) {
  // The sun: a spot as far away as the garden is wide, that fills as much of the sky as the sun does with
  // --light-radius 0.17.
  const glm::dvec3 toSun = glm::normalize(glm::dvec3(-0.36, 0.47, -0.80)), table(0, 0.05, 0);
  constexpr double kFar = 36;
  scene.addLight({.name = "sun",
                  .type = "spot",
                  .color = {1, 0.86, 0.66},
                  .intensity = 6.4 * kFar * kFar,
                  .position = table + kFar * toSun,
                  .target = table,
                  .innerCone = glm::radians(2.2),
                  .outerCone = glm::radians(3.0)});
  // The sky, as much of it as the window lets in.
  scene.addLight(
      {.name = "sky", .color = {0.66, 0.82, 1}, .intensity = 1.1, .position = {-0.20, 1.0, -0.42}});
  scene.addLight({.name = "room",
                  .color = {1, 0.93, 0.84},
                  .intensity = 3.8,
                  .position = {0.9, 1.3, 1.9},
                  .castsShadows = false});
  scene.addLight({.name = "side",
                  .color = {0.80, 0.88, 1},
                  .intensity = 1.5,
                  .position = {-1.4, 0.9, 0.9},
                  .castsShadows = false});
}

/// Four seconds from the egg to the cherries, setting out and coming to rest softly.
std::vector<CameraView> pastTheTable() {
  constexpr int kViews = 33;
  constexpr double kSeconds = 4;
  std::vector<CameraView> views;
  for (int i = 0; i < kViews; ++i) {
    const double t = static_cast<double>(i) / (kViews - 1), gone = t * t * (3 - 2 * t);
    views.push_back({.seconds = kSeconds * t,
                     .from = glm::mix(glm::dvec3(-0.24, 0.16, 0.80), glm::dvec3(0.22, 0.25, 0.86), gone),
                     .at = glm::mix(glm::dvec3(-0.05, 0.10, 0), glm::dvec3(0.05, 0.11, 0), gone)});
  }
  return views;
}

}  // namespace

void buildBreakfast(GltfBuilder& scene) {
  const Table table{{scene, {.scale = kCentimetre}}, addTableFinishes(scene)};
  addLinen(table);
  addPot(table);
  addGlasses(table);
  addBread(table);
  addChina(table);
  addFruit(table);
  addSprig(table);
  addWindowSide(table);
  addRestOfRoom(table);
  addBreakfastLights(scene);
  scene.setBackground({0.72, 0.84, 0.98});
  scene.addCamera("camera", {0.02, 0.21, 0.98}, {0.01, 0.112, 0}, 27);
  scene.moveCamera("past the table", pastTheTable());
}

}  // namespace generator
