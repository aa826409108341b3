// What the parts of the diner after the rain share: finishes and a place. Everything in this folder is in
// metres: X to the right, Y up from the street, Z towards the camera.
#pragma once

#include <array>

#include "stage.h"

namespace generator {

struct StreetFinishes {
  // metal and lacquer; what the rain has wetted mirrors as well
  Finish chrome, steel, redEnamel, creamEnamel, blackEnamel, iron, rubber, oilcloth;
  // glass and water
  Finish pane, glass, drop, ketchup;
  std::array<Finish, 4> bottles;
  // the street and the houses
  Finish asphalt, kerb, brick, stone, counter, wallTiles, wood, cloth;
  // what glows
  Finish redNeon, pinkNeon, blueNeon, bulb, ceiling, menu;
};

StreetFinishes addStreetFinishes(GltfBuilder& scene);

using Street = FurnishedStage<StreetFinishes>;

/// Where the diner stands: its own X runs along its front, its own Z out of the door.
constexpr Placement kDiner{.position = {1.6, 0.14, -3.2}, .turnY = -16};
constexpr double kDinerHalf = 7, kDinerDepth = 4;            // of its plan
constexpr double kSill = 0.95, kLintel = 2.2, kRoof = 2.95;  // heights above its floor

/// Text that stands upright and is read from +Z, its middle at the origin.
Mesh standingText(std::string_view text, double height, double stroke);

/// A strip around the diner's plan, `out` metres outside it, between two heights; `repeat` is in metres.
Mesh bandAround(double out, double low, double high, double repeat);
/// A tube around the plan.
Mesh tubeAround(double out, double height, double radius);

// The parts, each where it lies in the composition.
void addDiner(const Street& diner);  ///< walls, windows, roof; in the diner's own place, as the next two
void addInside(const Street& diner);
void addSigns(const Street& diner);
void addPavement(const Street& street);
void addLampPosts(const Street& street);
void addBicycle(const Street& street);
void addCafeTable(const Street& street);
void addUmbrella(const Street& street);
void addHouses(const Street& street);  ///< and the sky

}  // namespace generator
