// What an animation may move: the properties that are read, by their place in the file. Pointers follow
// KHR_animation_pointer and the glTF 2.0 Asset Object Model.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gltf/document.h"

namespace whittle::gltf {

/// Which parts of a file an animation moves.
struct Moved {
  std::vector<bool> nodes;                        ///< [node]; shown or hidden counts
  std::set<int> meshes;                           ///< their weights, for nodes without their own
  std::set<int> cameras, lights, materials = {};  ///< their numbers
  bool tangents = false;                          ///< how a material's textures lie on its meshes
};

struct Property {
  enum class Type {
    Number,
    Vector,  ///< of `width` numbers
    Turn,    ///< a quaternion
    List,    ///< of as many numbers as each keyframe has
    Flag
  };
  Type type = Type::Number;
  std::size_t width = 1;  ///< 0: a list
  /// Puts values into the document. They are in range of nothing: whoever reads them checks.
  std::function<void(const std::vector<double>&)> set;
};

struct FoundProperty {
  std::optional<Property> property;
  std::string whyNot = {};  ///< where there is none: "unknown", say
};

/// The property that a JSON pointer means, noted in `moved`. The document has kept the parts of its
/// transforms. It must be in the file, or have a default value and stand in an object of the file.
FoundProperty propertyAt(Document& document, const std::string& pointer, Moved& moved);

}  // namespace whittle::gltf
