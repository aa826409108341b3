// Output files.
#include "cli/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <span>
#include <stdexcept>

#include "cli/speech.h"
#include "image/bloom.h"
#include "image/tone_map.h"
#include "scene/input_error.h"
#include "scene/material_predicates.h"
#include "scene/whole_file.h"

namespace whittle::cli {
namespace {

namespace fs = std::filesystem;

bool hasExtension(const fs::path& file, std::initializer_list<const char*> names) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(names.begin(), names.end(), extension) != names.end();
}

bool isJpeg(const fs::path& file) { return hasExtension(file, {".jpg", ".jpeg"}); }

/// What libjpeg can write (JPEG_MAX_DIMENSION); beyond it, it ends the process.
constexpr int kLargestJpeg = 65500;

/// /dev/null, /dev/stdout, a named pipe: no file to replace.
bool isStream(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// To `path`, or to standard output as it is: opened anew, a file that it was
/// redirected to would lose what it has.
void writeStream(const fs::path& path, const std::string& text) {
  const bool standard = isStandardOutput(path);
  std::FILE* const out = standard ? stdout : std::fopen(path.c_str(), "wb");
  bool written = out != nullptr && std::fwrite(text.data(), 1, text.size(), out) == text.size();
  written = written && std::fflush(out) == 0;
  const int error = errno;
  if (out != nullptr && !standard) std::fclose(out);
  if (!written)
    throw std::runtime_error(fmt::format("{}: cannot be written: {}",
                                         standard ? "standard output" : path.string(), std::strerror(error)));
}

/// Wherever links lead.
bool isSame(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(a, error), error) ==
         fs::weakly_canonical(fs::absolute(b, error), error);
}

[[noreturn]] void refuseInput(const std::string& option, const fs::path& file) {
  throw InputError(fmt::format("{}: {} is the input; it would be overwritten", option, file.string()));
}

}  // namespace

void OutputCheck::reads(const fs::path& file) {
  for (const Claim& claim : claims_)
    if (isSame(claim.file, file)) refuseInput(claim.option, claim.file);
  inputs_.push_back(file);
}

void OutputCheck::claim(const std::string& option, const fs::path& file) {
  for (const fs::path& input : inputs_)
    if (isSame(input, file)) refuseInput(option, file);
  for (const Claim& other : claims_)
    if (isSame(other.file, file))
      throw InputError(fmt::format("{}: {} is named for two outputs", option, file.string()));
  claims_.push_back({option, file});
}

void OutputCheck::picture(const std::string& option, const fs::path& file) {
  if (file.empty()) throw InputError(fmt::format("{}: its value is empty; it names a file", option));
  try {
    checkWritable(file);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", option, e.what()));
  }
  if (isStream(file)) throw InputError(fmt::format("{}: {} is not a regular file", option, file.string()));
  if (isJpeg(file) && std::max(width_, height_) > kLargestJpeg)
    throw InputError(fmt::format("{}: {}: a JPEG has at most {} pixels to a side; .png and .exr have more",
                                 option, file.string(), kLargestJpeg));
  claim(option, file);
  tryFolder(file);
}

void OutputCheck::alpha(const std::vector<fs::path>& pictures) const {
  for (const fs::path& file : pictures)
    if (isJpeg(file))
      throw InputError(
          fmt::format("--alpha: {}: a JPEG has no alpha channel; .png and .exr have one", file.string()));
}

void OutputCheck::text(const std::string& option, const fs::path& file) {
  if (file.empty()) return;
  if (isStandardOutput(file)) {
    if (standardOutputUsed_)
      throw InputError(fmt::format("{}: standard output is named for two outputs", option));
    standardOutputUsed_ = true;
    return;
  }
  if (isStream(file)) return;  // written to as it is; its folder takes no part in that
  try {
    checkFolderWritable(file);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", option, e.what()));
  }
  claim(option, file);
  tryFolder(file);
}

Look lookOf(const FloatImage& radiance, const Scene& scene, const Settings& settings,
            const std::vector<fs::path>& outputs, bool quiet) {
  const bool isShown = std::any_of(outputs.begin(), outputs.end(), isToneMapped);
  const bool isUnlit = !scene.triangles.empty() &&
                       std::none_of(scene.triangles.begin(), scene.triangles.end(),
                                    [&](const Triangle& t) { return isLit(scene.materials[t.material]); });
  Look look;
  look.bloom = settings.bloom;
  look.dithers = settings.dither;
  look.rollsOff = settings.toneMap == ToneMap::Auto ? !isUnlit : settings.toneMap == ToneMap::Filmic;
  if (settings.exposure) {
    look.stops = *settings.exposure;
  } else if (isShown && !isUnlit) {
    look.stops = fittingExposure(radiance, settings.skyLight ? kNoisyBlock : 1);
    if (look.stops != 0.0F && !quiet)
      note(fmt::format(
          "exposed by {:+.1f} stops, since the picture would be too {}; --exposure 0 leaves it so",
          look.stops, look.stops > 0.0F ? "dark" : "bright"));
  }
  return look;
}

std::vector<std::uint8_t> pictureCodes(const FloatImage& radiance, const FloatImage& alpha,
                                       const Look& look) {
  FloatImage glaring;
  if (look.bloom.strength > 0.0F) glaring = withBloom(radiance, look.bloom);
  const FloatImage& shown = glaring.pixels.empty() ? radiance : glaring;
  if (alpha.pixels.empty()) return toneMap(shown, look.stops, nullptr, look.rollsOff, look.dithers);
  return toneMapWithAlpha(shown, alpha, look.stops, look.rollsOff, look.dithers);
}

void writePicture(const fs::path& file, const FloatImage& radiance, const FloatImage& alpha, const Look& look,
                  const ImageMetadata& metadata) {
  const bool opaque = alpha.pixels.empty();
  if (isExr(file))
    writeExr(file, opaque ? radiance : joined({&radiance, &alpha}), metadata);
  else
    writeCodes(file, {radiance.width, radiance.height, opaque ? 3 : 4, pictureCodes(radiance, alpha, look)},
               metadata);
}

bool isExr(const fs::path& file) { return hasExtension(file, {".exr"}); }

bool isToneMapped(const fs::path& file) { return isJpeg(file) || hasExtension(file, {".png"}); }

bool isStandardOutput(const fs::path& file) { return file == "-"; }

void writeTextFile(const fs::path& file, const std::string& text) {
  if (isStandardOutput(file) || isStream(file))
    writeStream(file, text);
  else
    writeWholeFile(file, std::as_bytes(std::span(text)));
}

}  // namespace whittle::cli
