// Every material of the diner after the rain, and the wet street's texture.
#include "diner/street.h"
#include "textures/noise.h"
#include "textures/surfaces.h"

namespace generator {
namespace {

/// Numbers that differ between the textures of this file.
enum StreetTextureSeries : std::uint32_t {
  kPuddle = 30000,
  kGravel = 30010,
  kTar = 30020,
  kWorn = 30030,
  kCourse = 30040
};

/// Asphalt after rain, with the stripes of a crossing: stones stand out of a film of water, and where the
/// ground is low nothing does.
SurfaceFunction wetAsphalt() {
  return [](glm::dvec2 uv) {
    const double low = fractalNoise(uv, {7, 9}, kPuddle, 5), puddle = smoothStep(0.525, 0.575, low);
    const double gravel = noise(uv, {820, 820}, kGravel), fine = noise(uv, {1400, 1400}, kGravel + 1),
                 swell = fractalNoise(uv, {40, 40}, kTar, 3);
    // Eight stripes across the way to the door.
    const double x = 32 * uv.x - 16, z = 32 * uv.y - 22, along = (x + 5.6) / 0.9,
                 stripeAt = along - std::floor(along);
    const double paint = (z > 0.4 && z < 3.4 && along > 0 && along < 9)
                             ? smoothStep(0.0, 0.03, stripeAt) * smoothStep(0.56, 0.53, stripeAt)
                             : 0;
    const double worn = smoothStep(0.36, 0.52, fractalNoise(uv, {160, 160}, kWorn, 3) + 0.12 * swell);
    glm::dvec3 color((0.05 + 0.05 * gravel * (1 - puddle)) * (0.75 + 0.5 * swell));
    color = glm::mix(color, glm::dvec3(0.74, 0.73, 0.69), 0.9 * paint * worn);
    return SurfacePoint{color * (1 - 0.3 * puddle),
                        (1 - puddle) * (1.0e-3 * gravel + 0.4e-3 * fine + 4e-3 * swell), 0.1};
  };
}

/// Bricks in a running bond; `courses` of them, even.
SurfaceFunction brickSurface(int courses, glm::dvec3 clay) {
  return [courses, clay](glm::dvec2 uv) {
    const double row = uv.y * courses, course = std::floor(row),
                 across = uv.x * courses * 0.35 + (static_cast<int>(course) % 2) * 0.5;
    const glm::dvec2 in(across - std::floor(across), row - course);
    const double joint = std::max(smoothStep(0.045, 0.02, std::min(in.x, 1 - in.x)),
                                  smoothStep(0.12, 0.06, std::min(in.y, 1 - in.y)));
    const double burn = noise({std::floor(across) / 64, course / courses}, {64, courses}, kCourse),
                 grain = fractalNoise(uv, {120, 120}, kCourse + 1, 2);
    const glm::dvec3 color =
        glm::mix(clay * (0.6 + 0.7 * burn) * (0.85 + 0.3 * grain), glm::dvec3(0.20, 0.19, 0.18), joint);
    return SurfacePoint{color, -4e-3 * joint + 5e-4 * grain, 0.8};
  };
}

void addStreetMetals(GltfBuilder& scene, StreetFinishes& f) {
  const auto plain = [&](const MaterialSpec& spec) { return plainFinish(scene, spec); };
  f.chrome = plain(metal("chrome", {0.82, 0.83, 0.85}, 0.04));
  f.steel = plain(metal("brushed steel", {0.62, 0.62, 0.63}, 0.28));
  f.redEnamel = plain(varnished("red enamel", {0.42, 0.012, 0.018}, 0.06));
  f.creamEnamel = plain(varnished("cream enamel", {0.66, 0.60, 0.47}, 0.06));
  f.blackEnamel = plain(varnished("black enamel", {0.012, 0.012, 0.014}, 0.06));
  f.iron = plain(varnished("cast iron", {0.016, 0.022, 0.020}, 0.14));
  MaterialSpec oilcloth = varnished("oilcloth", {0.78, 0.50, 0.04}, 0.3);
  oilcloth.doubleSided = true;
  oilcloth.emission = {0.09, 0.055, 0.004};  // light that shines through
  f.oilcloth = plain(oilcloth);
  f.rubber = plain(varnished("rubber", {0.014, 0.014, 0.015}, 0.35));
}

void addStreetGlass(GltfBuilder& scene, StreetFinishes& f) {
  const auto plain = [&](const MaterialSpec& spec) { return plainFinish(scene, spec); };
  MaterialSpec pane = glass("window", 1.5);
  pane.thickness = 0;  // a sheet
  f.pane = plain(pane);
  f.glass = plain(tinted("glass", 1.5, {0.94, 0.98, 0.97}, 0.05));
  f.drop = plain(glass("rain drop", 1.333));
  f.ketchup = plain(varnished("ketchup", {0.40, 0.02, 0.012}, 0.08));
  f.bottles = {plain(tinted("green bottle", 1.5, {0.25, 0.80, 0.30}, 0.05)),
               plain(tinted("amber bottle", 1.5, {0.95, 0.55, 0.10}, 0.05)),
               plain(tinted("blue bottle", 1.5, {0.25, 0.50, 0.95}, 0.05)),
               plain(tinted("rose bottle", 1.5, {0.95, 0.35, 0.40}, 0.05))};
}

void addGround(GltfBuilder& scene, StreetFinishes& f) {
  const auto plain = [&](const MaterialSpec& spec) { return plainFinish(scene, spec); };
  MaterialSpec wet = varnished("wet asphalt", {}, 0.1);
  wet.ior = 1.36;
  f.asphalt = bakedFinish(scene, wet, {2048, 2048, 32}, wetAsphalt());
  f.kerb =
      bakedFinish(scene, varnished("kerb", {}, 0.3), {1024, 1024, 2.4}, tileSurface(4, {0.22, 0.215, 0.21}));
  const auto glowing = [&](const char* name, double metres, glm::dvec3 glow, const SurfaceFunction& surface) {
    return glowingFinish(scene, name, metres, glow, surface);
  };
  // What dusk and lamps give them, were light that is thrown back followed.
  f.brick = glowing("brick", 3, {0.34, 0.30, 0.42}, brickSurface(40, {0.30, 0.12, 0.075}));
  f.stone = glowing("stone", 3, {0.22, 0.21, 0.30}, plasterSurface({0.30, 0.27, 0.24}));
  f.wallTiles = glowing("wall tiles", 1.2, {0.50, 0.42, 0.30}, tileSurface(8, {0.12, 0.27, 0.23}));
  f.wood = glowing("wood", 1.5, {0.5, 0.42, 0.3}, woodSurface(3));
  MaterialSpec counter = varnished("counter", {0.55, 0.50, 0.42}, 0.1);
  counter.emission = {0.10, 0.08, 0.055};
  f.counter = plain(counter);
  f.cloth = plain(varnished("seat", {0.30, 0.012, 0.016}, 0.3));
}

void addGlows(GltfBuilder& scene, StreetFinishes& f) {
  const auto plain = [&](const char* name, glm::dvec3 radiance) {
    return plainFinish(scene, lamp(name, radiance));
  };
  f.redNeon = plain("red neon", {4.2, 0.42, 0.22});
  f.pinkNeon = plain("pink neon", {3.4, 0.45, 1.5});
  f.blueNeon = plain("blue neon", {0.25, 1.7, 3.0});
  f.bulb = plain("bulb", {6, 4.4, 2.6});
  f.ceiling = plain("lit ceiling", {0.85, 0.66, 0.42});
  f.menu = plain("menu board", {0.62, 0.46, 0.26});
}

}  // namespace

StreetFinishes addStreetFinishes(GltfBuilder& scene) {
  StreetFinishes finishes;
  addStreetMetals(scene, finishes);
  addStreetGlass(scene, finishes);
  addGround(scene, finishes);
  addGlows(scene, finishes);
  return finishes;
}

}  // namespace generator
