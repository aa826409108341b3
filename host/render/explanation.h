// The ray trees of a pixel as text and as JSON: why it has the radiance that it has.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "render/render_session.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

struct Explanation {
  int x = 0, y = 0;            ///< the pixel, from the top left
  std::vector<RayTree> trees;  ///< of its samples
};

/// What an impulse does at the surface that it comes from.
enum class Passage { Reflected, Refracted, Straight };
Passage passageOf(const RayRecord& ray, const RayRecord& parent);
/// What the ray adds to its sample: throughput times radiance.
glm::dvec3 shareOf(const RayRecord& ray);
/// Over all rays of a tree.
glm::dvec3 sumOf(const RayTree& tree);

/// "reflected: \"white\"": what the ray is and what it meets.
std::string rayTitle(const RayTree& tree, std::size_t index, const Scene& scene);
/// One ray in lines, the first its title; without its children.
std::vector<std::string> rayLines(const RayTree& tree, std::size_t index, const Scene& scene);
/// Children indented below their parents; at most 80 columns, but for names and what lies deep.
std::string explanationText(const Explanation& explanation, const Scene& scene, const Settings& settings);
nlohmann::ordered_json explanationToJson(const Explanation& explanation, const Scene& scene);

}  // namespace whittle
