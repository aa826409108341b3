// A bicycle that leans on its stand: hoops, spokes, tubes, a chain.
#include <cmath>
#include <numbers>

#include "diner/street.h"
#include "shapes/gear.h"
#include "shapes/lathe.h"
#include "shapes/surface.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

using std::numbers::pi;

constexpr double kWheel = 0.335;                                          // to the rim
constexpr glm::dvec3 kRearHub(-0.50, 0.36, 0), kFrontHub(0.56, 0.36, 0);  // hubs
constexpr glm::dvec3 kCrank(-0.05, 0.30, 0), kSeat(-0.20, 0.82, 0), kHead(0.36, 0.88, 0),
    kFork(0.43, 0.66, 0);

/// Meshes of a wheel about the origin in the plane z = 0.
void addWheel(const Street& w, glm::dvec3 hub) {
  const StreetFinishes& f = w.finishes;
  const Street wheel = w.at({.position = hub});
  wheel.add("tyre", makeTorus(kWheel + 0.006, 0.019, 192, 24), f.rubber);
  wheel.add("rim", makeTorus(kWheel - 0.014, 0.009, 192, 16), f.chrome);
  wheel.add("hub", makeWire({{0, 0, -0.045}, {0, 0, 0.045}}, 0.016, 32), f.chrome);
  for (const double z : {-0.034, 0.034})
    wheel.add("flange", makeTorus(0.022, 0.006, 48, 12), f.chrome, {.position = {0, 0, z}});
  const int spoke = wheel.addMesh("spoke", makeWire({{0, 0, 0}, {0, kWheel - 0.02, 0}}, 0.0011, 8), f.chrome);
  for (int i = 0; i < 36; ++i) {
    // Each leaves its flange at a tangent, two ways in turn.
    const glm::dvec2 c = onCircle(i, 36), from = 0.022 * onCircle(i + (i % 4 < 2 ? 8 : 28), 36);
    const double z = i % 2 == 0 ? 0.034 : -0.034;
    const glm::dvec3 start(from, z), end(0.319 * c, 0.15 * z);
    wheel.placeMesh(
        spoke,
        {.position = start, .scale = glm::distance(start, end) / (kWheel - 0.02), .turn = upTo(end - start)});
  }
}

void addTubes(const Street& w) {
  const StreetFinishes& f = w.finishes;
  const auto tube = [&](const std::vector<glm::dvec3>& path, double radius, const Finish& finish) {
    w.add("tube", makeWire(path, radius, 32), finish);
  };
  tube({kCrank, kSeat - glm::dvec3(0, 0.12, 0)}, 0.016, f.creamEnamel);
  tube({kSeat + glm::dvec3(0.03, -0.17, 0), kHead - glm::dvec3(0, 0.06, 0)}, 0.015, f.creamEnamel);
  tube({kCrank, kFork + glm::dvec3(0, 0.04, 0)}, 0.017, f.creamEnamel);
  tube({kHead + glm::dvec3(-0.015, 0.04, 0), kFork - glm::dvec3(0, 0.02, 0)}, 0.020, f.creamEnamel);
  tube({kSeat - glm::dvec3(0, 0.14, 0), kSeat + glm::dvec3(-0.03, 0.06, 0)}, 0.012, f.chrome);
  for (const double z : {-0.055, 0.055}) {
    tube({kCrank + glm::dvec3(0, 0, 0.3 * z), kRearHub + glm::dvec3(0, 0, z)}, 0.010, f.creamEnamel);
    tube({kSeat + glm::dvec3(0.03, -0.16, 0.3 * z), kRearHub + glm::dvec3(0, 0, z)}, 0.008, f.creamEnamel);
    tube(smoothPath({kFork + glm::dvec3(0, -0.01, 0.6 * z), kFork + glm::dvec3(0.03, -0.12, z),
                     kFrontHub + glm::dvec3(-0.03, 0.08, z), kFrontHub + glm::dvec3(0, 0, z)},
                    10),
         0.010, f.chrome);
  }
  // Handlebar, grips, bell, lamp.
  tube({kHead, kHead + glm::dvec3(-0.03, 0.12, 0)}, 0.012, f.chrome);
  tube(smoothPath({kHead + glm::dvec3(-0.16, 0.10, -0.27), kHead + glm::dvec3(-0.04, 0.13, -0.24),
                   kHead + glm::dvec3(0.03, 0.13, -0.12), kHead + glm::dvec3(0.0, 0.12, 0),
                   kHead + glm::dvec3(0.03, 0.13, 0.12), kHead + glm::dvec3(-0.04, 0.13, 0.24),
                   kHead + glm::dvec3(-0.16, 0.10, 0.27)},
                  12),
       0.011, f.chrome);
  for (const double z : {-0.27, 0.27})
    tube({kHead + glm::dvec3(-0.17, 0.098, z), kHead + glm::dvec3(-0.07, 0.122, z * 0.94)}, 0.016, f.rubber);
  w.add("lamp",
        makeLathe(roundCorners({{0, 0, 0},
                                {0.03, 0.005, 0.01},
                                {0.045, 0.06, 0.01},
                                {0.047, 0.07, 0.004},
                                {0.04, 0.072, 0.004},
                                {0, 0.078, 0}},
                               false, 0.1),
                  64),
        f.chrome, {.position = kHead + glm::dvec3(0.03, 0.0, 0), .turn = upTo({1, 0.05, 0})});
  w.add("saddle",
        makeSurface({.columns = 64,
                     .rows = 64,
                     .isRound = true,
                     .position =
                         [](glm::dvec2 uv) {
                           const double x = 0.27 * uv.y, t = uv.y,
                                        wide = (0.03 + 0.085 * (1 - t) * (1 - t)) *
                                               std::sqrt(std::max(0.0, 1 - std::pow(2 * t - 1, 8)));
                           const double a = 2 * pi * uv.x;
                           return kSeat + glm::dvec3(x - 0.16,
                                                     0.07 + 0.022 * std::sin(a) - 0.012 * std::sin(pi * t),
                                                     -wide * std::cos(a));
                         }}),
        f.blackEnamel);
}

/// Chain wheel, cranks, pedals, and the chain around both wheels.
void addDrive(const Street& w) {
  const StreetFinishes& f = w.finishes;
  const Street side = w.at({.position = {0, 0, 0.05}});
  const GearSpec ring{46, 0.092};
  PlateSpec plate{.outline = gearOutline(ring),
                  .holes = spokeHoles(5, 0.022, 0.072, 0.012, 0.004),
                  .height = 0.004,
                  .bevel = 0.0006};
  side.add("chain wheel", untextured(joined(makePlate(plate))), f.chrome,
           {.position = kCrank, .turn = turnAbout({1, 0, 0}, 90)});
  for (const double way : {-1.0, 1.0}) {
    const glm::dvec3 arm(way * 0.10, -way * 0.13, way * 0.06 - 0.05),
        from = kCrank + glm::dvec3(0, 0, way * 0.06);
    w.add("crank", makeWire({from, kCrank + arm + glm::dvec3(0, 0, 0.05)}, 0.009, 24), f.chrome);
    w.add("pedal", makeRoundedBox({-0.045, -0.011, -0.04}, {0.045, 0.011, 0.04}, 0.008), f.rubber,
          {.position = kCrank + arm + glm::dvec3(0, 0, 0.05 + way * 0.05)});
  }
  std::vector<glm::dvec3> chain;
  constexpr double big = 0.094, small = 0.036;
  for (int i = 0; i <= 24; ++i) {
    const double a = pi / 2 - pi * i / 24;
    chain.push_back(kCrank + glm::dvec3(big * std::cos(a), big * std::sin(a), 0.052));
  }
  for (int i = 0; i <= 16; ++i) {
    const double a = -pi / 2 - pi * i / 16;
    chain.push_back(kRearHub + glm::dvec3(small * std::cos(a), small * std::sin(a), 0.052));
  }
  SweepSpec links{.path = chain,
                  .isClosed = true,
                  .section = rectangleOutline({-0.003, -0.003}, {0.003, 0.003}, 0.001, 0.4)};
  w.add("chain", makeSweep(links), f.iron);
  w.add("chain guard",
        makeSurface({.columns = 60,
                     .rows = 8,
                     .position =
                         [](glm::dvec2 uv) {
                           const glm::dvec3 a = kRearHub + glm::dvec3(-0.03, 0.055, 0.062),
                                            b = kCrank + glm::dvec3(0.03, 0.115, 0.062);
                           return glm::mix(a, b, uv.x) +
                                  glm::dvec3(0, 0.05 * (uv.y - 0.6) * (0.2 + std::sin(pi * uv.x)),
                                             0.01 * std::sin(pi * uv.y));
                         }}),
        f.redEnamel);
}

/// Mudguards, a rack, a stand.
void addFittings(const Street& w) {
  const StreetFinishes& f = w.finishes;
  const auto guard = [&](glm::dvec3 hub, double from, double to) {
    SweepSpec arc{
        .path = {}, .section = rectangleOutline({-0.003, -0.028}, {0.003, 0.028}, 0.0028, 0.3), .across = {}};
    for (int i = 0; i <= 40; ++i) {
      const double a = glm::radians(glm::mix(from, to, i / 40.0));
      arc.path.push_back(hub + (kWheel + 0.04) * glm::dvec3(std::cos(a), std::sin(a), 0));
    }
    arc.across = arc.path[0] - hub;
    w.add("mudguard", makeSweep(arc), f.chrome);
  };
  guard(kRearHub, 30, 190);
  guard(kFrontHub, 20, 150);
  for (const double z : {-0.06, 0.06}) {
    w.add("rack",
          makeWire(smoothPath({kSeat + glm::dvec3(-0.02, -0.06, 0.4 * z), kRearHub + glm::dvec3(0.1, 0.42, z),
                               kRearHub + glm::dvec3(-0.22, 0.42, z)},
                              8),
                   0.006, 16),
          f.chrome);
    w.add("rack",
          makeWire({kRearHub + glm::dvec3(0, 0, z), kRearHub + glm::dvec3(-0.14, 0.42, z)}, 0.005, 16),
          f.chrome);
  }
  w.add("stand", makeWire({kCrank + glm::dvec3(-0.08, 0.02, 0.02), {-0.20, 0.012, 0.20}}, 0.008, 16),
        f.chrome);
}

}  // namespace

void addBicycle(const Street& street) {
  const Street bicycle =
      street.at({.position = {-1.95, 0, 4.5}, .turn = turnAbout({0, 1, 0}, 24) * turnAbout({1, 0, 0}, 7)});
  addWheel(bicycle, kRearHub);
  addWheel(bicycle, kFrontHub);
  addTubes(bicycle);
  addDrive(bicycle);
  addFittings(bicycle);
}

}  // namespace generator
