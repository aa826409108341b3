// What encodes and decodes image files, as a library of its own that is loaded when the first picture is read
// or written: OpenImageIO brings some 250 shared libraries along, a quarter of a second for every start of a
// program that may never need it.
#pragma once

#include "image/image_io.h"

namespace whittle {

/// The functions of image_io.h by the same names; paths are checked there.
class ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  virtual Image decodeImage(std::span<const std::byte> bytes, const std::string& name) const = 0;
  virtual Image readImage(const std::filesystem::path& path) const = 0;
  virtual ImageHeader readHeader(const std::filesystem::path& path) const = 0;
  virtual FloatImage readFloatImage(const std::filesystem::path& path) const = 0;
  virtual void writeExr(const std::filesystem::path& path, const FloatImage& image,
                        const ImageMetadata& metadata,
                        const std::vector<std::string>& channelNames) const = 0;
  /// `format`: "png" or "jpeg".
  virtual void writeCodes(const std::filesystem::path& path, const std::string& format,
                          const CodeImage& image, const ImageMetadata& metadata) const = 0;
};

}  // namespace whittle

/// What the library exports.
extern "C" [[gnu::visibility("default")]] const whittle::ImageCodec* whittleImageCodec();
