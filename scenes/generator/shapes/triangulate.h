// Triangles of a polygon with holes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace generator {

/// `loops`: the outer one, counter-clockwise, then holes, clockwise, none of which touch. The triangles are
/// counter-clockwise and use every point of the loops and no other; they count through the loops in order.
/// Throws std::logic_error where none is left to cut off, as in a loop that runs the wrong way or crosses
/// itself.
std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<std::vector<glm::dvec2>>& loops);

}  // namespace generator
