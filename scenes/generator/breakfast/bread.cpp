// A round loaf on a board, two slices of it, and croissants.
#include <cmath>
#include <numbers>

#include "breakfast/table.h"
#include "hash.h"
#include "shapes/surface.h"
#include "textures/noise.h"

namespace generator {
namespace {

using std::numbers::pi;

enum BreadSeries : std::uint32_t {
  kLoafBump = 22000,
  kLoafFlour = 22010,
  kLoafBlister = 22020,
  kPastryFlake = 22030,
  kCrumbAt = 22040
};
constexpr double kBoardTop = 2;

/// How far a point of the top is inside one of the loaf's cuts, 0 to 1, and how far along its raised lip.
struct Slash {
  double open, lip;
};
Slash slashAt(glm::dvec2 at) {
  Slash result{0, 0};
  for (const double offset : {-4.2, 0.0, 4.2}) {
    const double across = at.y - offset - 0.05 * at.x + 0.012 * at.x * at.x * (offset > 0 ? -1 : 1);
    const double ends = smoothStep(8.2, 6.0, std::abs(at.x)) * smoothStep(9.6, 8.2, glm::length(at));
    result.open = std::max(result.open, ends * smoothStep(1.0, 0.25, std::abs(across)));
    result.lip = std::max(result.lip, ends * smoothStep(0.6, 0.0, std::abs(across - 1.0)));
  }
  return result;
}

/// The loaf at a direction: `uv.y` from below to the top.
glm::dvec3 loafSphere(glm::dvec2 uv) {
  const double polar = pi * (1 - uv.y), around = 2 * pi * uv.x;
  return {std::sin(polar) * std::cos(around), std::cos(polar), -std::sin(polar) * std::sin(around)};
}

void addLoaf(const Table& w) {
  SurfaceSpec loaf{.columns = 480, .rows = 320, .isRound = true, .position = {}};
  constexpr double kRadius = 10.2;
  loaf.position = [](glm::dvec2 uv) {
    const glm::dvec3 n = loafSphere(uv);
    const glm::dvec2 top = kRadius * glm::dvec2(n.x, n.z), plane = top / 40.0 + 0.5;
    const double bump = fractalNoise(plane, {9, 9}, kLoafBump, 3) - 0.5,
                 blister = smoothStep(0.62, 0.9, fractalNoise(plane, {70, 70}, kLoafBlister, 2));
    const Slash slash = n.y > 0 ? slashAt(top) : Slash{0, 0};
    const double r = kRadius * (1 + 0.10 * bump + 0.007 * blister) - 0.75 * slash.open + 0.28 * slash.lip;
    const double y = n.y > 0 ? 0.70 * n.y : 0.42 * n.y;
    return glm::dvec3(r * n.x, std::max(r * y + 4.0, 0.0), r * n.z);
  };
  loaf.color = [](glm::dvec2 uv) {
    const glm::dvec3 n = loafSphere(uv);
    const glm::dvec2 top = kRadius * glm::dvec2(n.x, n.z), plane = top / 40.0 + 0.5;
    const Slash slash = n.y > 0 ? slashAt(top) : Slash{0, 0};
    const double burn = fractalNoise(plane, {11, 11}, kLoafBump + 5, 4),
                 blister = fractalNoise(plane, {70, 70}, kLoafBlister, 2);
    glm::dvec3 color =
        glm::mix(glm::dvec3(0.62, 0.31, 0.10), glm::dvec3(0.34, 0.125, 0.03), smoothStep(0.35, 0.7, burn));
    color = glm::mix(color, glm::dvec3(0.55, 0.30, 0.10), 0.6 * smoothStep(0.62, 0.85, blister));
    const double flour =
        smoothStep(0.40, 0.72, fractalNoise(plane, {22, 22}, kLoafFlour, 5)) * smoothStep(-0.1, 0.5, n.y);
    color = glm::mix(color, glm::dvec3(0.80, 0.74, 0.64), 0.9 * flour * (1 - slash.open));
    color = glm::mix(color, glm::dvec3(0.70, 0.50, 0.27) * (0.75 + 0.4 * blister), slash.open);
    return glm::mix(color, glm::dvec3(0.17, 0.06, 0.018), 0.8 * slash.lip * (1 - slash.open));
  };
  w.add("loaf", makeSurface(loaf), w.finishes.crust, {.position = {-3, kBoardTop, -27.6}, .turnY = 28});
}

/// A slice stands on its flat side and leans.
void addSlices(const Table& w) {
  std::vector<Corner> outline{{-8.2, 0.3, 1.0}, {8.2, 0.3, 1.0},  {9.0, 3.2, 2.2}, {6.2, 7.2, 3.5},
                              {0, 8.6, 6},      {-6.2, 7.2, 3.5}, {-9.0, 3.2, 2.2}};
  PlateSpec slice{.outline = roundCorners(outline, true, 0.1),
                  .height = 1.5,
                  .bevel = 0.3,
                  .bevelSteps = 5,
                  .textureSize = 12};
  Plate plate = makePlate(slice);
  Mesh rind = untextured(plate.edges);
  for (std::size_t i = 0; i < rind.positions.size(); ++i)
    rind.colors.emplace_back(0.36F, 0.16F, 0.045F, 1.0F);
  const int face = w.addMesh("slice", plate.faces, w.finishes.crumb),
            edge = w.addMesh("rind", rind, w.finishes.crust);
  const auto lay = [&](glm::dvec3 at, double turnY, double lean) {
    const Placement place{.position = at, .turn = turnAbout({0, 1, 0}, turnY) * turnAbout({1, 0, 0}, lean)};
    w.placeMesh(face, place);
    w.placeMesh(edge, place);
  };
  lay({2.6, kBoardTop, -14.9}, -12, 66);
  lay({5.6, kBoardTop, -13.0}, -20, 61);
}

/// Layers of rolled dough lie one on another towards the tips: how far one is into its layer, 0 to 1.
double layerAt(glm::dvec2 uv) {
  const double layers = 4.6 * std::abs(2 * uv.y - 1) + 0.12 * std::sin(2 * pi * uv.x + 1);
  return layers - std::floor(layers);
}

/// A crescent of rolled dough. `uv.y` along it, `uv.x` around.
glm::dvec3 croissantPoint(glm::dvec2 uv) {
  const double angle = (uv.y - 0.5) * 2.5, around = 2 * pi * uv.x, bend = 5.6;
  // Each layer begins with a step and thins out towards the tip.
  const double side = std::abs(2 * uv.y - 1), step = layerAt(uv),
               ridge = smoothStep(0, 0.16, step) * (1 - smoothStep(0.16, 1, step));
  const double swell = std::pow(std::max(0.0, 1 - side * side), 0.62);
  const double flake = fractalNoise({uv.x, uv.y}, {9, 40}, kPastryFlake, 3) - 0.5;
  const double r = 2.75 * swell * (0.90 + 0.15 * ridge * swell + 0.05 * flake) + 0.02;
  const glm::dvec3 outward(std::sin(angle), 0, std::cos(angle));
  const glm::dvec3 rim = (bend + r * std::cos(around)) * outward;
  return {rim.x, std::max(-1.75, 0.86 * r * std::sin(around)), rim.z - bend};
}

void addCroissants(const Table& w) {
  SurfaceSpec croissant{.columns = 160, .rows = 420, .isRound = true, .position = croissantPoint};
  croissant.color = [](glm::dvec2 uv) {
    const double step = layerAt(uv);
    const double bake = fractalNoise(uv, {6, 22}, kPastryFlake + 5, 4),
                 flake = fractalNoise(uv, {14, 90}, kPastryFlake, 3);
    glm::dvec3 color = glm::mix(glm::dvec3(0.74, 0.37, 0.09), glm::dvec3(0.93, 0.70, 0.36),
                                0.7 * std::max(smoothStep(0.5, 1.0, step), smoothStep(0.12, 0.0, step)));
    color = glm::mix(color, glm::dvec3(0.44, 0.16, 0.03), 0.85 * smoothStep(0.40, 0.62, bake) * (1 - step));
    return color * (0.8 + 0.4 * flake);
  };
  const int mesh = w.addMesh("croissant", makeSurface(croissant), w.finishes.pastry);
  w.placeMesh(mesh, {.position = {kPastry.x - 1.2, 2.62, kPastry.z + 4.6}, .turnY = 12});
  w.placeMesh(mesh, {.position = {kPastry.x + 1.6, 2.62, kPastry.z - 0.6}, .turnY = -8});
}

/// Crumbs around what was cut and broken.
void addCrumbs(const Table& w) {
  SurfaceSpec crumb{.columns = 24, .rows = 16, .isRound = true, .position = {}};
  crumb.position = [](glm::dvec2 uv) {
    return loafSphere(uv) * (0.7 + 0.6 * fractalNoise(uv, {5, 4}, kLoafBlister + 4, 2));
  };
  crumb.color = [](glm::dvec2 uv) {
    return glm::mix(glm::dvec3(0.85, 0.70, 0.45), glm::dvec3(0.45, 0.20, 0.06),
                    smoothStep(0.4, 0.7, noise(uv, {3, 3}, kLoafFlour)));
  };
  const int mesh = w.addMesh("crumb", untextured(makeSurface(crumb)), w.finishes.crust);
  const auto scatter = [&](glm::dvec3 about, double reach, std::uint32_t count, std::uint32_t first) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      const double far = reach * std::sqrt(unitValue(kCrumbAt, i)),
                   turn = 2 * pi * unitValue(kCrumbAt + 1, i),
                   size = 0.06 + 0.16 * std::pow(unitValue(kCrumbAt + 2, i), 3);
      w.placeMesh(mesh,
                  {.position = about + glm::dvec3(far * std::cos(turn), 0.5 * size, far * std::sin(turn)),
                   .scale = size,
                   .turnY = 360 * unitValue(kCrumbAt + 3, i)});
    }
  };
  scatter({2, kBoardTop, -12.6}, 8, 60, 0);
  scatter({kPastry.x - 2, 0.9, kPastry.z}, 6.2, 46, 100);
  scatter({16, 0.05, 24}, 7, 26, 200);
}

}  // namespace

void addBread(const Table& table) {
  PlateSpec board{.outline = rectangleOutline({-18, 11}, {15, 38}, 3.5, 0.08),
                  .height = kBoardTop,
                  .bevel = 0.4,
                  .bevelSteps = 6,
                  .textureSize = 50};
  board.holes.push_back(reversed(circleOutline(0.9, 64, {12, 35})));
  table.add("board", joined(makePlate(board)), table.finishes.board);
  addLoaf(table);
  addSlices(table);
  addCroissants(table);
  addCrumbs(table);
}

}  // namespace generator
