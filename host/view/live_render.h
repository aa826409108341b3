// Renders, on a thread of its own, what it was last asked for: a coarse picture at once, then the full one,
// refined pass by pass. Whoever asks never waits.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "render/render_session.h"
#include "scene/appearance.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "view/pace.h"

namespace whittle::view {

/// What a picture is made of. Scenes are shared, not copied: the render's thread alone writes the numbers of
/// `appearance` into them, and nobody else reads those of a scene that was asked for.
struct Request {
  std::shared_ptr<Scene> scene;
  std::shared_ptr<const Appearance> appearance;
  Camera camera;  ///< in the place of all of the scene's
  Settings settings;
  /// A coarse picture may come first, of one sample for each of fewer pixels (Pace).
  bool coarseFirst = false;
  /// With a region the rest of the picture is of what was shown before for the same album.
  std::uint64_t album = 0;
};

struct Shown {
  std::shared_ptr<const RenderResult> result;  ///< null: nothing yet; with a region in the picture before
  std::shared_ptr<const RenderResult> region;  ///< that region alone; null: none was asked for
  std::uint64_t request = 0;                   ///< the one that it answers
  Settings asked;                              ///< that one's
  bool coarse = false;
  bool finished = false;  ///< nothing more will come for this request
};

struct Progress {
  std::string doing;   ///< "compiling kernels", …; empty: nothing is being done
  double share = -1;   ///< of the rays, in [0, 1]; negative: unknown
  double seconds = 0;  ///< since the request
  std::string error;   ///< why the last request has no (full) picture, in one line
  RenderWork work;     ///< of the last picture that was finished
};

class LiveRender {
 public:
  /// `wake` is called from the render's thread whenever there is something new to see.
  /// `compiler`, `kernelFolder`: see RenderHooks.
  LiveRender(std::function<void()> wake, std::filesystem::path compiler,
             std::optional<std::filesystem::path> kernelFolder);
  /// Ends what is under way between two launches.
  ~LiveRender();
  LiveRender(const LiveRender&) = delete;
  LiveRender& operator=(const LiveRender&) = delete;

  /// From now on this is rendered; what is under way ends between two launches. Returns the request's number.
  std::uint64_t ask(Request request);
  /// The rays of a pixel of this request, when what is under way has ended or been cut off; `done` gets them
  /// on the render's thread. A request that was cut off has to be asked for again.
  void explain(Request request, int x, int y, std::function<void(std::vector<RayTree>)> done);
  /// Work that has to happen on the render's thread, before the requests that follow: loading a scene.
  /// `doing` is shown meanwhile. What it throws becomes Progress::error.
  void run(std::string doing, std::function<void()> work);
  /// Ends what is under way; the picture so far stays.
  void stop();

  Shown shown() const;
  Progress progress() const;

 private:
  struct Job {
    std::string doing;
    std::function<void()> work;
  };
  void loop();
  void renderRequest(const Request& request, std::uint64_t number);
  void renderCoarse(const Request& request, std::uint64_t number, const Settings& settings, int divisor);
  void noteFull(const RenderResult& result);
  RenderHooks hooksFor(std::uint64_t number, bool coarse);
  void show(RenderResult result, std::uint64_t number, bool coarse, bool finished);
  bool isWanted(std::uint64_t number) const;
  bool isStopped() const;
  void fail(const std::string& text);
  void take(const Request& request);
  std::uint64_t featuresOfCamera(const Request& request);

  std::function<void()> wake_;
  std::filesystem::path compiler_;
  std::optional<std::filesystem::path> kernelFolder_;
  // Of the thread alone:
  RenderSession session_;
  Settings rendering_;       ///< of the request under way
  std::uint64_t album_ = 0;  ///< the same
  std::shared_ptr<const Scene> onDevice_;
  Pace pace_;
  bool hasShown_ = true;                       ///< a picture of the request
  bool keepsNearPlane_ = false;                ///< some camera of that scene needed it
  std::shared_ptr<const RenderResult> whole_;  ///< what was shown last for that album; null: nothing

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Request> next_;
  std::vector<Job> jobs_;
  std::uint64_t asked_ = 0;  ///< number of the newest request
  bool stopped_ = false;     ///< its refinement was ended by hand
  bool closing_ = false;
  Shown shown_;
  Progress progress_;
  std::chrono::steady_clock::time_point askedAt_{};
  std::thread thread_;  ///< last: it uses all of the above
};

}  // namespace whittle::view
