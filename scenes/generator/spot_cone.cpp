// Spot cone: a stage. A soft-edged spot lights the pedestal; two hard-edged ones draw discs on the wall.
#include "scenes.h"

namespace generator {

void buildSpotCone(GltfBuilder& scene) {
  const int stage = scene.addMaterial(matte("stage", glm::dvec3(0.6)));
  Mesh planes;
  addQuad(planes, {-6, 0, 4}, {12, 0, 0}, {0, 0, -6});
  addQuad(planes, {-6, 0, -2}, {12, 0, 0}, {0, 5, 0});
  planes.uv0.clear();
  planes.tangents.clear();
  scene.add("stage", std::move(planes), stage);
  const int sphere = scene.addGeometry(makeUnitSphere());
  scene.place("ball", sphere, scene.addMaterial(matte("white", glm::dvec3(0.8))),
              {.position = {0, 1.1, 0}, .scale = 0.5});
  Mesh pedestal;
  addBox(pedestal, {-0.35, 0, -0.35}, {0.35, 0.6, 0.35});
  scene.add("pedestal", std::move(pedestal), scene.addMaterial(matte("stone", {0.45, 0.4, 0.35})));

  const double degree = glm::radians(1.0);
  // glTF wants the inner angle below the outer. This much less is a hard edge: 4 um on the wall,
  // where a pixel covers millimetres. Their cosines still differ as floats, for readers that divide
  // by the difference.
  const double hard = 12 * degree, hardInner = hard - 1e-6;
  scene.addLight({.name = "soft spot",
                  .type = "spot",
                  .color = {1, 0.95, 0.85},
                  .intensity = 60,
                  .position = {1.6, 4.6, 2.4},
                  .target = {0, 0.5, 0},
                  .innerCone = 8 * degree,
                  .outerCone = 18 * degree});
  scene.addLight({.name = "hard red spot",
                  .type = "spot",
                  .color = {1, 0.25, 0.2},
                  .intensity = 48,
                  .position = {-2.3, 2.2, 2.2},
                  .target = {-2.5, 2.1, -2},
                  .innerCone = hardInner,
                  .outerCone = hard});
  scene.addLight({.name = "hard blue spot",
                  .type = "spot",
                  .color = {0.25, 0.45, 1},
                  .intensity = 48,
                  .position = {2.3, 2.2, 2.2},
                  .target = {2.5, 2.1, -2},
                  .innerCone = hardInner,
                  .outerCone = hard});
  scene.addLight({.name = "fill", .intensity = 4, .position = {0, 3, 5}, .castsShadows = false});
  scene.addCamera("camera", {0, 1.9, 6.0}, {0, 1.45, 0}, 37);
}

}  // namespace generator
