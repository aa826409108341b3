// A sweep as a table for a terminal, as JSON and as CSV.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scale/run_sweep.h"
#include "scale/sweep.h"
#include "scene/scene.h"

namespace whittle {

/// At most 80 columns, but for values of axes that are longer.
std::string sweepText(const Sweep& sweep, const std::vector<Axis>& axes, const Scene& scene);

/// Everything, with 95 % intervals: see host/scale/README.md.
nlohmann::ordered_json sweepToJson(const Sweep& sweep, const std::vector<Axis>& axes, const Scene& scene,
                                   const RoundsPlan& plan);

/// A line for each sample of each stage, and of the frame: the axes, round, quiet, stage, seconds.
std::string sweepToCsv(const Sweep& sweep, const std::vector<Axis>& axes);

/// "threads 2, work-group 64"; of a sweep without axes "the settings as given".
std::string pointText(const SweptPoint& point, const std::vector<Axis>& axes);

}  // namespace whittle
