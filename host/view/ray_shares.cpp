// See ray_shares.h.
#include "view/ray_shares.h"

#include <algorithm>
#include <numeric>

namespace whittle::view {

RayShares sharesOf(const RayTree& tree) {
  const auto& rays = tree.rays;
  const std::size_t count = rays.size();
  RayShares shares{std::vector<double>(count), std::vector<double>(count), std::vector<std::size_t>(count),
                   std::vector<bool>(count)};
  if (count == 0) return shares;
  std::vector<glm::dvec3> below(count);
  for (std::size_t i = 0; i < count; ++i) below[i] = shareOf(rays[i]);
  // Parents come before their children.
  for (std::size_t i = count; i-- > 0;)
    if (rays[i].parent >= 0) below[static_cast<std::size_t>(rays[i].parent)] += below[i];
  const auto brightness = [](const glm::dvec3& c) { return std::max({0.0, c.x, c.y, c.z}); };
  const double all = brightness(sumOf(tree));
  for (std::size_t i = 0; i < count && all > 0.0; ++i) {
    shares.own[i] = brightness(shareOf(rays[i])) / all;
    shares.below[i] = brightness(below[i]) / all;
  }
  auto& order = shares.largestFirst;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return shares.own[a] > shares.own[b]; });
  for (int i = static_cast<int>(order[0]); i >= 0; i = rays[static_cast<std::size_t>(i)].parent)
    shares.leadsToLargest[static_cast<std::size_t>(i)] = true;
  return shares;
}

}  // namespace whittle::view
