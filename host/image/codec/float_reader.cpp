// OpenEXR: parts and layers by name, the data window within the display window. PNG: gAMA and sRGB chunks
// read here, since OpenImageIO rounds gamma. Others: integers are sRGB unless the file says linear.
#include "image/codec/float_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <system_error>

#include "image/codec/oiio_input.h"
#include "image/codec/picture_channels.h"
#include "image/png_chunks.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

float srgbToLinear(float v) { return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F); }

/// The chosen channels of the open part, interleaved: its data window.
FloatImage readChannels(OIIO::ImageInput& input, const PictureChannels& chosen, const std::string& name) {
  const OIIO::ImageSpec& spec = input.spec();
  checkSize(spec, kMaxFloatSide, name);
  const auto count = static_cast<int>(chosen.channels.size());
  FloatImage image{spec.width, spec.height, count, {}, chosen.hasAlpha};
  image.pixels.resize(static_cast<std::size_t>(spec.width) * spec.height * count);
  const auto read = [&](int firstChannel, int channels, float* to) {
    const auto pixelBytes = static_cast<OIIO::stride_t>(sizeof(float) * count);
    const bool good = input.read_image(chosen.part, 0, firstChannel, firstChannel + channels,
                                       OIIO::TypeDesc::FLOAT, to, pixelBytes, pixelBytes * spec.width);
    const std::string said = input.geterror();
    // libjpeg fills what is missing with grey and calls that a warning.
    if (!good || said.find("Premature end") != std::string::npos) refuseToDecode(name, oneLine(said));
  };
  bool areNeighbours = true;
  for (int i = 0; i < count; ++i) areNeighbours &= chosen.channels[i] == chosen.channels[0] + i;
  if (areNeighbours) {
    read(chosen.channels[0], count, image.pixels.data());
  } else {
    for (int i = 0; i < count; ++i) read(chosen.channels[i], 1, image.pixels.data() + i);
  }
  return image;
}

/// What the display window shows: black where there are no data, nothing of what lies outside.
FloatImage inDisplayWindow(FloatImage data, const OIIO::ImageSpec& spec, const std::string& name) {
  if (spec.x == spec.full_x && spec.y == spec.full_y && spec.width == spec.full_width &&
      spec.height == spec.full_height)
    return data;
  if (spec.full_width < 1 || spec.full_height < 1) refuseToDecode(name, "its display window is empty");
  checkSize(spec.full_width, spec.full_height, kMaxFloatSide, name);
  const auto channels = static_cast<std::size_t>(data.channels);
  FloatImage shown{spec.full_width, spec.full_height, data.channels, {}, data.hadAlpha};
  shown.pixels.resize(static_cast<std::size_t>(shown.width) * shown.height * channels);
  const std::int64_t dx = std::int64_t{spec.x} - spec.full_x, dy = std::int64_t{spec.y} - spec.full_y;
  const std::int64_t left = std::max<std::int64_t>(0, dx), top = std::max<std::int64_t>(0, dy);
  const std::int64_t right = std::min<std::int64_t>(shown.width, dx + data.width);
  const std::int64_t bottom = std::min<std::int64_t>(shown.height, dy + data.height);
  if (left >= right) return shown;
  for (std::int64_t y = top; y < bottom; ++y) {
    const float* const from =
        &data.pixels[static_cast<std::size_t>((y - dy) * data.width + left - dx) * channels];
    std::copy_n(from, static_cast<std::size_t>(right - left) * channels,
                &shown.pixels[static_cast<std::size_t>(y * shown.width + left) * channels]);
  }
  return shown;
}

/// What OpenImageIO calls the parts; those after the first count in OpenEXR files alone: elsewhere they are
/// pages, thumbnails, frames.
std::vector<FilePart> partsOf(OIIO::ImageInput& input) {
  const bool several = input.format_name() == std::string_view("openexr");
  std::vector<FilePart> parts;
  for (int part = 0; (part == 0 || several) && input.seek_subimage(part, 0); ++part) {
    const OIIO::ImageSpec& spec = input.spec();
    parts.push_back({std::string(spec.get_string_attribute("oiio:subimagename")), {}});
    if (!spec.deep) parts.back().channels = spec.channelnames;
  }
  input.geterror();  // that there is no further part
  return parts;
}

FloatImage readAny(const fs::path& path, const std::string& name) {
  const auto input = openFile(path);
  const PictureChannels chosen = choosePicture(partsOf(*input), name);
  if (!input->seek_subimage(chosen.part, 0)) refuseToDecode(name, oneLine(input->geterror()));
  const OIIO::ImageSpec spec = input->spec();
  FloatImage image = readChannels(*input, chosen, name);
  if (input->format_name() == std::string_view("openexr"))
    return inDisplayWindow(std::move(image), spec, name);
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  if (!spec.format.is_floating_point() && space != "Linear" && space != "linear")
    for (float& v : image.pixels) v = srgbToLinear(v);
  return image;
}

FloatImage readPng(const std::vector<std::byte>& bytes, const std::string& name) {
  const std::vector<std::byte> texels = texelChunks(bytes, name);
  MemoryInput memory(texels, "png", name);
  FloatImage image = readChannels(memory.input(), choosePicture(partsOf(memory.input()), name), name);
  const std::optional<double> exponent = gammaExponent(bytes);
  if (exponent == 1.0) return image;
  for (float& v : image.pixels)
    v = exponent ? static_cast<float>(std::pow(static_cast<double>(v), *exponent)) : srgbToLinear(v);
  return image;
}

bool isPng(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::array<char, kPngMagic.size()> head{};
  std::ifstream file(path, std::ios::binary);
  return file.read(head.data(), head.size()) && std::string_view(head.data(), head.size()) == kPngMagic;
}

}  // namespace

FloatImage readFloats(const fs::path& path) {
  const std::string name = path.string();
  return guarded(name, [&] { return isPng(path) ? readPng(readBytes(path), name) : readAny(path, name); });
}

}  // namespace whittle
