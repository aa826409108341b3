// Tiny and huge triangles in one scene, a teapot in a stadium: heaps of balls, rings and gravel out of
// millimetre triangles on a plain of two triangles 120 km wide, mountains of a few triangles on its horizon,
// and slivers, a millimetre wide and up to kilometres long, that run askew through everything. A box around a
// sliver or around half the plain holds next to nothing of it, which is what a tree of boxes finds hardest.
#include <cmath>
#include <numbers>

#include "hash.h"
#include "scenes.h"

namespace generator {
namespace {

constexpr double kPlain = 60e3;       // half the side, metres
constexpr double kBallRadius = 0.03;  // 9 024 triangles each: about 1.5 mm long
constexpr double kRingRadius = 0.1;   // 18 432 triangles: about 2 mm long
constexpr double kRingThickness = 8e-3;
constexpr int kGrains = 4000;  // tetrahedra of 0.5 to 3 mm
constexpr int kWires = 64;     // each of two triangles

/// Numbers that differ between the things that are strewn about.
enum Series : std::uint32_t {
  kGrainAngle,
  kGrainFar,
  kGrainSize,
  kGrainTurn,
  kWireAngle,
  kWireRise,
  kWireAt
};

void forgetTextures(Mesh& mesh) {
  mesh.uv0.clear();
  mesh.tangents.clear();
}

/// One triangle, front along (b - a) × (c - a), flat.
void addTriangle(Mesh& mesh, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const glm::vec3 normal(glm::normalize(glm::cross(b - a, c - a)));
  for (const glm::dvec3 corner : {a, b, c}) {
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.emplace_back(corner);
    mesh.normals.push_back(normal);
  }
}

/// A pyramid on three corners of the ground without the face below.
void addPyramid(Mesh& mesh, glm::dvec3 foot, double width, double height, double turn) {
  const auto corner = [&](int k) {
    const double angle = turn + 2 * std::numbers::pi * k / 3;
    return foot + width * glm::dvec3(std::cos(angle), 0, -std::sin(angle));
  };
  for (int k = 0; k < 3; ++k) addTriangle(mesh, corner(k), corner(k + 1), foot + glm::dvec3(0, height, 0));
}

void addPlainAndMountains(GltfBuilder& scene) {
  Mesh plain;
  addQuad(plain, {-kPlain, 0, kPlain}, {2 * kPlain, 0, 0}, {0, 0, -2 * kPlain});
  forgetTextures(plain);
  scene.add("plain", std::move(plain), scene.addMaterial(matte("sand", {0.62, 0.52, 0.38})));
  Mesh mountains;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 foot(-42e3 + 12e3 * i, 0, -34e3 - 4e3 * (i % 3));
    addPyramid(mountains, foot, 12e3 + 2e3 * (i % 4), 4e3 + 1.5e3 * (i % 3), 0.7 * i);
  }
  scene.add("mountains", std::move(mountains), scene.addMaterial(matte("rock", {0.4, 0.38, 0.42})));
}

/// Four balls, one on top of them, and a ring that stands behind.
void addHeaps(GltfBuilder& scene) {
  const int ball = scene.addGeometry(makeUnitSphere());
  const int ring = scene.addGeometry(makeTorus(kRingRadius, kRingThickness, 384, 24));
  const int clay = scene.addMaterial(matte("clay", {0.7, 0.3, 0.18}));
  const int silver = scene.addMaterial(mirror("silver", glm::dvec3(0.92)));
  const int brass = scene.addMaterial(matte("brass", {0.7, 0.55, 0.2}));
  for (const glm::dvec3 at : {glm::dvec3(0, 0, 0), glm::dvec3(-0.45, 0, -0.9), glm::dvec3(6, 0, -12)}) {
    for (int k = 0; k < 4; ++k) {
      const glm::dvec3 beside(k % 2 == 0 ? -1 : 1, 1, k < 2 ? -1 : 1);
      scene.place("ball", ball, clay, {.position = at + kBallRadius * beside, .scale = kBallRadius});
    }
    const glm::dvec3 above(0, kBallRadius * (1 + std::numbers::sqrt2), 0);
    scene.place("mirror ball", ball, silver, {.position = at + above, .scale = kBallRadius});
    const glm::dvec3 behind(0, kRingRadius + kRingThickness, -0.08);
    scene.place("ring", ring, brass, {.position = at + behind, .turnY = 20});
  }
}

/// Tetrahedra strewn about the first heap, fewer farther out.
void addGravel(GltfBuilder& scene) {
  Mesh gravel;
  for (std::uint32_t i = 0; i < kGrains; ++i) {
    const double angle = 2 * std::numbers::pi * unitValue(kGrainAngle, i), u = unitValue(kGrainFar, i);
    const double far = 0.05 + 0.6 * u * u, size = 5e-4 + 2.5e-3 * unitValue(kGrainSize, i);
    const glm::dvec3 foot(far * std::cos(angle), 0, far * std::sin(angle));
    addPyramid(gravel, foot, size, size, 2 * std::numbers::pi * unitValue(kGrainTurn, i));
  }
  scene.add("gravel", std::move(gravel), scene.addMaterial(matte("gravel", {0.45, 0.45, 0.48})));
}

/// Slivers from near the first heap upwards into all directions, 30 m to 5 km long and a millimetre wide.
void addWires(GltfBuilder& scene) {
  Mesh wires;
  for (std::uint32_t i = 0; i < kWires; ++i) {
    const double angle = 2 * std::numbers::pi * unitValue(kWireAngle, i),
                 rise = 0.1 + unitValue(kWireRise, i);
    const glm::dvec3 along = glm::normalize(glm::dvec3(std::cos(angle), rise, std::sin(angle)));
    const glm::dvec3 across(-std::sin(angle), 0, std::cos(angle));
    const double length = 30 * std::pow(5e3 / 30, (i + 0.5) / kWires);
    const glm::dvec3 start(unitValue(kWireAt, 2 * i) - 0.5, 0, unitValue(kWireAt, 2 * i + 1) - 0.5);
    addQuad(wires, start, 1e-3 * across, length * along);
  }
  forgetTextures(wires);
  MaterialSpec steel = matte("steel", {0.2, 0.2, 0.22});
  steel.doubleSided = true;
  scene.add("wires", std::move(wires), scene.addMaterial(steel));
}

}  // namespace

void buildMixed(GltfBuilder& scene) {
  addPlainAndMountains(scene);
  addHeaps(scene);
  addGravel(scene);
  addWires(scene);
  scene.addLight({.name = "sun",
                  .type = "directional",
                  .color = {1, 0.94, 0.82},
                  .intensity = 2.6,
                  .position = {3, 4, 3},
                  .target = {0, 0, 0}});
  scene.addLight({.name = "lamp", .color = {1, 0.9, 0.75}, .intensity = 0.35, .position = {-0.5, 0.5, 0.4}});
  scene.addLight({.name = "sky",
                  .type = "directional",
                  .color = {0.6, 0.75, 1},
                  .intensity = 0.4,
                  .position = {-1, 6, 2},
                  .target = {0, 0, 0},
                  .castsShadows = false});
  scene.setBackground({0.45, 0.62, 0.88});
  scene.addCamera("camera", {0.05, 0.17, 0.5}, {-0.02, 0.1, 0}, 36);
}

}  // namespace generator
