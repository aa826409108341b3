// Neon: letters on the roof and in the windows, tubes around the eaves, an arrow.
#include "diner/street.h"
#include "shapes/lettering.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

/// Letters of tubes in a window.
void addNeonText(const Street& w, std::string_view text, double height, const Finish& neon, glm::dvec3 at) {
  w.add("neon", standingText(text, height, 0.085 * height), neon, {.position = at});
}

/// Struts that hold the sign on the roof.
void addScaffold(const Street& w, double left, double right, double low, double high) {
  for (double x = left; x <= right; x += (right - left) / 6) {
    w.add("strut", makeWire({{x, low, -0.35}, {x, high, -0.28}}, 0.022, 12), w.finishes.iron);
    w.add("brace", makeWire({{x, low, -1.1}, {x, high - 0.3, -0.3}}, 0.018, 12), w.finishes.iron);
  }
  for (const double y : {low + 0.25, high - 0.05})
    w.add("rail", makeWire({{left, y, -0.31}, {right, y, -0.31}}, 0.025, 12), w.finishes.iron);
}

}  // namespace

Mesh standingText(std::string_view text, double height, double stroke) {
  return moved(makeText(text, height, stroke), glm::dmat4(glm::mat4_cast(turnAbout({1, 0, 0}, 90))));
}

void addSigns(const Street& diner) {
  const StreetFinishes& f = diner.finishes;
  const Street roof = diner.at({.position = {0, kRoof + 0.18, 0}});
  addScaffold(roof, -2.9, 2.9, 0.0, 1.75);
  // Tubes before letters of sheet metal, which mirror them.
  const glm::dvec3 at(0, 1.28, -0.08);
  roof.add("letters", standingText("DINER", 1.15, 0.25), f.redEnamel,
           {.position = at - glm::dvec3(0, 0, 0.18)});
  addNeonText(roof, "DINER", 1.15, f.redNeon, at);
  // Under the letters, a line that is broken in the middle, and dots.
  for (const double side : {-1.0, 1.0})
    roof.add("underline", makeWire({{side * 0.25, 0.42, -0.1}, {side * 2.9, 0.42, -0.1}}, 0.035, 16),
             f.blueNeon);
  addNeonText(diner, "OPEN", 0.36, f.blueNeon, {-3.05, 1.62, -0.16});
  addNeonText(diner, "COFFEE", 0.25, f.redNeon, {3.05, 1.70, -0.16});
  addNeonText(diner, "PIE", 0.30, f.redNeon, {1.52, 1.66, -0.16});
  diner.add("eaves tube", tubeAround(0.05, 2.48, 0.022), f.pinkNeon);
  diner.add("eaves tube", tubeAround(0.05, 2.72, 0.022), f.blueNeon);
}

}  // namespace generator
