// Rows are filtered and compressed in bands, side by side. Each band but the first begins with the 32 kB
// before it as its dictionary and all but the last end on a whole byte, so that one stream comes out (as in
// pigz, M. Adler). Filters: the one with the least sum of absolute differences, row by row (PNG, 12.7).
#include "image/png_writer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <span>
#include <stdexcept>
#include <string_view>

#include "image/png_filter.h"

namespace whittle {
namespace {

using PngBytes = std::vector<std::uint8_t>;

constexpr std::size_t kBandBytes = 1 << 18;   ///< enough that what the dictionary costs does not show
constexpr std::size_t kDictionary = 1 << 15;  ///< as far as deflate looks back
constexpr int kLevel = 6;                     ///< zlib's own choice between time and size

void putBigEndian(PngBytes& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(value >> shift));
}

void putChunk(PngBytes& out, std::string_view type, const PngBytes& data) {
  putBigEndian(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = out.size();
  out.insert(out.end(), type.begin(), type.end());
  out.insert(out.end(), data.begin(), data.end());
  putBigEndian(
      out, static_cast<std::uint32_t>(::crc32(0, out.data() + start, static_cast<uInt>(out.size() - start))));
}

/// The filter's number and the filtered row, behind `out`. `above`: the row before, null for the first.
void putFiltered(const std::uint8_t* row, const std::uint8_t* above, std::size_t bytes, std::size_t pixel,
                 PngBytes& trial, std::uint8_t* out) {
  std::uint64_t least = ~std::uint64_t{0};
  for (int filter = 0; filter < kPngFilters; ++filter) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
      const int left = i < pixel ? 0 : row[i - pixel], up = above ? above[i] : 0,
                corner = i < pixel || !above ? 0 : above[i - pixel];
      trial[i] = static_cast<std::uint8_t>(row[i] - predict(filter, left, up, corner));
      sum += static_cast<std::uint64_t>(std::abs(static_cast<std::int8_t>(trial[i])));
    }
    if (sum >= least) continue;
    least = sum;
    out[0] = static_cast<std::uint8_t>(filter);
    std::copy_n(trial.begin(), bytes, out + 1);
  }
}

/// Of the picture's rows, each with the number of its filter in front.
PngBytes filtered(const CodeImage& image) {
  const auto pixel = static_cast<std::size_t>(image.channels), bytes = pixel * image.width;
  PngBytes out((bytes + 1) * image.height);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, image.height, 16), [&](const auto& rows) {
    PngBytes trial(bytes);
    for (std::size_t y = rows.begin(); y < rows.end(); ++y) {
      const std::uint8_t* const row = image.codes.data() + y * bytes;
      putFiltered(row, y == 0 ? nullptr : row - bytes, bytes, pixel, trial, out.data() + y * (bytes + 1));
    }
  });
  return out;
}

/// A part of a raw deflate stream.
PngBytes deflated(const PngBytes& all, std::size_t begin, std::size_t end) {
  z_stream stream{};
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
  const std::size_t before = std::min(begin, kDictionary);
  if (before > 0) deflateSetDictionary(&stream, all.data() + begin - before, static_cast<uInt>(before));
  PngBytes out(deflateBound(&stream, static_cast<uLong>(end - begin)) +
               16);                                         // and an empty block of the flush
  stream.next_in = const_cast<Bytef*>(all.data() + begin);  // which is only read
  stream.avail_in = static_cast<uInt>(end - begin);
  stream.next_out = out.data();
  stream.avail_out = static_cast<uInt>(out.size());
  const bool isLast = end == all.size();
  const int status = deflate(&stream, isLast ? Z_FINISH : Z_SYNC_FLUSH);
  out.resize(out.size() - stream.avail_out);
  const bool isWhole = status == (isLast ? Z_STREAM_END : Z_OK) && stream.avail_in == 0;
  deflateEnd(&stream);
  if (!isWhole) throw std::runtime_error("a picture cannot be compressed");
  return out;
}

PngBytes zlibStream(const PngBytes& all) {
  std::vector<PngBytes> parts((all.size() + kBandBytes - 1) / kBandBytes);
  std::vector<uLong> sums(parts.size());
  const auto endOf = [&](std::size_t i) { return std::min(all.size(), (i + 1) * kBandBytes); };
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    const std::size_t begin = i * kBandBytes;
    parts[i] = deflated(all, begin, endOf(i));
    sums[i] = ::adler32(1, all.data() + begin, static_cast<uInt>(endOf(i) - begin));
  });
  PngBytes out{0x78, 0x9c};  // deflate with a window of 32 kB, the default level
  uLong sum = 1;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    out.insert(out.end(), parts[i].begin(), parts[i].end());
    sum = ::adler32_combine(sum, sums[i], static_cast<z_off_t>(endOf(i) - i * kBandBytes));
  }
  putBigEndian(out, static_cast<std::uint32_t>(sum));
  return out;
}

/// In hundred thousandths, what sRGB says of itself (PNG, 11.3.2): for readers that know gamma alone.
constexpr std::uint32_t kGamma = 45455;
constexpr std::array<std::uint32_t, 8> kWhiteRedGreenBlue{31270, 32900, 64000, 33000,
                                                          30000, 60000, 15000, 6000};

}  // namespace

std::vector<std::byte> encodePng(const CodeImage& image, const ImageMetadata& metadata) {
  constexpr std::array<std::uint8_t, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr std::uint8_t kBits = 8, kColours = 2, kColoursAndAlpha = 6, kAbsolute = 3;  // colorimetric
  PngBytes out(kSignature.begin(), kSignature.end()), data;
  putBigEndian(data, static_cast<std::uint32_t>(image.width));
  putBigEndian(data, static_cast<std::uint32_t>(image.height));
  for (const std::uint8_t byte : {kBits, image.channels == 4 ? kColoursAndAlpha : kColours, std::uint8_t{0},
                                  std::uint8_t{0}, std::uint8_t{0}})
    data.push_back(byte);
  putChunk(out, "IHDR", data);
  data.clear();
  putBigEndian(data, kGamma);
  putChunk(out, "gAMA", data);
  putChunk(out, "sRGB", {kAbsolute});
  data.clear();
  for (const std::uint32_t v : kWhiteRedGreenBlue) putBigEndian(data, v);
  putChunk(out, "cHRM", data);
  for (const auto& [key, value] : metadata) {
    data.assign(key.begin(), key.end());
    data.push_back(0);
    data.insert(data.end(), value.begin(), value.end());
    putChunk(out, "tEXt", data);
  }
  // A chunk's length has 31 bits.
  constexpr std::size_t kMostData = std::size_t{1} << 30;
  const PngBytes stream = zlibStream(filtered(image));
  for (std::size_t at = 0; at < stream.size(); at += kMostData) {
    const auto begin = stream.begin() + static_cast<std::ptrdiff_t>(at);
    data.assign(begin, begin + static_cast<std::ptrdiff_t>(std::min(kMostData, stream.size() - at)));
    putChunk(out, "IDAT", data);
  }
  putChunk(out, "IEND", {});
  const auto bytes = std::as_bytes(std::span(out));
  return {bytes.begin(), bytes.end()};
}

}  // namespace whittle
