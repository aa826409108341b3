// Verlet steps and distance constraints that are satisfied one after another (Jakobsen 2001; Müller,
// Heidelberger, Hennix and Ratcliff 2007). Sums, products and square roots: the same bits on every machine.
#include "shapes/cloth.h"

#include <algorithm>
#include <cmath>

namespace generator {
namespace {

constexpr double kStep = 1.0 / 120;  // seconds
constexpr glm::dvec3 kGravity{0, -9.81, 0};
constexpr double kDamping = 0.8;  // of the speed, each step: cloth that air slows down comes to rest soon
constexpr int kIterations = 30;
constexpr double kFriction = 0.3;  // share of a sliding step that each iteration in contact takes back

struct Link {
  std::size_t a, b;
  double length, stiffness;
};

class Cloth {
 public:
  explicit Cloth(const ClothSpec& spec) : spec_(spec), stride_(static_cast<std::size_t>(spec.cells) + 1) {
    // Rounded, since the fall enlarges the smallest difference.
    const double c = static_cast<float>(std::cos(spec.turn)), s = static_cast<float>(std::sin(spec.turn));
    const double cell = spec.size / spec.cells;
    for (int row = 0; row <= spec.cells; ++row) {
      for (int column = 0; column <= spec.cells; ++column) {
        const double x = column * cell - spec.size / 2, z = row * cell - spec.size / 2;
        points_.push_back(spec.center + glm::dvec3(c * x + s * z, 0, c * z - s * x));
      }
    }
    before_ = points_;
    linkNeighbours();
  }

  void step() {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const glm::dvec3 speed = kDamping * (points_[i] - before_[i]);
      before_[i] = points_[i];
      points_[i] += speed + kStep * kStep * kGravity;
    }
    // Contacts are among the constraints: what hangs would pull the rest through.
    for (int k = 0; k < kIterations; ++k) {
      for (const Link& link : links_) satisfy(link);
      for (std::size_t i = 0; i < points_.size(); ++i) keepOutside(i);
    }
  }

  const std::vector<glm::dvec3>& points() const { return points_; }

 private:
  /// Sides and diagonals of the quads, and, weakly, every second neighbour against sharp folds.
  void linkNeighbours() {
    const auto link = [&](std::size_t row, std::size_t column, int down, int right, double stiffness) {
      const std::ptrdiff_t r = static_cast<std::ptrdiff_t>(row) + down;
      const std::ptrdiff_t c = static_cast<std::ptrdiff_t>(column) + right;
      const auto n = static_cast<std::ptrdiff_t>(stride_);
      if (r >= n || c < 0 || c >= n) return;
      const std::size_t a = row * stride_ + column, b = static_cast<std::size_t>(r * n + c);
      links_.push_back({a, b, glm::distance(points_[a], points_[b]), stiffness});
    };
    for (std::size_t row = 0; row < stride_; ++row) {
      for (std::size_t column = 0; column < stride_; ++column) {
        link(row, column, 0, 1, 1);
        link(row, column, 1, 0, 1);
        link(row, column, 1, 1, 0.3);
        link(row, column, 1, -1, 0.3);
        link(row, column, 0, 2, 0.04);
        link(row, column, 2, 0, 0.04);
      }
    }
  }

  void satisfy(const Link& link) {
    const glm::dvec3 d = points_[link.b] - points_[link.a];
    const double length = std::sqrt(glm::dot(d, d));
    const glm::dvec3 correction = 0.5 * link.stiffness * (length - link.length) / length * d;
    points_[link.a] += correction;
    points_[link.b] -= correction;
  }

  /// Pushes a point out along the slope of the distance, and slows it down there.
  void keepOutside(std::size_t i) {
    constexpr double h = 1e-5;  // metres, for the slope
    glm::dvec3& p = points_[i];
    const double depth = -spec_.distance(p);
    if (depth <= 0) return;
    glm::dvec3 slope;
    for (int k = 0; k < 3; ++k) {
      glm::dvec3 q = p;
      q[k] += h;
      slope[k] = (spec_.distance(q) + depth) / h;
    }
    p += depth * slope;
    const glm::dvec3 step = p - before_[i];
    p -= kFriction * (step - glm::dot(step, slope) * slope);
  }

  const ClothSpec& spec_;
  std::size_t stride_;
  std::vector<glm::dvec3> points_, before_;
  std::vector<Link> links_;
};

}  // namespace

Cage drapeCloth(const ClothSpec& spec) {
  Cloth cloth(spec);
  for (int i = 0; i < spec.steps; ++i) cloth.step();
  return makeGrid(spec.cells, spec.cells, cloth.points());
}

double distanceToBox(glm::dvec3 p, glm::dvec3 low, glm::dvec3 high, double radius) {
  const glm::dvec3 half = 0.5 * (high - low) - radius, q = glm::abs(p - 0.5 * (low + high)) - half;
  const double inside = std::min(std::max({q.x, q.y, q.z}), 0.0);
  return glm::length(glm::max(q, glm::dvec3(0))) + inside - radius;
}

}  // namespace generator
