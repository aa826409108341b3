// The wet street, the kerb around the diner, lamp posts.
#include "diner/street.h"
#include "shapes/lathe.h"
#include "shapes/sweep.h"

namespace generator {

void addPavement(const Street& street) {
  Mesh ground;
  addQuad(ground, {-16, 0, 10}, {32, 0, 0}, {0, 0, -32});
  street.add("street", std::move(ground), street.finishes.asphalt);
  const Street at = street.at({.position = {kDiner.position.x, 0, kDiner.position.z}, .turnY = kDiner.turnY});
  PlateSpec kerb{.outline = rectangleOutline({-9.5, -2.0}, {10.5, 6}, 0.8, 0.06),
                 .height = 0.14,
                 .bevel = 0.03,
                 .bevelSteps = 6,
                 .textureSize = 2.4};
  at.add("kerb", joined(makePlate(kerb)), street.finishes.kerb);
}

void addLampPosts(const Street& street) {
  const StreetFinishes& f = street.finishes;
  const auto turned = [](const std::vector<Corner>& profile, int segments) {
    return makeLathe(roundCorners(profile, false, 0.1), segments);
  };
  const int post = street.addMesh("lamp post",
                                  turned({{0, 0, 0},
                                          {0.20, 0, 0.02},
                                          {0.20, 0.12, 0.03},
                                          {0.15, 0.2, 0.05},
                                          {0.14, 0.7, 0.03},
                                          {0.09, 0.8, 0.04},
                                          {0.065, 1.2, 0.3},
                                          {0.05, 3.6, 0.1},
                                          {0.09, 3.66, 0.03},
                                          {0.05, 3.75, 0.03},
                                          {0.03, 4.0, 0},
                                          {0, 4.0, 0}},
                                         96),
                                  f.iron);
  const int arm = street.addMesh(
      "lamp arm",
      makeWire(
          smoothPath({{0, 3.9, 0}, {0.05, 4.25, 0}, {0.35, 4.45, 0}, {0.72, 4.36, 0}, {0.85, 4.15, 0}}, 14),
          0.028, 24),
      f.iron);
  const int head = street.addMesh("lamp head",
                                  turned({{0.25, 3.86, 0.005},
                                          {0.26, 3.865, 0.005},
                                          {0.22, 3.98, 0.06},
                                          {0.07, 4.07, 0.03},
                                          {0.06, 4.18, 0.02},
                                          {0, 4.19, 0}},
                                         128),
                                  f.iron);
  const int globe = street.addMesh("lamp globe", makeSphere(0.12, 96, 48), f.bulb);
  const auto stand = [&](glm::dvec3 at, double turnY) {
    const Street lamp = street.at({.position = at, .scale = 0.88, .turnY = turnY});
    lamp.placeMesh(post, {});
    lamp.placeMesh(arm, {});
    lamp.placeMesh(head, {.position = {0.85, 0, 0}});
    lamp.placeMesh(globe, {.position = {0.85, 3.90, 0}});
  };
  stand({-4.3, 0, 1.3}, -20);
  stand({-9.5, 0, -9.5}, 0);
  stand({-13.5, 0, -21}, 0);
}

}  // namespace generator
