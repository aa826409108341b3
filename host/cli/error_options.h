// Options of error against time, for the commands that render or plan a render.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "scene/settings.h"

namespace whittle::cli {

/// --target-error, --time-limit and --adaptive.
void addErrorOptions(CLI::App& command, Settings& settings);

/// A target or a time limit without --rays-per-pixel means: as many as it takes. Throws InputError where
/// nothing says how many, or the sampler must know.
void settleRaysPerPixel(const CLI::App& command, Settings& settings);

/// The same where a hand switches target and limit on and off: as many as it takes in the place of the
/// `usual` number, and back; any other number stays.
void followTarget(Settings& settings, int usual);

/// A line where --adaptive has nothing to give out.
std::vector<std::string> uselessAdaptive(const Settings& settings);

}  // namespace whittle::cli
