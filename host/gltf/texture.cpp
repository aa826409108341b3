// Reads texture slots and decodes images. Samplers: glTF 2.0, 3.8.4; transforms: KHR_texture_transform.
#include "gltf/texture.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "gltf/container.h"
#include "gltf/extensions.h"
#include "gltf/uri.h"
#include "image/image_io.h"
#include "scene/free_array.h"
#include "scene/input_error.h"

namespace whittle::gltf {

namespace {

Wrap wrapOf(int code) {
  if (code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::Clamp;
  if (code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::Mirror;
  return Wrap::Repeat;
}

/// The matrix T · R · S of KHR_texture_transform. Rotation is counter-clockwise
/// as seen, with v pointing down.
std::array<float, 6> transformOf(const Json& t) {
  const auto pair = [&t](const char* key, double fallback) {
    const Json& v = child(t, key);
    return v.size() == 2 ? glm::dvec2(v[0].get<double>(), v[1].get<double>()) : glm::dvec2(fallback);
  };
  const glm::dvec2 offset = pair("offset", 0.0);
  const glm::dvec2 scale = pair("scale", 1.0);
  const double angle = number(t, "rotation", 0.0);
  const double c = std::cos(angle), s = std::sin(angle);
  return {static_cast<float>(c * scale.x),  static_cast<float>(s * scale.y), static_cast<float>(offset.x),
          static_cast<float>(-s * scale.x), static_cast<float>(c * scale.y), static_cast<float>(offset.y)};
}

std::string conversionHint(std::string_view extensionName) {
  const auto command = conversionOf(extensionName);
  return command ? fmt::format(" ({})", *command) : "";
}

/// A picture on disk. OpenImageIO takes what stands behind '?' in a name for arguments: such a file
/// is read here.
Image readPicture(const std::filesystem::path& path) {
  if (path.native().find('?') == std::string::npos) return readImage(path);
  Bytes bytes;
  const auto problem = readStart(path, std::numeric_limits<std::uint64_t>::max(), bytes);
  if (problem) throw InputError(fmt::format("{} {}", path.string(), *problem));
  return decodeImage(bytes, path.string());
}

}  // namespace

TextureReader::TextureReader(Document& document, ImageSources& sources, Scene& scene, Notices& notices)
    : document_(document),
      sources_(sources),
      scene_(scene),
      notices_(notices),
      images_(child(document.json, "images").size(), kUnread),
      sourceless_(document.model.textures.size()) {}

TextureSlot TextureReader::slot(const Json& owner, const char* key) {
  TextureSlot slot;
  const auto info = owner.find(key);
  if (info == owner.end()) return slot;
  double set = number(*info, "texCoord", 0.0);
  if (const Json* transform = extension(*info, "KHR_texture_transform")) {
    slot.transform = transformOf(*transform);
    set = number(*transform, "texCoord", set);
  }
  if (set > 1.0) {
    notices_.warn(fmt::format("{} uses TEXCOORD_{:.0f}; only sets 0 and 1 are read, the texture is left out",
                              key, set));
    return slot;
  }
  slot.uvSet = static_cast<int>(set);
  const auto texture = (*info)["index"].get<std::size_t>();
  const int sampler = document_.model.textures[texture].sampler;
  if (sampler >= 0) {
    const tinygltf::Sampler& s = document_.model.samplers[static_cast<std::size_t>(sampler)];
    slot.wrapS = wrapOf(s.wrapS);
    slot.wrapT = wrapOf(s.wrapT);
    slot.filter = s.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? Filter::Nearest : Filter::Linear;
    // Texels that shall stay texels: drawn pixel by pixel. LINEAR without MIPMAP is what exporters write who
    // do not care, and nobody wants the shimmer that it stands for.
    slot.hasLevels = s.minFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
  }
  slot.image = imageAt(texture);
  return slot;
}

int TextureReader::imageAt(std::size_t texture) {
  const int source = imageOf(document_, texture);
  if (source >= 0) return decode(static_cast<std::size_t>(source));
  if (sourceless_[texture]) return -1;
  sourceless_[texture] = true;
  const Json& extensions = child(document_.json["textures"][texture], "extensions");
  const std::string kind = extensions.is_object() && !extensions.empty() ? extensions.begin().key() : "";
  if (kind.empty())
    notices_.warn(fmt::format("texture {} has no image; it is left out", texture));
  else
    notices_.warn(
        fmt::format("texture {} has an image for{} only, which Whittle does not read; it is left out{}",
                    texture, quotedName(kind), conversionHint(kind)));
  return -1;
}

int TextureReader::decode(std::size_t asked) {
  const std::size_t image = sources_.firstAlike(asked);
  if (images_[image] != kUnread) return images_[image];
  images_[image] = -1;
  try {
    Image decoded = read(image);
    decoded.name = document_.json["images"][image].value("name", decoded.name);
    scene_.images.push_back(std::move(decoded));
    images_[image] = static_cast<int>(scene_.images.size()) - 1;
  } catch (const InputError& e) {
    notices_.warn(fmt::format("image {} is left out: {}", image, e.what()));
  }
  return images_[image];
}

void TextureReader::dropUnreadTexels() {
  std::vector<bool> isRead(scene_.images.size());
  for (const Material& material : scene_.materials)
    for (std::size_t i = 0; i < kTextureSlots.size(); ++i)
      if (const TextureSlot& slot = material.*kTextureSlots[i]; slot.used() && kSlotIsLinear[i])
        isRead[static_cast<std::size_t>(slot.image)] = true;
  for (std::size_t i = 0; i < isRead.size(); ++i)
    if (!isRead[i]) freeArray(scene_.images[i].deepTexels);
}

Image TextureReader::read(std::size_t image) {
  const Json& description = document_.json["images"][image];
  const std::string label = fmt::format("{} (image {})", document_.name, image);
  if (!description.contains("uri")) {
    if (!description.contains("bufferView")) throw InputError("it has neither a uri nor a bufferView");
    return decodeImage(viewData(document_, description["bufferView"].get<int>()), label);
  }
  const auto& uri = description["uri"].get_ref<const std::string&>();
  if (isDataUri(uri)) {
    const auto bytes = decodeDataUri(uri);
    if (!bytes) throw InputError("its data URI cannot be decoded");
    return decodeImage(*bytes, label);
  }
  if (isAbsoluteUri(uri))
    throw InputError(fmt::format("it is at{}; Whittle reads local files only", quotedName(uri)));
  Image read = readPicture(sources_.file(image));
  read.name = uri;
  return read;
}

}  // namespace whittle::gltf
