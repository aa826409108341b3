// Branches that fork at the golden angle and grow thinner, as Weber and Penn (1995) have them, simplified.
#include "shapes/plants.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "hash.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

constexpr double kGoldenAngle = 2.399963229728653;  // radians

struct Branch {
  glm::dvec3 start, direction;
  double length, radius;
  int level;
};

class Growth {
 public:
  explicit Growth(const TreeSpec& spec) : spec_(spec) {}

  Tree grow() {
    addBranch({{0, -0.02 * spec_.height, 0}, {0, 1, 0}, 0.62 * spec_.height, spec_.trunkRadius, 0});
    return std::move(tree_);
  }

 private:
  double random() { return unitValue(spec_.series, count_++); }

  /// Bent by chance, and upwards towards the light.
  std::vector<glm::dvec3> pathOf(const Branch& branch) {
    constexpr int kPieces = 6;
    std::vector<glm::dvec3> path{branch.start};
    glm::dvec3 way = branch.direction;
    for (int i = 0; i < kPieces; ++i) {
      const glm::dvec3 chance = glm::dvec3(random(), random(), random()) - 0.5;
      way = glm::normalize(way + 0.28 * chance + glm::dvec3(0, branch.level > 0 ? 0.07 : 0, 0));
      path.push_back(path.back() + branch.length / kPieces * way);
    }
    return path;
  }

  void addBranch(const Branch& branch) {
    const std::vector<glm::dvec3> path = pathOf(branch);
    SweepSpec sweep;
    sweep.path = smoothPath(path, branch.level == 0 ? 4 : 2);
    for (std::size_t i = 0; i < sweep.path.size(); ++i)
      sweep.scale.push_back(1 - 0.75 * static_cast<double>(i) / static_cast<double>(sweep.path.size()));
    sweep.section = circleOutline(branch.radius, branch.level == 0 ? 16 : branch.level == 1 ? 8 : 4);
    append(tree_.wood, makeSweep(sweep));
    if (branch.level + 1 < spec_.levels) {
      addChildren(branch, path);
    } else {
      addLeaves(path);
    }
  }

  void addChildren(const Branch& branch, const std::vector<glm::dvec3>& path) {
    double turn = 6.28 * random();
    for (int i = 0; i < spec_.children; ++i) {
      const double t = (branch.level == 0 ? 0.42 : 0.25) + 0.58 * (i + random()) / spec_.children;
      const double at = std::min(0.98, t) * static_cast<double>(path.size() - 1);
      const auto piece = static_cast<std::size_t>(at);
      const glm::dvec3 along = glm::normalize(path[piece + 1] - path[piece]);
      const glm::dvec3 side = glm::normalize(
          glm::cross(along, std::abs(along.y) < 0.8 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
      turn += kGoldenAngle;
      const glm::dvec3 outward = std::cos(turn) * side + std::sin(turn) * glm::cross(along, side);
      const double lean = 0.75 + 0.3 * random();
      addBranch({glm::mix(path[piece], path[piece + 1], at - static_cast<double>(piece)),
                 glm::normalize(std::cos(lean) * along + std::sin(lean) * outward),
                 branch.length * (0.62 - 0.2 * (t - 0.25)) * (0.8 + 0.4 * random()),
                 branch.radius * (0.5 - 0.2 * (t - 0.25)), branch.level + 1});
    }
    // The tip goes on as a branch of its own.
    addBranch({path.back(), glm::normalize(path.back() - path[path.size() - 2]), 0.5 * branch.length,
               0.26 * branch.radius, branch.level + 1});
  }

  /// Sprays of leaves along a twig.
  void addLeaves(const std::vector<glm::dvec3>& path) {
    constexpr int kSpray = 4;
    for (std::size_t i = 1; i < path.size(); ++i)
      for (int k = 0; k < kSpray; ++k) {
        const double angle = kGoldenAngle * static_cast<double>(count_), rise = 0.9 * random() - 0.35;
        const double length = spec_.height * (0.019 + 0.012 * random());
        const glm::dvec3 along = glm::normalize(glm::dvec3(std::cos(angle), rise, std::sin(angle)));
        const glm::dvec3 foot = glm::mix(path[i - 1], path[i], (k + random()) / kSpray);
        addLeaf(foot + 0.3 * length * along, along, length);
      }
  }

  /// Folded along the middle and bent down; two triangles to each side, rounded at both ends.
  void addLeaf(glm::dvec3 foot, glm::dvec3 along, double length) {
    const glm::dvec3 across = glm::normalize(glm::cross(along, glm::dvec3(0, 1, 0))),
                     up = glm::cross(across, along);
    const double width = 0.3 * length;
    const glm::dvec3 tip = foot + length * along - 0.18 * length * up;
    for (const double side : {1.0, -1.0}) {
      const auto edge = [&](double t, double out) {
        return foot + t * length * along + side * out * width * across + 0.25 * out * width * up;
      };
      const glm::vec3 normal(glm::normalize(up - 0.25 * side * across));
      const auto first = static_cast<std::uint32_t>(tree_.leaves.positions.size());
      for (const glm::dvec3& p : {foot, edge(0.28, 0.9), edge(0.62, 1.0), tip}) {
        tree_.leaves.positions.emplace_back(p);
        tree_.leaves.normals.push_back(normal);
      }
      for (const std::uint32_t k : {1U, 2U}) {
        const std::uint32_t b = side > 0 ? k : k + 1;
        tree_.leaves.indices.insert(tree_.leaves.indices.end(), {first, first + b, first + 2 * k + 1 - b});
      }
    }
  }

  const TreeSpec& spec_;
  Tree tree_;
  std::uint32_t count_ = 0;
};

}  // namespace

Tree growTree(const TreeSpec& spec) { return Growth(spec).grow(); }

Mesh makeTuft(int blades, double height, double radius, std::uint32_t series) {
  Mesh mesh;
  for (int i = 0; i < blades; ++i) {
    const auto id = static_cast<std::uint32_t>(i);
    const double angle = kGoldenAngle * i, far = radius * std::sqrt((i + 0.5) / blades),
                 tall = height * (0.55 + 0.45 * unitValue(series, id));
    const glm::dvec3 outward(std::cos(angle), 0, std::sin(angle)), across(-outward.z, 0, outward.x);
    const double bend = tall * (0.2 + 0.5 * unitValue(series + 1, id)), width = 0.035 * tall;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec3 normal(glm::normalize(outward + 0.8 * glm::dvec3(0, 1, 0)));
    for (const double t : {0.0, 0.45, 1.0}) {
      const glm::dvec3 spine = far * outward + glm::dvec3(0, tall * t, 0) + bend * t * t * outward;
      for (const double side : {-1.0, 1.0}) {
        if (t == 1 && side > 0) continue;  // a point
        mesh.positions.emplace_back(spine + side * (1 - t) * width * across);
        mesh.normals.push_back(normal);
      }
    }
    for (const std::uint32_t k : {0U, 1U, 3U, 0U, 3U, 2U, 2U, 3U, 4U}) mesh.indices.push_back(first + k);
  }
  return mesh;
}

}  // namespace generator
