// Finds and loads the image codec, checks paths, and hands the work over.
#include "image/image_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "image/exr_header.h"
#include "image/image_codec.h"
#include "image/plain_images.h"
#include "image/png_writer.h"
#include "image/radiance_file.h"
#include "image/webp.h"
#include "scene/input_error.h"
#include "scene/own_library.h"
#include "scene/whole_file.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

const ImageCodec* loadCodec() {
  std::string problem = "it is neither beside the program nor in ../lib/whittle";
  using Entry = decltype(&whittleImageCodec);
  if (const auto entry =
          reinterpret_cast<Entry>(loadOwnLibrary("libwhittle_codec.so", "whittleImageCodec", problem)))
    return entry();
  throw std::runtime_error(
      fmt::format("libwhittle_codec.so, which reads and writes images, cannot be loaded: {}", problem));
}

const ImageCodec& codec() {
  static const ImageCodec* const loaded = loadCodec();
  return *loaded;
}

/// "png", "jpeg" or "openexr" by the extension, empty where it is none that can be written.
std::string imageFormatOf(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".exr") return "openexr";
  if (extension == ".png") return "png";
  if (extension == ".jpg" || extension == ".jpeg") return "jpeg";
  return {};
}

/// All of the file, where its first bytes are of that kind; what cannot be read is left to the codec, which
/// says why. `start`: so many tell.
template <class IsOfKind>
std::optional<std::vector<std::byte>> bytesIf(const fs::path& path, const IsOfKind& isOfKind,
                                              std::size_t start = 2) {
  std::error_code error;
  std::ifstream file(path, std::ios::binary);
  std::vector<std::byte> bytes(start);
  const auto readTo = [&](std::size_t from) {
    return static_cast<bool>(file.read(reinterpret_cast<char*>(bytes.data() + from),
                                       static_cast<std::streamsize>(bytes.size() - from)));
  };
  if (!readTo(0) || !isOfKind(bytes)) return std::nullopt;
  const auto size = fs::file_size(path, error);
  if (error || size < bytes.size()) return std::nullopt;
  bytes.resize(size);
  if (!readTo(start)) throw InputError(fmt::format("{}: cannot be read", path.string()));
  return bytes;
}

/// Opening a pipe waits for its other end, and a device may have no end. What is not there is left to the
/// codec, which says so.
void refuseStreams(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(fmt::format("{}: is not a regular file", path.string()));
}

void checkSize(const fs::path& path, const CodeImage& image) {
  const bool isPicture = image.width > 0 && image.height > 0 && (image.channels == 3 || image.channels == 4);
  if (!isPicture || image.codes.size() != std::size_t{1} * image.width * image.height * image.channels)
    throw std::runtime_error(fmt::format("{}: {} values are not a {}x{} picture of {} channels",
                                         path.string(), image.codes.size(), image.width, image.height,
                                         image.channels));
}

/// A header with what people put there; one that is longer is read by the codec alone.
constexpr std::size_t kLongHeader = 1 << 20;

void refuseDamagedExr(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::byte> head(4);
  const auto read = [&](std::size_t from) {
    file.read(reinterpret_cast<char*>(head.data() + from), static_cast<std::streamsize>(head.size() - from));
    return from + static_cast<std::size_t>(file.gcount());
  };
  if (read(0) < head.size() || !isExrFile(head)) return;
  head.resize(kLongHeader);
  head.resize(read(4));
  checkSampleTypes(head, path.string());
}

}  // namespace

FloatImage blackImage(const Settings& settings, int channels) {
  const Region region = tracedRegion(settings);
  FloatImage image{region.width, region.height, channels,
                   std::vector<float>(region.pixels() * static_cast<std::size_t>(channels))};
  if (settings.crop) image.frame = {settings.width, settings.height, region.x, region.y};
  return image;
}

FloatImage cutOut(const FloatImage& image, const Region& region) {
  FloatImage part{region.width, region.height, image.channels, {}, image.hadAlpha, {}};
  part.frame = {image.width, image.height, region.x, region.y};
  part.pixels.reserve(region.pixels() * static_cast<std::size_t>(image.channels));
  for (int y = region.y; y < region.y + region.height; ++y) {
    const auto row =
        image.pixels.begin() + (static_cast<std::ptrdiff_t>(y) * image.width + region.x) * image.channels;
    part.pixels.insert(part.pixels.end(), row,
                       row + static_cast<std::ptrdiff_t>(region.width) * image.channels);
  }
  return part;
}

FloatImage joined(const std::vector<const FloatImage*>& images) {
  FloatImage all{images.front()->width, images.front()->height, 0, {}};
  all.frame = images.front()->frame;
  for (const FloatImage* image : images) all.channels += image->channels;
  const std::size_t pixels = static_cast<std::size_t>(all.width) * all.height;
  const auto channels = static_cast<std::size_t>(all.channels);
  all.pixels.resize(pixels * channels);
  std::size_t at = 0;
  for (const FloatImage* image : images) {
    const auto own = static_cast<std::size_t>(image->channels);
    for (std::size_t p = 0; p < pixels; ++p)
      std::copy_n(&image->pixels[p * own], own, &all.pixels[p * channels + at]);
    at += own;
  }
  return all;
}

void loadImageCodec() { codec(); }

bool needsImageCodec(const fs::path& path) { return imageFormatOf(path) != "png"; }

Image decodeImage(std::span<const std::byte> bytes, const std::string& name) {
  if (isWebp(bytes)) return decodeWebp(bytes, name);
  if (auto plain = decodePlainImage(bytes, name)) return std::move(*plain);
  return codec().decodeImage(bytes, name);
}

Image readImage(const fs::path& path) {
  refuseStreams(path);
  if (const auto bytes = bytesIf(path, isWebp, kWebpStart)) return decodeWebp(*bytes, path.string());
  if (const auto bytes = bytesIf(path, mayBePlain))
    if (auto plain = decodePlainImage(*bytes, path.string())) return std::move(*plain);
  refuseDamagedExr(path);
  return codec().readImage(path);
}

ImageHeader readImageHeader(const fs::path& path) {
  refuseStreams(path);
  return codec().readHeader(path);
}

FloatImage readFloatImage(const fs::path& path) {
  refuseStreams(path);
  if (const auto bytes = bytesIf(path, isRadianceFile)) return decodeRadiance(*bytes, path.string());
  refuseDamagedExr(path);
  return codec().readFloatImage(path);
}

void writeExr(const fs::path& path, const FloatImage& image, const ImageMetadata& metadata,
              const std::vector<std::string>& channelNames) {
  if (imageFormatOf(path) != "openexr")
    throw InputError(fmt::format("{}: linear radiance needs the extension .exr", path.string()));
  checkFolderWritable(path);
  codec().writeExr(path, image, metadata, channelNames);
}

void writeCodes(const fs::path& path, const CodeImage& image, const ImageMetadata& metadata) {
  const std::string format = imageFormatOf(path);
  if (format != "png" && format != "jpeg")
    throw InputError(
        fmt::format("{}: a tone-mapped picture needs the extension .png or .jpg", path.string()));
  checkFolderWritable(path);
  if (format == "png") {
    checkSize(path, image);
    return writeWholeFile(path, encodePng(image, metadata));
  }
  codec().writeCodes(path, format, image, metadata);
}

void checkWritable(const fs::path& path) {
  if (imageFormatOf(path).empty())
    throw InputError(fmt::format(
        "{}: the extension says no format that can be written; use .exr, .png or .jpg", path.string()));
  checkFolderWritable(path);
}

}  // namespace whittle
