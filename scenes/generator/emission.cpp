// P3, emission: glowing balls from dim to bright over a polished dark floor. The room has no other light
// worth the name, so what is seen is emission and its reflection; that an emitter lights nothing around it is
// part of the model.
#include "scenes.h"

namespace generator {

void buildEmission(GltfBuilder& scene) {
  Mesh floor;
  addQuad(floor, {-8, 0, 4}, {16, 0, 0}, {0, 0, -10});
  floor.uv0.clear();
  floor.tangents.clear();
  scene.add("polished floor", std::move(floor), scene.addMaterial(mirror("dark metal", glm::dvec3(0.35))));
  const int sphere = scene.addGeometry(makeUnitSphere());
  struct Ball {
    const char* name;
    glm::dvec3 color;
    double radiance;
  };
  const std::array<Ball, 5> balls{{{"0.15 red", {1, 0.15, 0.1}, 0.15},
                                   {"0.4 orange", {1, 0.45, 0.1}, 0.4},
                                   {"0.8 yellow", {1, 0.8, 0.2}, 0.8},
                                   {"2 green", {0.3, 1, 0.35}, 2},
                                   {"6 blue", {0.3, 0.5, 1}, 6}}};
  for (int i = 0; i < 5; ++i) {
    const Ball& ball = balls[static_cast<std::size_t>(i)];
    const int glow = scene.addMaterial(lamp(ball.name, ball.color * ball.radiance));
    scene.place(ball.name, sphere, glow, {.position = {(i - 2) * 1.25, 0.75, 0}, .scale = 0.5});
  }
  scene.setBackground(glm::dvec3(0.01, 0.012, 0.02));
  scene.addCamera("camera", {0, 1.7, 5.6}, {0, 0.55, 0}, 36);
}

}  // namespace generator
