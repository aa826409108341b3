// White furnace: lossless mirrors and clear glass in uniform radiance 1 without lights. Every pixel must come
// out as 1 (up to what is cut off at the last bounce); whatever is seen is an error. No block of glass: one
// whose sides meet at right angles can hold a ray for ever.
#include "scenes.h"

namespace generator {

void buildWhiteFurnace(GltfBuilder& scene) {
  const int perfect = scene.addMaterial(mirror("perfect mirror", glm::dvec3(1)));
  const int clear = scene.addMaterial(glass("clear glass", 1.5));
  Mesh ball = makeUnitSphere();
  ball.normals.clear();  // flat facets: with interpolated normals some light is lost where a facet turns the
                         // other way
  const int sphere = scene.addGeometry(std::move(ball));
  scene.place("mirror ball", sphere, perfect, {.position = {-1.5, 0, 0}, .scale = 0.7});
  scene.place("glass ball", sphere, clear, {.position = {0, 0, 0}, .scale = 0.7});
  scene.place("glass ball behind", sphere, clear, {.position = {1.1, 0.5, -1.6}, .scale = 0.5});
  Mesh block;
  addBox(block, {-0.5, -0.6, -0.5}, {0.5, 0.6, 0.5});
  block.uv0.clear();
  block.tangents.clear();
  const int box = scene.addGeometry(std::move(block));
  scene.place("second glass ball", sphere, clear, {.position = {1.6, -0.1, 0.3}, .scale = 0.6});
  scene.place("mirror block", box, perfect, {.position = {-0.6, 0.2, -2}, .turnY = 50});
  scene.setBackground(glm::dvec3(1));
  scene.addCamera("camera", {0, 0.4, 5}, {0, 0, 0}, 32);
}

}  // namespace generator
