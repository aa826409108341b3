// Output files.
#include "cli/outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "image/tone_map.h"
#include "scene/input_error.h"

namespace whittle::cli {

AovOutput parseAov(const std::string& text) {
  static const std::array<std::string, 4> kNames{"depth", "normal", "albedo", "primitive"};
  const auto equals = text.find('=');
  const std::string name = text.substr(0, equals);
  if (equals == std::string::npos || std::find(kNames.begin(), kNames.end(), name) == kNames.end())
    throw InputError(fmt::format("--aov: '{}' is not NAME=FILE with NAME one of depth, normal, albedo, primitive", text));
  AovOutput aov{name, text.substr(equals + 1)};
  if (aov.file.extension() != ".exr") throw InputError(fmt::format("--aov: {} must end in .exr: it holds floats", aov.file.string()));
  return aov;
}

void writePicture(const std::filesystem::path& file, const FloatImage& radiance, float exposure, const ImageMetadata& metadata) {
  if (file.extension() == ".exr") {
    writeExr(file, radiance, metadata);
    return;
  }
  writeRgb8(file, radiance.width, radiance.height, toneMap(radiance, exposure), metadata);
}

void checkTextFile(const std::filesystem::path& file, const std::string& option) {
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder)) throw InputError(fmt::format("{}: folder {} does not exist", option, folder.string()));
  if (access(folder.c_str(), W_OK) != 0) throw InputError(fmt::format("{}: folder {} cannot be written", option, folder.string()));
  if (std::filesystem::is_directory(file)) throw InputError(fmt::format("{}: {} is a folder", option, file.string()));
}

void writeTextFile(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::path temporary = file;
  temporary += fmt::format(".{}.part", getpid());
  std::ofstream out(temporary, std::ios::binary);
  out << text;
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(temporary, file, error);
  if (!out || error) {
    std::filesystem::remove(temporary, error);
    throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
  }
}

}  // namespace whittle::cli
