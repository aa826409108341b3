// What JSON takes in memory: a text of two bytes for a value becomes tens of them.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace whittle::gltf {

/// What a parser would make of a text, counted without one.
struct JsonShape {
  std::uint64_t bytes = 0;  ///< parsed, roughly
  bool isTooDeep = false;   ///< brackets nested deeper than any glTF needs: parsers and destructors recurse
};
JsonShape shapeOf(std::string_view text);

/// Of parsed JSON, roughly.
std::uint64_t bytesOf(const nlohmann::json& json);

}  // namespace whittle::gltf
