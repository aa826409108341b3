// Everything a render can say about itself, once: printed by --profile, written by --stats.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/pruning_report.h"
#include "analysis/radiance_bound.h"
#include "report/stage_facts.h"
#include "scene/settings.h"

namespace whittle {

struct StageStats {
  StageFacts facts;
  std::uint32_t perWorkItem = 1;  ///< items that a work item takes
  std::uint64_t launches = 0;
  double seconds =
      0.0;  ///< on the device, from its event counters, or by the host (Stats::device.givesTimes)
  std::uint64_t items = 0;  ///< not padded work items
  std::uint64_t bytes = 0;  ///< of queues and film, as wavefront/stages.h counts them

  /// Adds the launches of another bounce of the same stage.
  void add(const StageStats& more) {
    launches += more.launches;
    seconds += more.seconds;
    items += more.items;
    bytes += more.bytes;
  }
};

/// The launches of one bounce.
struct BounceStats {
  std::uint32_t bounce = 0;  ///< 1 = what the eye sees; 0: stages outside the bounces
  std::vector<StageStats> stages;
};

/// What the host did when; phases may overlap, the kernel compiler runs beside the tree builder.
struct PhaseStats {
  std::string name;
  double start = 0.0;  ///< seconds of the steady clock
  double seconds = 0.0;
};

/// What ran the batches of a render from one on.
struct ProgramRun {
  bool isGeneral = false;            ///< else the scene's own programs
  std::uint32_t firstBatch = 0;      ///< from 0
  double from = 0.0, seconds = 0.0;  ///< of the render
};

struct BufferStats {
  std::string name;
  std::string group;  ///< tree, triangles, queues, textures, film
  std::uint64_t bytes = 0;
};

struct ErrorPoint {
  double seconds = 0.0;
  double raysPerPixel = 0.0;  ///< on average
  double estimate = 0.0;  ///< what rmse is expected to be, from the samples' variance (film.h), W/(m² sr)
  std::optional<double> rmse;  ///< against RenderHooks::reference, all colour channels, W/(m² sr)
  double mean = 0.0;           ///< radiance of the picture, over pixels and colour channels, W/(m² sr)
};

/// What the estimate at this point must come down to, W/(m² sr); 0: no target was asked for, or a share of a
/// black picture.
double errorTarget(const Settings& settings, const ErrorPoint& point);
/// Whether a target was asked for and the estimate is known to be within it. A black picture in which nothing
/// varies is within any share of its mean.
bool meetsTarget(const Settings& settings, const ErrorPoint& point);

struct Stats {
  struct {
    std::string file;
    std::uint64_t triangles = 0, droppedTriangles = 0, materials = 0, lights = 0, textures = 0;
  } scene;
  Settings settings;  ///< as used; raysPerPixel is what was asked for, `samples` what was reached
  std::string searchUsed;
  struct {
    std::string platform, name, version, driver;
    unsigned computeUnits = 0;
    int threads = 0;
    bool givesTimes = true;  ///< else its driver's are none, and those of stages are the host's
  } device;
  std::vector<std::string> featuresUsed;
  std::vector<std::string> featuresForced;  ///< those of them that the scene does not need
  std::vector<std::pair<std::string, std::string>> featuresLeftOut;  ///< name, reason
  PruningReport pruning;                                             ///< what of the scene stays on the host
  struct {
    std::uint64_t primary = 0, impulse = 0, shadow = 0;
    std::uint64_t total() const { return primary + impulse + shadow; }
  } rays;
  struct {
    double load = 0, build = 0, compile = 0, upload = 0, render = 0, write = 0, total = 0;  ///< seconds
  } time;
  std::vector<PhaseStats> phases;    ///< in the order of their ends
  std::vector<ProgramRun> programs;  ///< one after the other
  std::vector<StageStats> stages;    ///< over all bounces
  std::vector<BounceStats> bounces;
  std::vector<BufferStats> buffers;
  std::vector<ErrorPoint> error;
  EndedThroughput ended;      ///< of all samples
  double biasBound = 0.0;     ///< on what that took off the mean, W/(m² sr); may be infinite
  double meanRadiance = 0.0;  ///< of the picture, in the brightest channel, W/(m² sr)
  struct {
    std::uint32_t least = 0, most = 0;
    double mean = 0.0;
  } samples;                    ///< of a pixel
  std::uint64_t nonFinite = 0;  ///< samples counted as 0 because a component was not finite
  std::uint64_t dropped = 0;    ///< rays produced minus rays finished; anything but 0 is a bug
};

/// One key for each setting, camelCase, as the statistics file names them.
nlohmann::ordered_json settingsToJson(const Settings& settings);
/// One key for each fact of a stage.
nlohmann::ordered_json stageFactsToJson(const StageFacts& facts);
/// The statistics file.
nlohmann::ordered_json statsToJson(const Stats& stats);

}  // namespace whittle
