// The tablecloth, ironed and yet not flat, and a checked towel that fell over the edge of the board.
#include <cmath>

#include "breakfast/table.h"
#include "shapes/cloth.h"
#include "shapes/surface.h"
#include "textures/noise.h"

namespace generator {
namespace {

enum LinenSeries : std::uint32_t { kClothWave = 21000, kClothRipple = 21010 };
constexpr double kHalfWidth = 78, kFront = 62, kBack = -45, kHang = 30;

/// A fold that runs from one point to another: a soft ridge that dies away at both ends.
struct Fold {
  glm::dvec2 from, to;  // x and z
  double height, width;
};
constexpr Fold kFolds[] = {{{-64, 44}, {-22, 27}, 0.8, 2.4}, {{-52, 52}, {-4, 33}, 0.55, 1.9},
                           {{-34, 56}, {16, 37}, 0.6, 2.1},  {{-2, 29}, {34, 46}, 0.5, 2.0},
                           {{-66, 8}, {-42, 20}, 0.8, 2.0},  {{44, 8}, {66, 26}, 0.7, 1.8},
                           {{40, 24}, {58, 44}, 0.7, 1.7},   {{-56, -34}, {-30, -26}, 0.5, 1.8},
                           {{16, -40}, {40, -36}, 0.5, 1.6}, {{-12, 27}, {4, 24}, 0.35, 1.2}};

double foldHeight(const Fold& fold, glm::dvec2 at) {
  const glm::dvec2 along = fold.to - fold.from, rel = at - fold.from;
  const double t = glm::dot(rel, along) / glm::dot(along, along);
  const double off = (along.x * rel.y - along.y * rel.x) / glm::length(along) / fold.width;
  return fold.height * smoothStep(-0.1, 0.4, t) * smoothStep(1.1, 0.6, t) / (1 + off * off * off * off);
}

/// Where nothing stands, the cloth heaves; where the iron went, it has a crease.
double clothHeight(glm::dvec2 at) {
  double freedom = 1;
  for (const Footprint& f : kFootprints)
    freedom *= smoothStep(f.radius + 0.3, f.radius + 4, glm::distance(at, {f.x, f.z}));
  const glm::dvec2 uv = at / 200.0 + 0.5;
  double height = 0.75 * (fractalNoise(uv, {10, 9}, kClothWave, 2) - 0.5) +
                  0.05 * (noise(uv, {52, 44}, kClothRipple) - 0.5);
  for (const Fold& fold : kFolds) height += foldHeight(fold, at);
  height *= freedom;
  for (const double x : {-52.0, -10.0, 36.0}) height += 0.10 / (1 + 9 * (at.x - x) * (at.x - x));
  for (const double z : {-34.0, 26.0}) height += 0.10 / (1 + 9 * (at.y - z) * (at.y - z));
  return height;
}

/// Woven stripes along all borders: how blue the cloth is.
double stripe(double fromMiddle) {
  const auto band = [&](double low, double high) {
    return smoothStep(low - 0.1, low + 0.1, fromMiddle) * smoothStep(high + 0.1, high - 0.1, fromMiddle);
  };
  return band(30.4, 31.0) + band(31.8, 34.4) + band(35.2, 35.8);
}

void addTablecloth(const Table& w) {
  SurfaceSpec cloth{.columns = 760, .rows = 640, .position = {}, .repeat = {10, 9}};
  cloth.position = [](glm::dvec2 uv) {
    const double x = (2 * uv.x - 1) * kHalfWidth, along = kFront - uv.y * (kFront - kBack + kHang);
    const glm::dvec2 at(x, std::max(along, kBack));
    constexpr double kBend = 2.5;
    // Over the far edge in a quarter of a circle, then down.
    const double past = std::max(0.0, kBack - along), angle = std::min(past / kBend, std::acos(0.0));
    const double down = kBend * (1 - std::cos(angle)) + std::max(0.0, past - kBend * std::acos(0.0));
    return glm::dvec3(x, clothHeight(at) - down - 0.02, at.y - kBend * std::sin(angle));
  };
  cloth.color = [](glm::dvec2 uv) {
    const double x = std::abs((2 * uv.x - 1) * kHalfWidth - 6),
                 z = std::abs(kFront - uv.y * (kFront - kBack + kHang) + 5);
    const double blue = std::min(1.0, stripe(x - 10) + stripe(z + 2));
    return glm::mix(glm::dvec3(1), glm::dvec3(0.36, 0.50, 0.74), 0.8 * blue);
  };
  w.add("tablecloth", makeSurface(cloth), w.finishes.linen);
}

}  // namespace

void addLinen(const Table& table) {
  addTablecloth(table);
  ClothSpec towel;
  towel.center = {0.135, 0.06, -0.20};
  towel.size = 0.27;
  towel.turn = 0.42;
  towel.cells = 64;
  towel.steps = 240;
  // The board's corner, and the table; the cloth is a millimetre and a half thick.
  towel.distance = [](glm::dvec3 metres) {
    const glm::dvec3 p = 100.0 * metres;
    const double board = distanceToBox(p, {-18, 0, -38}, {15, 2, -11}, 0.4);
    const double loaf = glm::length((p - glm::dvec3(-3, 2, -27.6)) / glm::dvec3(1, 0.9, 1)) - 10;
    return 1e-2 * (std::min({p.y, board, loaf}) - 0.15);
  };
  Mesh mesh = meshOf(subdivided(subdivided(drapeCloth(towel))));
  for (glm::vec3& p : mesh.positions) p *= 100.0F;
  for (const glm::vec2& uv : mesh.uv0) {
    const glm::dvec2 at = glm::fract(glm::dvec2(uv) * 9.0);
    const double lines = 0.5 * ((at.x < 0.5 ? 1 : 0) + (at.y < 0.5 ? 1 : 0));
    mesh.colors.emplace_back(glm::vec4(glm::mix(glm::dvec3(1), glm::dvec3(0.14, 0.24, 0.50), lines), 1));
  }
  for (glm::vec2& uv : mesh.uv0) uv *= 4.5F;
  table.add("towel", std::move(mesh), table.finishes.towel);
}

}  // namespace generator
