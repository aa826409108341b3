// Animations (glTF 2.0, 3.11): where nodes are at a time, and the weights of their morph targets. Channels by
// JSON pointer (KHR_animation_pointer) are left out with a warning.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gltf/document.h"
#include "gltf/nodes.h"
#include "scene/scene.h"

namespace whittle::gltf {

/// What a file, whose JSON is not checked yet, says of its list of animations. One that does not say how long
/// it is counts as 0 s long.
std::vector<AnimationFacts> animationsOf(const Json& file);

struct Posed {
  int animation = -1;       ///< its index; -1: the file has none
  std::vector<bool> moved;  ///< [node] the animation itself moves it
};

/// Puts the nodes of the file where an animation has them at `seconds`; before its first keyframe and after
/// its last one they are as there. `wanted`: its name or index; unset: the first. The document has kept the
/// parts of its transforms. Throws InputError where there is no such animation, or it cannot be read.
Posed poseNodes(Document& document, const std::optional<std::string>& wanted, double seconds);

/// What of that which is shown moves.
struct Movement {
  bool meshes = false;       ///< or bends, or changes its shape
  bool eyesOrLamps = false;  ///< cameras and lights
};
/// When these nodes do: with them, below them, or by a joint of its skin.
Movement movementOf(const Document& document, const Hierarchy& hierarchy, std::vector<bool> moved);

}  // namespace whittle::gltf
