// Fractal hills, then hydraulic erosion drop by drop: a drop runs downhill with some inertia, takes up earth
// while it can carry more and leaves it where it slows down (Musgrave, Kolb and Mace 1989 for the idea;
// single drops as in Beyer 2015). Sums, products and square roots: the same bits on every machine.
#include "shapes/terrain.h"

#include <algorithm>
#include <cmath>

#include "hash.h"
#include "textures/noise.h"

namespace generator {

/// The rain of a terrain. Lengths here are in squares of the grid, heights in metres.
class Rain {
 public:
  explicit Rain(Terrain& terrain) : land_(terrain), n_(terrain.spec_.squares) {}

  void fall() {
    for (int i = 0; i < land_.spec_.droplets; ++i) run(static_cast<std::uint32_t>(i));
  }

 private:
  static constexpr int kLongestWay = 80;
  static constexpr double kInertia = 0.3, kCapacity = 3, kErosion = 0.08, kDeposit = 0.12, kDrying = 0.02;

  struct Slope {
    glm::dvec2 gradient;
    double height;
  };

  double& at(glm::ivec2 p) {
    return land_.heights_[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(n_ + 1) +
                          static_cast<std::size_t>(p.x)];
  }

  Slope slopeAt(glm::dvec2 p) {
    const glm::ivec2 c(p);
    const glm::dvec2 t = p - glm::dvec2(c);
    const double a = at(c), b = at(c + glm::ivec2(1, 0)), d = at(c + glm::ivec2(0, 1)),
                 e = at(c + glm::ivec2(1, 1));
    return {{(b - a) * (1 - t.y) + (e - d) * t.y, (d - a) * (1 - t.x) + (e - b) * t.x},
            (a * (1 - t.x) + b * t.x) * (1 - t.y) + (d * (1 - t.x) + e * t.x) * t.y};
  }

  /// Spread over the four points around `p`.
  void addEarth(glm::dvec2 p, double amount) {
    const glm::ivec2 c(p);
    const glm::dvec2 t = p - glm::dvec2(c);
    at(c) += amount * (1 - t.x) * (1 - t.y);
    at(c + glm::ivec2(1, 0)) += amount * t.x * (1 - t.y);
    at(c + glm::ivec2(0, 1)) += amount * (1 - t.x) * t.y;
    at(c + glm::ivec2(1, 1)) += amount * t.x * t.y;
  }

  bool isOnLand(glm::dvec2 p) const { return p.x >= 0 && p.y >= 0 && p.x < n_ && p.y < n_; }

  void run(std::uint32_t index) {
    const std::uint32_t series = land_.spec_.series;
    glm::dvec2 p =
        static_cast<double>(n_) * glm::dvec2(unitValue(series + 90, index), unitValue(series + 91, index));
    glm::dvec2 way(0);
    double water = 1, earth = 0, speed = 1;
    for (int step = 0; step < kLongestWay; ++step) {
      const Slope here = slopeAt(p);
      way = kInertia * way - (1 - kInertia) * here.gradient;
      const double length = glm::length(way);
      if (length < 1e-9) break;
      way /= length;
      const glm::dvec2 next = p + way;
      if (!isOnLand(next)) return;  // what it carries leaves with it
      const double descent = here.height - slopeAt(next).height;
      const double capacity = std::max(descent, 0.01) * speed * water * kCapacity;
      if (descent < 0 || earth > capacity) {
        const double left = descent < 0 ? std::min(-descent, earth) : kDeposit * (earth - capacity);
        addEarth(p, left);
        earth -= left;
      } else {
        const double taken = std::min(kErosion * (capacity - earth), descent);
        addEarth(p, -taken);
        earth += taken;
      }
      speed = std::sqrt(std::max(0.0, speed * speed + descent));
      water *= 1 - kDrying;
      p = next;
    }
    addEarth(p, earth);
  }

  Terrain& land_;
  int n_;
};

Terrain::Terrain(const TerrainSpec& spec) : spec_(spec) {
  const int n = spec.squares;
  for (int row = 0; row <= n; ++row) {
    for (int column = 0; column <= n; ++column) {
      const glm::dvec2 uv(static_cast<double>(column) / n, static_cast<double>(row) / n);
      // Valleys of a ridged noise between broad hills.
      const double broad = fractalNoise(0.7 * uv, {3, 3}, spec.series, 3);
      const double ridge = 1 - std::abs(2 * fractalNoise(0.7 * uv, {5, 5}, spec.series + 20, 6) - 1);
      heights_.push_back(spec.relief * (0.75 * broad + 0.45 * ridge * ridge * broad * broad));
    }
  }
  Rain(*this).fall();
}

double Terrain::heightAt(double x, double z) const {
  const int n = spec_.squares;
  const glm::dvec2 p =
      glm::clamp((glm::dvec2(x, z) / spec_.side + 0.5) * static_cast<double>(n), 0.0, n - 1e-9);
  const glm::ivec2 c(p);
  const glm::dvec2 t = p - glm::dvec2(c);
  const double* h = &heights_[static_cast<std::size_t>(c.y) * static_cast<std::size_t>(n + 1) +
                              static_cast<std::size_t>(c.x)];
  return (h[0] * (1 - t.x) + h[1] * t.x) * (1 - t.y) + (h[n + 1] * (1 - t.x) + h[n + 2] * t.x) * t.y;
}

glm::dvec3 Terrain::normalAt(double x, double z) const {
  const double h = spec_.side / spec_.squares;
  return glm::normalize(
      glm::dvec3(heightAt(x - h, z) - heightAt(x + h, z), 2 * h, heightAt(x, z - h) - heightAt(x, z + h)));
}

Mesh meshOf(const Terrain& terrain, const TerrainSpec& spec) {
  Mesh mesh;
  const int n = spec.squares;
  for (int row = 0; row <= n; ++row) {
    for (int column = 0; column <= n; ++column) {
      const double x = spec.side * (static_cast<double>(column) / n - 0.5),
                   z = spec.side * (static_cast<double>(row) / n - 0.5);
      const glm::dvec3 normal = terrain.normalAt(x, z);
      mesh.positions.emplace_back(x, terrain.heightAt(x, z), z);
      mesh.normals.emplace_back(normal);
      const double patch = fractalNoise({x / spec.side, z / spec.side}, {9, 9}, spec.series + 50, 5);
      const glm::dvec3 grass = glm::mix(glm::dvec3(0.10, 0.15, 0.035), glm::dvec3(0.22, 0.20, 0.07), patch);
      const glm::dvec3 rock = glm::dvec3(0.24, 0.21, 0.18) * (0.7 + 0.6 * patch);
      mesh.colors.emplace_back(glm::vec3(glm::mix(rock, grass, smoothStep(0.66, 0.84, normal.y))), 1.0F);
    }
  }
  const auto stride = static_cast<std::uint32_t>(n) + 1;
  for (std::uint32_t row = 0; row + 1 < stride; ++row) {
    for (std::uint32_t column = 0; column + 1 < stride; ++column) {
      const std::uint32_t a = row * stride + column, b = a + stride;
      mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  }
  return mesh;
}

}  // namespace generator
