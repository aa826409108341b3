// Header lines, the resolution line, then scanlines of RGBE: flat, or run-length encoded in the old way (runs
// of whole pixels) or the new one (each of the four components by itself).
#include "image/radiance_file.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "scene/input_error.h"

namespace whittle {
namespace {

constexpr int kMaxSide = 65536;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 30;

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw InputError(fmt::format("{}: cannot be decoded: {}", name, why));
}

/// What is left of the file.
class Reader {
 public:
  Reader(std::span<const std::byte> bytes, const std::string& name) : rest_(bytes), name_(name) {}

  std::size_t left() const { return rest_.size(); }

  std::uint8_t byte() {
    if (rest_.empty()) refuse(name_, "the Radiance picture is cut off");
    const auto value = std::to_integer<std::uint8_t>(rest_.front());
    rest_ = rest_.subspan(1);
    return value;
  }

  /// Up to the next line feed, which is skipped; without a carriage return before it.
  std::string line() {
    std::string text;
    for (std::uint8_t c = byte(); c != '\n'; c = byte()) text += static_cast<char>(c);
    if (!text.empty() && text.back() == '\r') text.pop_back();
    return text;
  }

 private:
  std::span<const std::byte> rest_;
  const std::string& name_;
};

/// The numbers behind a keyword, blanks between them; exactly N positive ones, or a refusal.
template <std::size_t N>
std::array<double, N> factors(std::string_view text, const std::string& line, const std::string& name) {
  std::array<double, N> values{};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  const auto skipBlanks = [&] {
    while (at != end && (*at == ' ' || *at == '\t')) ++at;
  };
  bool good = true;
  for (double& value : values) {
    skipBlanks();
    const auto [stopped, error] = std::from_chars(at, end, value);
    good = good && error == std::errc{} && value > 0.0 && std::isfinite(value);
    at = stopped;
  }
  skipBlanks();
  if (!good || at != end) refuse(name, fmt::format("its line '{}' is not {} positive", line, N));
  return values;
}

/// Stored values over these are radiance.
std::array<double, 3> readHeader(Reader& in, const std::string& name) {
  std::array<double, 3> scale{1, 1, 1};
  for (std::string line = in.line(); !line.empty(); line = in.line()) {
    const std::string_view text(line);
    if (text.starts_with("FORMAT=") && text.find("32-bit_rle_rgbe") == std::string_view::npos)
      refuse(name,
             fmt::format("its format is '{}', not 32-bit_rle_rgbe; convert it with Radiance's ra_xyze -r",
                         text.substr(7)));
    if (text.starts_with("EXPOSURE=")) {
      const double exposure = factors<1>(text.substr(9), line, name)[0];
      for (double& channel : scale) channel *= exposure;
    }
    if (text.starts_with("COLORCORR=")) {
      const auto correction = factors<3>(text.substr(10), line, name);
      for (int c = 0; c < 3; ++c) scale[c] *= correction[c];
    }
  }
  return scale;
}

/// One half of the resolution line: "-Y 512".
struct Axis {
  char sign = '+', name = 'X';
  int size = 0;

  /// Where step `i` lies, counted from the left (X) or the top (Y): +X goes right, +Y goes up.
  int place(int i) const { return (sign == '+') == (name == 'X') ? i : size - 1 - i; }
};

/// `slow` goes from scanline to scanline, `fast` along each.
struct Resolution {
  Axis slow, fast;
};

Axis parseAxis(std::string_view& text) {
  Axis axis;
  if (text.size() < 4 || (text[0] != '+' && text[0] != '-') || (text[1] != 'X' && text[1] != 'Y'))
    return axis;
  axis.sign = text[0];
  axis.name = text[1];
  text.remove_prefix(2);
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), axis.size);
  if (error != std::errc{}) axis.size = 0;
  text.remove_prefix(static_cast<std::size_t>(stopped - text.data()));
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  return axis;
}

Resolution readResolution(Reader& in, const std::string& name) {
  const std::string line = in.line();
  std::string_view text(line);
  Resolution r;
  r.slow = parseAxis(text);
  r.fast = parseAxis(text);
  if (!text.empty() || r.slow.size < 1 || r.fast.size < 1 || r.slow.name == r.fast.name)
    refuse(name, fmt::format("'{}' is no resolution, such as '-Y 512 +X 1024'", line));
  if (r.slow.size > kMaxSide || r.fast.size > kMaxSide ||
      std::int64_t{r.slow.size} * r.fast.size > kMaxPixels)
    throw InputError(fmt::format("{}: '{}' are too many pixels, at most {} a side and {} in all", name, line,
                                 kMaxSide, kMaxPixels));
  return r;
}

using Rgbe = std::array<std::uint8_t, 4>;

/// The old encoding: mantissas of 1, which no normalised colour has, repeat the pixel before them; several in
/// a row are the digits of one count, the lowest first.
void readOldScanline(Reader& in, const std::string& name, Rgbe first, std::vector<Rgbe>& line) {
  std::size_t at = 0;
  for (int shift = 0; at < line.size();) {
    if (first[0] == 1 && first[1] == 1 && first[2] == 1) {
      const std::size_t count = shift < 24 ? std::size_t{first[3]} << shift : line.size();
      if (at == 0 || count > line.size() - at) refuse(name, "a run leaves its scanline");
      for (std::size_t i = 0; i < count; ++i, ++at) line[at] = line[at - 1];
      shift += 8;
    } else {
      line[at++] = first;
      shift = 0;
    }
    if (at < line.size())
      for (auto& component : first) component = in.byte();
  }
}

void readScanline(Reader& in, const std::string& name, std::vector<Rgbe>& line) {
  constexpr std::size_t kLeast = 8, kMost = 0x7fff;  // pixels of a scanline in the new encoding
  Rgbe first{};
  for (auto& component : first) component = in.byte();
  if (line.size() < kLeast || line.size() > kMost || first[0] != 2 || first[1] != 2 || first[2] >= 128) {
    readOldScanline(in, name, first, line);
    return;
  }
  if ((std::size_t{first[2]} << 8 | first[3]) != line.size())
    refuse(name, "a scanline has another length than the header says");
  for (std::size_t component = 0; component < 4; ++component)
    for (std::size_t at = 0; at < line.size();) {
      const std::uint8_t code = in.byte();
      const bool isRun = code > 128;
      const std::size_t count = isRun ? code & 127U : code;
      if (count == 0 || count > line.size() - at) refuse(name, "a run leaves its scanline");
      const std::uint8_t repeated = isRun ? in.byte() : std::uint8_t{0};
      for (std::size_t i = 0; i < count; ++i) line[at++][component] = isRun ? repeated : in.byte();
    }
}

float decode(std::uint8_t mantissa, std::uint8_t exponent, double scale) {
  if (exponent == 0) return 0.0F;
  const float stored = std::ldexp(static_cast<float>(mantissa), exponent - 136);
  return scale == 1.0 ? stored : static_cast<float>(static_cast<double>(stored) / scale);
}

}  // namespace

bool isRadianceFile(std::span<const std::byte> bytes) {
  return bytes.size() >= 2 && bytes[0] == std::byte{'#'} && bytes[1] == std::byte{'?'};
}

FloatImage decodeRadiance(std::span<const std::byte> bytes, const std::string& name) {
  Reader in(bytes, name);
  const std::array<double, 3> scale = readHeader(in, name);
  const Resolution r = readResolution(in, name);
  // Each scanline takes four bytes at least: nothing is allocated for a header alone.
  if (in.left() / 4 < static_cast<std::size_t>(r.slow.size)) refuse(name, "the Radiance picture is cut off");
  const bool rows = r.slow.name == 'Y';
  FloatImage image{rows ? r.fast.size : r.slow.size, rows ? r.slow.size : r.fast.size, 3, {}};
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height * 3);
  std::vector<Rgbe> line(r.fast.size);
  for (int i = 0; i < r.slow.size; ++i) {
    readScanline(in, name, line);
    for (int j = 0; j < r.fast.size; ++j) {
      const int x = rows ? r.fast.place(j) : r.slow.place(i), y = rows ? r.slow.place(i) : r.fast.place(j);
      float* const rgb = &image.pixels[(static_cast<std::size_t>(y) * image.width + x) * 3];
      for (int c = 0; c < 3; ++c) rgb[c] = decode(line[j][c], line[j][3], scale[c]);
    }
  }
  return image;
}

}  // namespace whittle
