// Where pictures go: checked before a render, written whole after it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/image_io.h"

namespace whittle::cli {

/// One `--aov NAME=FILE`.
struct AovOutput {
  std::string name;
  std::filesystem::path file;
};

/// Throws InputError unless it is NAME=FILE with a name that exists.
AovOutput parseAov(const std::string& text);

/// .exr: linear floats; .png/.jpg: tone-mapped at `exposure` stops. `metadata` goes into the file.
void writePicture(const std::filesystem::path& file, const FloatImage& radiance, float exposure, const ImageMetadata& metadata);

/// Writes text to a file that appears whole or not at all. Throws std::runtime_error.
void writeTextFile(const std::filesystem::path& file, const std::string& text);
/// Throws InputError unless the file's folder exists and can be written.
void checkTextFile(const std::filesystem::path& file, const std::string& option);

}  // namespace whittle::cli
