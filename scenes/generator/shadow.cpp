// Shadow: three lights, red, green and blue, make white where all arrive; each shadow has the colour of
// the other two. The big ball right behind the lights casts none: shadow rays end at the light.
#include <array>

#include "scenes.h"

namespace generator {

void buildShadow(GltfBuilder& scene) {
  const int white = scene.addMaterial(matte("white", glm::dvec3(0.8)));
  Mesh planes;
  addQuad(planes, {-9, 0, 8}, {18, 0, 0}, {0, 0, -10.6});
  addQuad(planes, {-9, 0, -2.6}, {18, 0, 0}, {0, 7, 0});
  planes.uv0.clear();
  planes.tangents.clear();
  scene.add("floor and wall", std::move(planes), white);
  const int sphere = scene.addGeometry(makeUnitSphere());
  scene.place("pillar", scene.addGeometry(makeCylinder(0.28, 1.15, 64)), white, {.position = {0, 0, -0.9}});
  scene.place("ball", sphere, white, {.position = {0, 1.5, -0.9}, .scale = 0.48});
  scene.place("ball behind the lights", sphere, white, {.position = {0, 3.4, 8.5}, .scale = 1.5});
  const std::array<glm::dvec3, 3> colors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::array<const char*, 3> names{"red", "green", "blue"};
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    scene.addLight(
        {.name = names[k], .color = colors[k], .intensity = 120, .position = {(i - 1) * 2.6, 2.9, 5.2}});
  }
  scene.addCamera("camera", {2.6, 2.1, 6.2}, {-0.15, 1.0, -1.4}, 32);
}

}  // namespace generator
