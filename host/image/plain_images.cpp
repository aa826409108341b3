// See plain_images.h. PNG after its third edition; JPEG by libjpeg, which OpenImageIO asks in the same way.
#include "image/plain_images.h"

#include <jpeglib.h>
#include <zlib.h>
#include <cstdio>  // jpeglib.h wants it

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "image/byte_order.h"
#include "image/image_header.h"
#include "image/png_chunks.h"
#include "image/png_filter.h"
#include "scene/input_error.h"

namespace whittle {
namespace {

using Bytes = std::span<const std::byte>;
using Codes = std::vector<std::uint8_t>;

bool startsWith(Bytes bytes, std::string_view magic) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

bool isTexture(std::int64_t width, std::int64_t height) {
  return width >= 1 && height >= 1 && width <= kMaxTextureSide && height <= kMaxTextureSide;
}

/// RGBA from rows of one to four channels: grey, grey and alpha, colours, colours and alpha.
void toRgba(const std::uint8_t* from, std::size_t count, std::size_t channels, std::uint8_t* out) {
  for (std::size_t i = 0; i < count; ++i, from += channels, out += 4) {
    const bool isGrey = channels < 3;
    out[0] = from[0];
    out[1] = isGrey ? from[0] : from[1];
    out[2] = isGrey ? from[0] : from[2];
    out[3] = channels % 2 == 0 ? from[channels - 1] : std::uint8_t{255};
  }
}

/// What the chunks of a PNG say; see PNG, 11.2 and 11.3.1.
struct PngParts {
  std::uint32_t width = 0, height = 0, bits = 0, colours = 0, coding = 0;
  bool hasColourKey = false;
  std::array<std::array<std::uint8_t, 4>, 256> palette{};
  std::size_t paletteSize = 0;
  std::vector<Bytes> data;

  bool hasPalette() const { return colours == 3; }
  std::size_t channels() const {
    return hasPalette() ? 1 : colours == 0 ? 1 : colours == 4 ? 2 : colours == 2 ? 3 : 4;
  }
  /// 8 bits, not interlaced, no colour that stands for transparency.
  bool isPlain() const {
    const bool isKnown = colours == 0 || colours == 2 || colours == 3 || colours == 4 || colours == 6;
    return isKnown && bits == 8 && coding == 0 && !hasColourKey && isTexture(width, height) &&
           (!hasPalette() || paletteSize > 0);
  }
};

void readPalette(Bytes data, PngParts& parts) {
  parts.paletteSize = std::min<std::size_t>(data.size() / 3, parts.palette.size());
  for (std::size_t i = 0; i < parts.paletteSize; ++i)
    for (std::size_t c = 0; c < 4; ++c)
      parts.palette[i][c] = c < 3 ? std::to_integer<std::uint8_t>(data[3 * i + c]) : std::uint8_t{255};
}

/// `bytes`: those that texelChunks keeps, whose lengths and checksums are right.
PngParts partsOf(Bytes bytes) {
  PngParts parts;
  for (Bytes rest = bytes.subspan(8); rest.size() >= 12;) {
    const std::size_t length = bigEndian(rest.first(4));
    const std::string_view type(reinterpret_cast<const char*>(rest.data()) + 4, 4);
    const Bytes data = rest.subspan(8, length);
    if (type == "IHDR" && length == 13) {
      parts.width = bigEndian(data.first(4));
      parts.height = bigEndian(data.subspan(4, 4));
      parts.bits = bigEndian(data.subspan(8, 1));
      parts.colours = bigEndian(data.subspan(9, 1));
      parts.coding = bigEndian(data.subspan(10, 3));  // 0: deflate, the usual filters, not interlaced
    } else if (type == "PLTE") {
      readPalette(data, parts);
    } else if (type == "tRNS" && parts.hasPalette()) {
      for (std::size_t i = 0; i < std::min(data.size(), parts.paletteSize); ++i)
        parts.palette[i][3] = std::to_integer<std::uint8_t>(data[i]);
    } else if (type == "tRNS") {
      parts.hasColourKey = true;
    } else if (type == "IDAT") {
      parts.data.push_back(data);
    }
    rest = rest.subspan(12 + length);
  }
  return parts;
}

/// A row after the other out of the compressed data.
class Inflater {
 public:
  explicit Inflater(const std::vector<Bytes>& data) : data_(data) { isGood_ = inflateInit(&stream_) == Z_OK; }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }

  bool read(std::uint8_t* out, std::size_t bytes) {
    stream_.next_out = out;
    stream_.avail_out = static_cast<uInt>(bytes);
    while (isGood_ && !isAtEnd_ && stream_.avail_out > 0) step();
    return isGood_ && stream_.avail_out == 0;
  }
  /// Whether nothing but the checksum was left, and it was right.
  bool ends() {
    std::uint8_t beyond = 0;
    stream_.next_out = &beyond;
    stream_.avail_out = 1;
    while (isGood_ && !isAtEnd_ && stream_.avail_out > 0) step();
    return isGood_ && isAtEnd_ && stream_.avail_out == 1;
  }

 private:
  void step() {
    if (stream_.avail_in == 0) {
      isGood_ = next_ < data_.size();
      if (!isGood_) return;
      const Bytes part = data_[next_++];
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(part.data()));  // only read
      stream_.avail_in = static_cast<uInt>(part.size());
    }
    const int status = inflate(&stream_, Z_NO_FLUSH);
    isAtEnd_ = status == Z_STREAM_END;
    isGood_ = status == Z_OK || isAtEnd_ || (status == Z_BUF_ERROR && stream_.avail_in == 0);
  }

  const std::vector<Bytes>& data_;
  z_stream stream_{};
  std::size_t next_ = 0;
  bool isGood_ = false, isAtEnd_ = false;
};

/// Undoes the filter of a row in its place. False: there is no such filter.
bool unfilter(int filter, std::uint8_t* row, const std::uint8_t* above, std::size_t bytes,
              std::size_t pixel) {
  const auto undo = [&](auto predicted) {
    for (std::size_t i = 0; i < bytes; ++i) {
      const int left = i < pixel ? 0 : row[i - pixel], corner = i < pixel ? 0 : above[i - pixel];
      row[i] = static_cast<std::uint8_t>(row[i] + predicted(left, above[i], corner));
    }
  };
  switch (filter) {  // a loop for each, without a switch inside
    case 0:
      return true;
    case 1:
      undo([](int left, int, int) { return left; });
      return true;
    case 2:
      undo([](int, int up, int) { return up; });
      return true;
    case 3:
      undo([](int left, int up, int) { return (left + up) / 2; });
      return true;
    case 4:
      undo([](int left, int up, int corner) { return paeth(left, up, corner); });
      return true;
    default:
      return false;
  }
}

/// False where an index has no colour.
bool lookUp(const PngParts& parts, const std::uint8_t* from, std::uint8_t* out) {
  for (std::size_t i = 0; i < parts.width; ++i) {
    if (from[i] >= parts.paletteSize) return false;
    std::memcpy(out + 4 * i, parts.palette[from[i]].data(), 4);
  }
  return true;
}

std::optional<Codes> decodePng(const PngParts& parts) {
  const std::size_t channels = parts.channels(), bytes = channels * parts.width;
  Inflater stream(parts.data);
  Codes row(bytes + 1), above(bytes + 1), out(std::size_t{4} * parts.width * parts.height);
  for (std::size_t y = 0; y < parts.height; ++y) {
    std::uint8_t* const texels = out.data() + 4 * y * parts.width;
    if (!stream.read(row.data(), bytes + 1)) return std::nullopt;
    if (!unfilter(row[0], row.data() + 1, above.data() + 1, bytes, channels)) return std::nullopt;
    if (!parts.hasPalette())
      toRgba(row.data() + 1, parts.width, channels, texels);
    else if (!lookUp(parts, row.data() + 1, texels))
      return std::nullopt;
    std::swap(row, above);
  }
  if (!stream.ends()) return std::nullopt;
  return out;
}

std::optional<Image> decodePlainPng(Bytes bytes, const std::string& name) {
  const std::vector<std::byte> chunks = texelChunks(bytes, name);
  const PngParts parts = partsOf(chunks);
  if (!parts.isPlain()) return std::nullopt;
  auto texels = decodePng(parts);
  if (!texels) return std::nullopt;
  return Image{name, static_cast<int>(parts.width), static_cast<int>(parts.height), std::move(*texels)};
}

/// libjpeg is left by longjmp: decodeJpeg has nothing of its own that would have to be destroyed.
struct JpegErrors {
  jpeg_error_mgr manager;
  std::jmp_buf out;
};

[[noreturn]] void leave(j_common_ptr info) { std::longjmp(reinterpret_cast<JpegErrors*>(info->err)->out, 1); }
/// A warning is an error here: the codec decides what to make of the picture.
void onMessage(j_common_ptr info, int level) {
  if (level < 0) leave(info);
}

/// Rows of RGBA into `out`, which is made as soon as the size is known, by way of `row`.
bool decodeJpeg(Bytes bytes, jpeg_decompress_struct& info, JpegErrors& errors, Codes& row, Codes& out) {
  info.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = leave;
  errors.manager.emit_message = onMessage;
  if (setjmp(errors.out) != 0) return false;
  jpeg_create_decompress(&info);
  jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  if (jpeg_read_header(&info, TRUE) != JPEG_HEADER_OK) return false;
  const bool isPlain = (info.num_components == 1 && info.out_color_space == JCS_GRAYSCALE) ||
                       (info.num_components == 3 && info.out_color_space == JCS_RGB);
  if (!isPlain || !isTexture(info.image_width, info.image_height)) return false;
  jpeg_start_decompress(&info);
  const std::size_t width = info.output_width, channels = static_cast<std::size_t>(info.output_components);
  row.resize(width * channels);
  out.resize(4 * width * info.output_height);
  while (info.output_scanline < info.output_height) {
    std::uint8_t* const texels = out.data() + 4 * width * info.output_scanline;
    JSAMPROW into = row.data();
    jpeg_read_scanlines(&info, &into, 1);
    toRgba(row.data(), width, channels, texels);
  }
  jpeg_finish_decompress(&info);
  return true;
}

std::optional<Image> decodePlainJpeg(Bytes bytes, const std::string& name) {
  jpeg_decompress_struct info{};
  JpegErrors errors;
  Codes row, texels;
  const bool isWhole = decodeJpeg(bytes, info, errors, row, texels);
  Image image{name, static_cast<int>(info.output_width), static_cast<int>(info.output_height),
              std::move(texels)};
  jpeg_destroy_decompress(&info);
  if (!isWhole) return std::nullopt;
  return image;
}

}  // namespace

bool mayBePlain(Bytes bytes) {
  return startsWith(bytes.first(2), "\x89P") || startsWith(bytes.first(2), "\xff\xd8");
}

std::optional<Image> decodePlainImage(Bytes bytes, const std::string& name) {
  if (startsWith(bytes, "\x89PNG\r\n\x1a\n")) return decodePlainPng(bytes, name);
  if (startsWith(bytes, "\xff\xd8\xff")) return decodePlainJpeg(bytes, name);
  return std::nullopt;
}

}  // namespace whittle
