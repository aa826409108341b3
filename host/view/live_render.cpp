// See live_render.h.
#include "view/live_render.h"

#include <algorithm>
#include <utility>

#include "analysis/feature.h"
#include "scene/camera.h"
#include "scene/input_error.h"
#include "view/region_picture.h"

namespace whittle::view {
namespace {

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

LiveRender::LiveRender(std::function<void()> wake, std::filesystem::path compiler,
                       std::optional<std::filesystem::path> kernelFolder)
    : wake_(std::move(wake)),
      compiler_(std::move(compiler)),
      kernelFolder_(std::move(kernelFolder)),
      thread_([this] { loop(); }) {}

LiveRender::~LiveRender() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::uint64_t LiveRender::ask(Request request) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(request);
    number = ++asked_;
    stopped_ = false;
    askedAt_ = std::chrono::steady_clock::now();
    progress_.error.clear();
  }
  changed_.notify_all();
  return number;
}

void LiveRender::run(std::string doing, std::function<void()> work) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back({std::move(doing), std::move(work)});
    next_.reset();
    stopped_ = true;  // what is under way would be of the old scene
    progress_.error.clear();
  }
  changed_.notify_all();
}

/// What moves with the camera is compiled in, so that moves of it compile nothing: a projection costs a ray
/// nothing. A near plane that cuts does, a tenth and more, so it waits for the first camera that has
/// something before it.
std::uint64_t LiveRender::featuresOfCamera(const Request& r) {
  const double aspect = static_cast<double>(r.settings.width) / r.settings.height;
  keepsNearPlane_ = keepsNearPlane_ || nearPlaneCuts(*r.scene, r.camera, aspect);
  return bitOf(Feature::ORTHOGRAPHIC) | (keepsNearPlane_ ? bitOf(Feature::NEAR_PLANE) : 0);
}

void LiveRender::take(const Request& request) {
  if (onDevice_ != request.scene) session_.sceneChanged(), keepsNearPlane_ = false;
  onDevice_ = request.scene;
  setAppearance(*request.appearance, *request.scene);
}

void LiveRender::explain(Request request, int x, int y, std::function<void(std::vector<RayTree>)> done) {
  auto work = [this, request = std::move(request), x, y, done = std::move(done)] {
    take(request);
    RenderHooks hooks;
    hooks.kernelFolder = kernelFolder_;
    hooks.compiler = compiler_;
    hooks.camera = &request.camera;
    Settings settings = request.settings;
    settings.keepFeatures |= featuresOfCamera(request);
    done(session_.explain(*request.scene, settings, x, y, hooks, 1));
  };
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back({"following the rays of a pixel", std::move(work)});
    stopped_ = true;
  }
  changed_.notify_all();
}

void LiveRender::stop() {
  const std::lock_guard lock(mutex_);
  next_.reset();
  stopped_ = true;
}

Shown LiveRender::shown() const {
  const std::lock_guard lock(mutex_);
  return shown_;
}

Progress LiveRender::progress() const {
  const std::lock_guard lock(mutex_);
  Progress p = progress_;
  if (!p.doing.empty()) p.seconds = since(askedAt_);
  return p;
}

bool LiveRender::isWanted(std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  return number == asked_ && !stopped_ && !closing_;
}

bool LiveRender::isStopped() const {
  const std::lock_guard lock(mutex_);
  return stopped_ || closing_;
}

void LiveRender::fail(const std::string& text) {
  {
    const std::lock_guard lock(mutex_);
    progress_.error = text;
  }
  wake_();
}

void LiveRender::show(RenderResult result, std::uint64_t number, bool coarse, bool finished) {
  std::shared_ptr<const RenderResult> region, whole;
  if (rendering_.crop) {
    region = std::make_shared<const RenderResult>(std::move(result));
    whole = std::make_shared<const RenderResult>(withRegion(whole_.get(), *region, rendering_));
  } else {
    whole = std::make_shared<const RenderResult>(std::move(result));
  }
  {
    const std::lock_guard lock(mutex_);
    // A stopped request's last pass may lack samples of some pixels; a coarse one is whole.
    if (number != asked_ && !coarse) return;
    shown_ = {whole, region, number, rendering_, coarse, finished};
  }
  whole_ = std::move(whole);
  wake_();
}

RenderHooks LiveRender::hooksFor(std::uint64_t number, bool coarse) {
  RenderHooks hooks;
  hooks.kernelFolder = kernelFolder_;
  hooks.compiler = compiler_;
  if (!compiler_.empty()) hooks.tier = Tier::Auto;
  hooks.keepGoing = [this, number] { return isWanted(number); };
  hooks.phase = [this](const std::string& text) {
    {
      const std::lock_guard lock(mutex_);
      progress_.doing = text;
      progress_.share = -1;
    }
    wake_();
  };
  if (coarse) return hooks;
  hooks.progress = [this](const RenderProgress& p) {
    const std::lock_guard lock(mutex_);
    progress_.share = std::min(1.0, p.samplesDone / p.samplesTotal);
  };
  hooks.shown = [this, number](RenderResult result) {
    if (!isWanted(number)) return;
    noteFull(result);
    show(std::move(result), number, false, false);
  };
  return hooks;
}

/// With the sampler of the full picture, so that nothing else is compiled.
void LiveRender::renderCoarse(const Request& request, std::uint64_t number, const Settings& settings,
                              int divisor) {
  Settings coarse = settings;
  coarse.width /= divisor;
  coarse.height /= divisor;
  if (coarse.crop) coarse.crop = coarseRegion(*coarse.crop, coarse.width, coarse.height, divisor);
  const auto began = std::chrono::steady_clock::now();
  RenderHooks hooks = hooksFor(number, true);
  hooks.camera = &request.camera;
  hooks.isPreview = true;
  hooks.keepGoing = [&] { return isWanted(number) || (since(began) < kFinishedWithin && !isStopped()); };
  RenderResult result = session_.render(*request.scene, coarse, hooks);
  if (result.stats.samples.least < 1) return;  // it was cut off
  pace_.tookCoarse(static_cast<double>(tracedRegion(coarse).pixels()), result.stats.time.render);
  show(std::move(result), number, true, false);
  hasShown_ = true;
}

/// What its first pass tells.
void LiveRender::noteFull(const RenderResult& result) {
  if (result.stats.samples.most != 1) return;
  pace_.tookFull(static_cast<double>(tracedRegion(rendering_).pixels()), result.stats.time.render);
  hasShown_ = true;
}

void LiveRender::renderRequest(const Request& request, std::uint64_t number) {
  take(request);
  rendering_ = request.settings;
  if (std::exchange(album_, request.album) != request.album) whole_.reset();
  const Scene& scene = *request.scene;
  Settings settings = request.settings;
  settings.keepFeatures |= featuresOfCamera(request);
  RenderWork work;
  const double pixels = static_cast<double>(tracedRegion(settings).pixels());
  const bool wasCutShort = !std::exchange(hasShown_, false);
  const int divisor = request.coarseFirst ? pace_.divisor(pixels, wasCutShort) : 1;
  if (divisor > 1 && std::min(settings.width, settings.height) >= 2 * divisor) {
    renderCoarse(request, number, settings, divisor);
    work = session_.work();
  }
  if (!isWanted(number)) return;
  RenderHooks hooks = hooksFor(number, false);
  hooks.camera = &request.camera;
  RenderResult result = session_.render(scene, settings, hooks);
  const bool whole = isWanted(number);
  work.add(session_.work());
  {
    const std::lock_guard lock(mutex_);
    progress_.work = work;
  }
  if (!whole) return;
  noteFull(result);
  show(std::move(result), number, false, true);
}

void LiveRender::loop() {
  for (;;) {
    std::optional<Request> request;
    std::optional<Job> job;
    std::uint64_t number = 0;
    {
      std::unique_lock lock(mutex_);
      progress_.doing.clear();
      progress_.share = -1;
      changed_.wait(lock, [&] { return closing_ || next_ || !jobs_.empty(); });
      if (closing_) return;
      if (!jobs_.empty()) {
        job = std::move(jobs_.front());
        jobs_.erase(jobs_.begin());
        progress_.doing = job->doing;
      } else {
        request = std::exchange(next_, std::nullopt);
        number = asked_;
      }
    }
    wake_();
    try {
      if (job)
        job->work();
      else
        renderRequest(*request, number);
    } catch (const InputError& e) {
      fail(e.what());
    } catch (const std::exception& e) {
      session_.close();  // a lost device stays lost
      fail(e.what());
    }
    wake_();
  }
}

}  // namespace whittle::view
