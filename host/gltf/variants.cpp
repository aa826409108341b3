#include "gltf/variants.h"

#include <fmt/format.h>

#include <algorithm>

#include "gltf/choice.h"

namespace whittle::gltf {
namespace {

constexpr const char* kVariantsExtension = "KHR_materials_variants";

/// The material that a variant gives a primitive; nothing where it keeps its own.
std::optional<int> materialIn(const Json& primitive, std::size_t variant) {
  const Json* const e = extension(primitive, kVariantsExtension);
  if (!e) return std::nullopt;
  for (const Json& mapping : (*e)["mappings"]) {
    const Json& of = mapping["variants"];
    if (std::find(of.begin(), of.end(), variant) != of.end()) return mapping["material"].get<int>();
  }
  return std::nullopt;
}

}  // namespace

void applyVariant(Document& document, const std::optional<std::string>& wanted) {
  std::vector<std::string>& names = document.notices->variants;
  if (const Json* const e = extension(document.json, kVariantsExtension))
    for (const Json& variant : (*e)["variants"]) names.push_back(variant.value("name", ""));
  if (!wanted) {
    if (!names.empty())
      document.notices->note(
          fmt::format("materials are those without a variant; --variant NAME shows one of {}{}", names.size(),
                      quotedName(names[0])));
    return;
  }
  const std::size_t variant = indexCalled(document, "variant", names, *wanted);
  for (std::size_t m = 0; m < document.model.meshes.size(); ++m) {
    auto& primitives = document.model.meshes[m].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p)
      if (const auto material = materialIn(document.json["meshes"][m]["primitives"][p], variant))
        primitives[p].material = *material;
  }
}

}  // namespace whittle::gltf
