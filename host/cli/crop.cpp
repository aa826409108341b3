// See crop.h.
#include "cli/crop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cli/option_kinds.h"

namespace whittle::cli {
namespace {

constexpr std::int64_t kMostPixels = 65535;

std::vector<std::string> partsOf(const std::string& word) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= word.size();) {
    const std::size_t end = std::min(word.find(',', begin), word.size());
    parts.push_back(word.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

bool isShare(const std::string& part) { return part.ends_with('%') || part.find('.') != std::string::npos; }

double shareOf(const std::string& option, const std::string& part) {
  if (!part.ends_with('%')) return parseReal(option, part, 0, 1);
  return parseReal(option, part.substr(0, part.size() - 1), 0, 100) / 100;
}

}  // namespace

Crop parseCrop(const std::string& option, const std::string& word) {
  const std::vector<std::string> parts = partsOf(word);
  const auto shares = static_cast<std::size_t>(std::count_if(parts.begin(), parts.end(), isShare));
  Crop crop;
  if (parts.size() != crop.numbers.size() || (shares > 0 && shares < parts.size()))
    throw InputError(
        fmt::format("{}: '{}' is no region: X,Y,W,H are four numbers of pixels, or four shares with a "
                    "decimal point or %",
                    option, word));
  crop.areShares = shares > 0;
  for (std::size_t i = 0; i < parts.size(); ++i)
    crop.numbers[i] = crop.areShares ? shareOf(option, parts[i])
                                     : static_cast<double>(parseWhole(option, parts[i], 0, kMostPixels));
  return crop;
}

glm::ivec2 parsePixel(const std::string& option, const std::string& word) {
  const std::vector<std::string> parts = partsOf(word);
  if (parts.size() != 2)
    throw InputError(fmt::format("{}: '{}' is no pixel; it is two whole numbers, X,Y", option, word));
  const auto whole = [&](const std::string& part) {
    return static_cast<int>(parseWhole(option, part, 0, kMostPixels - 1));
  };
  return {whole(parts[0]), whole(parts[1])};
}

Region regionOf(const Crop& crop, int width, int height) {
  const auto edge = [&](double at, int side) {
    return static_cast<int>(std::lround(crop.areShares ? at * side : at));
  };
  const auto [x, y, w, h] = crop.numbers;
  Region region{edge(x, width), edge(y, height), 0, 0};
  region.width = edge(x + w, width) - region.x;
  region.height = edge(y + h, height) - region.y;
  if (region.width < 1 || region.height < 1)
    throw InputError(
        fmt::format("--crop: {},{},{},{} of {}×{} is less than a pixel", x, y, w, h, width, height));
  if (!liesWithin(region, width, height))
    throw InputError(
        fmt::format("--crop: {},{},{},{} lies outside the picture of {}×{}", x, y, w, h, width, height));
  return region;
}

}  // namespace whittle::cli
