// Image files in and out. The codec behind it (host/image/codec, the only user of OpenImageIO)
// is loaded when first needed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "image/image_header.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// The picture that an image is a region of, and the region's place in it; without a size: the image is no
/// region.
struct Frame {
  int width = 0, height = 0;
  int x = 0, y = 0;
};

/// Linear floats, interleaved channels, row 0 at the top.
struct FloatImage {
  int width = 0;
  int height = 0;
  int channels = 3;
  std::vector<float> pixels;  ///< width·height·channels
  bool hadAlpha = false;      ///< in the file that it was read from
  Frame frame{};              ///< of a region; an .exr has it as its display window
};

/// Black, of what the settings have traced: the picture, or a region in its frame.
FloatImage blackImage(const Settings& settings, int channels);

/// The pixels of a region of an image, in the image's frame.
FloatImage cutOut(const FloatImage& image, const Region& region);

/// The channels of several images of one size side by side, in one.
FloatImage joined(const std::vector<const FloatImage*>& images);

/// Loads the codec now, which takes a quarter of a second: from a thread that has nothing else to do. Throws
/// std::runtime_error where its library is missing, as do all functions below that need it.
void loadImageCodec();
/// Whether writing a picture of this name asks for the codec: all but PNG do.
bool needsImageCodec(const std::filesystem::path& path);

/// Whether this build has what decodes WebP: a library that is loaded now.
bool canDecodeWebp();

/// Decodes a PNG/JPEG/… held in memory (a texture inside a .glb) to 8-bit RGBA, and beside it to 16-bit RGBA
/// where the file holds more than 8 bits tell. Throws InputError naming `name`.
Image decodeImage(std::span<const std::byte> bytes, const std::string& name);
/// Reads an image file likewise. Throws InputError.
Image readImage(const std::filesystem::path& path);
/// The size of an image file of any format that can be read. Throws InputError.
ImageHeader readImageHeader(const std::filesystem::path& path);
/// Reads .exr, .hdr, .png, … as linear floats, three channels or a grey one; alpha is left out.
/// Channels are chosen by name: R, G and B of the unnamed layer or of the only one that has them, else Y,
/// else X, Y and Z of a layer, else the only channel. OpenEXR: the picture is the display window, black where
/// there are no data. Radiance: turned as its header says, divided by its exposures. PNG: by gAMA or sRGB;
/// other integers are sRGB unless the file says linear. Throws InputError.
FloatImage readFloatImage(const std::filesystem::path& path);

/// Key and value written into the file's metadata (EXR attributes, PNG text).
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

/// Writes linear floats as .exr (32-bit float, zip). The file appears whole or not at all: it is written
/// under another name beside its own and renamed. Throws std::runtime_error on a write failure, InputError on
/// an unknown extension or a folder that does not exist.
void writeExr(const std::filesystem::path& path, const FloatImage& image, const ImageMetadata& metadata,
              const std::vector<std::string>& channelNames = {});
/// 8-bit colours, tone-mapped and sRGB-encoded, interleaved.
struct CodeImage {
  int width = 0;
  int height = 0;
  int channels = 3;  ///< 4: with an alpha that the colours are not multiplied by
  std::vector<std::uint8_t> codes;
};

/// Writes them as .png or .jpg, which has no fourth channel; same guarantees.
void writeCodes(const std::filesystem::path& path, const CodeImage& image, const ImageMetadata& metadata);
/// Throws InputError unless `path` has an extension that can be written and its folder exists and is
/// writable: called before a render starts, so that nothing is lost at its end.
void checkWritable(const std::filesystem::path& path);

}  // namespace whittle
