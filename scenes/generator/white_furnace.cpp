// White furnace: lossless mirrors and clear glass in uniform radiance 1 without lights. Every pixel should
// come out as 1: what is missing is the last bounce, and, at outlines of the tessellated glass, refraction
// that fails at the facet. No block of glass: one whose sides meet at right angles can hold a ray for ever.
#include "scenes.h"

namespace generator {

void buildWhiteFurnace(GltfBuilder& scene) {
  const int perfect = scene.addMaterial(mirror("perfect mirror", glm::dvec3(1)));
  const int clear = scene.addMaterial(glass("clear glass", 1.5));
  // Smooth normals: rays stay for ever inside far more flat-sided balls than they are lost at the facets of
  // smooth ones.
  const int sphere = scene.addGeometry(makeUnitSphere());
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
