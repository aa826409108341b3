// The passes over a picture: how many samples which pixels get next, until the count, a time limit or an
// error target is reached; what is known of the error after each.
#pragma once

#include <chrono>
#include <functional>
#include <vector>

#include "cl/program.h"
#include "render/render_state.h"
#include "render/renderer.h"
#include "wavefront/film.h"
#include "wavefront/sample_counts.h"
#include "wavefront/wavefront.h"

namespace whittle {

/// The picture on the device. With Settings::adaptive or resumable `passOrder` and `passBlocks` have room for
/// all pixels and blocks.
struct FilmBuffers {
  std::size_t pixels;
  const Buffer& order;
  const Buffer& film;
  const Buffer& aovs;
  const Buffer& passOrder;
  const Buffer& passBlocks;
};

class SamplingLoop {
 public:
  SamplingLoop(Compute& compute, Wavefront& wavefront, const Settings& settings, const RenderHooks& hooks,
               const FilmBuffers& buffers);

  /// Renders. Each pixel gets its first sample whatever the time limit; after that nothing goes on for longer
  /// than a tenth of it, or a quarter of a second. Goes on from RenderHooks::resumed where there is one.
  /// `passDone`: called after each pass that another follows.
  void run(const std::function<void()>& passDone);

  const SampleCounts& counts() const { return counts_; }
  double seconds() const { return seconds_ > 0.0 ? seconds_ : elapsed(); }  ///< that run took, or has so far
  double secondsInAll() const { return before_ + seconds(); }  ///< with those of earlier sittings
  /// That it will go on for, by what it has done since it began; 0 before that says anything.
  double secondsLeft() const;
  const std::vector<ErrorPoint>& error() const { return error_; }
  /// The picture, after run.
  FloatImage picture();
  FloatImage alpha();
  FloatImage samples();
  FloatImage errors();  ///< with two samples for each pixel at least
  /// The throughput that ended (RayTally::ended) for each sample, so weighted that biasBound holds for the
  /// mean over the pixels.
  double endedPerSample() const;

 private:
  using Clock = std::chrono::steady_clock;

  bool looks() const;
  std::vector<SamplePass> nextPasses() const;
  double growth(double most) const;
  double shownGrowth() const;
  std::uint32_t nextSamples() const;
  void goOnFrom(const RenderState& state);
  RenderState state();
  void save();
  bool hasMetTarget() const;
  bool tracePending();
  bool tracePass(SamplePass& pass);
  bool traceWith(SamplePass& pass, const TracePass& launches);
  bool keepGoing(double samplesOfPass, bool betweenBatches);
  void reportProgress(double samples);
  double expectedSamples() const;
  void look();
  /// Calls visit(part) for the whole film, part by part: beside the device's there is never another.
  template <class Visit>
  void eachPart(const Visit& visit);
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  Compute& compute_;
  Wavefront& wavefront_;
  const Settings& settings_;
  const RenderHooks& hooks_;
  FilmBuffers buffers_;
  SampleCounts counts_;
  std::vector<SamplePass> pending_;  ///< decided on and not traced yet
  Clock::time_point start_{}, saved_{};
  double before_ = 0.0;     ///< seconds of earlier sittings
  bool isPausing_ = false;  ///< the wavefront was told to stop, for the state to be saved
  double seconds_ = 0.0;
  double passSeconds_ = 0.0;       ///< the last uniform pass
  std::uint32_t passSamples_ = 0;  ///< of each pixel, then
  double samplesDone_ = 0.0;       ///< a pass under way counts in part
  double samplesBefore_ = 0.0;     ///< of them, in earlier sittings
  bool saidLate_ = false;
  std::vector<double> variances_;  ///< of blocks, at the last look
  double endedShare_ = 0.0;        ///< bound on endedPerSample for passes of some blocks only
  std::vector<ErrorPoint> error_;
};

}  // namespace whittle
