// The rest of the room, which only mirrors show: walls that glow as the day would make them, a doorway, a
// chair.
#include "breakfast/table.h"
#include "hash.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

enum RoomSeries : std::uint32_t { kBookThick = 26000, kBookTall = 26010 };
constexpr double kLeft = -230, kRight = 250, kBackWall = 340, kFloorHeight = -75, kCeiling = 200;

void addShell(const Table& w) {
  const auto side = [&](const char* name, glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, const Finish& finish,
                        glm::dvec2 repeat) {
    Mesh mesh;
    addQuad(mesh, corner, u, v, repeat);
    w.add(name, std::move(mesh), finish);
  };
  const double depth = kBackWall - kWindowWall, height = kCeiling - kFloorHeight, width = kRight - kLeft;
  side("left wall", {kLeft, kFloorHeight, kBackWall}, {0, 0, -depth}, {0, height, 0}, w.finishes.wall,
       {2.7, 1.8});
  side("right wall", {kRight, kFloorHeight, kWindowWall}, {0, 0, depth}, {0, height, 0}, w.finishes.wall,
       {2.7, 1.8});
  side("back wall", {kRight, kFloorHeight, kBackWall}, {-width, 0, 0}, {0, height, 0}, w.finishes.wall,
       {3.2, 1.8});
  side("ceiling", {kLeft, kCeiling, kWindowWall}, {width, 0, 0}, {0, 0, depth}, w.finishes.ceiling, {2, 2});
  side("floor", {kLeft, kFloorHeight, kBackWall}, {width, 0, 0}, {0, 0, -depth}, w.finishes.floor, {2.4, 2});
  side("doorway", {60, kFloorHeight, kBackWall - 1}, {-95, 0, 0}, {0, 205, 0}, w.finishes.doorway, {1, 1});
}

/// Shelves full of books, for the looking glass to show.
void addBooks(const Table& w) {
  constexpr double kShelfLeft = 118, kShelfRight = 246, kDepth = 26;
  constexpr glm::dvec3 kCloths[] = {{0.30, 0.06, 0.05}, {0.06, 0.12, 0.20}, {0.10, 0.16, 0.09},
                                    {0.50, 0.40, 0.26}, {0.16, 0.10, 0.07}, {0.55, 0.52, 0.46}};
  std::vector<Finish> bindings;
  for (const glm::dvec3& color : kCloths) {
    MaterialSpec spec = varnished("binding", color, 0.5);
    spec.emission = 0.10 * color;
    bindings.push_back(plainFinish(w.scene, spec));
  }
  std::uint32_t id = 0;
  for (int shelf = 0; shelf < 7; ++shelf) {
    const double y = -70 + 32.0 * shelf;
    w.add("shelf",
          makeRoundedBox({kShelfLeft, y - 2, kBackWall - kDepth}, {kShelfRight, y, kBackWall - 1}, 0.4),
          w.finishes.board);
    for (double x = kShelfLeft + 1; x < kShelfRight - 8; ++id) {
      const double thick = 2.2 + 3.4 * unitValue(kBookThick, id), tall = 19 + 8 * unitValue(kBookTall, id);
      if (unitValue(kBookTall + 1, id) < 0.06) {
        x += 9;  // a gap
        continue;
      }
      w.add("book", makeRoundedBox({x, y, kBackWall - kDepth + 3}, {x + thick, y + tall, kBackWall - 4}, 0.5),
            bindings[mix(id) % bindings.size()]);
      x += thick + 0.2;
    }
  }
}

/// Frames of doors and pictures, and a chair on the other side of the table.
void addFurniture(const Table& w) {
  const auto box = [&](glm::dvec3 low, glm::dvec3 high, const Finish& finish) {
    w.add("furniture", makeRoundedBox(low, high, 1), finish);
  };
  for (const double x : {60.0, -45.0})
    box({x, kFloorHeight, kBackWall - 6}, {x + 10, 135, kBackWall - 1}, w.finishes.paint);
  box({-45, 130, kBackWall - 6}, {70, 140, kBackWall - 1}, w.finishes.paint);
  box({-190, -75, kBackWall - 50}, {-80, 20, kBackWall - 2}, w.finishes.board);
  box({-30, -32, 100}, {26, -28, 150}, w.finishes.cane);
  for (const double x : {-28.0, 22.0})
    w.add("chair post", makeWire({{x, -75, 148}, {x, 48, 154}}, 1.8, 32), w.finishes.cane);
  for (const double y : {0.0, 14.0, 28.0, 42.0})
    w.add("chair slat", makeWire(smoothPath({{-28, y, 151}, {-3, y + 2, 155}, {22, y, 151}}, 12), 1.5, 32),
          w.finishes.cane);
}

}  // namespace

void addRestOfRoom(const Table& table) {
  addShell(table);
  addBooks(table);
  addFurniture(table);
}

}  // namespace generator
