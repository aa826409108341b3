// Checks types, lengths and indices of a file. The tables at the top follow the JSON schemas of glTF 2.0
// and of the extensions that are read.
#include "gltf/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "gltf/shapes.h"

namespace whittle::gltf {

namespace {

/// The way to a property, kept as a list on the stack: it becomes text only when something is wrong.
struct Where {
  const Where* parent = nullptr;
  std::string_view key = {};
  std::size_t element = kNone;
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
};

std::string textOf(const Where& where) {
  std::string text = where.parent ? textOf(*where.parent) : std::string();
  if (where.element != Where::kNone) return text + fmt::format("[{}]", where.element);
  if (!text.empty()) text += '.';
  return text + std::string(where.key.substr(0, 60));
}

/// Largest integer that every JSON writer can express: offsets and counts above it are refused, so that sums
/// and products of two of them by small strides never overflow 64 bits.
constexpr double kLargestInteger = 9007199254740992.0;
constexpr double kLargestIndex = 2147483647.0;

/// "is 1 mesh", "are 2 meshes", "are no meshes".
std::string someOf(std::size_t count, std::string_view plural) {
  if (count != 1) return fmt::format("are {} {}", count == 0 ? "no" : std::to_string(count), plural);
  return fmt::format("is 1 {}", plural.substr(0, plural.size() - (plural == "meshes" ? 2 : 1)));
}

/// What is wrong with a property, as a sentence without its end. Where the property is forgiven, it is left
/// out; elsewhere the file is refused.
struct Flaw {
  std::string text;
};

class Checker {
 public:
  /// Nodes go to `nodes`: as JSON they would take ten times as much.
  Checker(const Document& document, const Json& root, std::vector<Node>& nodes)
      : document_(document), nodes_(nodes) {
    for (const Field& field : rootFields()) {
      if (field.kind == Kind::Objects && root.contains(field.key))
        counts_[field.key] = root[field.key].size();
    }
    for (const auto& [key, place] : {std::pair{"lights", "/extensions/KHR_lights_punctual/lights"},
                                     std::pair{"variants", "/extensions/KHR_materials_variants/variants"}}) {
      const Json::json_pointer list(place);
      if (root.contains(list)) counts_[key] = root[list].size();
    }
  }

  /// Of a part of the file that is read later, when there are nodes and accessors.
  Checker(const Document& document, std::vector<Node>& nodes) : document_(document), nodes_(nodes) {
    counts_["nodes"] = nodes.size();
    counts_["accessors"] = document.model.accessors.size();
  }

  /// Takes `in` apart on the way, so that no file is there twice.
  Json object(Json& in, std::span<const Field> fields, const Where& where) {
    if (!in.is_object()) wrong(where, "must be an object");
    Json out = Json::object();
    for (const Field& field : fields) {
      const Where here{&where, field.key};
      const auto found = in.find(field.key);
      if (found == in.end() || found->is_null()) {
        if (field.isRequired) wrong(here, "is missing");
        continue;
      }
      try {
        out[field.key] = value(*found, field, here);
      } catch (const Flaw& flaw) {
        if (!field.isForgiven) throw;
        forgive(field, flaw.text + "; read as if it were not there");
      }
    }
    return out;
  }

  void warnOfForgiven() const {
    for (const auto& [key, flaws] : forgiven_) {
      document_.warn(flaws.count == 1 ? flaws.first
                                      : fmt::format("{} (and {} more)", flaws.first, flaws.count - 1));
    }
  }

 private:
  struct Flaws {
    std::string first;
    std::size_t count = 0;
  };

  [[noreturn]] static void wrong(const Where& where, std::string_view what) {
    throw Flaw{fmt::format("{} {}", textOf(where), what)};
  }

  /// A writer that does something wrong does it throughout the file: one warning says so.
  void forgive(const Field& field, std::string what) {
    Flaws& flaws = forgiven_[field.key];
    if (flaws.count++ == 0) flaws.first = std::move(what);
  }

  Json value(Json& in, const Field& field, const Where& where) {
    switch (field.kind) {
      case Kind::Index:
        return indexValue(in, field, where);
      case Kind::Size:
        return integer(in, kLargestInteger, where);
      case Kind::Number:
        return numberValue(in, where);
      case Kind::Flag:
        if (!in.is_boolean()) wrong(where, "must be true or false");
        return in;
      case Kind::Text:
        return textValue(in, where);
      case Kind::Object:
        return object(in, field.fields, where);
      case Kind::Map:
        return map(in, field, where);
      case Kind::Raw:
        return std::move(in);
      default:
        return array(in, field, where);
    }
  }

  /// How many numbers of a list are used: of too many, where that is forgiven, the first.
  std::size_t usedNumbers(const Json& in, const Field& field, const Where& where) {
    if (field.length == 0 || in.size() == field.length) return in.size();
    const std::string what = fmt::format("must have {} numbers, but has {}", field.length, in.size());
    const bool isLonger = in.size() > field.length;
    const bool willDo = isLonger || (field.least > 0 && in.size() >= field.least);
    if (!field.isForgiven || !willDo) wrong(where, what);
    forgive(field, textOf(where) + " " + what +
                       (isLonger ? "; the first ones are used" : "; the missing ones are taken for 1"));
    return std::min(in.size(), field.length);
  }

  Json numbers(const Json& in, const Field& field, const Where& where) {
    const std::size_t used = usedNumbers(in, field, where);
    Json out = Json::array();
    for (std::size_t i = 0; i < used; ++i) out.push_back(numberValue(in[i], {&where, {}, i}));
    while (out.size() < field.length) out.push_back(1.0);
    return out;
  }

  Json array(Json& in, const Field& field, const Where& where) {
    if (!in.is_array()) wrong(where, "must be an array");
    if (field.kind == Kind::Numbers) return numbers(in, field, where);
    Json out = Json::array();
    for (std::size_t i = 0; i < in.size(); ++i) {
      const Where element{&where, {}, i};
      switch (field.kind) {
        case Kind::Texts:
          out.push_back(textValue(in[i], element));
          break;
        case Kind::Indices:
          out.push_back(indexValue(in[i], field, element));
          break;
        case Kind::Maps:
          out.push_back(map(in[i], field, element));
          break;
        default:
          addObject(object(in[i], field.fields, element), field, out);
          in[i] = nullptr;
          break;
      }
    }
    return out;
  }

  void addObject(Json checked, const Field& field, Json& out) {
    if (std::string_view(field.key) == "nodes")
      nodes_.push_back(nodeFrom(checked, document_.isPosed));
    else
      out.push_back(std::move(checked));
  }

  Json map(const Json& in, const Field& field, const Where& where) const {
    if (!in.is_object()) wrong(where, "must be an object");
    Json out = Json::object();
    for (const auto& [key, element] : in.items()) out[key] = indexValue(element, field, {&where, key});
    return out;
  }

  Json textValue(Json& in, const Where& where) const {
    if (!in.is_string()) wrong(where, "must be a string");
    return std::move(in);
  }

  Json numberValue(const Json& in, const Where& where) const {
    if (!in.is_number()) wrong(where, "must be a number");
    return in.get<double>();
  }

  Json integer(const Json& in, double largest, const Where& where) const {
    if (!in.is_number()) wrong(where, "must be an integer");
    const double number = in.get<double>();
    if (number < 0.0) wrong(where, "must not be negative");
    if (number > largest) wrong(where, "is too large");
    if (std::floor(number) != number) wrong(where, "must be an integer");
    return static_cast<std::uint64_t>(number);
  }

  Json indexValue(const Json& in, const Field& field, const Where& where) const {
    const Json out = integer(in, kLargestIndex, where);
    const auto number = out.get<std::uint64_t>();
    if (field.target) {
      const auto count = counts_.find(field.target);
      const std::size_t size = count == counts_.end() ? 0 : count->second;
      if (number >= size) {
        // Nobody can tell what was meant, so this is never forgiven.
        document_.fail(
            fmt::format("{} is {}, but there {}", textOf(where), number, someOf(size, field.target)));
      }
    }
    bool legal = field.oneOf.empty();
    for (const int allowed : field.oneOf) legal = legal || number == static_cast<std::uint64_t>(allowed);
    if (!legal) wrong(where, fmt::format("has the unknown value {}", number));
    return out;
  }

  const Document& document_;
  std::vector<Node>& nodes_;
  std::map<std::string_view, std::size_t> counts_;
  std::map<std::string_view, Flaws> forgiven_;  ///< by key
};

void dropKeys(Json& json, std::span<const char* const> keys) {
  if (json.is_object()) {
    for (const char* key : keys) json.erase(key);
  }
  if (json.is_structured()) {
    for (Json& element : json) dropKeys(element, keys);
  }
}

}  // namespace

Json checkedCopy(const Document& document, Json json, std::vector<Node>& nodes) {
  if (!json.is_object()) document.fail("not a glTF file: its JSON is not an object");
  Checker checker(document, json, nodes);
  try {
    Json checked = checker.object(json, rootFields(), {});
    checker.warnOfForgiven();
    return checked;
  } catch (const Flaw& flaw) {
    document.fail(flaw.text);
  }
}

Json checkedAnimations(Document& document, Json animations) {
  Json file = {{"animations", std::move(animations)}};
  Checker checker(document, document.nodes);
  try {
    return checker.object(file, animationFields(), {})["animations"];
  } catch (const Flaw& flaw) {
    document.fail(flaw.text);
  }
}

Json descriptionOnly(const Json& checked) {
  Json out = Json::object();
  for (const auto& [key, value] : checked.items())
    if (key != "buffers" && key != "images" && key != "materials" && key != "nodes") out[key] = value;
  static constexpr std::array<const char*, 2> kKeys{"extensions", "extras"};
  dropKeys(out, kKeys);
  return out;
}

}  // namespace whittle::gltf
