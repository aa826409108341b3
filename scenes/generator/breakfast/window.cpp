// The wall with the window, its curtains, and a garden that is out of focus.
#include <cmath>
#include <numbers>

#include "breakfast/table.h"
#include "hash.h"
#include "shapes/lathe.h"
#include "shapes/surface.h"
#include "shapes/sweep.h"
#include "textures/lens_discs.h"
#include "textures/noise.h"

namespace generator {
namespace {

using std::numbers::pi;

enum GardenSeries : std::uint32_t {
  kFoliage = 25000,
  kDiscAt = 25010,
  kDiscSize = 25030,
  kFoldPhase = 25040,
  kTrunk = 25050
};
constexpr glm::dvec2 kOpeningLow(-64, -2), kOpeningHigh(26, 112);  // x and y
constexpr double kWallDepth = 14;

void addWall(const Table& w) {
  constexpr double left = -230, right = 250, low = -75, high = 200;
  const auto part = [&](glm::dvec2 from, glm::dvec2 to) {
    // The texture goes on from part to part.
    Mesh mesh = makeQuad({from, kWindowWall}, {to.x - from.x, 0, 0}, {0, to.y - from.y, 0}, {1, 1});
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      mesh.uv0[i] = glm::vec2(mesh.positions[i].x, -mesh.positions[i].y) / 150.0F;
    w.add("window wall", std::move(mesh), w.finishes.wall);
  };
  part({left, low}, {kOpeningLow.x, high});
  part({kOpeningHigh.x, low}, {right, high});
  part({kOpeningLow.x, low}, {kOpeningHigh.x, kOpeningLow.y});
  part({kOpeningLow.x, kOpeningHigh.y}, {kOpeningHigh.x, high});
}

void addFrame(const Table& w) {
  const auto bar = [&](glm::dvec3 low, glm::dvec3 high) {
    w.add("window frame", makeRoundedBox(low, high, 0.5), w.finishes.paint);
  };
  const double z = kWindowWall - kWallDepth;
  bar({kOpeningLow.x - 6, kOpeningLow.y - 3, z},
      {kOpeningHigh.x + 6, kOpeningLow.y, kWindowWall + 5});  // sill
  for (const double x : {kOpeningLow.x - 3, kOpeningHigh.x - 1})
    bar({x, kOpeningLow.y, z}, {x + 4, kOpeningHigh.y, kWindowWall + 0.6});
  bar({kOpeningLow.x - 3, kOpeningHigh.y - 1, z},
      {kOpeningHigh.x + 3, kOpeningHigh.y + 3, kWindowWall + 0.6});
  const double middle = 0.5 * (kOpeningLow.x + kOpeningHigh.x);
  for (const double x : {kOpeningLow.x, middle - 4, middle + 0.4, kOpeningHigh.x - 4.5})
    bar({x, kOpeningLow.y, z + 3}, {x + 3.8, kOpeningHigh.y, z + 7});
  for (const double y : {kOpeningLow.y + 0.1, 44.0, 78.0})
    for (const double x : {kOpeningLow.x + 3.8, middle + 4.0})
      bar({x, y, z + 3.6}, {x + 37, y + (y < 5 ? 5.0 : 2.4), z + 6.4});
  w.add("panes",
        makeQuad({kOpeningLow, z + 5}, {kOpeningHigh.x - kOpeningLow.x, 0, 0},
                 {0, kOpeningHigh.y - kOpeningLow.y, 0}, {1, 1}),
        w.finishes.pane);
}

/// How far a curtain stands from its rail at `u` of its width, centimetres, for a fold depth of 1.
double curtainFold(double u, double v) {
  const double phase = 7.2 * u + 0.7 * noise({u, 0.5 * v + 0.1}, {5, 2}, kFoldPhase);
  return std::sin(2 * pi * phase) + 0.35 * std::sin(4 * pi * phase + 1.3);
}

/// Cloth that light shines through; where it is seen edge on there is more of it in the way.
std::vector<std::uint8_t> curtainPicture() {
  return paintPicture(512, 128, [](glm::dvec2 uv) {
    const double u = uv.x, v = 1 - uv.y, h = 0.002;
    const double slope = 0.05 * (curtainFold(u + h, v) - curtainFold(u - h, v)) / (2 * h);
    const double light = 0.30 + 0.70 / std::sqrt(1 + slope * slope);
    return light * glm::mix(glm::dvec3(0.72, 0.66, 0.58), glm::dvec3(0.80, 0.79, 0.77), v);
  });
}

void addCurtains(const Table& w) {
  MaterialSpec spec = matte("curtain", {0.8, 0.78, 0.74});
  spec.baseColor.a = 0.82;
  spec.alphaMode = "BLEND";
  spec.doubleSided = true;
  spec.emission = glm::dvec3(0.95);
  spec.emissionTexture.image = w.scene.addImage("curtain", curtainPicture(), false);
  const Finish curtain{w.scene.addMaterial(spec), true};
  const auto hang = [&](const char* name, double left, double right) {
    SurfaceSpec cloth{.columns = 420, .rows = 90, .position = {}};
    cloth.position = [=](glm::dvec2 uv) {
      // Gathered towards the rail, open below.
      const double open = 0.75 + 0.25 * (1 - uv.y), middle = 0.5 * (left + right);
      return glm::dvec3(middle + (uv.x - 0.5) * (right - left) * open, -16 + 136 * uv.y,
                        kWindowWall + 8 + (1.0 + 1.0 * (1 - uv.y)) * curtainFold(uv.x, uv.y));
    };
    w.add(name, makeSurface(cloth), curtain);
  };
  hang("left curtain", -86, -50);
  hang("right curtain", 15, 38);
  w.add("curtain rail", makeWire({{-100, 118, kWindowWall + 8}, {60, 118, kWindowWall + 8}}, 1.2, 32),
        w.finishes.gold);
}

std::vector<LensDisc> gardenDiscs() {
  std::vector<LensDisc> discs;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const double up = 0.16 + 0.72 * unitValue(kDiscAt + 1, i);
    const glm::dvec3 light = up > 0.5     ? glm::dvec3(0.70, 0.78, 0.62)
                             : up > 0.30  ? glm::dvec3(0.50, 0.56, 0.14)
                             : i % 5 == 0 ? glm::dvec3(0.80, 0.42, 0.40)
                                          : glm::dvec3(0.55, 0.62, 0.20);
    discs.push_back({{2 * unitValue(kDiscAt, i), 1 - up},
                     (6 + 19 * unitValue(kDiscSize, i)) / 768,
                     light,
                     0.04 + 0.16 * unitValue(kDiscSize + 1, i)});
  }
  return discs;
}

/// Lawn, bushes and trees without an edge, and sky between them.
glm::dvec3 gardenGreen(glm::dvec2 uv) {
  const double up = 1 - uv.y, trees = noise(uv, {13, 5}, kFoliage),
               bushes = noise(uv, {23, 10}, kFoliage + 1), broad = noise(uv, {5, 3}, kFoliage + 2);
  glm::dvec3 color = glm::mix(glm::dvec3(0.30, 0.42, 0.10), glm::dvec3(0.09, 0.16, 0.05),
                              smoothStep(0.25, 0.5, up + 0.08 * (bushes - 0.5)));
  color = glm::mix(color, glm::dvec3(0.17, 0.28, 0.07) * (0.6 + 1.0 * bushes), smoothStep(0.38, 0.62, up));
  const double sky = smoothStep(0.58, 0.95, up + 0.35 * (trees - 0.5) + 0.25 * (broad - 0.5));
  color = glm::mix(color * (0.75 + 0.5 * trees), glm::dvec3(0.78, 0.86, 0.92), sky);
  for (std::uint32_t i = 0; i < 9; ++i) {  // trunks
    const double off = std::abs(2 * (uv.x - 0.05 - 0.9 * unitValue(kTrunk, i))),
                 half = 0.018 + 0.034 * unitValue(kTrunk + 1, i),
                 top = 0.12 + 0.35 * unitValue(kTrunk + 2, i);
    const double dark =
        smoothStep(1.5, 0.4, off / half) * smoothStep(top, top + 0.2, uv.y) * smoothStep(0.6, 0.5, uv.y);
    color = glm::mix(color, glm::dvec3(0.055, 0.06, 0.03), 0.55 * dark);
  }
  return color;
}

/// Morning in a garden as a lens that is focused on the table shows it: soft greens, and discs where leaves
/// let the sky through.
std::vector<std::uint8_t> gardenPicture() {
  const std::vector<LensDisc> discs = gardenDiscs();
  return paintPicture(1536, 768, [&](glm::dvec2 uv) {
    return withDiscs(gardenGreen(uv), {2 * uv.x, uv.y}, discs);
  });
}

void addGarden(const Table& w) {
  MaterialSpec garden = lamp("garden", glm::dvec3(1.15));
  garden.emissionTexture.image = w.scene.addImage("garden", gardenPicture(), false);
  w.add("garden", makeQuad({-420, -190, -700}, {800, 0, 0}, {0, 400, 0}, {1, 1}),
        {w.scene.addMaterial(garden), true});
}

/// A round looking glass in a turned and gilded frame.
void addWallMirror(const Table& w) {
  const Table hung = w.at({.position = {54, 27, kWindowWall + 0.2}, .turn = upTo({0, 0, 1})});
  hung.add("mirror glass",
           makeLathe(roundCorners({{0, 0.5, 0}, {12.6, 0.5, 0}, {12.6, 0.9, 0}, {0, 0.9, 0}}, false), 192),
           w.finishes.mirrorGlass);
  hung.add("mirror frame",
           turnedVessel({{12.4, 0, 0.1},
                         {15.4, 0, 0.4},
                         {15.2, 1.6, 0.7},
                         {14.3, 1.4, 0.3},
                         {13.6, 2.2, 0.7},
                         {12.4, 1.2, 0.3}},
                        true),
           w.finishes.gold);
  const int bead = hung.addMesh("frame bead", makeSphere(0.34, 32, 16), w.finishes.gold);
  for (int i = 0; i < 96; ++i) {
    const glm::dvec2 c = onCircle(i, 96);
    hung.placeMesh(bead, {.position = {14.75 * c.x, 1.55, 14.75 * c.y}});
  }
}

}  // namespace

void addWindowSide(const Table& table) {
  addWall(table);
  addFrame(table);
  addCurtains(table);
  addGarden(table);
  addWallMirror(table);
}

}  // namespace generator
