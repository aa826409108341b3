// A watchmaker's bench at dusk: a pocket watch lies open in the light of a lamp while the city behind the
// window lights up. Metres; its parts are in watchmaker/.
#include "scenes.h"
#include "shapes/lathe.h"
#include "watchmaker/workshop.h"

namespace generator {
namespace {

constexpr double kMillimetre = 1e-3;

/// A spot light and the disc of glass that it shines through, which mirrors show.
void addSpot(const Workshop& workshop, const LightSpec& light) {
  constexpr double kRadiance = 18;  // W/(m² sr) of the disc, times the light's colour
  const glm::dvec3 way = glm::normalize(light.target - light.position);
  Mesh disc = makeLathe(roundCorners({{0, -1, 0}, {28, -1, 0.3}, {28, 0, 0.3}, {0, 0, 0}}, false), 64);
  const glm::dvec3 behind = (light.position - 0.002 * way) / kMillimetre;
  const Finish glow{workshop.scene.addMaterial(lamp(light.name + " glass", kRadiance * light.color)), false};
  workshop.add(light.name + " glass", std::move(disc), glow, {.position = behind, .turn = upTo(way)});
  workshop.scene.addLight(light);
}

void addLights(const Workshop& workshop) {
  GltfBuilder& scene = workshop.scene;
  const glm::dvec3 lampColor(1, 0.72, 0.42), skyColor(0.38, 0.55, 1);
  const double degree = glm::radians(1.0);
  // The key light: a second lamp, out of the picture above the watchmaker's left shoulder.
  addSpot(workshop, {.name = "key",
                     .type = "spot",
                     .color = lampColor,
                     .intensity = 1.1,
                     .position = {-0.06, 0.45, 0.165},
                     .target = {-0.01, 0.03, 0.02},
                     .innerCone = 9 * degree,
                     .outerCone = 19 * degree});
  // Just below the bulb, so that it lights the inside of the shade as well.
  scene.addLight(
      {.name = "lamp", .color = lampColor, .intensity = 0.04, .position = {-0.122, 0.1163, -0.0757}});
  // From the right, for what stands at the edge of the lamps' light.
  addSpot(workshop, {.name = "shelf lamp",
                     .type = "spot",
                     .color = {1, 0.86, 0.68},
                     .intensity = 0.22,
                     .position = {0.33, 0.36, 0.14},
                     .target = {0.13, 0.04, -0.06},
                     .innerCone = 8 * degree,
                     .outerCone = 22 * degree});
  scene.addLight({.name = "window", .color = skyColor, .intensity = 0.16, .position = {0.16, 0.30, -0.31}});
  scene.addLight({.name = "room",
                  .color = {1, 0.8, 0.6},
                  .intensity = 0.10,
                  .position = {0.3, 0.5, 0.8},
                  .castsShadows = false});
  scene.addLight({.name = "lantern",
                  .color = {1, 0.77, 0.5},
                  .intensity = 0.7,
                  .position = {-0.42, 0.98, 1.25},
                  .castsShadows = false});
}

}  // namespace

void buildWatchmaker(GltfBuilder& scene) {
  const Workshop workshop{{scene, {.scale = kMillimetre}}, addFinishes(scene)};
  addBench(workshop);
  const Assembly movement = makeMovement(workshop);
  addWatch(workshop, movement);
  addTools(workshop);
  addTray(workshop);
  addLamp(workshop);
  addMagnifier(workshop);
  addGlassware(workshop, movement);
  addTableClock(workshop);
  addRoomAround(workshop);
  addCity(workshop);
  addLights(workshop);
  scene.setBackground({0.012, 0.016, 0.03});
  scene.addCamera("camera", {0.026, 0.112, 0.4}, {0.006, 0.050, 0}, 25);
}

}  // namespace generator
