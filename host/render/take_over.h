// A scene's own programs, compiled by another process while general ones draw, and when they take over:
// between two batches. Kept by a session, since a film or a window draws many pictures of one kind.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "programs/compiler_process.h"
#include "render/program_choice.h"
#include "render/sampling_loop.h"
#include "report/stats.h"
#include "wavefront/stage_runner.h"

namespace whittle {

class TakeOver {
 public:
  TakeOver() = default;
  /// A compiler that is at work goes on by itself: the next run finds what it makes.
  ~TakeOver() { leave(); }
  TakeOver(const TakeOver&) = delete;
  TakeOver& operator=(const TakeOver&) = delete;

  /// A render begins.
  void begin(const ProgramChoice& choice, bool isGeneral);
  /// Before each batch of it: starts the compiler where that pays, and hands `stages` the scene's own
  /// programs once they are there. Nothing is asked or waited for where the render runs on its own already.
  void beforeBatch(std::uint32_t batch, OpenDevice& device, const ProgramChoice& choice,
                   const RenderHooks& hooks, const SamplingLoop& loop, StageRunner& stages);
  /// It ended after so many seconds.
  void end(const ProgramChoice& choice, const RenderHooks& hooks, double seconds);

  /// What ran when, up to now.
  std::vector<ProgramRun> runs(double seconds) const;

 private:
  void start(const ProgramChoice& choice, const RenderHooks& hooks, bool isBeside);
  void leave();
  bool isGeneral() const { return !runs_.empty() && runs_.back().isGeneral; }
  double generalSeconds(double seconds) const { return before_ + seconds; }

  std::string key_;         ///< of the programs that are wanted
  double before_ = 0.0;     ///< seconds that earlier renders of the session ran on general programs
  double notBefore_ = 0.0;  ///< of such seconds: the compiler did not do it
  std::optional<CompilerRun> compiler_;
  bool isBeside_ = false;         ///< it takes what is left over
  std::vector<ProgramRun> runs_;  ///< of the render
  std::chrono::steady_clock::time_point began_{};
};

}  // namespace whittle
