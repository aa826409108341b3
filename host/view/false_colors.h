// What a picture is made of, as colours for people: depth, normals, albedo, primitives, samples.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/image_io.h"
#include "render/renderer.h"

namespace whittle::view {

/// What a window can show in the place of radiance, in the order of a list; the first is radiance itself.
inline const std::vector<std::string> kLayers{"beauty", "depth", "normal", "albedo", "primitive", "samples"};

/// Codes of a layer, RGBA, width·height·4. depth: near white to far black on a logarithmic scale between the
/// nearest and the farthest, nothing blue; normal: (n + 1) / 2, nothing black; albedo: sRGB; primitive: a
/// colour for each; samples: black to white for the most. Throws std::out_of_range where the result has no
/// such layer.
std::vector<std::uint8_t> falseColors(const RenderResult& result, const std::string& layer);

}  // namespace whittle::view
