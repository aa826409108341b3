// See tree_comparison.h.
#include "render/tree_comparison.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace whittle {
namespace {

/// The share of a value's size that rounding may make of it. An operation rounds by 2^-24; those of one ray,
/// in a row, come to some 2^-20 (1e-6), and each curved surface magnifies what was before it by the distance
/// over its radius. Of all rays of our scenes, six bounces deep, those that met the same are off by 1e-4 at
/// most; this is twice as much, and a sixteenth of the step of an 8-bit code.
constexpr double kRounding = 0x1p-12;
/// What arrives is the difference of two of the kernels' sums of radiance; this share of them is their
/// rounding.
constexpr double kRoundingOfSum = 0x1p-22;

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

bool isClose(const glm::dvec3& a, const glm::dvec3& b, double size) {
  return largest(a - b) <= kRounding * size;
}
bool isClose(const glm::dvec3& a, const glm::dvec3& b) {
  return isClose(a, b, std::max(largest(a), largest(b)));
}

/// The neighbour of a triangle, met in the edge that both have, is no other surface.
bool isSameHit(const RayRecord& a, const RayRecord& b) {
  if (!a.hit || !b.hit) return !a.hit && !b.hit;
  const double size = std::max(largest(b.hit->position), glm::distance(b.hit->position, b.origin));
  return a.hit->material == b.hit->material && isClose(a.hit->position, b.hit->position, size) &&
         isClose(a.hit->normal, b.hit->normal, 1);
}

bool haveSameEnds(const RayRecord& a, const RayRecord& b) {
  return std::equal(a.ended.begin(), a.ended.end(), b.ended.begin(), b.ended.end(),
                    [](const EndedRecord& x, const EndedRecord& y) {
                      return x.byCutoff == y.byCutoff &&
                             std::abs(x.throughput - y.throughput) <= kRounding * y.throughput;
                    });
}

std::optional<std::uint32_t> partedLight(const RayRecord& kernels, const RayRecord& reference) {
  for (const auto& s : kernels.shadows) {
    const ShadowRecord* const other = shadowTo(s.light, reference);
    if (!other || !agree(s, *other, kernels)) return s.light;
  }
  for (const auto& s : reference.shadows)
    if (!shadowTo(s.light, kernels)) return s.light;
  return std::nullopt;
}

/// [ray] its children, in order.
std::vector<std::vector<std::size_t>> childrenOf(const RayTree& tree) {
  std::vector<std::vector<std::size_t>> children(tree.rays.size());
  for (std::size_t i = 0; i < tree.rays.size(); ++i)
    if (tree.rays[i].parent >= 0) children[static_cast<std::size_t>(tree.rays[i].parent)].push_back(i);
  return children;
}

/// Pairs the children of two rays that are the same; returns the reference's that are left over.
std::vector<std::size_t> pairChildren(const RayTree& kernels, const std::vector<std::size_t>& of,
                                      const RayTree& reference, std::vector<std::size_t> others,
                                      std::vector<int>& partner) {
  const auto passage = [](const RayTree& tree, std::size_t i) {
    return passageOf(tree.rays[i], tree.rays[static_cast<std::size_t>(tree.rays[i].parent)]);
  };
  for (const std::size_t child : of) {
    const auto same = std::find_if(others.begin(), others.end(), [&](std::size_t other) {
      return passage(reference, other) == passage(kernels, child);
    });
    if (same == others.end()) continue;
    partner[child] = static_cast<int>(*same);
    others.erase(same);
  }
  return others;
}

std::optional<Parting> partingAt(std::size_t i, const RayRecord& kernels, const RayRecord& reference) {
  using What = Parting::What;
  for (const auto& [aspect, what] :
       {std::pair(Aspect::Path, What::Path), std::pair(Aspect::Throughput, What::Throughput),
        std::pair(Aspect::Hit, What::Hit), std::pair(Aspect::Local, What::Local)})
    if (!agree(aspect, kernels, reference)) return Parting{i, what};
  if (const auto light = partedLight(kernels, reference)) return Parting{i, What::Shadow, *light};
  if (!agree(Aspect::Ended, kernels, reference)) return Parting{i, What::Ended};
  return std::nullopt;
}

}  // namespace

bool agree(Aspect aspect, const RayRecord& a, const RayRecord& b) {
  switch (aspect) {
    case Aspect::Path:
      return isClose(a.origin, b.origin) && isClose(a.direction, b.direction, 1);
    case Aspect::Throughput:
      return isClose(a.throughput, b.throughput);
    case Aspect::Hit:
      return isSameHit(a, b);
    case Aspect::Local:
      return isClose(a.local, b.local);
    case Aspect::Ended:
      return haveSameEnds(a, b);
    case Aspect::Share:
      return isClose(shareOf(a), shareOf(b));
  }
  return true;
}

bool agree(const ShadowRecord& a, const ShadowRecord& b, const RayRecord& ray) {
  const double size = std::max(largest(a.contribution), largest(b.contribution));
  return isClose(a.contribution, b.contribution) &&
         largest(a.arrived - b.arrived) <= kRounding * size + kRoundingOfSum * largest(ray.radiance);
}

const ShadowRecord* shadowTo(std::uint32_t light, const RayRecord& ray) {
  const auto found = std::find_if(ray.shadows.begin(), ray.shadows.end(),
                                  [&](const ShadowRecord& s) { return s.light == light; });
  return found == ray.shadows.end() ? nullptr : &*found;
}

TreeComparison compareTrees(const RayTree& kernels, const RayTree& reference) {
  TreeComparison c;
  c.partner.assign(kernels.rays.size(), -1);
  if (kernels.rays.empty() || reference.rays.empty()) return c;
  const auto children = childrenOf(kernels), others = childrenOf(reference);
  c.partner[0] = 0;
  for (std::size_t i = 0; i < kernels.rays.size(); ++i) {
    const RayRecord& ray = kernels.rays[i];
    std::optional<Parting> parting;
    if (c.partner[i] < 0) {
      parting = Parting{i, Parting::What::Missing};
    } else {
      const auto j = static_cast<std::size_t>(c.partner[i]);
      parting = partingAt(i, ray, reference.rays[j]);
      const auto left = pairChildren(kernels, children[i], reference, others[j], c.partner);
      c.alone.insert(c.alone.end(), left.begin(), left.end());
      if (!parting && !left.empty()) parting = Parting{i, Parting::What::Additional};
    }
    if (!c.parting) c.parting = parting;
  }
  return c;
}

}  // namespace whittle
