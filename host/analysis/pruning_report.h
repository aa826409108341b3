// What of a scene stays on the host, counted, with reasons: `whittle info` prints
// it, the statistics carry it.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace whittle {

struct DroppedLight {
  std::uint32_t index = 0;  ///< into Scene::lights
  std::string name;
  std::string reason;  ///< why it lights nothing
};

/// Counts of the scene's things. What is neither left out nor alike goes to the device.
struct PruningReport {
  struct Things {
    std::uint64_t all = 0;     ///< in the scene
    std::uint64_t unused = 0;  ///< nothing that is rendered reads them
    std::uint64_t alike = 0;   ///< the same as one that stays
    std::uint64_t kept() const { return all - unused - alike; }
  };
  Things materials, images, vertices;  ///< vertices: none alike; none unused where no attribute is uploaded
  std::uint64_t lights = 0;            ///< in the scene
  std::vector<DroppedLight> droppedLights;
  std::uint64_t needlessMasks = 0;   ///< used materials that are masked but nowhere cut out
  std::uint64_t needlessBlends = 0;  ///< used materials that are blended but nowhere let light through
};

/// The same in the statistics file and in `whittle info --json`.
nlohmann::ordered_json pruningToJson(const PruningReport& pruning);

}  // namespace whittle
