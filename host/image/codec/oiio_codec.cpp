// The image codec, on OpenImageIO 2.4. Reads files and memory blocks into Image and FloatImage,
// writes .exr, .png and .jpg. Pictures are encoded in memory and reach the disk through writeWholeFile, so
// that a full disk is noticed whatever the format's writer does. sRGB decoding follows IEC 61966-2-1.
#include "image/image_codec.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "image/png_chunks.h"
#include "scene/input_error.h"
#include "scene/whole_file.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

/// Larger pictures are taken for corrupt headers: the decoded texels alone would pass 1 GiB.
constexpr int kMaxTextureSide = 16384;
constexpr int kMaxFloatSide = 65536;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 30;

/// What OpenImageIO says, on one line; some of its messages carry several.
std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? "no reason given" : text;
}

OIIO::ImageSpec readHints() {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);  // premultiplying would lose colour where alpha is small
  return hints;
}

void checkSize(const OIIO::ImageSpec& spec, int maxSide, const std::string& name) {
  const std::int64_t pixels = std::int64_t{spec.width} * spec.height;
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1 || spec.deep) {
    throw InputError(fmt::format("{}: not a two-dimensional picture", name));
  }
  if (spec.width > maxSide || spec.height > maxSide || pixels > kMaxPixels) {
    throw InputError(fmt::format("{}: {}x{} pixels are too many, at most {} a side and {} in all", name,
                                 spec.width, spec.height, maxSide, kMaxPixels));
  }
}

/// The file's first picture as `channels` interleaved values of type T, at most four.
template <class T>
std::vector<T> readPixels(OIIO::ImageInput& input, OIIO::TypeDesc type, int channels,
                          const std::string& name) {
  const OIIO::ImageSpec& spec = input.spec();
  std::vector<T> pixels(static_cast<std::size_t>(spec.width) * spec.height * channels);
  const bool read = input.read_image(0, 0, 0, channels, type, pixels.data());
  const std::string said = input.geterror();
  // libjpeg fills what is missing with grey and calls that a warning.
  if (!read || said.find("Premature end") != std::string::npos) {
    throw InputError(fmt::format("{}: cannot be decoded: {}", name, oneLine(said)));
  }
  return pixels;
}

/// Turns whatever OpenImageIO and the allocator throw into the one exception for unusable input.
template <class F>
auto guarded(const std::string& name, F&& read) {
  try {
    return read();
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{}: cannot be decoded: {}", name, oneLine(error.what())));
  }
}

/// Grey, grey + alpha, RGB and RGBA to RGBA.
template <class T>
std::vector<T> toRgba(std::vector<T> in, int channels) {
  if (channels == 4) return in;
  const std::size_t count = in.size() / static_cast<std::size_t>(channels);
  const int green = channels >= 3 ? 1 : 0, blue = channels >= 3 ? 2 : 0;
  std::vector<T> out(count * 4);
  for (std::size_t i = 0; i < count; ++i) {
    const T* texel = &in[i * channels];
    out[i * 4 + 0] = texel[0];
    out[i * 4 + 1] = texel[green];
    out[i * 4 + 2] = texel[blue];
    out[i * 4 + 3] = channels == 2 ? texel[1] : std::numeric_limits<T>::max();
  }
  return out;
}

/// Whether 16-bit values say more than 8 bits could: those are the multiples of 257.
bool areDeep(const std::vector<std::uint16_t>& values) {
  return std::any_of(values.begin(), values.end(), [](std::uint16_t v) { return v % 257 != 0; });
}

/// As the library converts what it reads.
std::vector<std::uint8_t> inEightBits(const std::vector<std::uint16_t>& values) {
  std::vector<std::uint8_t> bytes(values.size());
  OIIO::convert_pixel_values(OIIO::TypeDesc::UINT16, values.data(), OIIO::TypeDesc::UINT8, bytes.data(),
                             static_cast<int>(values.size()));
  return bytes;
}

Image toImage(OIIO::ImageInput& input, const std::string& name) {
  const OIIO::ImageSpec& spec = input.spec();
  checkSize(spec, kMaxTextureSide, name);
  const int channels = std::min(spec.nchannels, 4);
  Image image{name, spec.width, spec.height, {}};
  if (spec.format != OIIO::TypeDesc::UINT16) {
    image.texels = toRgba(readPixels<std::uint8_t>(input, OIIO::TypeDesc::UINT8, channels, name), channels);
    return image;
  }
  auto deep = toRgba(readPixels<std::uint16_t>(input, OIIO::TypeDesc::UINT16, channels, name), channels);
  image.texels = inEightBits(deep);
  if (areDeep(deep)) image.deepTexels = std::move(deep);
  return image;
}

bool startsWith(std::span<const std::byte> bytes, std::size_t at, std::string_view magic) {
  return bytes.size() >= at + magic.size() && std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

/// OpenImageIO's reader for a memory block: a block has no extension, and those in files often lie.
const char* formatOf(std::span<const std::byte> bytes) {
  if (startsWith(bytes, 0, "\x89PNG\r\n\x1a\n")) return "png";
  if (startsWith(bytes, 0, "\xff\xd8\xff")) return "jpeg";
  if (startsWith(bytes, 0, "RIFF") && startsWith(bytes, 8, "WEBP")) return "webp";
  if (startsWith(bytes, 0, "BM")) return "bmp";
  return nullptr;
}

std::unique_ptr<OIIO::ImageInput> openFile(const fs::path& path) {
  const std::string name = path.string();
  std::error_code error;
  if (fs::is_directory(path, error)) throw InputError(fmt::format("{}: is a folder, not a picture", name));
  const int file = ::open(name.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0)
    throw InputError(fmt::format("{}: cannot be read: {}", name, std::generic_category().message(errno)));
  ::close(file);
  const OIIO::ImageSpec hints = readHints();
  auto input = OIIO::ImageInput::open(name, &hints);
  if (!input) throw InputError(fmt::format("{}: cannot be opened: {}", name, oneLine(OIIO::geterror())));
  return input;
}

std::vector<std::byte> readBytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::byte> bytes(fs::file_size(path));
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
    throw InputError(fmt::format("{}: cannot be read", path.string()));
  }
  return bytes;
}

float srgbToLinear(float v) { return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F); }

/// Integer files hold sRGB unless they say otherwise; floats are linear already.
void linearise(FloatImage& image, const OIIO::ImageSpec& spec) {
  if (spec.format.is_floating_point() || spec.get_string_attribute("oiio:ColorSpace") == "Linear") return;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (static_cast<int>(i % image.channels) != spec.alpha_channel)
      image.pixels[i] = srgbToLinear(image.pixels[i]);
  }
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
  FloatImage readFloatImage(const fs::path& path) const override;
  void writeExr(const fs::path& path, const FloatImage& image, const ImageMetadata& metadata,
                const std::vector<std::string>& channelNames) const override;
  void writeRgb8(const fs::path& path, const std::string& format, int width, int height,
                 std::span<const std::uint8_t> rgb, const ImageMetadata& metadata) const override;
};

Image OiioCodec::decodeImage(std::span<const std::byte> bytes, const std::string& name) const {
  return guarded(name, [&] {
    const char* format = formatOf(bytes);
    if (format == nullptr) {
      throw InputError(fmt::format("{}: neither PNG nor JPEG, WebP or BMP ({} bytes)", name, bytes.size()));
    }
    std::vector<std::byte> checked;
    if (format == std::string_view("png")) bytes = checked = texelChunks(bytes, name);
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    auto input = OIIO::ImageInput::create(format);
    if (!input || !input->set_ioproxy(&memory)) {
      throw InputError(fmt::format("{}: this OpenImageIO cannot decode {} from memory", name, format));
    }
    OIIO::ImageSpec spec;
    if (!input->open(format, spec, readHints())) {
      throw InputError(fmt::format("{}: cannot be decoded: {}", name, oneLine(input->geterror())));
    }
    return toImage(*input, name);
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

FloatImage OiioCodec::readFloatImage(const fs::path& path) const {
  const std::string name = path.string();
  return guarded(name, [&] {
    const auto input = openFile(path);
    const OIIO::ImageSpec& spec = input->spec();
    checkSize(spec, kMaxFloatSide, name);
    FloatImage image{spec.width, spec.height, std::min(spec.nchannels, 4), {}};
    image.pixels = readPixels<float>(*input, OIIO::TypeDesc::FLOAT, image.channels, name);
    linearise(image, spec);
    return image;
  });
}

void OiioCodec::writeExr(const fs::path& path, const FloatImage& image, const ImageMetadata& metadata,
                         const std::vector<std::string>& channelNames) const {
  checkPixelCount(path, image.width, image.height, image.channels, image.pixels.size());
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  if (static_cast<int>(channelNames.size()) == image.channels) spec.channelnames = channelNames;
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // the same picture is the same bytes, whenever it was made
  for (const auto& [key, value] : metadata) spec.attribute(key, value);
  encodeAndWrite(path, "openexr", spec, image.pixels.data());
}

void OiioCodec::writeRgb8(const fs::path& path, const std::string& format, int width, int height,
                          std::span<const std::uint8_t> rgb, const ImageMetadata& metadata) const {
  checkPixelCount(path, width, height, 3, rgb.size());
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
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
  encodeAndWrite(path, format, spec, rgb.data());
}

}  // namespace
}  // namespace whittle

extern "C" const whittle::ImageCodec* whittleImageCodec() {
  static const whittle::OiioCodec codec;
  return &codec;
}
