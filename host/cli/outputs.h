// Where pictures and reports go: checked before a render, written whole after it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "image/image_io.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle::cli {

/// Everything that one command will read and write, so that the checks happen in one place.
class OutputCheck {
 public:
  /// Width and height: of the pictures.
  OutputCheck(int width, int height) : width_(width), height_(height) {}

  /// `file` is an input: throws InputError where an output, named before or after this, would replace it.
  void reads(const std::filesystem::path& file);

  /// Throws InputError unless `file` can be written as a picture, and is not named twice.
  void picture(const std::string& option, const std::filesystem::path& file);
  /// Throws InputError where --alpha is asked for and a picture has no place for it.
  void alpha(const std::vector<std::filesystem::path>& pictures) const;
  /// The same for a text file; an empty path is no file.
  void text(const std::string& option, const std::filesystem::path& file);

 private:
  void claim(const std::string& option, const std::filesystem::path& file);

  struct Claim {
    std::string option;
    std::filesystem::path file;
  };
  int width_, height_;
  std::vector<std::filesystem::path> inputs_;
  std::vector<Claim> claims_;
  bool standardOutputUsed_ = false;
};

/// How radiance becomes codes.
struct Look {
  float stops = 0.0F;
  bool rollsOff = true;
  Bloom bloom;
  bool dithers = false;
};

/// What the settings leave to picture and scene; a note on standard error where stops were chosen and one of
/// the outputs shows them, unless `quiet`.
Look lookOf(const FloatImage& radiance, const Scene& scene, const Settings& settings,
            const std::vector<std::filesystem::path>& outputs, bool quiet);

/// Codes as .png and .jpg have them, three for each pixel, or with `alpha` (a channel, or no picture) four.
std::vector<std::uint8_t> pictureCodes(const FloatImage& radiance, const FloatImage& alpha, const Look& look);

/// .exr: linear floats; .png/.jpg: tone-mapped. `alpha`: a channel that joins them, or no picture at all.
/// `metadata` goes into the file.
void writePicture(const std::filesystem::path& file, const FloatImage& radiance, const FloatImage& alpha,
                  const Look& look, const ImageMetadata& metadata);

bool isExr(const std::filesystem::path& file);

/// Whether a picture's extension is of a format that holds tone-mapped colours, not radiance: .png, .jpg.
bool isToneMapped(const std::filesystem::path& file);

/// "-": text goes to standard output, and nothing else does.
bool isStandardOutput(const std::filesystem::path& file);

/// Writes text to a file that appears whole or not at all; devices and pipes are written to as they
/// are. Throws std::runtime_error.
void writeTextFile(const std::filesystem::path& file, const std::string& text);

}  // namespace whittle::cli
