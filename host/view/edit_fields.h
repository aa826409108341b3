// The values of lights and materials that a hand may edit: names, tips, texts there and back, and what makes
// no sense.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "scene/scene.h"
#include "view/edited_light.h"
#include "view/view_model.h"

namespace whittle::view {

using Values = std::vector<double>;
using Origin = glm::dvec3;  ///< Scene::origin

/// What a T is in the scene.
template <typename T>
using FileOf = std::conditional_t<std::is_same_v<T, EditedLight>, Light, Material>;

/// One editable value of a T: numbers as a user reads them.
template <typename T>
struct Field {
  const char *id, *label, *tip;
  Control::Kind kind;
  Values (*get)(const T&, const Origin&);
  void (*set)(T&, const Values&, const Origin&);
  bool (*isOf)(const FileOf<T>&) = nullptr;  ///< whether a light or material of the file has it; null: all do
};

/// In the order in which a window shows them; ids are those behind "light.0." and "material.0.".
const std::vector<Field<EditedLight>>& fields(const EditedLight&);
const std::vector<Field<Material>>& fields(const Material&);

/// Null: there is none.
template <typename T>
const Field<T>* fieldOf(const T& thing, const std::string& id) {
  for (const Field<T>& f : fields(thing))
    if (f.id == id) return &f;
  return nullptr;
}

std::string textOf(Control::Kind kind, const Values& values);
/// As many numbers as `count`; throws std::invalid_argument with what is wrong.
Values valuesOf(Control::Kind kind, const std::string& text, std::size_t count);

/// What is wrong with it as it would be, without its label; empty: nothing. What the file had wrong before is
/// left to it.
std::string flawOf(const EditedLight& now, const EditedLight& before, const Light& ofFile);
std::string flawOf(const Material& now, const Material& before, const Material& ofFile);

}  // namespace whittle::view
