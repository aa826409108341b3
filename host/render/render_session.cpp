// A render, phase by phase: each takes what those before it returned, or what an earlier render left.
#include "render/render_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>

#include "cl/device_facts.h"
#include "programs/kernel_programs.h"
#include "render/aovs.h"
#include "render/describe.h"
#include "render/phase_log.h"
#include "render/preparation.h"
#include "render/program_choice.h"
#include "render/sampling_loop.h"
#include "render/take_over.h"
#include "scene/camera.h"
#include "wavefront/camera_to_device.h"
#include "wavefront/constants_to_device.h"
#include "wavefront/film.h"
#include "wavefront/pixel_recorder.h"
#include "wavefront/ray_recorder.h"
#include "wavefront/wavefront.h"

namespace whittle {
namespace {

using Clock = PhaseLog::Clock;

void say(const RenderHooks& hooks, const char* phase) {
  if (hooks.phase) hooks.phase(phase);
}

}  // namespace

struct RenderSession::State {
  /// What decides on the device that is open.
  struct DeviceKey {
    std::string selector;
    int threads = 0;
    bool timed = true;
    bool operator==(const DeviceKey&) const = default;
  };

  /// What decides on the scene's buffers, besides the scene.
  struct SceneKey {
    std::uint64_t features = 0;
    bool keepsAll = false;
    float mirrorRoughness = 0.0F;
    bool operator==(const SceneKey&) const = default;
  };

  struct QueueKey {
    std::uint64_t features = 0, planes = 0;
    std::uint32_t waitingLights = 0, capacity = 0, compactChunk = 0;
    bool operator==(const QueueKey&) const = default;
  };

  struct PictureKey {
    Region region;
    std::size_t planes = 0;
    bool aovs = false, passes = false;
    bool operator==(const PictureKey&) const = default;
  };

  /// Something on the device, and what decided on it.
  template <typename Value, typename Key>
  struct Kept {
    std::optional<Value> value;
    Key key;

    bool serves(const Key& wanted) const { return value && key == wanted; }
    /// The old one is let go before the new one is made.
    template <typename Make>
    Value& remake(const Key& wanted, const Make& make) {
      value.reset();
      value.emplace(make());
      key = wanted;
      return *value;
    }
  };

  Kept<OpenDevice, DeviceKey> device;
  Kept<PictureBuffers, PictureKey> pictures[2];  ///< [RenderHooks::isPreview]
  Kept<DeviceScene, SceneKey> scene;
  Kept<RayQueues, QueueKey> queues;
  TexelFacts texels;  ///< of the scene's images
  bool haveMeshesMoved = false;
  /// Of general programs that ran: their buffers stay when the scene's own take over.
  std::uint64_t bufferFeatures = 0;
  TakeOver ownPrograms;
  RenderWork work;

  /// What lives on the device.
  void dropBuffers() {
    for (auto& picture : pictures) picture.value.reset();
    scene.value.reset();
    queues.value.reset();
  }

  struct Prepared;
  Prepared prepare(const Scene& from, const Settings& settings, const RenderHooks& hooks, PhaseLog& log);
  OpenDevice& openFor(const Settings& settings, const RenderHooks& hooks);
  void providePicture(Compute& compute, const Settings& settings, const Decisions& decisions, bool isPreview);
  void provideScene(Compute& compute, const Scene& from, const Settings& settings, const Decisions& decisions,
                    const RenderHooks& hooks, PhaseLog& log);
  void provideQueues(Compute& compute, const Settings& settings, const Decisions& decisions, bool isPreview,
                     PhaseLog& log);
};

void RenderWork::add(const RenderWork& other) {
  device |= other.device;
  programs += other.programs;
  scene |= other.scene;
  texelReads += other.texelReads;
  tables.lights |= other.tables.lights;
  tables.materials |= other.tables.materials;
  tables.textures |= other.tables.textures;
  tables.triangles |= other.tables.triangles;
  queues |= other.queues;
  picture |= other.picture;
}

RenderSession::RenderSession() : state_(std::make_unique<State>()) {}
RenderSession::~RenderSession() = default;
RenderSession::RenderSession(RenderSession&&) noexcept = default;
RenderSession& RenderSession::operator=(RenderSession&&) noexcept = default;

void RenderSession::open(const Settings& settings, const RenderHooks& hooks) {
  state_->openFor(settings, hooks);
}

void RenderSession::sceneChanged() {
  state_->scene.value.reset();
  state_->texels = {};
}

void RenderSession::meshesMoved() { state_->haveMeshesMoved = true; }

void RenderSession::close() {
  state_->dropBuffers();
  state_->device.value.reset();
}

const RenderWork& RenderSession::work() const { return state_->work; }

/// What stands before the first ray.
struct RenderSession::State::Prepared {
  OpenDevice& device;
  Decisions decisions;
  ProgramChoice choice;
  StartingPrograms start;
  double pictureSeconds = 0.0;
};

OpenDevice& RenderSession::State::openFor(const Settings& settings, const RenderHooks& hooks) {
  const DeviceKey wanted{settings.device, settings.threads, hooks.timeStages};
  if (hooks.device) return *hooks.device;
  if (device.serves(wanted)) return *device.value;
  dropBuffers();
  work.device = true;
  return device.remake(wanted, [&] {
    return OpenDevice{openDevice(settings, Compute::Memory::Real,
                                 hooks.timeStages ? Compute::Launches::Timed : Compute::Launches::Untimed)};
  });
}

/// An empty film, and the order of its pixels.
void RenderSession::State::providePicture(Compute& compute, const Settings& settings,
                                          const Decisions& decisions, bool isPreview) {
  auto& picture = pictures[isPreview];
  const PictureKey wanted{tracedRegion(settings),
                          filmPlanes(settings, decisions.features.has(Feature::COVERAGE)),
                          decisions.features.has(Feature::AOVS), settings.adaptive || settings.resumable};
  work.picture = !picture.serves(wanted);
  if (work.picture)
    picture.remake(wanted,
                   [&] { return allocatePicture(compute, settings, decisions, Compute::Memory::Real); });
  else
    compute.fillZero(picture.value->film);
}

void RenderSession::State::provideScene(Compute& compute, const Scene& from, const Settings& settings,
                                        const Decisions& decisions, const RenderHooks& hooks, PhaseLog& log) {
  const SceneKey wanted{decisions.buffers.bits() & kSceneBufferFeatures, settings.keepAllFeatures,
                        settings.mirrorRoughness};
  DeviceTables tables = tablesOf(from, decisions.pruned);
  const bool hasTexels = scene.serves(wanted) && scene.value->tables.texels == tables.texels;
  work.scene = !hasTexels || haveMeshesMoved || scene.value->tables.emitters != tables.emitters;
  if (!work.scene) {
    work.tables =
        log.time("upload", [&] { return takeOver(compute, from, std::move(tables), *scene.value); });
    return;
  }
  DeviceScene stays = hasTexels ? imagesOf(std::move(*scene.value)) : DeviceScene();
  scene.remake(wanted, [&] {
    TriTree tree = log.time("build tree", [&] { return buildTree(from, decisions); });
    return log.time("upload", [&] {
      return uploadScene(compute, from, decisions.pruned, std::move(tree), decisions.buffers, hooks.consumed,
                         std::move(stays));
    });
  });
  haveMeshesMoved = false;
}

void RenderSession::State::provideQueues(Compute& compute, const Settings& settings,
                                         const Decisions& decisions, bool isPreview, PhaseLog& log) {
  QueueKey wanted{decisions.features.bits() & kQueueFeatures, decisions.buffers.bits() & kQueueFeatures,
                  mostWaiting(decisions.lights),
                  queueCapacity(settings, decisions.features, compute.device()), decisions.compactChunk};
  // A preview takes larger ones that are there, and leaves them to the render that follows.
  if (isPreview && queues.value) wanted.capacity = std::max(wanted.capacity, queues.key.capacity);
  work.queues = !queues.serves(wanted);
  if (work.queues)
    queues.remake(wanted, [&] {
      return log.time("allocate queues", [&] {
        return RayQueues(compute, decisions.features, decisions.buffers, wanted.waitingLights,
                         wanted.capacity, decisions.compactChunk);
      });
    });
}

RenderSession::State::Prepared RenderSession::State::prepare(const Scene& from, const Settings& settings,
                                                             const RenderHooks& hooks, PhaseLog& log) {
  work = {};
  checkSettings(settings);
  findCamera(from, settings.camera);  // an unknown one is said before a device is opened
  say(hooks, kFirstPhase);
  const auto opening = Clock::now();
  OpenDevice& open = openFor(settings, hooks);
  log.end("open the device", opening);
  if (hooks.note && settings.threads > 0 && !keepsToThreads(open.compute.device(), settings.threads))
    hooks.note(fmt::format("--threads: {} takes as many as it likes, its driver cannot be told otherwise",
                           open.compute.device().name));
  const std::size_t readBefore = texels.reads;
  Decisions decisions = log.time("decide what is needed",
                                 [&] { return decide(from, settings, open.compute.device(), &texels); });
  work.texelReads = texels.reads - readBefore;

  say(hooks, "compiling kernels");
  const auto compiling = Clock::now();
  const std::uint64_t programsBefore = open.programs.total();
  const ProgramChoice choice =
      choosePrograms(open.compute.device(), open.programs, settings, decisions, hooks);
  bufferFeatures |= choice.bufferFeatures;
  decisions.buffers = SceneFeatures::ofBits(decisions.features.bits() | bufferFeatures);
  auto starting =
      std::async(std::launch::async, [&] { return startPrograms(open, choice, hooks, compiling); });
  const auto allocating = Clock::now();
  providePicture(open.compute, settings, decisions, hooks.isPreview);
  const double pictureSeconds = PhaseLog::secondsSince(allocating);
  provideScene(open.compute, from, settings, decisions, hooks, log);
  provideQueues(open.compute, settings, decisions, hooks.isPreview, log);
  StartingPrograms started = starting.get();
  log.add("compile kernels", compiling, started.seconds);
  work.programs = static_cast<int>(open.programs.total() - programsBefore);
  return {open, std::move(decisions), choice, std::move(started), pictureSeconds};
}

namespace {

/// What a wavefront is set up with; refers to the scene and the features.
WavefrontSetup setupOf(const Scene& scene, const DeviceScene& onDevice, const Settings& settings,
                       const Decisions& decisions, const RenderHooks& hooks, const DeviceInfo& device) {
  const Camera& camera = hooks.camera ? *hooks.camera : scene.cameras[decisions.camera];
  return {decisions.features,
          onDevice,
          decisions.lights,
          cameraToDevice(camera, settings),
          constantsToDevice(scene, camera, settings),
          static_cast<std::uint32_t>(settings.bounces),
          static_cast<std::uint32_t>(mostHits(decisions.features, settings)),
          decisions.compactChunk,
          static_cast<std::uint32_t>(tracedRegion(settings).pixels()),
          loopLimits(device).samples,
          loopBudget(device) > 0};
}

StageRunner runnerOf(Compute& compute, const std::vector<cl::Program>& programs, const Decisions& decisions,
                     const RayQueues& queues) {
  return {compute, programs, decisions.workGroup,
          LaunchWidths{decisions.features.has(Feature::PACKETS), decisions.compactChunk},
          queues.entryBytes()};
}

}  // namespace

RenderResult RenderSession::render(const Scene& scene, const Settings& settings, const RenderHooks& hooks) {
  State& kept = *state_;
  PhaseLog log(hooks.trace);
  const auto threads = limitThreads(settings.threads);
  const State::Prepared prepared = kept.prepare(scene, settings, hooks, log);
  const Decisions& decisions = prepared.decisions;
  Compute& compute = prepared.device.compute;
  const PictureBuffers& picture = *kept.pictures[hooks.isPreview].value;

  say(hooks, kLastPhase);
  const auto rendering = Clock::now();
  StageRunner stages = runnerOf(compute, prepared.start.programs, decisions, *kept.queues.value);
  stages.record(hooks.trace);
  const WavefrontSetup setup =
      setupOf(scene, *kept.scene.value, settings, decisions, hooks, compute.device());
  Wavefront wavefront(compute, stages, *kept.queues.value, setup, picture.film, picture.aovs);
  std::optional<PixelRecorder> recorder;
  if (settings.bounceAov || settings.costAov)
    recorder.emplace(compute, *kept.queues.value, decisions.features, settings);
  wavefront.observe(recorder ? &*recorder : nullptr);
  SamplingLoop loop(compute, wavefront, settings, hooks,
                    FilmBuffers{tracedRegion(settings).pixels(), picture.order, picture.film, picture.aovs,
                                picture.passOrder, picture.passBlocks});
  kept.ownPrograms.begin(prepared.choice, prepared.start.areGeneral);
  wavefront.beforeEachBatch([&](std::uint32_t batch) {
    kept.ownPrograms.beforeBatch(batch, prepared.device, prepared.choice, hooks, loop, stages);
  });
  BiasBound bias(scene, settings);
  const auto resultSoFar = [&] {
    RenderResult result{loop.picture(), {}, readAovs(compute, settings, picture, loop, recorder), {}};
    if (settings.alpha) result.alpha = loop.alpha();
    Stats& stats = result.stats;
    describeScene(stats, scene);
    stats.settings = settingsInEffect(settings, decisions, *kept.queues.value);
    describeDevice(stats, compute.device(), settings.threads);
    describeDecisions(stats, decisions);
    describeRays(stats, bias, wavefront, loop);
    stats.meanRadiance = meanRadiance(result.radiance);
    stats.stages = stages.stats();
    stats.bounces = stages.statsByBounce();
    kept.scene.value->report(stats.buffers);
    kept.queues.value->report(stats.buffers);
    picture.report(stats.buffers);
    stats.time.compile = prepared.start.seconds;
    stats.time.build = log.seconds("build tree");
    stats.time.upload = prepared.pictureSeconds + log.seconds("upload") + log.seconds("allocate queues");
    stats.time.render = loop.secondsInAll();
    stats.phases = log.phases();
    stats.programs = kept.ownPrograms.runs(loop.seconds());
    return result;
  };
  try {
    loop.run([&] {
      if (hooks.shown) hooks.shown(resultSoFar());
    });
  } catch (...) {
    kept.queues.value.reset();  // some of them may be with the rays that were under way
    throw;
  }
  log.end("render", rendering);
  kept.ownPrograms.end(prepared.choice, hooks, loop.seconds());
  return resultSoFar();
}

std::vector<RayTree> RenderSession::explain(const Scene& scene, const Settings& settings, int x, int y,
                                            const RenderHooks& hooks, int samples) {
  State& kept = *state_;
  PhaseLog log(nullptr);
  const auto threads = limitThreads(settings.threads);
  RenderHooks ownAlone = hooks;  // the recorder knows the planes of the scene's own features
  ownAlone.tier = Tier::Specialised;
  const State::Prepared prepared = kept.prepare(scene, settings, ownAlone, log);
  const Decisions& decisions = prepared.decisions;
  Compute& compute = prepared.device.compute;
  StageRunner stages = runnerOf(compute, prepared.start.programs, decisions, *kept.queues.value);
  const WavefrontSetup setup =
      setupOf(scene, *kept.scene.value, settings, decisions, hooks, compute.device());
  const Buffer& film = kept.pictures[hooks.isPreview].value->film;
  const Buffer none;
  Wavefront wavefront(compute, stages, *kept.queues.value, setup, film, none);
  const std::vector<std::uint32_t> pixel(FILM_BLOCK,
                                         static_cast<std::uint32_t>(y) << 16 | static_cast<std::uint32_t>(x));
  const Buffer order = compute.upload("explained pixel", pixel);
  std::vector<RayTree> trees;
  for (int sample = 0; sample < std::min(samples, settings.raysPerPixel); ++sample) {
    compute.fillZero(film);
    RayRecorder recorder(compute, *kept.queues.value, *kept.scene.value, decisions.features);
    wavefront.observe(&recorder);
    wavefront.trace({order, none, 1, static_cast<std::uint32_t>(sample), 1},
                    {[](double, bool) { return true; }});
    RayTree tree{recorder.rays(), {}};
    const std::size_t planeBytes = setup.pixels * sizeof(float);
    for (int c = 0; c < 3; ++c) {
      float channel = 0.0F;
      compute.read(film, static_cast<std::size_t>(c) * planeBytes, sizeof(float), &channel);
      tree.radiance[c] = static_cast<double>(channel);
    }
    for (RayRecord& ray : tree.rays) {
      if (ray.hit) ray.hit->material = scene.triangles[ray.hit->primitive].material;
      for (ShadowRecord& shadow : ray.shadows) shadow.light = decisions.pruned.lights[shadow.light];
    }
    trees.push_back(std::move(tree));
  }
  return trees;
}

RenderResult render(const Scene& scene, const Settings& settings, const RenderHooks& hooks) {
  return RenderSession().render(scene, settings, hooks);
}

}  // namespace whittle
