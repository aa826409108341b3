// A sprig of dog rose in a flask of water.
#include <cmath>
#include <numbers>

#include "breakfast/table.h"
#include "hash.h"
#include "shapes/lathe.h"
#include "shapes/surface.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

using std::numbers::pi;

enum SprigSeries : std::uint32_t { kLeafTurn = 24000, kLeafSize, kPetalTurn };

/// A leaf along +Z from the origin, its upper side to +Y; folded a little and bent down at the tip.
Mesh makeLeaf(double length, double width) {
  SurfaceSpec leaf{.columns = 20, .rows = 28, .position = {}};
  leaf.position = [=](glm::dvec2 uv) {
    const double t = 1 - uv.y, side = 2 * uv.x - 1,
                 half = width * std::pow(std::sin(pi * std::pow(t, 0.8)), 0.9) * 0.5;
    const double wave = 0.03 * length * std::sin(9 * pi * t) * side * side;
    return glm::dvec3(side * half, 0.35 * half * side * side + wave * half / width - 0.22 * length * t * t,
                      length * t);
  };
  return makeSurface(leaf);
}

/// One of five petals, a shallow spoon with a notch at the end.
Mesh makePetal() {
  SurfaceSpec petal{.columns = 24, .rows = 18, .position = {}};
  petal.position = [](glm::dvec2 uv) {
    const double t = 1 - uv.y, side = 2 * uv.x - 1;
    const double half = 1.12 * std::pow(t, 0.85) * std::sqrt(std::max(0.0, 1.02 - t * t * t * 0.35));
    const double length = 1.75 * t - 0.34 * t * t * (1 - std::abs(side)) - 0.42 * t * side * side;
    return glm::dvec3(side * half,
                      0.42 * t * t + 0.42 * side * side * t + 0.04 * std::sin(5 * side + 3 * t) * t,
                      0.12 + length);
  };
  // White at the foot, rose at the rim.
  petal.color = [](glm::dvec2 uv) {
    const double t = 1 - uv.y, side = 2 * uv.x - 1;
    return glm::mix(glm::dvec3(0.88, 0.86, 0.80), glm::dvec3(0.86, 0.50, 0.56),
                    std::min(1.0, 0.85 * t * t + 0.25 * side * side));
  };
  return untextured(makeSurface(petal));
}

struct SprigMeshes {
  int leaf, petal, pollen;
};

void addBlossom(const Table& w, const SprigMeshes& meshes, const Placement& place) {
  const Table blossom = w.at(place);
  for (int i = 0; i < 5; ++i)
    blossom.placeMesh(meshes.petal,
                      {.turnY = 72.0 * i + 8 * unitValue(kPetalTurn, static_cast<std::uint32_t>(i))});
  blossom.placeMesh(meshes.pollen, {.position = {0, 0.12, 0}, .scale = 2.2});
  for (int i = 0; i < 26; ++i) {
    const glm::dvec2 c = onCircle(i, 26);
    const double r = 0.34 + 0.17 * (i % 3);
    blossom.placeMesh(meshes.pollen, {.position = {r * c.x, 0.42 + 0.1 * (i % 2), r * c.y}, .scale = 0.7});
  }
}

/// A stem with leaves to both sides and a blossom at its end.
void addStem(const Table& w, const SprigMeshes& meshes, const std::vector<glm::dvec3>& points,
             std::uint32_t id, bool hasBlossom) {
  SweepSpec stem;
  stem.path = smoothPath(points, 14);
  for (std::size_t i = 0; i < stem.path.size(); ++i)
    stem.scale.push_back(1 - 0.5 * static_cast<double>(i) / static_cast<double>(stem.path.size()));
  stem.section = circleOutline(0.17, 24);
  stem.capLength = 0.17;
  w.add("stem", makeSweep(stem), w.finishes.stem);
  std::uint32_t leaf = 64 * id;
  for (std::size_t i = stem.path.size() / 3; i + 2 < stem.path.size(); i += 4, ++leaf) {
    if (stem.path[i].y < 17.5) continue;
    const glm::dvec3 along = glm::normalize(stem.path[i + 1] - stem.path[i]);
    for (int side = 0; side < 2; ++side) {
      const double turn = (leaf % 2 == 0 ? 20 : 110) + 180.0 * side +
                          50 * unitValue(kLeafTurn, 2 * leaf + static_cast<std::uint32_t>(side));
      const glm::dquat way = upTo(along) * turnAbout({0, 1, 0}, turn) * turnAbout({1, 0, 0}, -24);
      w.placeMesh(meshes.leaf,
                  {.position = stem.path[i],
                   .scale = 0.7 + 0.5 * unitValue(kLeafSize, 2 * leaf + static_cast<std::uint32_t>(side)),
                   .turn = way});
    }
  }
  const glm::dvec3 tip = stem.path.back(), before = stem.path[stem.path.size() - 3];
  if (hasBlossom)
    addBlossom(w, meshes,
               {.position = tip, .turn = upTo(glm::normalize(tip - before) + glm::dvec3(0, 0, 0.9))});
}

}  // namespace

void addSprig(const Table& table) {
  const Table w = table.at({.position = {kVase.x, 0, kVase.z}});
  w.add("flask",
        turnedVessel({{0, 0.2, 0},
                      {3.2, 0.15, 0.2},
                      {3.8, 0, 0.3},
                      {4.5, 1.0, 1.0},
                      {4.2, 6.0, 3.0},
                      {1.7, 10.6, 3.0},
                      {1.5, 15.2, 1.0},
                      {2.3, 17.0, 0.4},
                      {2.15, 17.2, 0.1},
                      {2.0, 17.0, 0.1},
                      {1.25, 15.2, 1.0},
                      {1.45, 10.4, 0}}),
        w.finishes.glass);
  w.add("flask wetted",
        insideOut(
            turnedVessel({{0, 0.8, 0}, {3.4, 0.7, 0.6}, {4.1, 1.4, 0.7}, {3.85, 5.9, 2.8}, {1.45, 10.4, 0}})),
        w.finishes.waterWall);
  w.add("flask water", turnedVessel({{1.45, 10.4, 0}, {1.33, 10.28, 0.1}, {1.0, 10.24, 0.3}, {0, 10.24, 0}}),
        w.finishes.waterTop);
  const SprigMeshes meshes{w.addMesh("leaf", makeLeaf(4.4, 2.3), w.finishes.leaf),
                           w.addMesh("petal", makePetal(), w.finishes.petal),
                           w.addMesh("pollen", makeSphere(0.13, 20, 10), w.finishes.pollen)};
  addStem(w, meshes,
          {{-2.2, 1.4, 0.6}, {-0.6, 8, 0.2}, {0.5, 16, 0}, {2.4, 22, 0.6}, {5.4, 27.5, 1.2}, {7.6, 31, 2.5}},
          0, true);
  addStem(w, meshes,
          {{2.4, 1.3, -0.4},
           {0.9, 8, 0},
           {-0.5, 16, 0.2},
           {-3.4, 21.5, 1.0},
           {-6.6, 25.4, 2.0},
           {-8.6, 26.6, 3.4}},
          1, true);
  addStem(w, meshes,
          {{0.4, 1.5, 1.8},
           {0.2, 8, 0.5},
           {-0.1, 16, -0.4},
           {-0.6, 22, -1.2},
           {-1.8, 28, -1.6},
           {-1.5, 33.5, -0.4}},
          2, true);
  // Petals that fell.
  for (std::uint32_t i = 0; i < 4; ++i) {
    constexpr glm::dvec2 kFallen[] = {{-12, 42}, {3, 37.5}, {-17, 49}, {-6, 29}};
    const glm::dquat way =
        turnAbout({0, 1, 0}, 360 * unitValue(kPetalTurn, 50 + i)) * turnAbout({1, 0, 0}, 10);
    w.placeMesh(meshes.petal, {.position = {kFallen[i].x, 0.12, kFallen[i].y}, .scale = 1.25, .turn = way});
  }
  addStem(w, meshes, {{-0.8, 1.5, -1.8}, {-0.3, 8, -0.6}, {0.4, 16, 0.4}, {0.9, 19.5, 2.2}, {2.6, 21.5, 5.0}},
          3, true);
}

}  // namespace generator
