// What a finished render says on the terminal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/stats.h"

namespace whittle {

/// `--profile`: launches, items, time and rate of each stage, then the phases.
std::string profileTable(const Stats& stats);

/// A few lines: picture, rays, time, rate, error.
std::string renderSummary(const Stats& stats);

/// Which limits of depth ended a visible share of the throughput: a line for each.
std::vector<std::string> limitNotes(const Stats& stats);
/// One code of 8 bits.
inline constexpr double kVisibleShare = 1.0 / 256.0;

}  // namespace whittle
