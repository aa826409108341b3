// The room around the bench, its window, and the city outside, which a lens that is focused on the watch sees
// as discs of light.
#include <algorithm>
#include <cmath>
#include <vector>

#include "hash.h"
#include "shapes/lathe.h"
#include "textures/bake.h"
#include "textures/lens_discs.h"
#include "textures/noise.h"
#include "watchmaker/workshop.h"

namespace generator {
namespace {

constexpr double kWindowZ = -330, kSill = 2;
constexpr glm::dvec2 kWindowLow(-460, 4), kWindowHigh(520, 900);  // x and y

/// Numbers that differ between the things of the city.
enum CitySeries : std::uint32_t {
  kSkyCloud = 8000,
  kLit = 8100,
  kHouseWidth = 8200,
  kHouseHeight = 8210,
  kTraffic = 8220
};

/// Walls far enough away that nothing but mirrors shows them, and the wall with the window behind the bench.
void addShell(const Workshop& w) {
  const Finishes& f = w.finishes;
  constexpr double x = 1900, back = 2600, high = 1750, low = -900;
  w.add("left wall", makeQuad({-x, low, back}, {0, 0, kWindowZ - back}, {0, high - low, 0}, {2, 2}),
        f.plaster);
  w.add("right wall", makeQuad({x, low, kWindowZ}, {0, 0, back - kWindowZ}, {0, high - low, 0}, {2, 2}),
        f.plaster);
  w.add("back wall", makeQuad({x, low, back}, {-2 * x, 0, 0}, {0, high - low, 0}, {2, 2}), f.plaster);
  w.add("ceiling", makeQuad({-x, high, kWindowZ}, {2 * x, 0, 0}, {0, 0, back - kWindowZ}, {2, 2}), f.plaster);
  w.add("floor", makeQuad({-x, low, back}, {2 * x, 0, 0}, {0, 0, kWindowZ - back}, {4, 3}), f.tiles);
  const auto wallPart = [&](glm::dvec2 from, glm::dvec2 to) {
    w.add("window wall", makeQuad({from, kWindowZ}, {to.x - from.x, 0, 0}, {0, to.y - from.y, 0}, {1, 1}),
          f.plaster);
  };
  wallPart({-x, low}, {kWindowLow.x, high});
  wallPart({kWindowHigh.x, low}, {x, high});
  wallPart({kWindowLow.x, low}, {kWindowHigh.x, kWindowLow.y});
  wallPart({kWindowLow.x, kWindowHigh.y}, {kWindowHigh.x, high});
}

void addWindow(const Workshop& w) {
  const Finishes& f = w.finishes;
  const auto bar = [&](glm::dvec3 low, glm::dvec3 high) {
    w.add("window frame", makeRoundedBox(low, high, 3), f.darkWood);
  };
  bar({kWindowLow.x - 20, kSill, kWindowZ - 30}, {kWindowHigh.x + 20, kSill + 22, kWindowZ + 12});
  bar({kWindowLow.x - 20, kWindowHigh.y - 20, kWindowZ - 30},
      {kWindowHigh.x + 20, kWindowHigh.y + 20, kWindowZ + 12});
  for (const double x : {kWindowLow.x - 12, -165.0, 170.0, kWindowHigh.x - 8})
    bar({x, kSill, kWindowZ - 26}, {x + 20, kWindowHigh.y, kWindowZ + 4});
  w.add("pane",
        makeQuad({kWindowLow, kWindowZ - 14}, {kWindowHigh.x - kWindowLow.x, 0, 0},
                 {0, kWindowHigh.y - kWindowLow.y, 0}),
        f.pane);
}

// The picture of the city: twice as wide as it is high. Places are in its heights, y up.
constexpr double kCityHeight = 2200, kCityBase = -1000, kCityZ = -3000;  // millimetres
constexpr double kSkyline = 0.552;  ///< where the houses end and the sky begins
constexpr double kDisc = 0.0115;    ///< radius of what the lens makes of a point

/// A row of houses, one behind the other in three rows: 2 is the farthest.
struct House {
  double left, right, top;
  std::uint32_t row;
};

std::vector<House> houses() {
  std::vector<House> all;
  for (std::uint32_t row = 3; row-- > 0;) {
    double x = -0.1 * unitValue(kHouseWidth, row);
    for (std::uint32_t i = 0; x < 2; ++i) {
      const std::uint32_t id = 100 * row + i;
      const double width = 0.055 + 0.06 * unitValue(kHouseWidth + 1, id),
                   chance = unitValue(kHouseHeight, id);
      const double tower = row == 2 && i % 5 == 2 ? 0.045 : 0.0;
      all.push_back({x, x + width, kSkyline - 0.045 * (2 - row) + 0.045 * (chance - 0.5) + tower, row});
      x += width + 0.004;
    }
  }
  return all;
}

/// Dusk: from a warm band above the roofs to deep blue.
glm::dvec3 duskAt(glm::dvec2 at) {
  const double up = at.y - kSkyline, cloud = fractalNoise({0.5 * at.x, 3 * at.y}, {5, 9}, kSkyCloud, 5);
  glm::dvec3 color =
      glm::mix(glm::dvec3(0.80, 0.38, 0.17), glm::dvec3(0.36, 0.25, 0.40), smoothStep(-0.01, 0.04, up));
  color = glm::mix(color, glm::dvec3(0.06, 0.12, 0.36), smoothStep(0.02, 0.10, up));
  return color * (0.80 + 0.4 * cloud);
}

/// Walls and sky as the lens blurs them: edges as wide as a disc. Walls in the haze of their row.
glm::dvec3 wallsAndSky(glm::dvec2 at, const std::vector<House>& all) {
  constexpr glm::dvec3 kWalls[] = {{0.022, 0.026, 0.046}, {0.036, 0.038, 0.062}, {0.062, 0.056, 0.082}};
  glm::dvec3 color = duskAt(at);
  for (const House& house : all) {
    const double beside = std::max(house.left - at.x, at.x - house.right), above = at.y - house.top;
    if (beside > kDisc || above > kDisc) continue;
    const double covers = smoothStep(kDisc, -kDisc, beside) * smoothStep(kDisc, -kDisc, above);
    color = glm::mix(color, kWalls[house.row], covers);
  }
  return color;
}

/// A lit window of a house. Places are from the top here, as pictures have them.
LensDisc windowLight(glm::dvec2 at, const House& house, std::uint32_t seed) {
  const double kind = unitValue(kLit + 1, seed);
  const glm::dvec3 light = kind < 0.62   ? glm::dvec3(1.0, 0.60, 0.22)
                           : kind < 0.82 ? glm::dvec3(1.0, 0.80, 0.52)
                           : kind < 0.95 ? glm::dvec3(0.55, 0.72, 1.0)
                                         : glm::dvec3(1.0, 0.24, 0.12);
  const double haze = 1 - 0.22 * house.row;
  return {{at.x, 1 - at.y},
          kDisc * (0.9 + 0.2 * unitValue(kLit + 2, seed)),
          light,
          haze * (0.10 + 0.75 * std::pow(unitValue(kLit + 3, seed), 2.5))};
}

std::vector<LensDisc> cityLights(const std::vector<House>& all) {
  constexpr double kFloor = 0.017, kBay = 0.013;
  std::vector<LensDisc> discs;
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const House& house = all[i];
    std::uint32_t seed = 4096 * i;
    for (double y = house.top - kFloor; y > 0.28; y -= kFloor)
      for (double x = house.left + kBay; x < house.right - 0.5 * kBay; x += kBay)
        if (unitValue(kLit, ++seed) < 0.12) discs.push_back(windowLight({x, y}, house, seed));
  }
  for (std::uint32_t i = 0; i < 70; ++i) {  // lamps and cars of the street
    const double x = 2 * unitValue(kTraffic, i), up = 0.36 + 0.035 * unitValue(kTraffic + 1, i);
    const bool isRear = i % 3 == 0;
    discs.push_back({{x, 1 - up},
                     1.15 * kDisc,
                     isRear ? glm::dvec3(1.0, 0.16, 0.08) : glm::dvec3(1.0, 0.74, 0.40),
                     0.35 + 0.5 * unitValue(kTraffic + 2, i)});
  }
  return discs;
}

std::vector<std::uint8_t> cityPicture() {
  const std::vector<House> all = houses();
  const std::vector<LensDisc> discs = cityLights(all);
  return paintPicture(2048, 1024, [&](glm::dvec2 uv) {
    const glm::dvec2 at(2 * uv.x, uv.y);
    return withDiscs(wallsAndSky({at.x, 1 - at.y}, all), at, discs);
  });
}

}  // namespace

void addRoomAround(const Workshop& workshop) {
  addShell(workshop);
  addWindow(workshop);
  // A paper lantern above and behind the camera, for the metals to mirror.
  workshop.add("lantern", makeSphere(260, 96, 48), workshop.finishes.lantern,
               {.position = {-420, 980, 1250}});
  workshop.add("paper blind", makeQuad({-100, 250, 2500}, {-1500, 0, 0}, {0, 1300, 0}),
               workshop.finishes.blind);
}

void addCity(const Workshop& workshop) {
  MaterialSpec city = lamp("evening city", glm::dvec3(1.15));
  city.emissionTexture.image = workshop.scene.addImage("evening city", cityPicture(), false);
  workshop.add("city",
               makeQuad({-kCityHeight, kCityBase, kCityZ}, {2 * kCityHeight, 0, 0}, {0, kCityHeight, 0}),
               {workshop.scene.addMaterial(city), true});
}

}  // namespace generator
