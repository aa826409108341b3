// Hills out of fractal value noise (Perlin & Hoffert 1989's sum of octaves over a lattice of hashed
// integers). Additions and multiplications only, so every machine gets the same bits. Reads nothing; 2n²
// triangles up to n = 4096 (33 million).
#include <array>
#include <cmath>

#include "hash.h"
#include "scenes.h"

namespace generator {
namespace {

constexpr double kSide = 16;     // metres, centred on the origin
constexpr double kHeight = 3.2;  // metres between about the lowest and the highest point
constexpr int kOctaves = 9;      // the last one is about as fine as 1024 squares resolve

/// A fixed value in [0, 1) for each lattice point of each octave.
double lattice(int x, int z, int octave) {
  return mix(static_cast<std::uint32_t>(x) + mix(static_cast<std::uint32_t>(z) + mix(octave))) * 0x1p-32;
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

double valueNoise(double x, double z, int octave) {
  const double fx = std::floor(x), fz = std::floor(z), u = fade(x - fx), v = fade(z - fz);
  const int ix = static_cast<int>(fx), iz = static_cast<int>(fz);
  const double near = lattice(ix, iz, octave) + u * (lattice(ix + 1, iz, octave) - lattice(ix, iz, octave));
  const double far =
      lattice(ix, iz + 1, octave) + u * (lattice(ix + 1, iz + 1, octave) - lattice(ix, iz + 1, octave));
  return near + v * (far - near);
}

/// Metres above 0 at a point of the plane.
double hills(double x, double z) {
  double height = 0, amplitude = 0.5, frequency = 0.25;
  for (int octave = 0; octave < kOctaves; ++octave) {
    height += amplitude * valueNoise(x * frequency, z * frequency, octave);
    amplitude *= 0.45;
    frequency *= 2.03;  // not 2: the lattices never coincide
  }
  return kHeight * height;
}

/// Heights with a border of one sample all around, for the slopes at the edge.
std::vector<float> sampleHeights(int n) {
  std::vector<float> heights;
  heights.reserve((n + 3ULL) * (n + 3ULL));
  const double step = kSide / n;
  for (int j = -1; j <= n + 1; ++j) {
    for (int i = -1; i <= n + 1; ++i)
      heights.push_back(static_cast<float>(hills(i * step - kSide / 2, j * step - kSide / 2)));
  }
  return heights;
}

Mesh makeHills(int n) {
  Mesh mesh;
  const std::vector<float> heights = sampleHeights(n);
  const std::size_t stride = n + 3ULL;
  const double step = kSide / n;
  const std::size_t vertices = (n + 1ULL) * (n + 1ULL);
  mesh.positions.reserve(vertices);
  mesh.normals.reserve(vertices);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const float* h = &heights[(j + 1) * stride + i + 1];
      mesh.positions.emplace_back(i * step - kSide / 2, *h, j * step - kSide / 2);
      const double slopeX = (static_cast<double>(h[1]) - h[-1]) / (2 * step);
      const double slopeZ = (static_cast<double>(h[stride]) - *(h - stride)) / (2 * step);
      mesh.normals.emplace_back(glm::normalize(glm::dvec3(-slopeX, 1, -slopeZ)));
    }
  }
  mesh.indices.reserve(6ULL * n * n);
  const auto row = static_cast<std::uint32_t>(n) + 1;
  for (std::uint32_t j = 0; j + 1 < row; ++j) {
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = j * row + i, b = a + row;
      for (const std::uint32_t v : {a, b, b + 1, a, b + 1, a + 1}) mesh.indices.push_back(v);
    }
  }
  return mesh;
}

void addHills(GltfBuilder& scene, int n) {
  scene.add("hills", makeHills(n), scene.addMaterial(matte("earth", {0.55, 0.5, 0.36})));
}

}  // namespace

void buildHeightField(GltfBuilder& scene, int n) {
  addHills(scene, n);
  scene.addLight({.name = "sun",
                  .type = "directional",
                  .color = {1, 0.93, 0.8},
                  .intensity = 3.6,
                  .position = {-6, 4.4, -1.5},
                  .target = {0, 0, 0}});
  scene.addLight({.name = "sky",
                  .type = "directional",
                  .color = {0.6, 0.75, 1},
                  .intensity = 0.5,
                  .position = {1, 6, 2},
                  .target = {0, 0, 0},
                  .castsShadows = false});
  scene.setBackground({0.45, 0.62, 0.88});
  scene.addCamera("camera", {0, 4.2, 7.6}, {0, 1.0, 0}, 42);
}

void buildFrame(GltfBuilder& scene) {
  addHills(scene, 560);
  const int sphere = scene.addGeometry(makeUnitSphere());
  const int silver = scene.addMaterial(mirror("silver", glm::dvec3(0.92)));
  const std::array<glm::dvec4, 5> balls{{{-2.8, 2.6, 1.2, 0.7},
                                         {0.2, 2.9, 0.2, 0.9},
                                         {3.0, 2.5, 1.4, 0.65},
                                         {-1.2, 2.1, 3.2, 0.4},
                                         {1.9, 3.0, -2.6, 0.7}}};
  for (const glm::dvec4& b : balls)
    scene.place("mirror ball", sphere, silver, {.position = glm::dvec3(b), .scale = b.w});
  scene.addLight({.name = "lamp", .color = {1, 0.95, 0.85}, .intensity = 160, .position = {-4, 7, 4}});
  scene.setBackground({0.45, 0.62, 0.88});
  scene.addCamera("camera", {0, 4.2, 7.6}, {0, 1.0, 0}, 42);
}

}  // namespace generator
