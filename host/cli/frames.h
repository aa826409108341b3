// --frames: numbered pictures of a scene that moves, in one run.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

namespace whittle::cli {

struct Frames {
  int first = 0, last = 0;  ///< both are drawn
  double perSecond = 24.0;

  int count() const { return last - first + 1; }
  double secondsOf(int frame) const { return frame / perSecond; }
};

struct FrameOptions {
  std::optional<Frames> frames;  ///< unset: one picture
  double perSecond = 24.0;
};

/// --frames and --fps.
void addFrameOptions(CLI::App& command, FrameOptions& options);

/// Throws InputError unless it is A:B with 0 ≤ A ≤ B, whole numbers.
Frames parseFrames(const std::string& option, const std::string& text);

/// The name of a frame's file: its number stands in the place of the last run of #, with as many digits at
/// least; without one before the extension, with four and an underscore: film_0012.png.
std::filesystem::path frameFile(const std::filesystem::path& pattern, int frame);

}  // namespace whittle::cli
