// What a finished render says on the terminal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/stats.h"

namespace whittle {

/// `--profile`: launches, items, time and rate of each stage, then the phases.
std::string profileTable(const Stats& stats);

/// One or two lines: picture, rays, time, rate.
std::string renderSummary(const Stats& stats);

}  // namespace whittle
