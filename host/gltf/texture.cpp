// Reads texture slots and decodes images. Samplers: glTF 2.0, 3.8.4; transforms: KHR_texture_transform.
#include "gltf/texture.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

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
  if (source >= 0) return numberOf(static_cast<std::size_t>(source));
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

int TextureReader::numberOf(std::size_t asked) {
  const std::size_t image = sources_.firstAlike(asked);
  const auto known = std::find(asked_.begin(), asked_.end(), image) - asked_.begin();
  if (at(static_cast<int>(known)) == asked_.size()) asked_.push_back(image);
  return static_cast<int>(known);
}

void TextureReader::decodeAll() {
  struct Decoded {
    std::optional<Image> image;
    std::string problem;
    int number = -1;  ///< of Scene::images
  };
  const LoggedWork all(document_.log, "decode images");
  std::vector<Decoded> decoded(asked_.size());
  std::vector<std::function<Image()>> decoders(asked_.size());
  const auto attempt = [&](std::size_t i, const auto& work) {
    try {
      work();
    } catch (const InputError& e) {
      decoded[i].problem = e.what();
    }
  };
  // Finding the bytes may read buffers and resolve names, which only one thread may do.
  for (std::size_t i = 0; i < asked_.size(); ++i) attempt(i, [&] { decoders[i] = decoderOf(asked_[i]); });
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, asked_.size(), 1),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          if (!decoders[i]) continue;
          const LoggedWork work(document_.log, fmt::format("decode image {}", asked_[i]));
          attempt(i, [&] { decoded[i].image = decoders[i](); });
        }
      },
      tbb::simple_partitioner{});
  for (std::size_t i = 0; i < asked_.size(); ++i) {
    if (!decoded[i].image) {
      notices_.warn(fmt::format("image {} is left out: {}", asked_[i], decoded[i].problem));
      continue;
    }
    Image& image = *decoded[i].image;
    image.name = document_.json["images"][asked_[i]].value("name", image.name);
    decoded[i].number = static_cast<int>(scene_.images.size());
    scene_.images.push_back(std::move(image));
  }
  const auto settle = [&](TextureSlot& slot) {
    if (slot.used()) slot.image = decoded[at(slot.image)].number;
  };
  for (Material& material : scene_.materials) {
    for (const auto slot : kTextureSlots) settle(material.*slot);
    settle(material.occlusionTexture);
  }
  dropUnreadTexels();
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

/// What decodes an image, from any thread; throws InputError here or there.
std::function<Image()> TextureReader::decoderOf(std::size_t image) {
  const Json& description = document_.json["images"][image];
  const std::string label = fmt::format("{} (image {})", document_.name, image);
  if (!description.contains("uri")) {
    if (!description.contains("bufferView")) throw InputError("it has neither a uri nor a bufferView");
    return [bytes = viewData(document_, description["bufferView"].get<int>()), label] {
      return decodeImage(bytes, label);
    };
  }
  const auto& uri = description["uri"].get_ref<const std::string&>();
  if (isDataUri(uri))
    return [&uri, label] {
      const auto bytes = decodeDataUri(uri);
      if (!bytes) throw InputError("its data URI cannot be decoded");
      return decodeImage(*bytes, label);
    };
  if (isAbsoluteUri(uri))
    throw InputError(fmt::format("it is at{}; Whittle reads local files only", quotedName(uri)));
  return [&uri, file = sources_.file(image)] {
    Image read = readPicture(file);
    read.name = uri;
    return read;
  };
}

}  // namespace whittle::gltf
