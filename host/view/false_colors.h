// What a picture is made of, as colours for people: depth, normals, albedo, …, error, cost.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/image_io.h"
#include "render/renderer.h"
#include "view/color_scale.h"

namespace whittle::view {

/// What a window shows if nobody asks for another layer: radiance. The others are kAovNames.
inline constexpr const char* kBeauty = "beauty";

struct FalseColors {
  std::vector<std::uint8_t> codes;  ///< RGBA, width·height·4
  std::optional<ColorScale> scale;  ///< what the colours mean, where they are a ramp
};

/// A layer of a result. depth: near white to far black on a logarithmic scale between the
/// nearest and the farthest, nothing blue; normal: (n + 1) / 2, nothing black; albedo: sRGB; primitive: a
/// colour for each; samples: black to white for the most; error and cost (nodes and triangles together) on a
/// logarithmic ramp; bounce on a linear one from 1, nothing black. Throws std::out_of_range where the result
/// has no such layer.
FalseColors falseColors(const RenderResult& result, const std::string& layer);

}  // namespace whittle::view
