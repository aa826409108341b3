// See preparation.h.
#include "render/preparation.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "bvh/uninitialized.h"
#include "cl/device.h"
#include "cl/device_facts.h"
#include "report/text.h"
#include "scene/byte_counts.h"
#include "scene/camera.h"
#include "scene/free_array.h"
#include "scene/input_error.h"
#include "scene/machine_memory.h"
#include "wavefront/camera_to_device.h"
#include "wavefront/film.h"
#include "wavefront/pixel_order.h"
#include "wavefront/stage_runner.h"

namespace whittle {

void checkSettings(const Settings& s) {
  if (s.width < 1 || s.height < 1 || s.width > 65535 || s.height > 65535)
    throw InputError(
        fmt::format("--width/--height: {}×{} is not between 1×1 and 65535×65535", s.width, s.height));
  if (s.crop && !liesWithin(*s.crop, s.width, s.height))
    throw InputError(fmt::format("--crop: {},{},{},{} lies outside the picture of {}×{}", s.crop->x,
                                 s.crop->y, s.crop->width, s.crop->height, s.width, s.height));
  if (s.bounces < 1) throw InputError("--bounces: at least 1");
  if (s.transparentBounces < 0) throw InputError("--transparent-bounces: at least 0");
  if (s.ambient && !(*s.ambient >= 0.0F && *s.ambient <= kLargestAmbient))
    throw InputError(fmt::format("--ambient: not from 0 to {}", kLargestAmbient));
  if (!(s.cutoff >= 0.0F && s.cutoff <= kLargestCutoff))
    throw InputError(fmt::format("--cutoff: not from 0 to {}", kLargestCutoff));
  if (s.raysPerPixel < 1) throw InputError("--rays-per-pixel: at least 1");
  if (s.adaptive && s.sampler == Sampler::Stratified)
    throw InputError(
        "--adaptive: stratified samples need the same number in every pixel; use --sampler sobol");
}

Compute openDevice(const Settings& settings, Compute::Memory memory, Compute::Launches launches) {
  // The environment is left alone: the platform has read it, or another thread may.
  prepareCpuThreads(0, settings.workGroup);
  Compute compute(withThreads(selectDevice(listDevices(), settings.device), settings.threads), memory,
                  launches);
  learnFacts(compute);
  return compute;
}

std::unique_ptr<tbb::global_control> limitThreads(int threads) {
  if (threads <= 0) return nullptr;
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}

namespace {

/// Throws InputError for what the device's driver would not do to its end.
void checkLoops(const Scene& scene, const SceneFeatures& features, const DeviceInfo& device,
                const LoopLimits& limits) {
  if (device.facts.loopLimit == 0) return;
  if (features.has(Feature::PACKETS))
    throw InputError(
        fmt::format("--lanes: 16 cannot be had on {}, whose driver ends loops after {} iterations",
                    device.name, device.facts.loopLimit));
  if (!features.has(Feature::TREE) && scene.triangles.size() > limits.triangles)
    throw InputError(
        fmt::format("--search: array takes at most {} triangles on {}, whose driver ends loops after "
                    "{} iterations, and the scene has {}; take tree",
                    formatInteger(limits.triangles), device.name, device.facts.loopLimit,
                    formatInteger(scene.triangles.size())));
}

}  // namespace

Decisions decide(const Scene& scene, const Settings& settings, const DeviceInfo& device, TexelFacts* texels) {
  Decisions d;
  d.camera = findCamera(scene, settings.camera);
  d.pruned = pruneScene(scene, settings, texels);
  d.features = SceneFeatures::analyse(scene, d.pruned, settings, {device.suitsPackets()});
  const LoopLimits limits = loopLimits(device);
  checkLoops(scene, d.features, device, limits);
  d.lights = lightGroups(scene, d.pruned, d.features, limits.lights);
  d.hasLateLight = hasLateLight(scene, d.pruned, d.lights);
  d.buffers = SceneFeatures::ofBits(d.features.bits());
  d.compactChunk = defaultCompactChunk(device);
  d.workGroup = settings.workGroup > 0 ? settings.workGroup : defaultWorkGroup(d.features);
  if (static_cast<std::uint64_t>(d.workGroup) > device.maxWorkGroup)
    throw InputError(fmt::format("--work-group: {} allows at most {}", device.name, device.maxWorkGroup));
  return d;
}

PictureBuffers allocatePicture(Compute& compute, const Settings& settings, const Decisions& decisions,
                               Compute::Memory memory) {
  const Region region = tracedRegion(settings);
  const std::size_t pixels = region.pixels();
  const std::size_t film = pixels * sizeof(float) *
                           filmPlanes(settings, decisions.features.has(Feature::COVERAGE)),
                    order = pixels * sizeof(std::uint32_t);
  const std::size_t aovs = decisions.features.has(Feature::AOVS) ? pixels * AOV_PLANES * sizeof(float) : 0;
  const DeviceInfo& device = compute.device();
  if (film + order + aovs > device.globalMemory)
    throw ClError(fmt::format("a picture of {} needs {} for its film but {} has {}", sizeText(settings),
                              formatBytes(film + order + aovs), device.name,
                              formatBytes(device.globalMemory)));
  PictureBuffers picture;
  picture.film = compute.allocate("film", film);
  picture.order = compute.allocate("pixelOrder", order);
  picture.aovs = compute.allocate("aovs", aovs);
  if (settings.adaptive || settings.resumable) {
    picture.passOrder = compute.allocate("passOrder", order);
    picture.passBlocks =
        compute.allocate("passBlocks", SampleCounts(pixels).blocks() * sizeof(std::uint32_t));
  }
  if (memory == Compute::Memory::SizesOnly) return picture;
  compute.write(picture.order, makePixelOrder(region).data());
  compute.fillZero(picture.film);
  return picture;
}

void PictureBuffers::report(std::vector<BufferStats>& out) const {
  for (const Buffer* b : {&order, &film, &aovs, &passOrder, &passBlocks})
    if (*b) out.push_back({b->name, "film", b->bytes});
}

TriTree buildTree(const Scene& scene, const Decisions& decisions) {
  TriTree tree;
  if (decisions.buffers.has(Feature::TREE)) {
    UninitializedVector<glm::uvec3> corners(scene.triangles.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, corners.size(), 1 << 14), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const Triangle& t = scene.triangles[i];
        corners[i] = {t.v0, t.v1, t.v2};
      }
    });
    tree = buildTriTree(scene.positions, corners);
    freeArray(corners);
    returnFreedMemory();  // of its subtrees
    return tree;
  }
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) tree.order.push_back(i);
  return tree;
}

/// Room for what a sample's slice sends out, of a picture that is small.
std::uint32_t queueCapacity(const Settings& s, const SceneFeatures& features, const DeviceInfo& device) {
  const std::uint64_t raysOfHit = std::max(mostRaysOfHit(features), 2U);
  const std::uint64_t samples = tracedRegion(s).pixels() * static_cast<std::uint64_t>(s.raysPerPixel);
  const std::uint64_t wanted =
      std::min<std::uint64_t>({static_cast<std::uint64_t>(s.wavefront), raysOfHit * samples,
                               std::uint64_t{loopLimits(device).entries} / 64 * 64});
  return static_cast<std::uint32_t>((std::max(wanted, raysOfHit * LONG_RUN) + 63) / 64 * 64);
}

SceneBuffers allocateScene(Compute& compute, const Scene& scene, const Settings& settings,
                           const Decisions& decisions, TriTree tree, Scene* consumed) {
  return {uploadScene(compute, scene, decisions.pruned, std::move(tree), decisions.buffers, consumed),
          RayQueues(compute, decisions.features, decisions.buffers, mostWaiting(decisions.lights),
                    queueCapacity(settings, decisions.features, compute.device()), decisions.compactChunk)};
}

void SceneBuffers::report(std::vector<BufferStats>& out) const {
  scene.report(out);
  queues.report(out);
}

Settings settingsInEffect(const Settings& settings, const Decisions& decisions, const RayQueues& queues) {
  Settings used = settings;
  used.wavefront = static_cast<int>(queues.capacity());
  used.workGroup = decisions.workGroup;
  return used;
}

}  // namespace whittle
