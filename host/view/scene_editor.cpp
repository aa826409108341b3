// See scene_editor.h.
#include "view/scene_editor.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "scene/material_factors.h"
#include "scene/ranges.h"

namespace whittle::view {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::size_t kSteps = 1000;  ///< of undo
constexpr const char* kPartWords[] = {"light", "material"};

using Kind = Control::Kind;
using Values = std::vector<double>;
using Origin = glm::dvec3;

/// One editable value of a T: numbers as a user reads them.
template <typename T>
struct Field {
  const char *id, *label, *tip;
  Kind kind;
  Values (*get)(const T&, const Origin&);
  void (*set)(T&, const Values&, const Origin&);
  bool (*isOf)(const LightType&) = nullptr;  ///< of lights; null: of all
};

Values listOf(const auto& v) { return {v.x, v.y, v.z}; }
glm::dvec3 vectorOf(const Values& v) { return {v[0], v[1], v[2]}; }

const std::vector<Field<EditedLight>>& fields(const EditedLight&) {
  using L = EditedLight;
  static const std::vector<Field<L>> all{
      {"on", "on", "off: saved with intensity 0", Kind::Switch,
       [](const L& l, const Origin&) { return Values{l.isOn ? 1.0 : 0.0}; },
       [](L& l, const Values& v, const Origin&) { l.isOn = v[0] != 0.0; }},
      {"intensity", "intensity", "of the brightest channel; candela or lux where the scene is photometric",
       Kind::Amount, [](const L& l, const Origin&) { return Values{l.intensity}; },
       [](L& l, const Values& v, const Origin&) { l.intensity = v[0]; }},
      {"color", "colour", "linear red, green, blue", Kind::Color,
       [](const L& l, const Origin&) { return listOf(l.color); },
       [](L& l, const Values& v, const Origin&) { l.color = vectorOf(v); }},
      {"inner-cone", "inner cone, °", "half angle: full intensity inside", Kind::Amount,
       [](const L& l, const Origin&) { return Values{l.innerConeAngle / kDegree}; },
       [](L& l, const Values& v, const Origin&) { l.innerConeAngle = v[0] * kDegree; },
       [](const LightType& t) { return t.hasCone; }},
      {"outer-cone", "outer cone, °", "half angle: dark outside", Kind::Amount,
       [](const L& l, const Origin&) { return Values{l.outerConeAngle / kDegree}; },
       [](L& l, const Values& v, const Origin&) { l.outerConeAngle = v[0] * kDegree; },
       [](const LightType& t) { return t.hasCone; }},
      {"position", "position, m", "x,y,z of the file; or drag the handle over the picture", Kind::Text,
       [](const L& l, const Origin& origin) { return listOf(glm::dvec3(l.position) + origin); },
       [](L& l, const Values& v, const Origin& origin) { l.position = glm::vec3(vectorOf(v) - origin); },
       [](const LightType& t) { return t.isPlaced; }}};
  return all;
}

/// A factor of materials that is one number.
template <float Material::*factor>
Field<Material> numberField(const char* id, const char* label, const char* tip, Kind kind) {
  return {id,
          label,
          tip,
          kind,
          [](const Material& m, const Origin&) { return Values{static_cast<double>(m.*factor)}; },
          [](Material& m, const Values& v, const Origin&) { m.*factor = static_cast<float>(v[0]); }};
}

const std::vector<Field<Material>>& fields(const Material&) {
  using M = Material;
  static const std::vector<Field<M>> all{
      {"base-color", "base colour", "linear red, green, blue; multiplies the texture", Kind::Color,
       [](const M& m, const Origin&) { return listOf(glm::vec3(m.baseColor)); },
       [](M& m, const Values& v, const Origin&) {
         m.baseColor = {glm::vec3(vectorOf(v)), m.baseColor.a};
       }},
      numberField<&M::metallic>("metallic", "metallic", "multiplies the texture", Kind::Share),
      numberField<&M::roughness>(
          "roughness", "roughness",
          "below --mirror-roughness it is a mirror or clear glass; multiplies the texture", Kind::Share),
      numberField<&M::transmission>("transmission", "transmission", "multiplies the texture", Kind::Share),
      numberField<&M::ior>("ior", "ior", "inside over outside", Kind::Amount),
      {"emission", "emission", "red, green, blue, W/(m² sr); multiplies the texture", Kind::Text,
       [](const M& m, const Origin&) { return listOf(m.emission); },
       [](M& m, const Values& v, const Origin&) { m.emission = glm::vec3(vectorOf(v)); }}};
  return all;
}

std::string textOf(Kind kind, const Values& values) {
  if (kind == Kind::Switch) return values[0] != 0.0 ? "on" : "off";
  std::vector<std::string> numbers;
  for (const double v : values) numbers.push_back(fmt::format("{:.7g}", v));
  return fmt::format("{}", fmt::join(numbers, ","));
}

/// As many numbers as `count`; throws std::invalid_argument with what is wrong.
Values valuesOf(Kind kind, const std::string& text, std::size_t count) {
  if (kind == Kind::Switch) {
    if (text != "on" && text != "off")
      throw std::invalid_argument(fmt::format("'{}' is not one of on|off", text));
    return {text == "on" ? 1.0 : 0.0};
  }
  Values values;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, ',');) {
    const auto isBlank = [](char c) { return c == ' '; };
    word.erase(std::remove_if(word.begin(), word.end(), isBlank), word.end());
    double v = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), v);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(v))
      throw std::invalid_argument(fmt::format("'{}' is no number", word));
    values.push_back(v);
  }
  if (values.size() != count)
    throw std::invalid_argument(
        fmt::format("'{}' is not {}", text, count == 1 ? "a number" : "three numbers"));
  return values;
}

/// Of a light as it would be, without its label.
std::string flawOf(const EditedLight& now, const EditedLight&, const Light& ofFile) {
  // Off, its intensity is still one to come back to.
  const std::string flaw = intensityFlaw(glm::vec3(now.color * now.intensity));
  if (!flaw.empty()) return flaw;
  if (!(glm::length(glm::dvec3(now.position)) < 1e30)) return "a transform that cannot be used";
  return typeOf(ofFile.kind).hasCone && !coneFits(now.innerConeAngle, now.outerConeAngle) ? kConeFlaw : "";
}

/// What the file had wrong before is left to it.
std::string flawOf(const Material& now, const Material& before, const Material&) {
  if (now.ior < 0.0F) return kIorFlaw;
  const bool isFinite = std::isfinite(now.ior + now.emission.x + now.emission.y + now.emission.z);
  if (!isFinite) return kFactorFlaw;
  return !isInRange(now) && isInRange(before) ? kFactorFlaw : "";
}

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

template <typename T>
const Field<T>* fieldOf(const T& thing, const std::string& id) {
  for (const Field<T>& f : fields(thing))
    if (f.id == id) return &f;
  return nullptr;
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

EditedLight::EditedLight(const Light& light)
    : intensity(static_cast<double>(std::max({light.intensity.x, light.intensity.y, light.intensity.z}))),
      position(light.position),
      innerConeAngle(static_cast<double>(light.innerConeAngle)),
      outerConeAngle(static_cast<double>(light.outerConeAngle)) {
  if (intensity > 0.0) color = glm::dvec3(light.intensity) / intensity;
}

/// Unedited it has the file's bits: a quotient of floats times its divisor is off by less than a float
/// rounds.
Light EditedLight::asLight(const Light& ofFile) const {
  Light light = ofFile;
  light.intensity = isOn ? glm::vec3(color * intensity) : glm::vec3(0.0F);
  light.position = position;
  light.innerConeAngle = static_cast<float>(innerConeAngle);
  light.outerConeAngle = static_cast<float>(outerConeAngle);
  return light;
}

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
  const auto add = [&](const auto& file, const LightType* type) {
    for (const auto& f : fields(file)) {
      if (type && f.isOf && !f.isOf(*type)) continue;
      Control c;
      c.id = idOf(part, index, f.id);
      c.label = f.label;
      if (type && c.label == "intensity") c.label = fmt::format("intensity, {}", unitOf(*type));
      c.kind = f.kind;
      c.tip = f.tip;
      c.standard = textOf(f.kind, f.get(file, origin_));
      controls.push_back(std::move(c));
    }
  };
  if (index >= count(part)) return controls;
  if (part == Part::Light)
    add(EditedLight(ofFile_.lights[index]), &typeOf(ofFile_.lights[index].kind));
  else
    add(ofFile_.materials[index], nullptr);
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
