// See scene_editor.h.
#include "view/scene_editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "view/edit_fields.h"

namespace whittle::view {
namespace {

constexpr std::size_t kSteps = 1000;  ///< of undo
constexpr const char* kPartWords[] = {"light", "material"};

/// light.0.intensity
struct Id {
  Part part = Part::Light;
  std::size_t index = 0;
  std::string field;
};
std::optional<Id> parsed(const std::string& id) {
  std::istringstream in(id);
  std::string part, number, field;
  if (!std::getline(in, part, '.') || !std::getline(in, number, '.') || !std::getline(in, field))
    return std::nullopt;
  Id out{part == kPartWords[0] ? Part::Light : Part::Material, 0, field};
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), out.index);
  if (error != std::errc{} || end != number.data() + number.size()) return std::nullopt;
  return out;
}

std::string idOf(Part part, std::size_t index, const char* field) {
  return fmt::format("{}.{}.{}", kPartWords[static_cast<std::size_t>(part)], index, field);
}

/// The edits of `old` on top of `now`, each field by itself.
template <typename T>
void carryOver(const T& old, const T& oldFile, T& now, const Origin& origin) {
  for (const Field<T>& f : fields(old))
    if (const Values v = f.get(old, origin); v != f.get(oldFile, origin)) f.set(now, v, origin);
}

/// The unit that glTF gives it.
const char* unitOf(const LightType& type) { return type.isPlaced ? "cd" : "lx"; }

}  // namespace

void SceneEditor::take(const Scene& scene, bool keeps) {
  const Appearance oldFile = std::exchange(ofFile_, appearanceOf(scene));
  const auto oldLights = std::exchange(lights_, {ofFile_.lights.begin(), ofFile_.lights.end()});
  const auto oldMaterials = std::exchange(materials_, ofFile_.materials);
  origin_ = scene.origin;
  steps_.clear();
  light_ = std::min(light_, lights_.size());
  material_ = std::min(material_, materials_.size());
  if (!keeps) return void(light_ = material_ = 0);
  std::size_t kept = 0, lost = 0;
  for (std::size_t i = 0; i < oldLights.size(); ++i) {
    const EditedLight before(oldFile.lights[i]);
    if (oldLights[i] == before) continue;
    const bool fits = i < lights_.size() && ofFile_.lights[i].name == oldFile.lights[i].name &&
                      ofFile_.lights[i].kind == oldFile.lights[i].kind;
    if (fits) carryOver(oldLights[i], before, lights_[i], origin_);
    ++(fits ? kept : lost);
  }
  for (std::size_t i = 0; i < oldMaterials.size(); ++i) {
    if (!differs(oldMaterials[i], oldFile.materials[i])) continue;
    const bool fits = i < materials_.size() && ofFile_.materials[i].name == oldFile.materials[i].name;
    if (fits) carryOver(oldMaterials[i], oldFile.materials[i], materials_[i], origin_);
    ++(fits ? kept : lost);
  }
  if (lost > 0)
    owner_.say(true,
               fmt::format("the file was read again: the edits of {} lights and materials are lost, whose "
                           "numbers have other names now",
                           lost));
  if (kept > 0)
    owner_.say(false,
               fmt::format("the file was read again: edits of {} lights and materials are kept", kept));
}

Appearance SceneEditor::appearance() const {
  Appearance now;
  for (std::size_t i = 0; i < lights_.size(); ++i)
    now.lights.push_back(lights_[i].asLight(ofFile_.lights[i]));
  now.materials = materials_;
  return now;
}

bool SceneEditor::isId(const std::string& id) {
  return std::any_of(std::begin(kPartWords), std::end(kPartWords),
                     [&](const char* word) { return id.starts_with(fmt::format("{}.", word)); });
}

std::string SceneEditor::value(const std::string& id) const {
  const auto at = parsed(id);
  const auto valueIn = [&](const auto& all) {
    const auto* const field = at->index < all.size() ? fieldOf(all[at->index], at->field) : nullptr;
    if (!field) throw std::invalid_argument(fmt::format("'{}' is no setting", id));
    return textOf(field->kind, field->get(all[at->index], origin_));
  };
  if (!at) throw std::invalid_argument(fmt::format("'{}' is no setting", id));
  return at->part == Part::Light ? valueIn(lights_) : valueIn(materials_);
}

std::string SceneEditor::set(const std::string& id, const std::string& text) {
  const auto at = parsed(id);
  const auto setIn = [&](auto& all, const auto& ofFile) -> std::string {
    using T = std::remove_cvref_t<decltype(all[0])>;
    const Field<T>* const field = at->index < all.size() ? fieldOf(all[at->index], at->field) : nullptr;
    if (!field) return fmt::format("'{}' is no setting of the window", id);
    const T& file = T(ofFile[at->index]);
    T now = all[at->index];
    try {
      const Values standard = field->get(file, origin_);
      const bool isStandard = text == textOf(field->kind, standard);
      field->set(now, isStandard ? standard : valuesOf(field->kind, text, standard.size()), origin_);
    } catch (const std::invalid_argument& e) {
      return fmt::format("{}: {}", id, e.what());
    }
    const std::string flaw = flawOf(now, all[at->index], ofFile[at->index]);
    if (!flaw.empty())
      return fmt::format("{} {}: {}", kPartWords[static_cast<std::size_t>(at->part)], at->index, flaw);
    remember(at->part, at->index, at->field);
    all[at->index] = now;
    owner_.edited();
    return {};
  };
  if (!at) return fmt::format("'{}' is no setting of the window", id);
  return at->part == Part::Light ? setIn(lights_, ofFile_.lights) : setIn(materials_, ofFile_.materials);
}

nlohmann::ordered_json SceneEditor::state() const {
  nlohmann::ordered_json out;
  for (const Part part : {Part::Light, Part::Material}) {
    auto things = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < count(part); ++i) {
      nlohmann::ordered_json thing{{"title", title(part, i)}, {"edited", isEdited(part, i)}};
      for (const Control& c : controls(part, i)) thing[c.id.substr(c.id.rfind('.') + 1)] = value(c.id);
      things.push_back(thing);
    }
    out[kPartWords[static_cast<std::size_t>(part)]] = things;
  }
  for (const Handle& h : handles()) {
    out["light"][h.light]["x"] = h.x;
    out["light"][h.light]["y"] = h.y;
  }
  out["chosenLight"] = light_;
  out["chosenMaterial"] = material_;
  out["steps"] = steps_.size();
  return out;
}

std::size_t SceneEditor::count(Part part) const {
  return part == Part::Light ? lights_.size() : materials_.size();
}

std::string SceneEditor::title(Part part, std::size_t index) const {
  const std::string& name =
      part == Part::Light ? ofFile_.lights.at(index).name : ofFile_.materials.at(index).name;
  return name.empty() ? std::to_string(index) : fmt::format("{} {}", index, name);
}

bool SceneEditor::isEdited(Part part, std::size_t index) const {
  return part == Part::Light ? !(lights_.at(index) == EditedLight(ofFile_.lights[index]))
                             : differs(materials_.at(index), ofFile_.materials[index]);
}

std::vector<Control> SceneEditor::controls(Part part, std::size_t index) const {
  std::vector<Control> controls;
  const auto add = [&](const auto& file, const auto& ofFile, const char* unit) {
    for (const auto& f : fields(file)) {
      if (f.isOf && !f.isOf(ofFile)) continue;
      Control c;
      c.id = idOf(part, index, f.id);
      c.label = f.label;
      if (c.label == "intensity") c.label = fmt::format("intensity, {}", unit);
      c.kind = f.kind;
      c.tip = f.tip;
      c.standard = textOf(f.kind, f.get(file, origin_));
      controls.push_back(std::move(c));
    }
  };
  if (index >= count(part)) return controls;
  if (part == Part::Light)
    add(EditedLight(ofFile_.lights[index]), ofFile_.lights[index],
        unitOf(typeOf(ofFile_.lights[index].kind)));
  else
    add(ofFile_.materials[index], ofFile_.materials[index], "");
  return controls;
}

std::size_t SceneEditor::chosen(Part part) const { return part == Part::Light ? light_ : material_; }

void SceneEditor::choose(Part part, std::size_t index) { (part == Part::Light ? light_ : material_) = index; }

void SceneEditor::remember(Part part, std::size_t index, const std::string& field) {
  const std::string id = idOf(part, index, field.c_str());
  if (isDragging_ && std::find(dragged_.begin(), dragged_.end(), id) != dragged_.end()) return;
  if (isDragging_) dragged_.push_back(id);
  if (steps_.size() == kSteps) steps_.erase(steps_.begin());
  const bool isLight = part == Part::Light;
  steps_.push_back({part, index, isLight ? lights_[index] : EditedLight(Light{}),
                    isLight ? Material{} : materials_[index]});
}

void SceneEditor::reset(Part part, std::size_t index) {
  if (index >= count(part) || !isEdited(part, index)) return;
  remember(part, index, "all");
  if (part == Part::Light)
    lights_[index] = EditedLight(ofFile_.lights[index]);
  else
    materials_[index] = ofFile_.materials[index];
  owner_.edited();
}

}  // namespace whittle::view
