// The ray trees of a pixel as text and as JSON: why it has the radiance that it has.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "render/tree_comparison.h"
#include "scene/ray_tree.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// Samples that a text tells ray by ray.
inline constexpr std::size_t kToldSamples = 4;

struct Explanation {
  int x = 0, y = 0;                ///< the pixel, from the top left
  std::vector<RayTree> trees;      ///< of its samples, the kernels'
  std::vector<RayTree> reference;  ///< of the same samples in double precision; empty: nobody asked
};

/// What the reference has of a sample, and how the kernels' tree compares with it.
struct Beside {
  const RayTree& reference;
  const TreeComparison& comparison;
};

struct RayLine {
  std::string text;
  bool parts = false;  ///< what the reference has instead
};

/// "[2] reflected: \"white\"": its number, what the ray is and what it meets.
std::string rayTitle(const RayTree& tree, std::size_t index, const Scene& scene);
/// One ray in lines, the first its number, kind and path; without its children. With `beside`, below each
/// line that the reference has otherwise the reference's.
std::vector<RayLine> rayLines(const RayTree& tree, std::size_t index, const Scene& scene,
                              const Beside* beside = nullptr);
/// "reference: 1 1 1; the kernels 1 1 1; no difference beyond rounding", or where they part.
std::string verdict(const RayTree& tree, const Beside& beside, const Scene& scene);
/// Children indented below their parents; at most 80 columns, but for names, what lies deep and the
/// reference.
std::string explanationText(const Explanation& explanation, const Scene& scene, const Settings& settings);
nlohmann::ordered_json explanationToJson(const Explanation& explanation, const Scene& scene);

}  // namespace whittle
