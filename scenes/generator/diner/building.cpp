// The diner: a railway car of chrome and red enamel that stays where it is.
#include <cmath>

#include "diner/street.h"
#include "shapes/lathe.h"
#include "shapes/skin.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

constexpr double kEndRadius = 1.7;

Outline planOutline() {
  return rectangleOutline({-kDinerHalf, 0}, {kDinerHalf, kDinerDepth}, kEndRadius, 0.04);
}

/// A slab of the plan's shape.
Mesh slab(double out, double thickness, double bevel) {
  return untextured(joined(
      makePlate({.outline = rectangleOutline({-kDinerHalf - out, -out}, {kDinerHalf + out, kDinerDepth + out},
                                             kEndRadius + out, 0.04),
                 .height = thickness,
                 .bevel = bevel,
                 .bevelSteps = 6})));
}

void addWalls(const Street& w) {
  const StreetFinishes& f = w.finishes;
  w.add("plinth", bandAround(-0.03, 0, 0.16, 1), f.blackEnamel);
  w.add("lower wall", bandAround(0, 0.14, kSill, 1), f.redEnamel);
  for (const double y : {0.16, 0.24, 0.32, 0.40, 0.48}) w.add("rib", tubeAround(0.0, y, 0.034), f.chrome);
  for (const double y : {0.62, 0.72, 0.82}) w.add("trim", tubeAround(0.0, y, 0.014), f.chrome);
  w.add("sill", tubeAround(0.02, kSill, 0.045), f.chrome);
  w.add("lintel", tubeAround(0.02, kLintel, 0.045), f.chrome);
  w.add("fascia", bandAround(0, kLintel, kRoof, 1), f.redEnamel);
  for (const double y : {2.30, 2.36, 2.84, 2.90}) w.add("trim", tubeAround(0.0, y, 0.016), f.chrome);
  w.add("eaves", tubeAround(0.04, kRoof, 0.07), f.chrome);
  w.add("roof", slab(0.10, 0.16, 0.07), f.steel, {.position = {0, kRoof + 0.02, 0}});
  w.add("clerestory", slab(-0.9, 0.30, 0.12), f.creamEnamel, {.position = {0, kRoof + 0.15, 0}});
  w.add("floor", slab(-0.05, 0.1, 0.02), f.counter, {.position = {0, 0.02, 0}});
  w.add("ceiling", insideOut(slab(-0.06, 0.05, 0.01)), f.ceiling, {.position = {0, kLintel + 0.12, 0}});
}

void addWindows(const Street& w) {
  const StreetFinishes& f = w.finishes;
  w.add("windows", bandAround(-0.04, kSill, kLintel, 1), f.pane);
  const int post =
      w.addMesh("post", makeRoundedBox({-0.035, kSill, -0.05}, {0.035, kLintel, 0.035}, 0.02), f.chrome);
  for (const double x : {-5.3, -3.8, -2.3, -0.75, 0.75, 2.3, 3.8, 5.3})
    w.placeMesh(post, {.position = {x, 0, 0}});
  for (int end = 0; end < 2; ++end) {
    for (const double degrees : {22.0, 45.0, 68.0}) {
      const double a = glm::radians(degrees), side = end == 0 ? -1 : 1;
      w.placeMesh(post, {.position = {side * (kDinerHalf - kEndRadius + kEndRadius * std::sin(a)), 0,
                                      -kEndRadius + kEndRadius * std::cos(a)},
                         .turnY = side * degrees});
    }
  }
}

/// A door of glass in the middle of the front, with a round handle, a step before it and a small roof above.
void addDoor(const Street& w) {
  const StreetFinishes& f = w.finishes;
  for (const double x : {-0.75, 0.67})
    w.add("door post", makeRoundedBox({x, 0.02, 0.0}, {x + 0.08, kLintel + 0.05, 0.10}, 0.02), f.chrome);
  w.add("door panel", makeRoundedBox({-0.66, 0.05, 0.0}, {0.66, kSill + 0.06, 0.06}, 0.02), f.redEnamel);
  for (const double x : {-0.34, 0.34}) {
    w.add("porthole", makeTorus(0.19, 0.025, 96, 24), f.chrome, {.position = {x, 0.70, 0.065}});
    w.add("light behind it",
          makeLathe(roundCorners({{0, 0, 0}, {0.18, 0, 0}, {0.18, 0.01, 0}, {0, 0.01, 0}}, false), 64),
          f.menu, {.position = {x, 0.70, 0.058}, .turn = upTo({0, 0, 1})});
  }
  w.add("kick plate", makeRoundedBox({-0.6, 0.1, 0.03}, {0.6, 0.36, 0.07}, 0.01), f.chrome);
  w.add("door rail", makeRoundedBox({-0.03, 0.05, 0.02}, {0.03, kLintel, 0.08}, 0.015), f.chrome);
  for (const double x : {-0.12, 0.12})
    w.add(
        "handle",
        makeWire(smoothPath(
                     {{x, 1.0, 0.06}, {x, 1.02, 0.13}, {x, 1.25, 0.14}, {x, 1.48, 0.13}, {x, 1.5, 0.06}}, 12),
                 0.015, 24),
        f.chrome);
  w.add("step", makeRoundedBox({-1.2, -0.02, -0.05}, {1.2, 0.06, 0.75}, 0.02), f.steel);
  PlateSpec canopy{.outline = rectangleOutline({-1.15, -0.9}, {1.15, 0.2}, 0.45, 0.06),
                   .height = 0.12,
                   .bevel = 0.05,
                   .bevelSteps = 5};
  w.add("canopy", untextured(joined(makePlate(canopy))), f.creamEnamel, {.position = {0, kLintel + 0.16, 0}});
}

}  // namespace

Mesh bandAround(double out, double low, double high, double repeat) {
  Mesh mesh;
  const Outline plan = planOutline();
  const auto n = static_cast<std::uint32_t>(plan.points.size());
  for (const double y : {low, high}) {
    double length = 0;
    for (std::uint32_t i = 0; i <= n; ++i) {
      const OutlinePoint& p = plan.points[i % n];
      if (i > 0) length += glm::distance(p.position, plan.points[i - 1].position);
      const glm::dvec3 normal(p.normal.x, 0, -p.normal.y);
      addVertex(mesh, {glm::dvec3(p.position.x, y, -p.position.y) + out * normal,
                       normal,
                       glm::cross(glm::dvec3(0, 1, 0), normal),
                       {length / repeat, -y / repeat}});
    }
  }
  sewRings(mesh, 0, 2, n + 1);
  return mesh;
}

Mesh tubeAround(double out, double height, double radius) {
  SweepSpec tube{.path = {}, .isClosed = true, .section = circleOutline(radius, 20)};
  const Outline plan = planOutline();
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    const OutlinePoint &p = plan.points[i], &next = plan.points[(i + 1) % plan.points.size()];
    const auto at = [&](glm::dvec2 q) { return glm::dvec3(q.x, height, -q.y); };
    tube.path.push_back(at(p.position + out * p.normal));
    // Straight sides get points of their own, or the first turn would shade all of them.
    const glm::dvec2 from = p.position + out * p.normal, to = next.position + out * next.normal;
    if (glm::distance(from, to) > 0.5) {
      tube.path.push_back(at(glm::mix(from, to, 0.01)));
      tube.path.push_back(at(glm::mix(from, to, 0.99)));
    }
  }
  return makeSweep(tube);
}

void addDiner(const Street& diner) {
  addWalls(diner);
  addWindows(diner);
  addDoor(diner);
}

}  // namespace generator
