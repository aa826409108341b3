// See frames.h.
#include "cli/frames.h"

#include <fmt/format.h>

#include <string>

#include "cli/option_kinds.h"

namespace whittle::cli {
namespace {

constexpr int kMostFrame = 9'999'999;

}  // namespace

void addFrameOptions(CLI::App& c, FrameOptions& o) {
  CLI::Option* frames = addText(
      c, "--frames", [&o](const std::string& word) { o.frames = parseFrames("--frames", word); },
      {"A:B",
       "draw frames A to B of the animation as numbered pictures, frame k at k / fps seconds: the number "
       "stands for #### in a file's name, or before its extension. What is chosen to suit the scene "
       "(exposure, focus, ambient light, an added camera) is that of the first",
       ""});
  addReal(c, "--fps", o.perSecond, 1e-3, 1e6, "N", "frames in a second of the animation", "24")
      ->needs(frames);
}

Frames parseFrames(const std::string& option, const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
    throw InputError(fmt::format(
        "{}: '{}' is not the first and the last frame with a colon between, such as 0:47", option, text));
  Frames frames;
  frames.first = static_cast<int>(parseWhole(option, text.substr(0, colon), 0, kMostFrame));
  frames.last = static_cast<int>(parseWhole(option, text.substr(colon + 1), 0, kMostFrame));
  if (frames.last < frames.first)
    throw InputError(
        fmt::format("{}: the last frame, {}, comes before the first, {}", option, frames.last, frames.first));
  return frames;
}

std::filesystem::path frameFile(const std::filesystem::path& pattern, int frame) {
  std::string name = pattern.filename().string();
  const std::size_t last = name.rfind('#');
  if (last == std::string::npos) {
    name = fmt::format("{}_{:04}{}", pattern.stem().string(), frame, pattern.extension().string());
  } else {
    const std::size_t before = name.find_last_not_of('#', last);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const auto digits = static_cast<int>(last + 1 - begin);
    name.replace(begin, last + 1 - begin, fmt::format("{:0{}}", frame, digits));
  }
  return pattern.parent_path() / name;
}

}  // namespace whittle::cli
