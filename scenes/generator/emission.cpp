// Emission: five neon rings from dim to bright over a polished dark floor, with a mirror ball. The room
// has no other light worth the name, so what is seen is emission and its reflections; that an emitter lights
// nothing around it is part of the model.
#include <array>

#include "scenes.h"

namespace generator {

void buildEmission(GltfBuilder& scene) {
  Mesh floor;
  addQuad(floor, {-12, 0, 5}, {24, 0, 0}, {0, 0, -14});
  floor.uv0.clear();
  floor.tangents.clear();
  scene.add("polished floor", std::move(floor), scene.addMaterial(mirror("dark metal", glm::dvec3(0.4))));
  const int ring = scene.addGeometry(makeTorus(0.6, 0.055, 64, 16));
  struct Neon {
    const char* name;
    glm::dvec3 color;
    double radiance;
    glm::dvec3 position;
    double turn;
  };
  const std::array<Neon, 5> neons{{{"red 0.3", {1, 0.08, 0.06}, 0.3, {-2.1, 0.75, 0}, 25},
                                   {"orange 0.6", {1, 0.4, 0.05}, 0.6, {-1.1, 1.05, -0.5}, -15},
                                   {"magenta 1", {1, 0.15, 0.7}, 1, {0, 1.35, -0.9}, 0},
                                   {"green 2", {0.15, 1, 0.3}, 2, {1.1, 1.05, -0.5}, 15},
                                   {"blue 4", {0.15, 0.4, 1}, 4, {2.1, 0.75, 0}, -25}}};
  for (const Neon& neon : neons) {
    const int glow = scene.addMaterial(lamp(neon.name, neon.color * neon.radiance));
    scene.place(neon.name, ring, glow, {.position = neon.position, .turnY = neon.turn});
  }
  scene.place("mirror ball", scene.addGeometry(makeSphere(1, 64, 32)),
              scene.addMaterial(mirror("silver", glm::dvec3(0.93))),
              {.position = {0, 0.5, 0.4}, .scale = 0.5});
  scene.setBackground({0.012, 0.014, 0.025});
  scene.addCamera("camera", {0, 1.9, 6.4}, {0, 0.55, 0}, 36);
}

}  // namespace generator
