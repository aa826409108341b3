// Outlines of clockwork: toothed wheels, the windows between their spokes, escape wheels.
#pragma once

#include "shapes/outline.h"

namespace generator {

/// A toothed wheel about the origin. A tooth is half a pitch wide on the pitch circle; its flanks are radial
/// below that circle and curve to a blunt point above, as watchmakers cut them.
struct GearSpec {
  int teeth = 60;
  double pitchRadius = 10;

  /// Diameter of the pitch circle for each tooth; two wheels that mesh have the same, and their pitch radii
  /// sum to the distance of their axes.
  double module() const { return 2 * pitchRadius / teeth; }
  double tipRadius() const { return pitchRadius + 1.1 * module(); }
  double rootRadius() const { return pitchRadius - 1.4 * module(); }
  /// Of a plate: what the rounding of the teeth leaves room for.
  double bevel() const { return 0.12 * module(); }
};

Outline gearOutline(const GearSpec& spec);

/// An escape wheel: teeth that lean forward (clockwise) with a flat foot at their tip.
Outline escapeOutline(int teeth, double tipRadius);

/// The holes between `spokes` spokes of the width `spokeWidth` from a hub to a rim, clockwise.
std::vector<Outline> spokeHoles(int spokes, double hubRadius, double rimRadius, double spokeWidth,
                                double cornerRadius);

}  // namespace generator
