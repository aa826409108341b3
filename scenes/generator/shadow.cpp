// P3, shadow: three lights, red, green and blue, make white where all arrive; each shadow shows the colours
// of the other two. The ball behind the lights (out of their way to the floor) casts no shadow: shadow rays
// end at the light.
#include "scenes.h"

namespace generator {

void buildShadow(GltfBuilder& scene) {
  const int white = scene.addMaterial(matte("white", glm::dvec3(0.8)));
  Mesh planes;
  addQuad(planes, {-8, 0, 5}, {16, 0, 0}, {0, 0, -8});
  addQuad(planes, {-8, 0, -3}, {16, 0, 0}, {0, 7, 0});
  planes.uv0.clear();
  planes.tangents.clear();
  scene.add("floor and wall", std::move(planes), white);
  const int sphere = scene.addGeometry(makeUnitSphere());
  scene.place("ball", sphere, white, {.position = {0, 0.9, 0}, .scale = 0.9});
  scene.place("ball behind the lights", sphere, white, {.position = {0, 5.8, 6.6}, .scale = 0.6});
  const std::array<glm::dvec3, 3> colors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::array<const char*, 3> names{"red", "green", "blue"};
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    scene.addLight(
        {.name = names[k], .color = colors[k], .intensity = 130, .position = {(i - 1) * 2.0, 4.6, 5.2}});
  }
  scene.addCamera("camera", {0, 3.0, 7}, {0, 0.95, -0.8}, 38);
}

}  // namespace generator
