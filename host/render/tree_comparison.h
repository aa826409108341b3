// The rays of one sample as two computed them, the kernels in single precision and the reference in double:
// which of them are the same ray, and where the two part by more than rounding.
#pragma once

#include <optional>
#include <vector>

#include "scene/ray_tree.h"

namespace whittle {

/// What there is to say of a ray besides its shadow rays.
enum class Aspect : std::uint8_t { Path, Throughput, Hit, Local, Ended, Share };

/// Whether the two say the same, but for rounding.
bool agree(Aspect aspect, const RayRecord& kernels, const RayRecord& reference);
/// The same of shadow rays to one light; `ray`: the kernels' that the first is of.
bool agree(const ShadowRecord& kernels, const ShadowRecord& reference, const RayRecord& ray);
/// Its shadow ray to that light; null: it has none.
const ShadowRecord* shadowTo(std::uint32_t light, const RayRecord& ray);

/// The first ray that differs, in the order of the kernels' rays.
struct Parting {
  enum class What : std::uint8_t { Path, Throughput, Hit, Local, Shadow, Ended, Missing, Additional };
  std::size_t ray = 0;  ///< of the kernels' tree; Additional: of which the reference alone has a child
  What what = What::Path;
  std::uint32_t light = 0;  ///< Shadow: of the scene's
};

struct TreeComparison {
  std::vector<int> partner;  ///< of each of the kernels' rays, in the reference's tree; −1: it has none
  std::vector<std::size_t> alone;  ///< rays of the reference without a partner whose parents have one
  std::optional<Parting> parting;  ///< nothing: no difference beyond rounding
};

/// Rays are the same that do the same (Passage) at the same ray.
TreeComparison compareTrees(const RayTree& kernels, const RayTree& reference);

}  // namespace whittle
