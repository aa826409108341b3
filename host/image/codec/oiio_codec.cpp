// The image codec, on OpenImageIO 2.4. Reads files and memory blocks into Image and FloatImage,
// writes .exr, .png and .jpg. Pictures are encoded in memory and reach the disk through writeWholeFile, so
// that a full disk is noticed whatever the format's writer does. sRGB decoding follows IEC 61966-2-1.
#include "image/image_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "image/codec/float_reader.h"
#include "image/codec/oiio_input.h"
#include "image/png_chunks.h"
#include "scene/whole_file.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

/// Some rows at a time: the library holds what it reads in the file's own format beside what it returns.
bool readInStrips(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int channels,
                  const OIIO::TypeDesc& type, void* pixels, OIIO::stride_t pixelBytes) {
  constexpr int kRows = 64;
  if (spec.tile_width > 0) return input.read_image(0, 0, 0, channels, type, pixels, pixelBytes);
  const OIIO::stride_t rowBytes = pixelBytes * spec.width;
  for (int y = 0; y < spec.height; y += kRows) {
    const int end = std::min(y + kRows, spec.height);
    if (!input.read_scanlines(0, 0, spec.y + y, spec.y + end, 0, 0, channels, type,
                              static_cast<std::byte*>(pixels) + y * rowBytes, pixelBytes, rowBytes))
      return false;
  }
  return true;
}

/// The file's first picture as RGBA of type T: grey, grey + alpha, RGB and RGBA are read into their places.
template <class T>
std::vector<T> readRgba(OIIO::ImageInput& input, OIIO::TypeDesc type, const std::string& name) {
  const OIIO::ImageSpec& spec = input.spec();
  const int channels = std::min(spec.nchannels, 4);
  const std::size_t count = static_cast<std::size_t>(spec.width) * spec.height;
  std::vector<T> pixels(4 * count);
  const auto pixelBytes = static_cast<OIIO::stride_t>(4 * sizeof(T));
  const bool read = readInStrips(input, spec, channels, type, pixels.data(), pixelBytes);
  const std::string said = input.geterror();
  // libjpeg fills what is missing with grey and calls that a warning.
  if (!read || said.find("Premature end") != std::string::npos) {
    refuseToDecode(name, oneLine(said));
  }
  for (std::size_t i = 0; channels < 4 && i < count; ++i) {
    T* const texel = &pixels[4 * i];
    texel[3] = channels == 2 ? texel[1] : std::numeric_limits<T>::max();
    if (channels < 3) texel[1] = texel[2] = texel[0];
  }
  return pixels;
}

/// Whether 16-bit values say more than 8 bits could: those are the multiples of 257.
bool areDeep(const std::vector<std::uint16_t>& values) {
  return std::any_of(values.begin(), values.end(), [](std::uint16_t v) { return v % 257 != 0; });
}

/// As the library converts what it reads; some at a time, since it goes through floats.
std::vector<std::uint8_t> inEightBits(const std::vector<std::uint16_t>& values) {
  std::vector<std::uint8_t> bytes(values.size());
  constexpr std::size_t kAtOnce = 1 << 16;
  for (std::size_t at = 0; at < values.size(); at += kAtOnce)
    OIIO::convert_pixel_values(OIIO::TypeDesc::UINT16, &values[at], OIIO::TypeDesc::UINT8, &bytes[at],
                               static_cast<int>(std::min(kAtOnce, values.size() - at)));
  return bytes;
}

Image toImage(OIIO::ImageInput& input, const std::string& name) {
  const OIIO::ImageSpec& spec = input.spec();
  checkSize(spec, kMaxTextureSide, name);
  Image image{name, spec.width, spec.height, {}};
  if (spec.format != OIIO::TypeDesc::UINT16) {
    image.texels = readRgba<std::uint8_t>(input, OIIO::TypeDesc::UINT8, name);
    return image;
  }
  auto deep = readRgba<std::uint16_t>(input, OIIO::TypeDesc::UINT16, name);
  image.texels = inEightBits(deep);
  if (areDeep(deep)) image.deepTexels = std::move(deep);
  return image;
}

/// OpenImageIO's reader for a memory block: a block has no extension, and those in files often lie.
const char* formatOf(std::span<const std::byte> bytes) {
  if (startsWith(bytes, 0, kPngMagic)) return "png";
  if (startsWith(bytes, 0, "\xff\xd8\xff")) return "jpeg";
  if (startsWith(bytes, 0, "RIFF") && startsWith(bytes, 8, "WEBP")) return "webp";
  if (startsWith(bytes, 0, "BM")) return "bmp";
  return nullptr;
}

/// Encodes in memory, then writes the file whole.
void encodeAndWrite(const fs::path& path, const std::string& format, const OIIO::ImageSpec& spec,
                    const void* pixels) {
  const std::string name = path.string();
  OIIO::Filesystem::IOVecOutput memory;  // outlives the writer, whose destructor may still use it
  auto output = OIIO::ImageOutput::create(format);
  if (!output) throw std::runtime_error(fmt::format("{}: {}", name, oneLine(OIIO::geterror())));
  if (!output->set_ioproxy(&memory)) {
    throw std::runtime_error(fmt::format("{}: this OpenImageIO cannot encode {} in memory", name, format));
  }
  const bool encoded =
      output->open(name, spec) && output->write_image(spec.format, pixels) && output->close();
  if (!encoded) throw std::runtime_error(fmt::format("{}: {}", name, oneLine(output->geterror())));
  writeWholeFile(path, std::as_bytes(std::span(memory.buffer())));
}

void checkPixelCount(const fs::path& path, int width, int height, int channels, std::size_t count) {
  if (width < 1 || height < 1 || channels < 1 ||
      count != static_cast<std::size_t>(width) * height * channels) {
    throw std::runtime_error(fmt::format("{}: {} values are not a {}x{} picture of {} channels",
                                         path.string(), count, width, height, channels));
  }
}

class OiioCodec final : public ImageCodec {
 public:
  Image decodeImage(std::span<const std::byte> bytes, const std::string& name) const override;
  Image readImage(const fs::path& path) const override;
  ImageHeader readHeader(const fs::path& path) const override;
  FloatImage readFloatImage(const fs::path& path) const override;
  void writeExr(const fs::path& path, const FloatImage& image, const ImageMetadata& metadata,
                const std::vector<std::string>& channelNames) const override;
  void writeCodes(const fs::path& path, const std::string& format, const CodeImage& image,
                  const ImageMetadata& metadata) const override;
};

Image OiioCodec::decodeImage(std::span<const std::byte> bytes, const std::string& name) const {
  return guarded(name, [&] {
    const char* format = formatOf(bytes);
    if (format == nullptr) {
      throw InputError(fmt::format("{}: neither PNG nor JPEG, WebP or BMP ({} bytes)", name, bytes.size()));
    }
    std::vector<std::byte> checked;
    if (format == std::string_view("png")) bytes = checked = texelChunks(bytes, name);
    MemoryInput memory(bytes, format, name);
    return toImage(memory.input(), name);
  });
}

Image OiioCodec::readImage(const fs::path& path) const {
  const std::string name = path.string();
  return guarded(name, [&] {
    auto input = openFile(path);
    if (input->format_name() != std::string_view("png")) return toImage(*input, name);
    input.reset();
    const std::vector<std::byte> bytes = readBytes(path);  // PNG goes through decodeImage's checks
    return decodeImage(bytes, name);
  });
}

ImageHeader OiioCodec::readHeader(const fs::path& path) const {
  return guarded(path.string(), [&] {
    const auto input = openFile(path);
    const OIIO::ImageSpec& spec = input->spec();
    checkSize(spec, kMaxFloatSide, path.string());
    return ImageHeader{spec.width, spec.height, spec.format == OIIO::TypeDesc::UINT16};
  });
}

FloatImage OiioCodec::readFloatImage(const fs::path& path) const { return readFloats(path); }

void OiioCodec::writeExr(const fs::path& path, const FloatImage& image, const ImageMetadata& metadata,
                         const std::vector<std::string>& channelNames) const {
  checkPixelCount(path, image.width, image.height, image.channels, image.pixels.size());
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  if (image.frame.width > 0) {
    spec.x = image.frame.x, spec.y = image.frame.y;
    spec.full_width = image.frame.width, spec.full_height = image.frame.height;
  }
  if (static_cast<int>(channelNames.size()) == image.channels) spec.channelnames = channelNames;
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // the same picture is the same bytes, whenever it was made
  for (const auto& [key, value] : metadata) spec.attribute(key, value);
  encodeAndWrite(path, "openexr", spec, image.pixels.data());
}

void OiioCodec::writeCodes(const fs::path& path, const std::string& format, const CodeImage& image,
                           const ImageMetadata& metadata) const {
  checkPixelCount(path, image.width, image.height, image.channels, image.codes.size());
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);  // as it is: no division by alpha
  if (format == "jpeg") {
    spec.attribute("Compression", "jpeg:95");
    spec.attribute("jpeg:subsampling", "4:4:4");  // coloured edges stay sharp
  }
  std::string description;  // JPEG has one comment and no named texts
  for (const auto& [key, value] : metadata) {
    if (format == "png") spec.attribute(key, value);
    description += fmt::format("{}{}: {}", description.empty() ? "" : "\n", key, value);
  }
  if (format == "jpeg" && !description.empty()) spec.attribute("ImageDescription", description);
  encodeAndWrite(path, format, spec, image.codes.data());
}

}  // namespace
}  // namespace whittle

extern "C" const whittle::ImageCodec* whittleImageCodec() {
  static const whittle::OiioCodec codec;
  return &codec;
}
