// Every material of the scene. Polished metals stay below the roughness from which the renderer draws no
// mirror image; the others have theirs as it is, for renderers that draw gloss.
#include "textures/surfaces.h"
#include "watchmaker/workshop.h"

namespace generator {
namespace {

constexpr glm::dvec3 kGold(0.98, 0.74, 0.38), kBrass(0.90, 0.68, 0.32), kSteel(0.62, 0.61, 0.60),
    kNickel(0.74, 0.70, 0.63), kBlue(0.09, 0.17, 0.62), kDarkNickel(0.30, 0.29, 0.29);

/// Walls and floor glow as the lamps' light would make them, were light that they throw back followed.
Finish roomFinish(GltfBuilder& scene, const std::string& name, double metres,
                  const SurfaceFunction& surface) {
  return glowingFinish(scene, name, metres, {0.16, 0.12, 0.085}, surface);
}

void addMetals(GltfBuilder& scene, Finishes& f) {
  const auto plain = [&](const MaterialSpec& spec) { return plainFinish(scene, spec); };
  const auto baked = [&](const MaterialSpec& spec, const BakeSize& size, const SurfaceFunction& surface) {
    return bakedFinish(scene, spec, size, surface);
  };
  f.polishedGold = plain(metal("polished gold", kGold, 0.06));
  f.polishedBrass = plain(metal("polished brass", kBrass, 0.08));
  f.polishedSteel = plain(metal("polished steel", {0.80, 0.80, 0.81}, 0.03));
  f.satinSteel = plain(metal("satin steel", kSteel, 0.3));
  f.bluedSteel = plain(metal("blued steel", kBlue, 0.12));
  f.gilt = plain(metal("gilt", kGold, 0.34));
  f.wheelBrass =
      baked(metal("wheel brass", kBrass, 0.34), {512, 512, 0.012}, brushedMetalSurface(kGold, 0.36, 1.6e-6));
  f.pearledNickel = baked(metal("pearled nickel", kNickel, 0.3), {1024, 1024, 0.036},
                          pearledMetalSurface(14, kDarkNickel, 0.34));
  f.stripedNickel =
      baked(metal("striped nickel", kNickel, 0.3), {1024, 1024, 0.024}, stripedMetalSurface(8, kNickel, 0.3));
}

void addGlasses(GltfBuilder& scene, Finishes& f) {
  const auto plain = [&](const MaterialSpec& spec) { return plainFinish(scene, spec); };
  f.crystal = plain(tinted("crystal", 1.52, {0.93, 0.97, 0.95}, 0.05));
  f.ruby = plain(tinted("ruby", 1.76, {0.85, 0.03, 0.10}, 0.0012));
  f.oil = plain(tinted("oil", 1.47, {0.85, 0.45, 0.06}, 0.012));
  MaterialSpec pane = glass("window pane", 1.5);
  pane.thickness = 0;  // a sheet: light goes straight through
  f.pane = plain(pane);
}

void addBenchFinishes(GltfBuilder& scene, Finishes& f) {
  const auto plain = [&](const MaterialSpec& spec) { return plainFinish(scene, spec); };
  const auto baked = [&](const MaterialSpec& spec, const BakeSize& size, const SurfaceFunction& surface) {
    return bakedFinish(scene, spec, size, surface);
  };
  f.walnut = baked(varnished("walnut", {}, 0.4), {3072, 1536, 1.0}, woodSurface(3));
  f.darkWood = baked(varnished("dark wood", {}, 0.4), {1024, 1024, 0.2}, woodSurface(1));
  f.leather =
      baked(varnished("leather", {}, 0.5), {1536, 1536, 0.15}, leatherSurface(84, {0.035, 0.085, 0.055}));
  f.stitch = plain(matte("stitch", {0.62, 0.48, 0.26}));
  f.cloth = baked(matte("polishing cloth", {}), {1024, 1024, 0.05}, fabricSurface(150, {0.50, 0.34, 0.15}));
  f.enamel = plain(varnished("green enamel", {0.01, 0.06, 0.045}, 0.05));
  f.dial = plain(varnished("white enamel", {0.78, 0.76, 0.70}, 0.25));
  f.ink = plain(varnished("black enamel", {0.02, 0.02, 0.022}, 0.25));
  f.marble = baked(varnished("marble", {}, 0.1), {1024, 1024, 0.18}, marbleSurface());
  f.plaster = roomFinish(scene, "plaster", 1.6, plasterSurface({0.50, 0.44, 0.36}));
  f.tiles = roomFinish(scene, "floor tiles", 0.9, tileSurface(6, {0.30, 0.17, 0.09}));
  f.bulb = plain(lamp("bulb", {26, 17, 8}));
  MaterialSpec lining = matte("inside of the shade", {0.55, 0.46, 0.34});
  lining.emission = {0.20, 0.125, 0.05};
  f.shadeInside = plain(lining);
  f.blind = plain(lamp("paper blind", {0.34, 0.46, 0.70}));
  f.lantern = plain(lamp("lantern", {1.5, 1.15, 0.75}));
}

}  // namespace

Finishes addFinishes(GltfBuilder& scene) {
  Finishes finishes;
  addMetals(scene, finishes);
  addGlasses(scene, finishes);
  addBenchFinishes(scene, finishes);
  return finishes;
}

}  // namespace generator
