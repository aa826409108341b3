// The coffee pot: silver, with an ebony handle.
#include "breakfast/table.h"
#include "shapes/lathe.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

constexpr double kBodyArc = 0.05;  // radians between two points of a profile's arc

/// Beads on a circle, each a ball half sunk.
void addBeads(const Table& w, double radius, double height, double bead, int count) {
  const int ball = w.addMesh("bead", makeSphere(bead, 40, 20), w.finishes.silver);
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 c = onCircle(i, count);
    w.placeMesh(ball, {.position = {radius * c.x, height, radius * c.y}});
  }
}

void addSpoutAndHandle(const Table& w) {
  SweepSpec spout;
  spout.path = smoothPath(
      {{-5.0, 5.4, 0}, {-7.4, 6.6, 0}, {-9.4, 9.8, 0}, {-10.4, 13.8, 0}, {-11.8, 17.2, 0}, {-13.4, 18.9, 0}},
      20);
  for (std::size_t i = 0; i < spout.path.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(spout.path.size() - 1);
    spout.scale.push_back(0.38 + 0.62 * (1 - t) * (1 - t) + 0.06 * t * t * t);
  }
  spout.section = circleOutline(2.3, 96);
  w.add("spout", makeSweep(spout), w.finishes.silver);
  SweepSpec handle;
  handle.path = smoothPath({{6.0, 17.6, 0},
                            {8.6, 18.8, 0},
                            {11.6, 17.6, 0},
                            {12.6, 13.6, 0},
                            {11.2, 9.6, 0},
                            {9.0, 7.6, 0},
                            {7.6, 6.4, 0}},
                           20);
  for (std::size_t i = 0; i < handle.path.size(); ++i) {
    const double t = 2.0 * static_cast<double>(i) / static_cast<double>(handle.path.size() - 1) - 1;
    handle.scale.push_back(1 - 0.25 * t * t);
  }
  handle.section = circleOutline(0.95, 64);
  handle.capLength = 0.5;
  w.add("handle", makeSweep(handle), w.finishes.ebony);
  w.add("upper socket", makeWire({{3.8, 17.0, 0}, {6.4, 17.8, 0}}, 1.05, 64), w.finishes.silver);
  w.add("lower socket", makeWire({{6.0, 6.0, 0}, {8.0, 6.8, 0}}, 1.05, 64), w.finishes.silver);
}

}  // namespace

void addPot(const Table& table) {
  const Finish& silver = table.finishes.silver;
  const Table pot = table.at({.position = {kPot.x, 0, kPot.z}, .turnY = 24});
  const auto spun = [](const std::vector<Corner>& profile) {
    return makeLathe(roundCorners(profile, false, kBodyArc), 288);
  };
  pot.add("pot",
          spun({{0, 0, 0},
                {5.6, 0, 0.2},
                {5.6, 0.6, 0.3},
                {4.2, 1.4, 0.8},
                {4.3, 2.0, 0.3},
                {8.3, 4.6, 4.2},
                {7.4, 11, 6},
                {4.0, 15.6, 6},
                {3.9, 19.4, 2},
                {4.7, 20.4, 0.3},
                {4.5, 20.8, 0.2},
                {0, 20.8, 0}}),
          silver);
  pot.add("lid",
          spun({{0, 20.7, 0},
                {4.5, 20.7, 0.1},
                {4.5, 21.1, 0.2},
                {3.9, 22.2, 1.6},
                {1.1, 23.6, 1.5},
                {0.7, 24.4, 0.4},
                {0, 24.4, 0}}),
          silver);
  pot.add("knob", spun({{0, 24.2, 0}, {0.8, 24.3, 0.2}, {1.3, 25.3, 0.6}, {0.9, 26.5, 0.6}, {0, 26.9, 0}}),
          pot.finishes.ebony);
  addBeads(pot, 5.62, 0.35, 0.26, 72);
  addBeads(pot, 4.72, 20.5, 0.2, 72);
  addSpoutAndHandle(pot);
}

}  // namespace generator
