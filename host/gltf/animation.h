// Animations (glTF 2.0, 3.11): where nodes are at a time, the weights of their morph targets, and whatever
// else channels by JSON pointer move (KHR_animation_pointer).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gltf/document.h"
#include "gltf/nodes.h"
#include "gltf/properties.h"
#include "scene/scene.h"

namespace whittle::gltf {

/// What a file, whose JSON is not checked yet, says of its list of animations. One that does not say how long
/// it is counts as 0 s long.
std::vector<AnimationFacts> animationsOf(const Json& file);

struct Posed {
  int animation = -1;  ///< its index; -1: the file has none
  Moved moved;         ///< by the animation itself
};

/// Gives what an animation moves the values that it has at `seconds`; before its first keyframe and after its
/// last one they are as there. Warns of what is not played. `wanted`: its name or index; unset: the first.
/// The document has kept the parts of its transforms. Throws InputError where there is no such animation, or
/// it cannot be read.
Posed poseDocument(Document& document, const std::optional<std::string>& wanted, double seconds);

/// What of that which is shown at some time moves.
struct Movement {
  bool meshes = false;        ///< or bends, changes its shape, comes or goes
  bool eyesOrLamps = false;   ///< cameras and lights
  std::set<int> materials{};  ///< those that change, by their numbers in the file
};
/// When these parts do, themselves, below a node that does, or by a joint of a skin. `materials`: of meshes.
Movement movementOf(const Document& document, const Hierarchy& hierarchy, const std::set<int>& materials,
                    Moved moved);

}  // namespace whittle::gltf
