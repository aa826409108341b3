// Every material of the breakfast table, and the textures that only it has.
#include "breakfast/table.h"
#include "hash.h"
#include "textures/noise.h"
#include "textures/surfaces.h"

namespace generator {
namespace {

/// Numbers that differ between the textures of this file.
enum BreakfastTextureSeries : std::uint32_t {
  kCrumbHole = 20000,
  kCrumbShade = 20010,
  kPeel = 20020,
  kLeafVein = 20030,
  kSlub = 20040
};

/// The cut face of a loaf: holes of all sizes in a cream-coloured sponge.
SurfaceFunction crumbSurface() {
  return [](glm::dvec2 uv) {
    const CellHit large = cellNoise(uv, {17, 17}, kCrumbHole),
                  small = cellNoise(uv, {44, 44}, kCrumbHole + 1);
    const double size = 0.16 + 0.22 * noise(uv, {8, 8}, kCrumbHole + 2);
    const double wanted = unitValue(kCrumbHole + 3, large.id) < 0.45 ? size : 0.35 * size;
    const double hole = std::max(smoothStep(wanted + 0.10, wanted - 0.10, large.nearest),
                                 0.55 * smoothStep(0.30, 0.10, small.nearest));
    const double shade = fractalNoise(uv, {5, 5}, kCrumbShade, 4);
    const glm::dvec3 color = glm::mix(glm::dvec3(0.87, 0.76, 0.57), glm::dvec3(0.58, 0.42, 0.24), 0.8 * hole);
    return SurfacePoint{color * (0.85 + 0.25 * shade), -0.8e-3 * hole + 2e-4 * shade, 0.9};
  };
}

/// Peel of an orange: pores between oil glands.
SurfaceFunction peelSurface() {
  return [](glm::dvec2 uv) {
    const CellHit gland = cellNoise(uv, {110, 60}, kPeel);
    const double pore = smoothStep(0.32, 0.1, gland.nearest), patch = fractalNoise(uv, {4, 3}, kPeel + 1, 4);
    const glm::dvec3 color = glm::mix(glm::dvec3(0.82, 0.27, 0.015), glm::dvec3(0.86, 0.38, 0.03), patch);
    return SurfacePoint{color * (1 - 0.25 * pore), -2.2e-4 * pore, 0.32};
  };
}

/// A leaf along v with its midrib at u = 1/2.
SurfaceFunction leafSurface() {
  return [](glm::dvec2 uv) {
    const double off = std::abs(uv.x - 0.5), rib = smoothStep(0.03, 0.008, off);
    const double along = 9 * (uv.y + 1.1 * off), side = std::abs(along - std::floor(along) - 0.5);
    const double vein = std::max(rib, 0.7 * smoothStep(0.06, 0.0, side));
    const double patch = fractalNoise(uv, {5, 5}, kLeafVein, 4);
    const glm::dvec3 color = glm::mix(glm::dvec3(0.05, 0.14, 0.03), glm::dvec3(0.11, 0.21, 0.05), patch);
    return SurfacePoint{glm::mix(color, glm::dvec3(0.20, 0.30, 0.08), 0.6 * vein), -3e-4 * vein, 0.4};
  };
}

/// Fine linen from where one cannot tell its threads: some of them are thicker for a while.
SurfaceFunction linenSurface(glm::dvec3 color) {
  return [color](glm::dvec2 uv) {
    const double slub =
                     0.5 * (fractalNoise(uv, {9, 260}, kSlub, 2) + fractalNoise(uv, {260, 9}, kSlub + 4, 2)),
                 broad = fractalNoise(uv, {3, 3}, kSlub + 8, 3);
    return SurfacePoint{color * (0.90 + 0.12 * slub + 0.05 * broad), 3.5e-5 * slub, 0.9};
  };
}

void addTableware(GltfBuilder& scene, TableFinishes& f) {
  const auto plain = [&](const MaterialSpec& spec) { return plainFinish(scene, spec); };
  f.silver = plain(metal("silver", {0.94, 0.92, 0.88}, 0.04));
  f.gold = plain(metal("gold rim", {0.98, 0.76, 0.40}, 0.08));
  f.china = plain(varnished("china", {0.80, 0.79, 0.76}, 0.06));
  f.blueChina = plain(varnished("blue china", {0.035, 0.085, 0.24}, 0.06));
  f.glass = plain(tinted("glass", 1.5, {0.95, 0.985, 0.975}, 0.06));
  // Where a liquid meets its glass: the ratio of both, the front away from the denser one.
  f.waterWall = plain(glass("glass at water", 1.5 / 1.333));
  f.waterTop = plain(glass("water", 1.333));
  MaterialSpec honey = tinted("honey at glass", 1.503 / 1.5, {0.97, 0.63, 0.12}, 0.034);
  honey.baseColor = {1, 0.86, 0.55, 1};  // what shadow rays see of it
  f.honeyWall = plain(honey);
  honey.name = "honey";
  honey.ior = 1.503;
  f.honeyTop = plain(honey);
  f.coffee = plain(varnished("coffee", {0.012, 0.005, 0.002}, 0.02));
  f.ebony = plain(varnished("ebony", {0.02, 0.014, 0.011}, 0.12));
}

void addFood(GltfBuilder& scene, TableFinishes& f) {
  const auto plain = [&](const MaterialSpec& spec) { return plainFinish(scene, spec); };
  MaterialSpec crust = varnished("crust", glm::dvec3(1), 0.75);
  crust.specular = 0.5;
  f.crust = plain(crust);
  f.crumb = bakedFinish(scene, matte("crumb", {}), {1024, 1024, 0.12}, crumbSurface());
  f.pastry = plain(varnished("pastry", glm::dvec3(1), 0.36));
  f.egg = plain(varnished("egg", {0.72, 0.46, 0.30}, 0.45));
  f.orange = bakedFinish(scene, varnished("orange", {}, 0.3), {1024, 512, 0.24}, peelSurface());
  f.cherries = {plain(varnished("cherry", {0.28, 0.008, 0.014}, 0.08)),
                plain(varnished("ripe cherry", {0.10, 0.004, 0.010}, 0.08))};
  f.stem = plain(varnished("stem", {0.13, 0.17, 0.035}, 0.5));
  MaterialSpec leaf = varnished("leaf", {}, 0.4);
  leaf.doubleSided = true;
  leaf.emission = {0.35, 0.42, 0.10};  // light that shines through
  leaf = withTextures(scene, leaf, {256, 512, 0.03}, leafSurface());
  leaf.emissionTexture = leaf.baseColorTexture;
  f.leaf = {scene.addMaterial(leaf), true};
  MaterialSpec petal = matte("petal", glm::dvec3(1));
  petal.doubleSided = true;
  petal.emission = {0.10, 0.08, 0.08};
  f.petal = plain(petal);
  f.pollen = plain(matte("pollen", {0.75, 0.50, 0.05}));
}

void addSurroundings(GltfBuilder& scene, TableFinishes& f) {
  const auto plain = [&](const MaterialSpec& spec) { return plainFinish(scene, spec); };
  MaterialSpec linen = matte("linen", {});
  linen.doubleSided = true;
  f.linen = bakedFinish(scene, linen, {1024, 1024, 0.155}, linenSurface({0.82, 0.81, 0.79}));
  linen.name = "towel";
  f.towel = bakedFinish(scene, linen, {1024, 1024, 0.06}, fabricSurface(90, {0.80, 0.78, 0.74}));
  f.board = bakedFinish(scene, varnished("board", {}, 0.45), {2048, 1024, 0.5}, woodSurface(2));
  f.spindle = plain(varnished("spindle", {0.52, 0.32, 0.15}, 0.4));
  f.paint = plain(varnished("white paint", {0.84, 0.83, 0.79}, 0.35));
  f.cane = plain(varnished("cane", {0.45, 0.28, 0.12}, 0.4));
  const auto room = [&](const char* name, double metres, glm::dvec3 glow, const SurfaceFunction& surface) {
    return glowingFinish(scene, name, metres, glow, surface);
  };
  f.wall = room("wall", 1.5, {0.30, 0.29, 0.28}, plasterSurface({0.50, 0.55, 0.50}));
  f.ceiling = room("ceiling", 3, {0.62, 0.60, 0.56}, plasterSurface({0.75, 0.74, 0.70}));
  f.floor = room("floor", 2, {0.8, 0.7, 0.6}, woodSurface(8));
  f.mirrorGlass = plain(mirror("mirror", glm::dvec3(0.90)));
  MaterialSpec pane = glass("pane", 1.5);
  pane.thickness = 0;  // a sheet
  f.pane = plain(pane);
  f.doorway = plain(lamp("doorway", {0.55, 0.50, 0.42}));
}

}  // namespace

TableFinishes addTableFinishes(GltfBuilder& scene) {
  TableFinishes finishes;
  addTableware(scene, finishes);
  addFood(scene, finishes);
  addSurroundings(scene, finishes);
  return finishes;
}

}  // namespace generator
