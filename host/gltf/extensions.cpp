// The table of extensions that are known and not read.
#include "gltf/extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "gltf/shapes.h"

namespace whittle::gltf {
namespace {

/// Without it the scene is there and looks different.
struct Look {
  const char* extension;
  const char* difference;
};
constexpr std::array kLooks{
    Look{"KHR_materials_volume_scatter", "nothing is scattered inside solids"},
};

/// What a tool makes Whittle's of. Textures of such a format may have another image beside it.
struct Conversion {
  const char* extension;
  const char* what;
  const char* command;
  bool isTexture;
};
constexpr std::array kConversions{
    Conversion{"KHR_texture_basisu", "its textures are KTX2",
               "gltf-transform ktxdecompress IN OUT makes PNG of them", true},
    Conversion{"EXT_texture_avif", "its textures are AVIF",
               "gltf-transform png IN OUT --formats avif makes PNG of them", true},
    Conversion{"MSFT_texture_dds", "its textures are DDS", "convert them to PNG", true},
    Conversion{"KHR_gaussian_splatting", "it holds Gaussian splats, which are no surfaces",
               "no converter makes surfaces of them; ask whatever made the splats for a mesh", false},
};

constexpr std::string_view kMaterials = "KHR_materials_";

/// Every extension with properties of its own is among the shapes; quantization has none, and those of
/// textures are kept as they are.
bool isSupported(std::string_view name) {
  return name == "KHR_mesh_quantization" || name == "EXT_texture_webp" || readsExtension(name);
}

const Conversion* conversion(std::string_view name) {
  const auto found = std::find_if(kConversions.begin(), kConversions.end(),
                                  [&](const Conversion& c) { return name == c.extension; });
  return found == kConversions.end() ? nullptr : &*found;
}

/// What looks different without it; empty where more than the look would be missing.
std::string differenceWithout(const Document& document, std::string_view name) {
  for (const Look& look : kLooks)
    if (name == look.extension) return look.difference;
  if (name.starts_with(kMaterials)) return "some materials look different";
  const Conversion* const c = conversion(name);
  if (!c || !c->isTexture) return {};
  for (const Json& texture : child(document.json, "textures"))
    if (child(texture, "extensions").contains(c->extension) && !texture.contains("source")) return {};
  return "textures are those beside them, which may be coarser";
}

struct List {
  std::string text;
  void add(const std::string& name) {
    if (text.size() > 200) return;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", name.substr(0, 60));
    if (text.size() > 200) text += ", …";
  }
};

}  // namespace

std::optional<std::string_view> conversionOf(std::string_view extensionName) {
  const Conversion* const found = conversion(extensionName);
  return found ? std::optional<std::string_view>(found->command) : std::nullopt;
}

void checkExtensions(const Document& document, Notices& notices) {
  std::vector<std::string> warned;
  List needed;
  for (const Json& json : child(document.json, "extensionsRequired")) {
    const auto name = json.get<std::string>();
    if (isSupported(name)) continue;
    if (const std::string difference = differenceWithout(document, name); !difference.empty()) {
      notices.warn(fmt::format("the file needs{}, which is not drawn: {}", quotedName(name), difference));
      warned.push_back(name);
      continue;
    }
    if (const Conversion* const c = conversion(name))
      document.fail(fmt::format("{} ({}): {}", c->what, c->extension, c->command));
    needed.add(name);
  }
  if (!needed.text.empty())
    document.fail(fmt::format("needs {}, which Whittle does not read (extensionsRequired)", needed.text));
  List used;
  for (const Json& json : child(document.json, "extensionsUsed")) {
    const auto name = json.get<std::string>();
    if (!isSupported(name) && std::find(warned.begin(), warned.end(), name) == warned.end()) used.add(name);
  }
  if (!used.text.empty()) notices.note(fmt::format("extensions not read: {}", oneLine(used.text)));
}

}  // namespace whittle::gltf
