// The properties of a glTF file that Whittle reads, and what each must look like.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace whittle::gltf {

enum class Kind { Index, Size, Number, Flag, Text, Texts, Numbers, Indices, Object, Objects, Map, Maps, Raw };

struct Field {
  const char* key;
  Kind kind;
  const char* target = nullptr;        ///< indices: the array they refer to
  std::span<const Field> fields = {};  ///< objects
  std::size_t length = 0;              ///< numbers: exactly so many; 0: any
  std::span<const int> oneOf = {};     ///< indices without a target: the legal values; empty: any
  bool isRequired = false;
  bool isForgiven = false;  ///< a flaw within costs a warning and the property, not the file
  std::size_t least = 0;  ///< numbers, forgiven: so many will do, 1 stands for those that are missing; 0: all
};

/// The members of the file's root object; everything else hangs on them.
std::span<const Field> rootFields();
/// An object with a list of animations, which are checked when one is to be played.
std::span<const Field> animationFields();
/// Whether some object's "extensions" may hold this one.
bool readsExtension(std::string_view name);

}  // namespace whittle::gltf
