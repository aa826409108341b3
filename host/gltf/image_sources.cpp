#include "gltf/image_sources.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <string_view>
#include <tuple>
#include <unordered_map>

#include "gltf/uri.h"
#include "image/image_io.h"
#include "scene/input_error.h"

namespace whittle::gltf {
namespace {

/// Of a JPEG before its frame header; a whole picture need not be decoded for its size.
constexpr std::size_t kEncodedStart = 1 << 20;

/// The textures that a material's slots name, as far down as its extensions go.
void collectTextures(const Json& object, std::set<std::size_t>& textures) {
  for (const auto& [key, value] : object.items()) {
    if (!value.is_object()) continue;
    if (key.ends_with("Texture") && value.contains("index"))
      textures.insert(value["index"].get<std::size_t>());
    collectTextures(value, textures);
  }
}

}  // namespace

int imageOf(const Document& document, std::size_t texture) {
  const int plain = document.model.textures[texture].source;
  const Json* const webp = extension(document.json["textures"][texture], "EXT_texture_webp");
  if (!webp || !webp->is_object()) return plain;
  const Json& source = child(*webp, "source");
  if (!source.is_number_unsigned() || source.get<std::uint64_t>() >= child(document.json, "images").size())
    return plain;
  return plain < 0 || canDecodeWebp() ? source.get<int>() : plain;
}

ImageSources::ImageSources(Document& document) : document_(document) {
  const Json& images = child(document.json, "images");
  std::unordered_map<std::string_view, std::size_t> byUri;
  std::map<std::tuple<int, std::size_t, std::size_t>, std::size_t> byRange;
  first_.resize(images.size());
  for (std::size_t i = 0; i < first_.size(); ++i) {
    first_[i] = i;
    if (images[i].contains("uri")) {
      first_[i] = byUri.try_emplace(images[i]["uri"].get_ref<const std::string&>(), i).first->second;
    } else if (images[i].contains("bufferView")) {
      const auto& view = document.model.bufferViews[images[i]["bufferView"].get<std::size_t>()];
      first_[i] = byRange.try_emplace({view.buffer, view.byteOffset, view.byteLength}, i).first->second;
    }
  }
}

const std::filesystem::path& ImageSources::file(std::size_t image) {
  if (const auto known = files_.find(image); known != files_.end()) return known->second;
  const auto& uri = document_.json["images"][image]["uri"].get_ref<const std::string&>();
  return files_.emplace(image, fileOf(document_, uri)).first->second;
}

/// Nothing where it cannot be told: whoever decodes the image says why.
std::optional<ImageHeader> ImageSources::header(std::size_t image) {
  const Json& description = document_.json["images"][image];
  try {
    if (!description.contains("uri")) {
      if (!description.contains("bufferView")) return std::nullopt;
      return headerOf(viewData(document_, description["bufferView"].get<int>()));
    }
    const std::string_view uri = description["uri"].get_ref<const std::string&>();
    if (isDataUri(uri)) {
      const auto start = decodeDataUri(uri.substr(0, kEncodedStart));
      return start ? headerOf(*start) : std::nullopt;
    }
    if (isAbsoluteUri(uri)) return std::nullopt;
    std::error_code unknown;
    const std::uintmax_t size = std::filesystem::file_size(file(image), unknown);
    if (!unknown) document_.budget->sawFile(size);
    return headerOf(file(image));
  } catch (const InputError&) {
    return std::nullopt;
  }
}

void ImageSources::hold(const std::set<int>& materials) {
  std::set<std::size_t> textures, images;
  for (const int material : materials)
    if (material >= 0) collectTextures(document_.json["materials"][at(material)], textures);
  for (const std::size_t texture : textures)
    if (const int source = imageOf(document_, texture); source >= 0) images.insert(first_[at(source)]);
  std::uint64_t pixels = 0, bytes = 0;
  std::vector<std::uint64_t> decoders;
  for (const std::size_t image : images) {
    const auto found = header(image);
    // One that is too large by itself is left out, with a warning of its own.
    if (!found || found->width > kMaxTextureSide || found->height > kMaxTextureSide) continue;
    pixels += found->pixels();
    bytes += found->decodedBytes();
    decoders.push_back(found->decoderBytes());
  }
  if (bytes == 0) return;
  const std::string what =
      fmt::format("{}, {:.4g} megapixels in all,",
                  images.size() == 1 ? "its image" : fmt::format("its {} images", images.size()),
                  static_cast<double>(pixels) / 1e6);
  // As many as there are threads are decoded at once; the largest of them, at worst.
  std::sort(decoders.begin(), decoders.end(), std::greater());
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  decoders.resize(std::min(threads, decoders.size()));
  document_.pass(std::accumulate(decoders.begin(), decoders.end(), bytes), what);
  document_.hold(bytes, what);
  // A quarter of each level is the next.
  if (document_.textureLevels) document_.promise(bytes / 3, "the smaller levels of its images");
}

}  // namespace whittle::gltf
