// The rest of the room, which only mirrors show: walls that glow as the day would make them, a doorway, a chair.
#include "breakfast/table.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

constexpr double kLeft = -230, kRight = 250, kBackWall = 340, kFloorHeight = -75, kCeiling = 200;

void addShell(const Table& w) {
  const auto side = [&](const char* name, glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, const Finish& finish, glm::dvec2 repeat) {
    Mesh mesh;
    addQuad(mesh, corner, u, v, repeat);
    w.add(name, std::move(mesh), finish);
  };
  const double depth = kBackWall - kWindowWall, height = kCeiling - kFloorHeight, width = kRight - kLeft;
  side("left wall", {kLeft, kFloorHeight, kBackWall}, {0, 0, -depth}, {0, height, 0}, w.finishes.wall, {2.7, 1.8});
  side("right wall", {kRight, kFloorHeight, kWindowWall}, {0, 0, depth}, {0, height, 0}, w.finishes.wall, {2.7, 1.8});
  side("back wall", {kRight, kFloorHeight, kBackWall}, {-width, 0, 0}, {0, height, 0}, w.finishes.wall, {3.2, 1.8});
  side("ceiling", {kLeft, kCeiling, kWindowWall}, {width, 0, 0}, {0, 0, depth}, w.finishes.ceiling, {2, 2});
  side("floor", {kLeft, kFloorHeight, kBackWall}, {width, 0, 0}, {0, 0, -depth}, w.finishes.floor, {2.4, 2});
  side("doorway", {60, kFloorHeight, kBackWall - 1}, {-95, 0, 0}, {0, 205, 0}, w.finishes.doorway, {1, 1});
}

/// Frames of doors and pictures, and a chair on the other side of the table.
void addFurniture(const Table& w) {
  const auto box = [&](glm::dvec3 low, glm::dvec3 high, const Finish& finish) { w.add("furniture", makeRoundedBox(low, high, 1), finish); };
  for (const double x : {60.0, -45.0}) box({x, kFloorHeight, kBackWall - 6}, {x + 10, 135, kBackWall - 1}, w.finishes.paint);
  box({-45, 130, kBackWall - 6}, {70, 140, kBackWall - 1}, w.finishes.paint);
  box({-190, -75, kBackWall - 50}, {-80, 20, kBackWall - 2}, w.finishes.board);
  box({-30, -32, 100}, {26, -28, 150}, w.finishes.cane);
  for (const double x : {-28.0, 22.0}) w.add("chair post", makeWire({{x, -75, 148}, {x, 48, 154}}, 1.8, 32), w.finishes.cane);
  for (const double y : {0.0, 14.0, 28.0, 42.0}) w.add("chair slat", makeWire(smoothPath({{-28, y, 151}, {-3, y + 2, 155}, {22, y, 151}}, 12), 1.5, 32), w.finishes.cane);
}

}  // namespace

void addRestOfRoom(const Table& table) {
  addShell(table);
  addFurniture(table);
}

}  // namespace generator
