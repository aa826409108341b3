// Auxiliary outputs: --aov NAME=FILE.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "image/image_io.h"
#include "scene/settings.h"

namespace whittle::cli {

/// One `--aov NAME=FILE`.
struct AovOutput {
  std::string name;
  std::filesystem::path file;
};

/// The name that stands for the picture and every other, in one file of layers.
inline constexpr const char* kAllAovs = "all";

/// What `whittle render` and `whittle reference` know.
const std::vector<std::string>& renderAovs();
inline const std::vector<std::string> kReferenceAovs{"depth", "primitive", kAllAovs};

/// Has the render keep these outputs of renderAovs. Throws InputError where they and the settings do not fit.
void askForAovs(Settings& settings, const std::vector<std::string>& names);

/// Throws InputError unless it is NAME=FILE.exr with a name among `names`.
AovOutput parseAov(const std::string& text, const std::vector<std::string>& names);

/// What compositors look for: Z, normal.X, albedo.R, primitive.V, … No name is a word alone, which some
/// readers drop.
std::vector<std::string> channelNamesOf(const std::string& aov);

/// The picture as R, G, B, A where it has an alpha, and every output under its channel names, interleaved;
/// all of one size. `names`: those of the channels, in their order.
FloatImage layered(const FloatImage& radiance, const FloatImage& alpha,
                   const std::map<std::string, FloatImage>& aovs, std::vector<std::string>& names);

/// One output, or all of them. `aovs` has those that the command knows. Throws as writeExr.
void writeAov(const AovOutput& output, const FloatImage& radiance, const FloatImage& alpha,
              const std::map<std::string, FloatImage>& aovs, const ImageMetadata& metadata);

}  // namespace whittle::cli
