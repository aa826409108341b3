// Covers what materials can ask for: textures with two sets of coordinates, a normal map, cut-outs (MASK),
// see-through (BLEND) and vertex colours.
#include <algorithm>
#include <array>
#include <cmath>

#include "png.h"
#include "scenes.h"

namespace generator {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint8_t toByte(double v) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255));
}

/// Calls color(u, v) for the centre of each texel.
template <class F>
Bytes paint(int size, F&& color) {
  Bytes rgba;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const glm::dvec4 c = color((x + 0.5) / size, (y + 0.5) / size);
      for (int k = 0; k < 4; ++k) rgba.push_back(toByte(c[k]));
    }
  }
  return encodePng(size, size, rgba);
}

double fraction(double v) { return v - std::floor(v); }

/// Running-bond bricks, four courses.
Bytes brickPicture() {
  return paint(64, [](double u, double v) {
    const double course = std::floor(v * 4), along = u * 2 + 0.5 * std::fmod(course, 2);
    const bool mortar = fraction(v * 4) < 0.14 || fraction(along) < 0.07;
    const double shade = 0.06 * std::fmod(std::floor(along) + course, 3);
    return mortar ? glm::dvec4(0.75, 0.72, 0.68, 1) : glm::dvec4(0.68 - shade, 0.3 - shade, 0.22 - shade, 1);
  });
}

/// Round studs, one for each repetition, as a tangent-space normal map.
Bytes studNormals() {
  return paint(32, [](double u, double v) {
    const double x = 2.6 * (u - 0.5), y = 2.6 * (0.5 - v), r2 = x * x + y * y;
    const glm::dvec3 n = r2 < 1 ? glm::normalize(glm::dvec3(x, y, 0.9)) : glm::dvec3(0, 0, 1);
    return glm::dvec4(0.5 * n + 0.5, 1);
  });
}

/// A leaf: opaque green inside, transparent outside.
Bytes leafPicture() {
  return paint(64, [](double u, double v) {
    const double x = std::abs(u - 0.5), width = 0.42 * 4 * v * (1 - v) * (0.35 + 0.65 * v);
    const bool stem = x < 0.015 && v > 0.05;
    const double alpha = x < width || stem ? 1 : 0;
    return stem ? glm::dvec4(0.35, 0.5, 0.15, alpha) : glm::dvec4(0.2, 0.55 + 0.3 * x, 0.15, alpha);
  });
}

void addWall(GltfBuilder& scene) {
  MaterialSpec bricks = matte("bricks and studs", glm::dvec3(1));
  bricks.baseColorTexture = {scene.addImage("bricks", brickPicture(), false), 0};
  bricks.normalTexture = {scene.addImage("studs", studNormals(), false), 1};
  Mesh wall = makeQuad({-3.2, 0, -1}, {6.4, 0, 0}, {0, 2.8, 0}, {4, 2});
  for (const glm::vec2 uv : wall.uv0) wall.uv1.emplace_back(uv * 4.0F);
  scene.add("wall", std::move(wall), scene.addMaterial(bricks));
}

void addLeaves(GltfBuilder& scene) {
  MaterialSpec leaf = matte("leaf cut-out", glm::dvec3(1));
  leaf.alphaMode = "MASK";
  leaf.doubleSided = true;
  leaf.baseColorTexture.image = scene.addImage("leaf", leafPicture(), false);
  Mesh mesh = makeQuad({-0.35, 0, 0}, {0.7, 0, 0}, {0, 1.0, 0});
  mesh.tangents.clear();
  const int geometry = scene.addGeometry(std::move(mesh)), material = scene.addMaterial(leaf);
  for (int i = 0; i < 4; ++i) {
    scene.place("leaf", geometry, material,
                {.position = {-2.2 + 0.45 * i, 0, 0.3 + 0.1 * (i % 2)}, .turnY = 25.0 - 20 * i});
  }
}

void addPanes(GltfBuilder& scene) {
  const std::array<glm::dvec4, 3> colors{
      {{0.9, 0.15, 0.1, 0.35}, {0.95, 0.75, 0.1, 0.5}, {0.1, 0.3, 0.9, 0.65}}};
  for (int i = 0; i < 3; ++i) {
    MaterialSpec pane = matte("see-through", glm::dvec3(1));
    pane.baseColor = colors[static_cast<std::size_t>(i)];
    pane.alphaMode = "BLEND";
    pane.doubleSided = true;
    Mesh mesh = makeQuad({1.0 + 0.45 * i, 0.1, 0.1 + 0.25 * i}, {0.75, 0, 0}, {0, 1.5, 0});
    mesh.uv0.clear();
    mesh.tangents.clear();
    scene.add("pane", std::move(mesh), scene.addMaterial(pane));
  }
}

/// A ball whose vertex colours run through the rainbow with the direction.
void addRainbowBall(GltfBuilder& scene) {
  Mesh ball = makeSphere(1, 48, 24);
  for (const glm::vec3& n : ball.normals) ball.colors.emplace_back(0.5F + 0.5F * n, 1.0F);
  scene.place("rainbow ball", scene.addGeometry(std::move(ball)),
              scene.addMaterial(matte("vertex colours", glm::dvec3(1))),
              {.position = {0.15, 0.5, 0.5}, .scale = 0.5});
}

}  // namespace

void buildTextured(GltfBuilder& scene) {
  addWall(scene);
  Mesh floor = makeQuad({-6, 0, 4}, {12, 0, 0}, {0, 0, -5});
  floor.uv0.clear();
  floor.tangents.clear();
  scene.add("floor", std::move(floor), scene.addMaterial(matte("floor", glm::dvec3(0.5))));
  addLeaves(scene);
  addPanes(scene);
  addRainbowBall(scene);
  scene.addLight({.name = "key", .intensity = 52, .position = {-2.2, 3.6, 3}});
  scene.addLight({.name = "fill", .intensity = 16, .position = {2, 2, 5}, .castsShadows = false});
  scene.setBackground({0.4, 0.5, 0.65});
  scene.addCamera("camera", {0, 1.35, 5}, {0, 0.95, 0}, 32);
}

}  // namespace generator
