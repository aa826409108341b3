// See aovs.h.
#include "cli/aovs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/outputs.h"
#include "render/aovs.h"
#include "scene/input_error.h"

namespace whittle::cli {

const std::vector<std::string>& renderAovs() {
  static const std::vector<std::string> names = [] {
    auto all = kAovNames;
    all.emplace_back(kAllAovs);
    return all;
  }();
  return names;
}

void askForAovs(Settings& settings, const std::vector<std::string>& names) {
  for (const auto& name : names) {
    if (name == "error" && settings.raysPerPixel == 1)
      throw InputError(
          "--aov error: one ray for each pixel tells nothing of its error; use --rays-per-pixel 2 or more");
    if (name == kAllAovs)
      askForAllAovs(settings);
    else
      askForAov(settings, name);
  }
}

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
  if (aov == "cost") return {"cost.nodes", "cost.triangles"};
  return {aov + ".V"};
}

FloatImage layered(const FloatImage& radiance, const FloatImage& alpha,
                   const std::map<std::string, FloatImage>& aovs, std::vector<std::string>& names) {
  names = {"R", "G", "B"};
  std::vector<const FloatImage*> layers{&radiance};
  if (!alpha.pixels.empty()) {
    names.emplace_back("A");
    layers.push_back(&alpha);
  }
  for (const auto& [name, image] : aovs) {
    for (auto& channel : channelNamesOf(name)) names.push_back(std::move(channel));
    layers.push_back(&image);
  }
  return joined(layers);
}

void writeAov(const AovOutput& output, const FloatImage& radiance, const FloatImage& alpha,
              const std::map<std::string, FloatImage>& aovs, const ImageMetadata& metadata) {
  if (output.name != kAllAovs) {
    writeExr(output.file, aovs.at(output.name), metadata, channelNamesOf(output.name));
    return;
  }
  std::vector<std::string> names;
  const FloatImage all = layered(radiance, alpha, aovs, names);
  writeExr(output.file, all, metadata, names);
}

}  // namespace whittle::cli
