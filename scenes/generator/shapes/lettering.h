// Text as relief: letters drawn with a round stroke on the ground, half of it above.
#pragma once

#include <string_view>

#include "mesh.h"

namespace generator {

/// `text` (capitals, digits, space, point, hyphen; anything else throws std::logic_error) along +X on y = 0
/// with its top towards -Z, its middle at the origin, `height` tall, of strokes `stroke` wide.
Mesh makeText(std::string_view text, double height, double stroke);

/// The same bent around +Y: its base line is the circle of `radius`, read from outside at the top.
Mesh makeTextOnCircle(std::string_view text, double height, double stroke, double radius);

}  // namespace generator
