// Builds and searches the reference's own tree. The build runs its two halves in parallel; which node gets
// which number may then differ from run to run, but what a ray meets does not depend on it.
#include "reference/triangle_index.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>

namespace whittle::reference {
namespace {

constexpr int kBins = 16;
constexpr std::uint32_t kLeafTriangles = 4;
constexpr std::uint32_t kParallelTriangles = 4096;
constexpr int kMaxSahDepth = 64;  // below it halves by number: at most 32 levels more

struct Split {
  double cost = std::numeric_limits<double>::infinity();
  int axis = -1;
  int bin = 0;  ///< entries of bins below it go left
};

int binOf(double centre, double lo, double hi) {
  return std::clamp(static_cast<int>(kBins * ((centre - lo) / (hi - lo))), 0, kBins - 1);
}

/// The cheapest of the planes between bins along `axis`: area · number on both sides.
template <class Entries>
Split bestSplit(const Entries& entries, std::uint32_t begin, std::uint32_t end, const Box& centres,
                int axis) {
  std::array<Box, kBins> boxes;
  std::array<std::uint32_t, kBins> counts{};
  for (std::uint32_t i = begin; i < end; ++i) {
    const int bin = binOf(entries[i].centre[axis], centres.lo[axis], centres.hi[axis]);
    boxes[bin].grow(entries[i].box);
    ++counts[bin];
  }
  std::array<double, kBins> rightCost{};
  Box right;
  std::uint32_t rightCount = 0;
  for (int bin = kBins - 1; bin > 0; --bin) {
    right.grow(boxes[bin]);
    rightCount += counts[bin];
    rightCost[bin] = rightCount > 0 ? right.halfArea() * rightCount : std::numeric_limits<double>::infinity();
  }
  Split best;
  Box left;
  std::uint32_t leftCount = 0;
  for (int bin = 1; bin < kBins; ++bin) {
    left.grow(boxes[bin - 1]);
    leftCount += counts[bin - 1];
    if (leftCount == 0) continue;
    const double cost = left.halfArea() * leftCount + rightCost[bin];
    if (cost < best.cost) best = {cost, axis, bin};
  }
  return best;
}

}  // namespace

TriangleIndex::TriangleIndex(const Scene& scene) : scene_(&scene) {
  std::vector<Entry> entries;
  entries.reserve(scene.triangles.size());
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const auto [p0, p1, p2] = corners(i);
    const Vec3 normal = glm::cross(p1 - p0, p2 - p0);
    if (!isFinite(normal) || normal == Vec3(0)) continue;
    Box box;
    for (const Vec3& p : {p0, p1, p2}) box.grow(p);
    entries.push_back({box, 0.5 * (box.lo + box.hi), i});
  }
  nodes_.resize(std::max<std::size_t>(1, 2 * entries.size()));
  order_.resize(entries.size());
  if (!entries.empty()) build(entries, 0, 0, static_cast<std::uint32_t>(entries.size()), 0);
}

std::array<Vec3, 3> TriangleIndex::corners(std::uint32_t triangle) const {
  const Triangle& t = scene_->triangles[triangle];
  return {Vec3(scene_->positions[t.v0]), Vec3(scene_->positions[t.v1]), Vec3(scene_->positions[t.v2])};
}

void TriangleIndex::build(std::vector<Entry>& entries, std::uint32_t node, std::uint32_t begin,
                          std::uint32_t end, int depth) {
  Box centres;
  for (std::uint32_t i = begin; i < end; ++i) {
    nodes_[node].box.grow(entries[i].box);
    centres.grow(entries[i].centre);
  }
  const std::uint32_t count = end - begin;
  if (count <= kLeafTriangles) {
    nodes_[node].first = begin;
    nodes_[node].count = count;
    for (std::uint32_t i = begin; i < end; ++i) order_[i] = entries[i].triangle;
    return;
  }
  Split split;
  for (int axis = 0; axis < 3 && depth < kMaxSahDepth; ++axis) {
    if (!(centres.hi[axis] > centres.lo[axis])) continue;
    const Split found = bestSplit(entries, begin, end, centres, axis);
    if (found.cost < split.cost) split = found;
  }
  std::uint32_t middle = begin + count / 2;
  if (split.axis >= 0) {
    const auto left = [&](const Entry& e) {
      return binOf(e.centre[split.axis], centres.lo[split.axis], centres.hi[split.axis]) < split.bin;
    };
    middle = static_cast<std::uint32_t>(std::partition(entries.begin() + begin, entries.begin() + end, left) -
                                        entries.begin());
  }
  const std::uint32_t children = nodeCount_.fetch_add(2);
  nodes_[node].first = children;
  const auto buildLeft = [&] { build(entries, children, begin, middle, depth + 1); };
  const auto buildRight = [&] { build(entries, children + 1, middle, end, depth + 1); };
  if (count > kParallelTriangles) {
    tbb::parallel_invoke(buildLeft, buildRight);
  } else {
    buildLeft();
    buildRight();
  }
}

std::optional<Hit> TriangleIndex::nearestHitBruteForce(const Ray& ray) const {
  std::optional<Hit> best;
  visitHitsBruteForce(ray, std::numeric_limits<double>::infinity(), [&](const Hit& hit) {
    if (!best || hit.t < best->t || (hit.t == best->t && hit.triangle < best->triangle)) best = hit;
    return best->t;
  });
  return best;
}

TriangleIndex::BoxRay::BoxRay(const Ray& ray, const Box& scene) : origin(ray.origin) {
  // Coordinates relative to the origin, and the sheared ones, are off by a few units in the last place of the
  // farthest: 16 ulp is generous.
  slack = 16 * std::numeric_limits<double>::epsilon() *
          maxComponent(glm::max(glm::abs(scene.lo - origin), glm::abs(scene.hi - origin)));
  for (int axis = 0; axis < 3; ++axis) {
    parallel[axis] = std::abs(ray.direction[axis]) < 1e-300;
    inverse[axis] = 1.0 / ray.direction[axis];
  }
}

bool TriangleIndex::BoxRay::meets(const Box& box, double tMax, double& tNear) const {
  tNear = 0;
  double tFar = tMax;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = box.lo[axis] - origin[axis] - slack;
    const double hi = box.hi[axis] - origin[axis] + slack;
    if (parallel[axis]) {
      if (lo > 0 || hi < 0) return false;
      continue;
    }
    const bool forward = inverse[axis] > 0;
    tNear = std::max(tNear, (forward ? lo : hi) * inverse[axis]);
    tFar = std::min(tFar, (forward ? hi : lo) * inverse[axis]);
  }
  constexpr double kWiden = 1 + 1e-15 * 8;  // rounding of the two quotients (Ize 2013)
  return tNear <= tFar * kWiden;
}

}  // namespace whittle::reference
