// The bench lamp: a heavy foot, a bent arm, an enamelled shade over a bulb.
#include "shapes/lathe.h"
#include "shapes/sweep.h"
#include "watchmaker/workshop.h"

namespace generator {

void addLamp(const Workshop& workshop) {
  const Workshop lamp = workshop.at({.position = {-174, 0, -112}});
  const auto turnedPart = [](const std::vector<Corner>& profile, int segments) {
    return makeLathe(roundCorners(profile, false, 0.1), segments);
  };
  const Finishes& f = workshop.finishes;
  lamp.add(
      "lamp foot",
      turnedPart({{0, 0, 0}, {34, 0, 1}, {34, 4, 2}, {27, 9, 6}, {9, 13, 6}, {5, 20, 3}, {0, 20, 0}}, 128),
      f.polishedBrass);
  lamp.add("lamp arm",
           makeWire(smoothPath({{0, 15, 0},
                                {0, 60, 0},
                                {-2, 110, 2},
                                {2, 150, 6},
                                {14, 172, 12},
                                {28, 170, 17},
                                {33, 156, 19}},
                               24),
                    2.6, 32),
           f.polishedBrass);
  const Workshop head = lamp.at({.position = {54, 112, 38}, .turn = upTo({-0.45, 1, -0.4})});
  const std::vector<Corner> outside{{44.5, 0.2, 0.3}, {45.6, 0, 0.3}, {45.0, 1.4, 0.6}, {36, 20, 30},
                                    {17, 40, 16},     {10, 44, 4},    {10, 46, 0},      {9.2, 46, 0},
                                    {9.2, 43, 4},     {16.4, 39, 16}, {35.2, 19.4, 30}, {44.2, 1.0, 0.3}};
  head.add("shade", makeLathe(roundCorners(outside, true, 0.08), 192), f.enamel);
  const std::vector<Corner> lining{{9.1, 42.9, 0}, {16.2, 38.7, 16}, {34.9, 19.2, 30}, {43.8, 1.2, 0}};
  head.add("lining", makeLathe(roundCorners(lining, false, 0.08), 128), f.shadeInside);
  head.add("cap", turnedPart({{0, 42, 0}, {10.6, 42, 0.4}, {10.6, 52, 2}, {4, 58, 3}, {0, 58, 0}}, 96),
           f.polishedBrass);
  head.add("bulb", turnedPart({{0, 8, 0}, {9, 9, 8}, {10, 22, 8}, {5, 36, 6}, {5, 43, 0}, {0, 43, 0}}, 64),
           f.bulb);
}

}  // namespace generator
