// Houses across the street and behind, their windows placed one by one, and the last light of the day.
#include <array>
#include <cmath>

#include "diner/street.h"
#include "hash.h"
#include "textures/bake.h"
#include "textures/noise.h"

namespace generator {
namespace {

enum HouseSeries : std::uint32_t { kCloudBank = 33000, kIsLit = 33010, kBlind = 33020 };

/// From orange where the sun went down to a blue that is nearly night, behind rags of cloud.
std::vector<std::uint8_t> duskPicture() {
  return paintPicture(1024, 512, [](glm::dvec2 uv) {
    const double up = 1 - uv.y, cloud = smoothStep(0.46, 0.72, fractalNoise(uv, {4, 11}, kCloudBank, 6));
    glm::dvec3 color =
        glm::mix(glm::dvec3(0.62, 0.28, 0.14), glm::dvec3(0.34, 0.20, 0.30), smoothStep(0.10, 0.30, up));
    color = glm::mix(color, glm::dvec3(0.075, 0.115, 0.27), smoothStep(0.22, 0.55, up));
    color = glm::mix(color, glm::dvec3(0.03, 0.05, 0.14), smoothStep(0.5, 1.0, up));
    const glm::dvec3 lit =
        glm::mix(glm::dvec3(0.42, 0.19, 0.17), glm::dvec3(0.05, 0.055, 0.11), smoothStep(0.1, 0.5, up));
    return glm::mix(color, lit, 0.75 * cloud);
  });
}

/// A sash window: its frame, its sill, and what can be behind it, about its lower edge's middle.
struct WindowMeshes {
  int frame, sill;
  std::array<int, 4> glow;
};

WindowMeshes makeWindows(const Street& w) {
  Mesh frame;
  for (const double x : {-0.56, 0.48}) addBox(frame, {x, 0, -0.06}, {x + 0.08, 1.7, 0.05});
  for (const double y : {0.0, 0.82, 1.62}) addBox(frame, {-0.5, y, -0.05}, {0.5, y + 0.07, 0.04});
  addBox(frame, {-0.02, 0.05, -0.05}, {0.02, 1.65, 0.02});
  const auto pane = [&](const char* name, glm::dvec3 radiance) {
    MaterialSpec spec = varnished(name, glm::dvec3(0.01), 0.05);
    spec.emission = radiance;
    Mesh quad;
    addQuad(quad, {-0.5, 0.02, -0.03}, {1.0, 0, 0}, {0, 1.64, 0});
    return w.addMesh(name, std::move(quad), plainFinish(w.scene, spec));
  };
  return {w.addMesh("window frame", std::move(frame), w.finishes.stone),
          w.addMesh("window sill", makeRoundedBox({-0.68, -0.12, -0.05}, {0.68, 0, 0.14}, 0.02),
                    w.finishes.stone),
          {pane("dark window", {0.012, 0.016, 0.03}), pane("lit window", {1.3, 0.82, 0.34}),
           pane("lamp behind a blind", {0.60, 0.34, 0.12}), pane("television", {0.20, 0.34, 0.50})}};
}

/// A house with its front at z = 0 from x = 0 to the right.
void addHouse(const Street& w, const WindowMeshes& meshes, double width, int floors, std::uint32_t id) {
  constexpr double kStorey = 3.1, kBay = 2.0, kDeep = 9;
  const double height = kStorey * floors + 1.4;
  Mesh walls;
  addQuad(walls, {0, 0, 0}, {width, 0, 0}, {0, height, 0}, {width / 3, height / 3});
  addQuad(walls, {width, 0, 0}, {0, 0, -kDeep}, {0, height, 0}, {kDeep / 3, height / 3});
  addQuad(walls, {0, 0, -kDeep}, {0, 0, kDeep}, {0, height, 0}, {kDeep / 3, height / 3});
  w.add("house", std::move(walls), id % 3 == 1 ? w.finishes.stone : w.finishes.brick);
  w.add("cornice", makeRoundedBox({-0.2, height - 0.35, -kDeep}, {width + 0.2, height + 0.1, 0.35}, 0.06),
        w.finishes.stone);
  w.add("string course",
        makeRoundedBox({-0.05, kStorey + 0.2, -kDeep}, {width + 0.05, kStorey + 0.42, 0.12}, 0.03),
        w.finishes.stone);
  const auto window = [&](glm::dvec3 at, double turnY, std::uint32_t seed) {
    const double chance = unitValue(kIsLit, seed);
    const Placement place{.position = at, .turnY = turnY};
    w.placeMesh(meshes.frame, place);
    w.placeMesh(meshes.sill, place);
    w.placeMesh(meshes.glow[chance < 0.30 ? 1 : chance < 0.46 ? 2 : chance < 0.51 ? 3 : 0], place);
  };
  const int bays = static_cast<int>((width - 0.8) / kBay), deepBays = static_cast<int>((kDeep - 0.8) / kBay);
  for (int floor = 0; floor < floors; ++floor) {
    const double y = kStorey * floor + 0.95;
    const std::uint32_t seed = id * 4096 + static_cast<std::uint32_t>(floor) * 64;
    for (int bay = 0; bay < bays; ++bay)
      window({0.5 * (width - kBay * (bays - 1)) + kBay * bay, y, 0.07}, 0,
             seed + static_cast<std::uint32_t>(bay));
    for (int bay = 0; bay < deepBays; ++bay) {
      const double z = -0.5 * (kDeep - kBay * (deepBays - 1)) - kBay * bay;
      window({width + 0.07, y, z}, 90, seed + 32 + static_cast<std::uint32_t>(bay));
      window({-0.07, y, z}, -90, seed + 48 + static_cast<std::uint32_t>(bay));
    }
  }
}

}  // namespace

void addHouses(const Street& street) {
  MaterialSpec dusk = lamp("dusk", glm::dvec3(1.0));
  dusk.emissionTexture.image = street.scene.addImage("dusk", duskPicture(), false);
  const Finish sky{street.scene.addMaterial(dusk), true};
  Mesh behind;
  addQuad(behind, {-260, -12, -190}, {520, 0, 0}, {0, 170, 0});
  street.add("sky", std::move(behind), sky);
  Mesh ground;
  addQuad(ground, {-260, -0.02, -21}, {520, 0, 0}, {0, 0, -170}, {173, 57});
  addQuad(ground, {-260, -0.02, 60}, {244, 0, 0}, {0, 0, -81});
  addQuad(ground, {16, -0.02, 60}, {244, 0, 0}, {0, 0, -81});
  street.add("ground", std::move(ground), street.finishes.stone);
  const WindowMeshes meshes = makeWindows(street);
  struct House {
    double x, z, width;
    int floors;
    double turnY;
  };
  constexpr House kHouses[] = {{-24, -13, 12, 3, 26},
                               {-25, -36, 12, 4, 6},
                               {-12, -40, 11, 3, 0},
                               {0.5, -42, 12, 4, -3},
                               {14, -41, 10, 3, -6},
                               {19, -17, 11, 3, -24},
                               {-44, -60, 14, 6, 0},
                               {-27, -72, 15, 5, 0},
                               {-9, -78, 13, 6, 0},
                               {8, -74, 16, 5, 0},
                               {27, -70, 14, 7, 0},
                               {46, -60, 16, 6, 0},
                               // behind the camera, for what mirrors
                               {24, 22, 12, 4, 180},
                               {11, 23, 12, 5, 180},
                               {-2, 22, 11, 3, 180},
                               {-14, 23, 12, 4, 180}};
  // Shop windows over there, for the chrome to mirror.
  const Finish shop = plainFinish(street.scene, lamp("shop window", {1.25, 1.0, 0.66})),
               neon = plainFinish(street.scene, lamp("shop sign", {0.4, 1.6, 2.0}));
  for (int i = 0; i < 9; ++i) {
    const double x = -21 + 5.2 * i;
    street.add("shop window", makeRoundedBox({x, 0.5, 21.6}, {x + 3.6, 2.9, 21.8}, 0.05), shop);
    if (i % 2 == 0)
      street.add("shop sign", makeRoundedBox({x + 0.4, 3.2, 21.5}, {x + 3.2, 3.6, 21.7}, 0.05), neon);
  }
  std::uint32_t id = 0;
  for (const House& house : kHouses)
    addHouse(street.at({.position = {house.x, 0, house.z}, .turnY = house.turnY}), meshes, house.width,
             house.floors, ++id);
}

}  // namespace generator
