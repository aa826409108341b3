// Sets a render up, runs its passes and gathers its statistics.
#include "render/renderer.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <chrono>
#include <cmath>
#include <future>

#include "analysis/radiance_bound.h"
#include "bvh/tri_tree.h"
#include "cl/device.h"
#include "cl/program.h"
#include "programs/compiler_process.h"
#include "programs/kernel_programs.h"
#include "render/plan.h"
#include "render/sampling_loop.h"
#include "scene/input_error.h"
#include "wavefront/camera_to_device.h"
#include "wavefront/film.h"
#include "wavefront/pixel_order.h"
#include "wavefront/wavefront.h"

namespace whittle {
namespace {

using Clock = std::chrono::steady_clock;
double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void copy3(float* out, const glm::vec3& v) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

device::RenderConstants constantsToDevice(const Scene& scene, const Settings& s) {
  device::RenderConstants c{};
  copy3(c.background, scene.background.radiance);
  c.rayOffset = s.rayOffset.value_or(-1.0F);
  c.backgroundWidth = scene.background.width;
  c.backgroundHeight = scene.background.height;
  c.mirrorRoughness = s.mirrorRoughness;
  c.seed = s.seed;
  c.cutoff = s.cutoff;
  return c;
}

TriTree buildTree(const Scene& scene, bool wanted) {
  TriTree tree;
  if (wanted) {
    std::vector<glm::uvec3> corners;
    corners.reserve(scene.triangles.size());
    for (const auto& t : scene.triangles) corners.emplace_back(t.v0, t.v1, t.v2);
    return buildTriTree(scene.positions, corners);
  }
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) tree.order.push_back(i);
  return tree;
}

std::uint32_t roundedCapacity(const Settings& s) {
  const std::uint64_t samples = static_cast<std::uint64_t>(s.width) * s.height * s.raysPerPixel;
  // Never more than the picture has samples (twice, for branching), never fewer than two long runs.
  const std::uint64_t wanted = std::min<std::uint64_t>(static_cast<std::uint64_t>(s.wavefront), 2 * samples);
  return static_cast<std::uint32_t>((std::max<std::uint64_t>(wanted, 2 * LONG_RUN) + 63) / 64 * 64);
}

void checkLimits(const Settings& s) {
  if (s.width < 1 || s.height < 1 || s.width > 65535 || s.height > 65535)
    throw InputError(
        fmt::format("--width/--height: {}×{} is not between 1×1 and 65535×65535", s.width, s.height));
  if (s.bounces < 1) throw InputError("--bounces: at least 1");
  if (!(s.cutoff >= 0.0F && s.cutoff <= kLargestCutoff))
    throw InputError(fmt::format("--cutoff: not from 0 to {}", kLargestCutoff));
  if (s.raysPerPixel < 1) throw InputError("--rays-per-pixel: at least 1");
  if (s.adaptive && s.sampler == Sampler::Stratified)
    throw InputError(
        "--adaptive: stratified samples need the same number in every pixel; use --sampler sobol");
}

/// Everything a render holds between its phases.
class Session {
 public:
  Session(const Scene& scene, const Settings& settings, const RenderHooks& hooks,
          Compute::Memory memory = Compute::Memory::Real)
      : scene_(scene), settings_(settings), hooks_(hooks), memory_(memory) {
    checkLimits(settings_);
    cameraIndex_ = findCamera(scene_, settings_.camera);
    say("opening the device");
    const auto opening = Clock::now();
    limitCpuThreads(settings_.threads);
    if (hooks_.device)
      compute_ = &hooks_.device->compute;
    else
      compute_ = &own_.emplace(selectDevice(listDevices(), settings_.device), memory_,
                               hooks_.timeStages ? Compute::Launches::Timed : Compute::Launches::Untimed);
    endPhase("open the device", opening);
    if (settings_.threads > 0)
      tbbLimit_.emplace(tbb::global_control::max_allowed_parallelism, settings_.threads);
    const bool cpu = compute_->device().kind == "cpu";
    const auto deciding = Clock::now();
    pruned_ = pruneScene(scene_, settings_);
    endPhase("decide what is needed", deciding);
    features_ = SceneFeatures::analyse(scene_, pruned_, settings_, {compute_->device().suitsPackets()});
    compactChunk_ = cpu ? 1024 : 32;
    workGroup_ = settings_.workGroup > 0 ? settings_.workGroup : defaultWorkGroup(features_);
    if (static_cast<std::uint64_t>(workGroup_) > compute_->device().maxWorkGroup)
      throw InputError(fmt::format("--work-group: {} allows at most {}", compute_->device().name,
                                   compute_->device().maxWorkGroup));
  }

  RenderResult run() {
    prepare();
    samplePicture();
    return finish();
  }

  /// Sizes of everything; needs a session with Memory::SizesOnly.
  RenderPlan plan() {
    const TriTree tree = allocate();
    queues_->reserve(usualQueues(features_));
    reportBuffers();
    usedSettings();
    return {features_,
            std::move(pruned_),
            plannedStages(features_, deviceScene_.lightCount, settings_.bounces),
            stats_.buffers,
            bytesOfEverything(tree),
            compute_->device(),
            stats_.settings};
  }

 private:
  /// Ray queues of a picture whose queues are never cut.
  static std::size_t usualQueues(const SceneFeatures& features) {
    return features.has(Feature::IMPULSES) ? 2 : 1;
  }

  /// What all buffers would take if nothing were left out.
  std::uint64_t bytesOfEverything(const TriTree& tree) {
    Settings all = settings_;
    all.keepAllFeatures = true;
    const PrunedScene whole = unprunedScene(scene_);
    const auto features = SceneFeatures::analyse(scene_, whole, all, {compute_->device().suitsPackets()});
    std::vector<BufferStats> buffers;
    uploadScene(*compute_, scene_, whole, tree, features).report(buffers);
    RayQueues queues(*compute_, features, queues_->capacity(), compactChunk_);
    queues.reserve(usualQueues(features));
    queues.report(buffers);
    std::uint64_t bytes = pixelOrder_.bytes + film_.bytes + aovs_.bytes;
    for (const auto& b : buffers) bytes += b.bytes;
    return bytes;
  }

  void say(const std::string& phase) const {
    if (hooks_.phase) hooks_.phase(phase);
  }
  /// A phase of the host ends now.
  void endPhase(const char* name, Clock::time_point start) {
    stats_.phases.push_back({name, steadySeconds(start), secondsSince(start)});
    if (hooks_.trace) hooks_.trace->phase(name, start);
  }

  void prepare() {
    say("compiling kernels");
    const auto start = Clock::now();
    auto programs = std::async(std::launch::async, [this, start] {
      const auto stages = plannedStages(features_, pruned_.lights.size(), settings_.bounces);
      const CompileTarget target{compactChunk_, workGroup_, settings_.relaxedArithmetic};
      CompileBeside beside;
      if (!hooks_.compiler.empty())
        beside = [&] {
          return startCompilerProcess(hooks_.compiler, {compute_->device().index, features_.bits(), target,
                                                        hooks_.kernelFolder, stages});
        };
      const auto wanted = kernelPrograms(features_, stages, hooks_.kernelFolder);
      auto built = hooks_.device ? compileOnce(*hooks_.device, wanted, target, beside)
                                 : compilePrograms(*compute_, wanted, target, beside);
      stats_.time.compile = secondsSince(start);
      if (hooks_.trace) hooks_.trace->phase("compile kernels", start, Trace::Track::Compiler);
      return built;
    });
    allocate();
    stages_.emplace(*compute_, programs.get(), workGroup_);
    stats_.phases.push_back({"compile kernels", steadySeconds(start), stats_.time.compile});
    stages_->record(hooks_.trace);
    const WavefrontSetup setup{features_,
                               deviceScene_,
                               cameraToDevice(scene_.cameras[cameraIndex_], settings_),
                               constantsToDevice(scene_, settings_),
                               static_cast<std::uint32_t>(settings_.bounces),
                               compactChunk_};
    wavefront_.emplace(*compute_, *stages_, *queues_, setup, film_, aovs_);
  }

  /// Of the picture, before anything that takes time: too large a picture is refused at once.
  void allocateFilm() {
    const std::size_t pixels = static_cast<std::size_t>(settings_.width) * settings_.height;
    const std::size_t film = pixels * filmPlanes(settings_.raysPerPixel) * sizeof(float),
                      order = pixels * sizeof(std::uint32_t);
    const std::size_t aovs = features_.has(Feature::AOVS) ? pixels * AOV_PLANES * sizeof(float) : 0;
    const DeviceInfo& device = compute_->device();
    if (film + order + aovs > device.globalMemory)
      throw ClError(fmt::format("a picture of {}×{} needs {} for its film but {} has {}", settings_.width,
                                settings_.height, formatBytes(film + order + aovs), device.name,
                                formatBytes(device.globalMemory)));
    film_ = compute_->allocate("film", film);
    pixelOrder_ = compute_->allocate("pixelOrder", order);
    aovs_ = compute_->allocate("aovs", aovs);
    if (settings_.adaptive) {
      passOrder_ = compute_->allocate("passOrder", order);
      passBlocks_ = compute_->allocate("passBlocks", SampleCounts(pixels).blocks() * sizeof(std::uint32_t));
    }
    if (memory_ == Compute::Memory::SizesOnly) return;
    pixelOrderTable_ = makePixelOrder(static_cast<std::uint32_t>(settings_.width),
                                      static_cast<std::uint32_t>(settings_.height));
    compute_->write(pixelOrder_, pixelOrderTable_.data());
    compute_->fillZero(film_);
  }

  /// Everything but the kernels; returns the tree.
  TriTree allocate() {
    auto start = Clock::now();
    allocateFilm();
    const double film = secondsSince(start);
    start = Clock::now();
    TriTree tree = buildTree(scene_, features_.has(Feature::TREE));
    stats_.time.build = secondsSince(start);
    endPhase("build tree", start);
    start = Clock::now();
    deviceScene_ = uploadScene(*compute_, scene_, pruned_, tree, features_);
    queues_.emplace(*compute_, features_, roundedCapacity(settings_), compactChunk_);
    stats_.time.upload = film + secondsSince(start);
    endPhase("upload", start);
    return tree;
  }

  void samplePicture() {
    say("rendering");
    const auto start = Clock::now();
    loop_.emplace(*compute_, *wavefront_, settings_, hooks_,
                  FilmBuffers{pixelOrderTable_, pixelOrder_, film_, passOrder_, passBlocks_});
    loop_->run();
    stats_.time.render = loop_->seconds();
    endPhase("render", start);
  }

  RenderResult finish() {
    RenderResult result;
    result.radiance = loop_->picture();
    stats_.meanRadiance = meanRadiance(result.radiance);
    if (aovs_) {
      std::vector<float> planes(aovs_.bytes / sizeof(float));
      compute_->read(aovs_, 0, aovs_.bytes, planes.data());
      result.aovs = splitAovs(settings_.width, settings_.height, planes);
      result.aovs["samples"] = loop_->samples();
    }
    fillStats();
    result.stats = std::move(stats_);
    return result;
  }

  void fillStats() {
    stats_.scene.file = scene_.file;
    stats_.scene.triangles = scene_.triangles.size();
    stats_.scene.droppedTriangles = scene_.droppedTriangles;
    stats_.scene.materials = scene_.materials.size();
    stats_.scene.lights = scene_.lights.size();
    stats_.scene.textures = scene_.images.size();
    usedSettings();
    stats_.samples = {loop_->counts().least(), loop_->counts().most(), loop_->counts().mean()};
    stats_.error = loop_->error();
    stats_.searchUsed = features_.has(Feature::TREE) ? "tree" : "array";
    const DeviceInfo& d = compute_->device();
    stats_.device = {
        d.platform,     d.name,
        d.version,      d.driver,
        d.computeUnits, settings_.threads > 0 ? settings_.threads : static_cast<int>(d.computeUnits)};
    for (const auto& line : features_.lines()) {
      if (line.used)
        stats_.featuresUsed.push_back(line.text);
      else
        stats_.featuresLeftOut.emplace_back(line.text, line.reason);
      if (line.forced) stats_.featuresForced.push_back(line.text);
    }
    stats_.pruning = pruned_.pruning;
    const RayTally& t = wavefront_->tally();
    stats_.rays = {t.primary, t.impulse, t.shadow};
    stats_.dropped = t.produced - t.finished;
    stats_.cutOffThroughput = cutOffThroughput(settings_, t.cutOff);
    stats_.biasBound = biasBound(scene_, settings_, loop_->cutOffPerSample());
    stats_.nonFinite = wavefront_->nonFinite();
    stats_.stages = stages_->stats();
    stats_.bounces = stages_->statsByBounce();
    reportBuffers();
  }

  void usedSettings() {
    stats_.settings = settings_;
    stats_.settings.wavefront = static_cast<int>(queues_->capacity());
    stats_.settings.workGroup = workGroup_;
  }

  void reportBuffers() {
    deviceScene_.report(stats_.buffers);
    queues_->report(stats_.buffers);
    for (const Buffer* b : {&pixelOrder_, &film_, &aovs_, &passOrder_, &passBlocks_})
      if (*b) stats_.buffers.push_back({b->name, "film", b->bytes});
  }

  const Scene& scene_;
  Settings settings_;
  const RenderHooks& hooks_;
  Compute::Memory memory_;
  std::size_t cameraIndex_ = 0;
  PrunedScene pruned_;
  SceneFeatures features_;
  std::uint32_t compactChunk_ = 0;
  int workGroup_ = 0;
  Stats stats_;
  std::optional<tbb::global_control> tbbLimit_;
  std::optional<Compute> own_;
  Compute* compute_ = nullptr;  ///< its own, or that of the hooks
  DeviceScene deviceScene_;
  std::vector<std::uint32_t> pixelOrderTable_;
  Buffer pixelOrder_, film_, aovs_, passOrder_, passBlocks_;
  std::optional<RayQueues> queues_;
  std::optional<StageRunner> stages_;
  std::optional<Wavefront> wavefront_;
  std::optional<SamplingLoop> loop_;
};

}  // namespace

RenderResult render(const Scene& scene, const Settings& settings, const RenderHooks& hooks) {
  return Session(scene, settings, hooks).run();
}

RenderPlan planRender(const Scene& scene, const Settings& settings) {
  const RenderHooks none;
  return Session(scene, settings, none, Compute::Memory::SizesOnly).plan();
}

}  // namespace whittle
