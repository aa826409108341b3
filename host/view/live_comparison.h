// Compares, on a thread of its own, the newest picture with a reference. Whoever asks never waits.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "image/metrics.h"
#include "render/renderer.h"
#include "view/difference.h"
#include "view/newest_worker.h"

namespace whittle::view {

/// A picture to compare with.
struct Reference {
  FloatImage light;        ///< linear, at least three channels
  bool isRadiance = true;  ///< W/(m² sr); else codes of a screen made linear, 1 is white
  std::string name;
};

/// A picture and what to do with it.
struct Comparable {
  std::uint64_t serial = 0;
  std::shared_ptr<const RenderResult> picture;
  std::shared_ptr<const Reference> reference;  ///< of the picture's size
  /// Codes of radiance, RGBA, with the picture's exposure and tone map. Called on the other thread.
  std::function<std::vector<std::uint8_t>(const FloatImage&)> codes;
  bool isRelative = false;
};

/// What became of it. Codes are RGBA.
struct Compared {
  std::uint64_t serial = 0;  ///< 0: nothing yet
  std::vector<std::uint8_t> referenceCodes, differenceCodes;
  ErrorScale scale;
  std::optional<ImageMetrics> figures;  ///< come last; as `whittle compare` has them
};

class LiveComparison {
 public:
  /// `wake` is called from the other thread whenever there is something new.
  explicit LiveComparison(std::function<void()> wake);

  /// Reads a reference there; what it throws becomes the problem.
  void open(std::function<Reference()> read);
  /// In the place of any that was asked for and is not begun.
  void compare(Comparable pictures);

  struct Opened {
    std::shared_ptr<const Reference> reference;  ///< null: there is a problem
    std::string problem;
  };
  /// What is new since the last time.
  std::optional<Opened> takeOpened();
  std::optional<Compared> takeCompared();

 private:
  void read(const std::function<Reference()>& read);
  void work(const Comparable& pictures);
  void publish(const Compared& compared);

  std::function<void()> wake_;
  std::mutex mutex_;
  std::optional<Opened> opened_;
  std::optional<Compared> compared_;
  NewestWorker worker_;  ///< last: its thread uses all of the above
};

}  // namespace whittle::view
