// One picture, from a loaded scene to its files: what `whittle render` does once, and --frames for each
// frame.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/aovs.h"
#include "cli/checkpoint.h"
#include "cli/frames.h"
#include "cli/options.h"
#include "render/render_session.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle::cli {

struct RenderOptions {
  SceneOptions scene;
  Settings settings;
  std::vector<std::filesystem::path> outputs;
  std::vector<std::string> aovTexts;
  std::filesystem::path stats, trace, reference, kernelFolder;
  std::optional<glm::ivec2> explain;  ///< a pixel
  bool withReference = false;         ///< --explain beside the reference
  bool json = false;
  bool profile = false;
  Tier tier = Tier::Auto;
  FrameOptions frames;
  CheckpointOptions checkpoint;
  int picturesToCome = 0;  ///< of several
  std::string what = {};   ///< is drawn, of several pictures
  bool isLater = false;    ///< of those: not the first

  std::vector<AovOutput> aovs;                   ///< aovTexts, parsed
  std::shared_ptr<Checkpointing> checkpointing;  ///< null: neither --checkpoint nor --resume
};

inline double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Runs `work`; errors of kernels and devices in words that help.
void explainingErrors(const RenderOptions& o, const std::function<void()>& work);

/// Whether anything tells of the time of each launch (RenderHooks::timeStages).
bool timesStages(const RenderOptions& o);

/// Renders a loaded scene and writes what is asked for. `session`: holds what the next frame needs too; after
/// the one picture it is closed. `load`: what loading took since `start`, seconds. Returns whether every file
/// is where it should be; `stops` becomes the exposure that was chosen.
bool drawScene(RenderOptions& o, Scene& scene, const FloatImage& reference, Trace* trace,
               RenderSession& session, std::chrono::steady_clock::time_point start, double load,
               float& stops);

}  // namespace whittle::cli
