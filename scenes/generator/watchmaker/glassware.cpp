// A bell jar over a second movement, and flasks of oil.
#include "shapes/lathe.h"
#include "watchmaker/workshop.h"

namespace generator {
namespace {

/// A vessel of glass: one closed wall.
Mesh blown(const std::vector<Corner>& profile) { return makeLathe(roundCorners(profile, false, 0.08), 192); }

void addBellJar(const Workshop& w, const Assembly& movement) {
  const Finishes& f = w.finishes;
  w.add("jar foot",
        makeLathe(roundCorners({{0, 0, 0}, {44, 0, 1.5}, {44, 5, 2}, {40, 9, 3}, {40, 12, 1}, {0, 12, 0}},
                               false, 0.1),
                  160),
        f.darkWood);
  // Up on the outside, down on the inside.
  w.add("bell jar",
        blown({{34.6, 12.05, 0.5}, {36.6, 12.05, 0.5}, {36.6, 72, 34}, {30, 104, 20}, {0, 112, 0}}),
        f.crystal);
  w.add("bell jar inside", insideOut(blown({{34.6, 12.05, 0}, {34.6, 72, 33}, {28.5, 102, 19}, {0, 110, 0}})),
        f.crystal);
  w.add("jar knob", makeSphere(4.5, 64, 32), f.crystal, {.position = {0, 115.5, 0}});
  w.add("pedestal",
        makeLathe(
            roundCorners({{0, 0, 0}, {18, 0, 1}, {18, 4, 2}, {6, 8, 6}, {5, 22, 4}, {9, 26, 2}, {0, 26, 0}},
                         false, 0.1),
            96),
        f.polishedBrass, {.position = {0, 12, 0}});
  w.at({.position = {0, 66, 0}, .scale = 0.86, .turn = turnAbout({0, 1, 0}, 7) * turnAbout({1, 0, 0}, 73)})
      .placeAll(movement);
}

/// A flask with oil to `level`, 0 to 1.
void addFlask(const Workshop& w, double level) {
  const double top = 3 + 24 * level;
  w.add("flask",
        blown({{0, 0, 0},
               {13, 0, 3},
               {14, 26, 6},
               {5, 36, 5},
               {5, 42, 1},
               {6.4, 44, 0.6},
               {5.6, 45, 0.4},
               {3.8, 44, 0.6},
               {3.8, 36, 4},
               {12.4, 25, 5},
               {11.6, 2, 2},
               {0, 2, 0}}),
        w.finishes.crystal);
  w.add("oil", blown({{0, 2.3, 0}, {11.0, 2.3, 1.8}, {11.3, top, 0.2}, {0, top, 0}}), w.finishes.oil);
  w.add("stopper",
        makeLathe(
            roundCorners(
                {{0, 40, 0}, {3.5, 40, 0.3}, {3.7, 45.2, 0.2}, {6.2, 45.6, 0.5}, {6.0, 49, 1.5}, {0, 51, 0}},
                false, 0.1),
            96),
        w.finishes.darkWood);
}

}  // namespace

void addGlassware(const Workshop& workshop, const Assembly& movement) {
  addBellJar(workshop.at({.position = {150, 0, -86}}), movement);
  addFlask(workshop.at({.position = {140, 0, -22}}), 0.75);
  addFlask(workshop.at({.position = {114, 0, 4}}), 0.45);
}

}  // namespace generator
