// See edit_fields.h.
#include "view/edit_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "scene/material_factors.h"
#include "scene/material_predicates.h"
#include "scene/ranges.h"

namespace whittle::view {
namespace {

using Kind = Control::Kind;

constexpr double kDegree = std::numbers::pi / 180.0;

Values listOf(const auto& v) { return {v.x, v.y, v.z}; }
glm::dvec3 vectorOf(const Values& v) { return {v[0], v[1], v[2]}; }

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

}  // namespace

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
      {"azimuth", "shines to, °", "where it shines, seen from above: 0 along +Z, 90 along +X", Kind::Angle,
       [](const L& l, const Origin&) { return Values{l.azimuth / kDegree}; },
       [](L& l, const Values& v, const Origin&) { l.azimuth = v[0] * kDegree; },
       [](const Light& l) { return typeOf(l.kind).isAimed; }},
      {"elevation", "up or down, °", "where it shines: 90 straight up, -90 straight down", Kind::Angle,
       [](const L& l, const Origin&) { return Values{l.elevation / kDegree}; },
       [](L& l, const Values& v, const Origin&) { l.elevation = v[0] * kDegree; },
       [](const Light& l) { return typeOf(l.kind).isAimed; }},
      {"inner-cone", "inner cone, °", "half angle: full intensity inside", Kind::Angle,
       [](const L& l, const Origin&) { return Values{l.innerConeAngle / kDegree}; },
       [](L& l, const Values& v, const Origin&) { l.innerConeAngle = v[0] * kDegree; },
       [](const Light& l) { return typeOf(l.kind).hasCone; }},
      {"outer-cone", "outer cone, °", "half angle: dark outside", Kind::Angle,
       [](const L& l, const Origin&) { return Values{l.outerConeAngle / kDegree}; },
       [](L& l, const Values& v, const Origin&) { l.outerConeAngle = v[0] * kDegree; },
       [](const Light& l) { return typeOf(l.kind).hasCone; }},
      {"position", "position, m", "x,y,z of the file; or drag the handle over the picture", Kind::Text,
       [](const L& l, const Origin& origin) { return listOf(glm::dvec3(l.position) + origin); },
       [](L& l, const Values& v, const Origin& origin) { l.position = glm::vec3(vectorOf(v) - origin); },
       [](const Light& l) { return typeOf(l.kind).isPlaced; }}};
  return all;
}

const std::vector<Field<Material>>& fields(const Material&) {
  using M = Material;
  static const std::vector<Field<M>> all{
      {"base-color", "base colour", "linear red, green, blue; multiplies the texture", Kind::Color,
       [](const M& m, const Origin&) { return listOf(glm::vec3(m.baseColor)); },
       [](M& m, const Values& v, const Origin&) {
         m.baseColor = {glm::vec3(vectorOf(v)), m.baseColor.a};
       }},
      {"alpha", "alpha",
       "how much it covers, where the file blends it or cuts it out; multiplies the texture", Kind::Share,
       [](const M& m, const Origin&) { return Values{static_cast<double>(m.baseColor.a)}; },
       [](M& m, const Values& v, const Origin&) { m.baseColor.a = static_cast<float>(v[0]); },
       [](const M& m) { return isMasked(m) || blends(m); }},
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

std::string flawOf(const EditedLight& now, const EditedLight&, const Light& ofFile) {
  // Off, its intensity is still one to come back to.
  const std::string flaw = intensityFlaw(glm::vec3(now.color * now.intensity));
  if (!flaw.empty()) return flaw;
  if (!(glm::length(glm::dvec3(now.position)) < 1e30)) return "a transform that cannot be used";
  if (!(std::abs(now.elevation) <= std::numbers::pi / 2)) return "an elevation outside -90° to 90°";
  return typeOf(ofFile.kind).hasCone && !coneFits(now.innerConeAngle, now.outerConeAngle) ? kConeFlaw : "";
}

std::string flawOf(const Material& now, const Material& before, const Material&) {
  if (now.ior < 0.0F) return kIorFlaw;
  const bool isFinite = std::isfinite(now.ior + now.emission.x + now.emission.y + now.emission.z);
  if (!isFinite) return kFactorFlaw;
  return !isInRange(now) && isInRange(before) ? kFactorFlaw : "";
}

}  // namespace whittle::view
