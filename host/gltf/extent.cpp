// Boxes around points.
#include "gltf/extent.h"

#include <algorithm>
#include <cmath>

#include "gltf/accessor.h"

namespace whittle::gltf {

void Extent::grow(const glm::dvec3& p) {
  if (!(glm::length(p) < 1e30)) return;
  lo = glm::min(lo, p);
  hi = glm::max(hi, p);
}

void Extent::grow(const Extent& other) {
  lo = glm::min(lo, other.lo);
  hi = glm::max(hi, other.hi);
}

double Extent::farthest() const {
  double most = 0.0;
  for (int axis = 0; axis < 3 && !isEmpty(); ++axis)
    most = std::max({most, std::abs(lo[axis]), std::abs(hi[axis])});
  return most;
}

const Extent& Extents::of(int accessor) {
  const auto [at, isNew] = known_.try_emplace(accessor);
  Extent& extent = at->second;
  if (!isNew || componentCount(accessorAt(document_, accessor)) != 3) return extent;  // refused later
  const std::vector<float> values = readFloats(document_, accessor);
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    extent.grow(glm::dvec3(values[i], values[i + 1], values[i + 2]));
  return extent;
}

}  // namespace whittle::gltf
