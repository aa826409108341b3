// See aovs.h.
#include "cli/aovs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/outputs.h"
#include "scene/input_error.h"

namespace whittle::cli {
namespace {

/// Puts the channels of `from` behind the first `at` of each pixel.
void place(const FloatImage& from, int at, FloatImage& to) {
  const auto source = static_cast<std::size_t>(from.channels), target = static_cast<std::size_t>(to.channels);
  for (std::size_t p = 0; p < from.pixels.size() / source; ++p)
    std::copy_n(&from.pixels[p * source], source, &to.pixels[p * target + static_cast<std::size_t>(at)]);
}

}  // namespace

AovOutput parseAov(const std::string& text, const std::vector<std::string>& names) {
  const auto equals = text.find('=');
  const std::string name = text.substr(0, equals);
  if (equals == std::string::npos || std::find(names.begin(), names.end(), name) == names.end())
    throw InputError(
        fmt::format("--aov: '{}' is not NAME=FILE with NAME one of {}", text, fmt::join(names, ", ")));
  AovOutput aov{name, text.substr(equals + 1)};
  if (!isExr(aov.file))
    throw InputError(fmt::format("--aov: '{}' must end in .exr: it holds floats", aov.file.string()));
  return aov;
}

std::vector<std::string> channelNamesOf(const std::string& aov) {
  if (aov == "depth") return {"Z"};
  if (aov == "normal") return {"normal.X", "normal.Y", "normal.Z"};
  if (aov == "albedo") return {"albedo.R", "albedo.G", "albedo.B"};
  return {aov + ".V"};
}

FloatImage layered(const FloatImage& radiance, const std::map<std::string, FloatImage>& aovs,
                   std::vector<std::string>& names) {
  names = {"R", "G", "B"};
  for (const auto& [name, image] : aovs)
    for (auto& channel : channelNamesOf(name)) names.push_back(std::move(channel));
  FloatImage all{radiance.width, radiance.height, static_cast<int>(names.size()), {}};
  all.pixels.resize(radiance.pixels.size() / 3 * names.size());
  place(radiance, 0, all);
  int at = 3;
  for (const auto& [name, image] : aovs) {
    place(image, at, all);
    at += image.channels;
  }
  return all;
}

void writeAov(const AovOutput& output, const FloatImage& radiance,
              const std::map<std::string, FloatImage>& aovs, const ImageMetadata& metadata) {
  if (output.name != kAllAovs) {
    writeExr(output.file, aovs.at(output.name), metadata, channelNamesOf(output.name));
    return;
  }
  std::vector<std::string> names;
  const FloatImage all = layered(radiance, aovs, names);
  writeExr(output.file, all, metadata, names);
}

}  // namespace whittle::cli
