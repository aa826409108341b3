// The room around the bench, its window, and the city outside. In millimetres like all the rest: a street is
// 10⁵ of them away.
#include <array>
#include <cmath>

#include "hash.h"
#include "shapes/lathe.h"
#include "textures/bake.h"
#include "textures/noise.h"
#include "watchmaker/workshop.h"

namespace generator {
namespace {

constexpr double kWindowZ = -330, kSill = 2;
constexpr glm::dvec2 kWindowLow(-460, 4), kWindowHigh(520, 900);  // x and y
constexpr double kStreet = -14000;                                // the room is on the fourth floor

/// Numbers that differ between the things of the city.
enum CitySeries : std::uint32_t {
  kSkyCloud = 8000,
  kLit = 8100,
  kWindowHeight,
  kHouseWidth = 8200,
  kHouseAt,
  kHouseFloors
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

/// Dusk: from a warm band at the horizon (below) to deep blue.
std::vector<std::uint8_t> skyPicture() {
  return paintPicture(256, 256, [](glm::dvec2 uv) {
    const double up = 1 - uv.y, cloud = fractalNoise({uv.x, 3 * uv.y}, {5, 9}, kSkyCloud, 5);
    glm::dvec3 color =
        glm::mix(glm::dvec3(0.78, 0.40, 0.20), glm::dvec3(0.36, 0.27, 0.42), smoothStep(0.24, 0.46, up));
    color = glm::mix(color, glm::dvec3(0.07, 0.13, 0.36), smoothStep(0.38, 0.78, up));
    return color * (0.85 + 0.3 * cloud);
  });
}

/// A house of `floors` floors of lit and dark windows.
void addHouse(Mesh& facades, std::array<Mesh, 3>& windows, glm::dvec3 foot, double width, double depth,
              int floors, std::uint32_t id) {
  constexpr double kFloor = 3200, kBay = 2600;
  const double height = kFloor * floors;
  addQuad(facades, foot, {width, 0, 0}, {0, height, 0});                             // to the bench
  addQuad(facades, foot + glm::dvec3(0, 0, -depth), {0, 0, depth}, {0, height, 0});  // to the left
  addQuad(facades, foot + glm::dvec3(width, 0, 0), {0, 0, -depth}, {0, height, 0});  // to the right
  addQuad(facades, foot + glm::dvec3(0, height, 0), {width, 0, 0}, {0, 0, -depth});  // roof
  const int bays = static_cast<int>(width / kBay);
  const double margin = 0.5 * (width - bays * kBay);
  for (int floor = 0; floor < floors; ++floor) {
    for (int bay = 0; bay < bays; ++bay) {
      const std::uint32_t seed = id * 4096 + static_cast<std::uint32_t>(floor * 64 + bay);
      const double chance = unitValue(kLit, seed);
      if (chance > 0.58) continue;
      const std::size_t kind = chance < 0.24 ? 0 : chance < 0.32 ? 1 : 2;
      const glm::dvec3 corner = foot + glm::dvec3(margin + kBay * bay + 700, kFloor * floor + 900, 40);
      addQuad(windows[kind], corner, {1000, 0, 0}, {0, 1200 + 500 * unitValue(kWindowHeight, id), 0});
    }
  }
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
  GltfBuilder& scene = workshop.scene;
  MaterialSpec sky = lamp("evening sky", glm::dvec3(1));
  sky.emissionTexture.image = scene.addImage("evening sky", skyPicture(), false);
  workshop.add("sky", makeQuad({-900e3, -30e3, -800e3}, {1800e3, 0, 0}, {0, 110e3, 0}),
               {scene.addMaterial(sky), true});
  std::array<Mesh, 3> facades, windows;
  constexpr std::uint32_t kHouses = 260;
  for (std::uint32_t i = 0; i < kHouses; ++i) {
    const double t = (i + 0.5) / kHouses, far = 150e3 + 520e3 * t * t;
    const double width = 9e3 + 14e3 * unitValue(kHouseWidth, i),
                 x = (unitValue(kHouseAt, i) - 0.5) * 1.3 * (far + 30e3);
    const bool isTower = i % 13 == 0 && far > 220e3;
    const int floors = 3 + static_cast<int>(4 * unitValue(kHouseFloors, i)) + (isTower ? 6 : 0);
    addHouse(facades[i % 3], windows, {x, kStreet, -far}, width, 12e3, floors, i);
  }
  // What dusk gives to walls, from near to hazy.
  const glm::dvec3 dusk[] = {{0.020, 0.024, 0.042}, {0.030, 0.033, 0.052}, {0.042, 0.042, 0.062}};
  const glm::dvec3 glow[] = {{1.7, 0.95, 0.38}, {0.75, 0.95, 1.25}, {0.55, 0.27, 0.1}};
  const auto addGlowing = [&](const char* name, Mesh& mesh, glm::dvec3 radiance) {
    workshop.add(name, std::move(mesh), {scene.addMaterial(lamp(name, radiance)), false});
  };
  for (std::size_t k = 0; k < 3; ++k) {
    addGlowing("houses", facades[k], dusk[k]);
    addGlowing("lit windows", windows[k], glow[k]);
  }
  Mesh street = makeQuad({-900e3, kStreet, -20e3}, {1800e3, 0, 0}, {0, 0, -780e3});
  addGlowing("street", street, {0.016, 0.018, 0.026});
  const int streetLamp = workshop.addMesh("street lamp", makeSphere(420, 24, 12),
                                          {scene.addMaterial(lamp("street lamp", {3.2, 2.0, 0.8})), false});
  for (std::uint32_t i = 0; i < 80; ++i) {
    const std::uint32_t pair = i / 2;
    const double far = 140e3 + 9e3 * pair;
    const double side = (i % 2 == 0 ? -1 : 1) * (8e3 + 0.05 * far) + 6e3;
    workshop.placeMesh(streetLamp, {.position = {side, kStreet + 8000, -far}});
  }
}

}  // namespace generator
