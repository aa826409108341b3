// --checkpoint and --resume: a render that may be interrupted, and goes on to the same bits.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/options.h"
#include "render/checkpoint_file.h"
#include "render/renderer.h"

namespace whittle::cli {

struct CheckpointOptions {
  std::filesystem::path file;          ///< --checkpoint; empty: none
  std::filesystem::path resume;        ///< --resume; empty: from the beginning
  double every = 60.0;                 ///< seconds
  bool partial = true;                 ///< an interrupted render writes the picture so far
  std::vector<std::string> arguments;  ///< of this command, without the program's name

  bool areAsked() const { return !file.empty() || !resume.empty(); }
};

/// With --resume the SCENE of `command` may be left out.
void addCheckpointOptions(CLI::App& command, CheckpointOptions& options);

/// The command line of the render that `options.resume` began, with this one's options behind it, so that
/// they count; empty where this one names a scene itself. Throws InputError: unreadable, or it began
/// elsewhere.
std::vector<std::string> resumedArguments(const CheckpointOptions& options, const SceneOptions& scene);

/// All that decides on the bits of a picture. `files`: that were read for it.
nlohmann::ordered_json identityOf(const SceneOptions& options, const Scene& scene, const Settings& settings,
                                  const std::vector<std::filesystem::path>& files);

/// What differs between the two, in one line; empty where a render of the second may go on from the first.
std::string differenceOf(const nlohmann::ordered_json& began, const nlohmann::ordered_json& now);

/// Reads what is resumed, and writes what is saved.
class Checkpointing {
 public:
  /// Reads options.resume; throws InputError where that is another picture's.
  Checkpointing(const CheckpointOptions& options, nlohmann::ordered_json identity);

  /// Refers to this. From the first ray on a signal that the user sends ends the render with what there is.
  void hookInto(RenderHooks& hooks);
  /// A signal ended the render, and pictures of what there is are not wanted.
  bool keepsPictureBack() const { return wasInterrupted() && !options_.partial; }
  /// Says how to go on, where a signal ended the render.
  void sayHowToGoOn(const Stats& stats) const;

 private:
  bool wasInterrupted() const;

  CheckpointOptions options_;
  Checkpoint checkpoint_;
  bool isResumed_ = false;
  bool hasFailed_ = false;  ///< to write: said once
};

}  // namespace whittle::cli
