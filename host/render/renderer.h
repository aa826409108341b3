// One render from a loaded scene to linear pixels: analysis, tree, kernels, upload, passes, film.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "image/image_io.h"
#include "report/stats.h"
#include "report/trace.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

struct OpenDevice;
struct RenderState;

/// Which programs a scene runs on. The picture has the same bits.
enum class Tier : std::uint8_t {
  Auto,        ///< general ones while its own are not compiled yet, if they are in the cache
  General,     ///< general ones from first to last
  Specialised  ///< its own, which it waits for
};
inline constexpr Word<Tier> kTierWords[]{
    {"auto", Tier::Auto}, {"general", Tier::General}, {"specialised", Tier::Specialised}};
constexpr const auto& wordsOf(Tier) { return kTierWords; }

struct RenderProgress {
  double samplesDone = 0.0;   ///< a batch under way counts in part
  double samplesTotal = 0.0;  ///< as far as limits and targets let one guess
  double seconds = 0.0;       ///< since the first ray, without what lay between sittings
  std::uint64_t rays = 0;
};

/// With Settings::crop all images are of that region, in its frame.
struct RenderResult {
  FloatImage radiance;  ///< RGB, W/(m² sr)
  FloatImage alpha;     ///< with Settings::alpha, 1 channel: the share of each pixel that the scene covers
  /// Those that were asked for: depth (1 channel, m), primitive (1), normal (3, world), albedo (3), samples
  /// (1), error (1, W/(m² sr)), bounce (1), cost (2: nodes, triangles; PixelRecorder).
  std::map<std::string, FloatImage> aovs;
  Stats stats;  ///< time.load, time.write and time.total are the caller's to fill
};

/// The phases that others wait for: nothing is open yet; nothing that can be found out before the work is
/// left to be found out.
inline constexpr const char* kFirstPhase = "opening the device";
inline constexpr const char* kLastPhase = "rendering";

struct RenderHooks {
  std::function<void(const RenderProgress&)> progress;  ///< now and then, may be empty
  std::function<void(const std::string&)> phase;        ///< "compiling kernels", … may be empty
  std::function<void(const std::string&)> note;         ///< what the user should know meanwhile; may be empty
  /// Asked between launches; false: the render ends, and the result holds what there is. May be empty.
  std::function<bool()> keepGoing;
  /// Gets the picture so far after each pass but the last, which is the result; passes then multiply the
  /// samples. May be empty.
  std::function<void(RenderResult)> shown;
  /// One sample for each pixel and no more. A session keeps its film beside that of other renders, so that
  /// the two take turns and nothing is allocated.
  bool isPreview = false;
  /// Looks from here in the place of Settings::camera, which says what is compiled: a camera that is
  /// orthographic, or has a near plane that cuts, needs those features kept. Null: the scene's.
  const Camera* camera = nullptr;
  std::optional<std::filesystem::path> kernelFolder;  ///< kernels from here instead of the binary
  /// Of the result's size: each look at the film says how far it is from this.
  const FloatImage* reference = nullptr;
  /// The `whittle` binary, to compile kernels with a second process (compilerProcessMain); empty: this one
  /// does it all.
  std::filesystem::path compiler;
  Tier tier = Tier::Specialised;
  /// Pictures like this one that follow in the session, as far as is known: what a film saves by programs of
  /// its own.
  int picturesToCome = 0;
  /// For tests: compiles the scene's own programs before this batch (from 0) and goes on with them.
  std::optional<std::uint32_t> takeOverBefore;
  /// False: the command queue keeps no times, so that Stats' stages have none.
  bool timeStages = true;
  Trace* trace = nullptr;  ///< records launches and phases, needs timeStages; null: nothing is kept
  /// Null, or the scene that is rendered: what is not read after the upload may be taken out of it
  /// (uploadScene).
  Scene* consumed = nullptr;
  /// Null, or what an earlier render of the same scene, settings and device left: this one goes on from there
  /// (Settings::resumable).
  const RenderState* resumed = nullptr;
  /// With Settings::resumable gets the state every `checkpointSeconds` or so, and when the render ends, for
  /// whatever reason but an error. May be empty.
  std::function<void(RenderState)> checkpoint;
  double checkpointSeconds = 60.0;
  /// Opened before, with timeStages, in place of the device that the settings name; null: the render opens
  /// its own.
  OpenDevice* device = nullptr;
};

/// Renders. The same scene and settings on the same device give the same bits, whatever the threads,
/// work-group and wavefront size. Throws ClError, InputError (unknown camera, picture too large) or
/// std::invalid_argument (device).
RenderResult render(const Scene& scene, const Settings& settings, const RenderHooks& hooks = {});

}  // namespace whittle
