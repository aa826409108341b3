// The phases before the first ray, each a function from what the ones before it returned: decide, allocate
// the picture, allocate the scene. A render runs them all, planRender without taking any memory.
#pragma once

#include <tbb/global_control.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "analysis/light_groups.h"
#include "analysis/scene_features.h"
#include "bvh/tri_tree.h"
#include "cl/program.h"
#include "render/phase_log.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "wavefront/device_scene.h"
#include "wavefront/ray_queues.h"

namespace whittle {

/// Throws InputError where a setting is out of its range, or two contradict each other.
void checkSettings(const Settings& settings);

/// The device that the settings ask for, with what is known of it (cl/device_facts.h). Throws ClError or
/// std::invalid_argument.
Compute openDevice(const Settings& settings, Compute::Memory memory, Compute::Launches launches);

/// For as long as it is kept: the tree builder and whatever else runs on the host's threads has so many at
/// most. Null: all there are.
std::unique_ptr<tbb::global_control> limitThreads(int threads);

/// What is settled before anything is allocated.
struct Decisions {
  std::size_t camera = 0;  ///< of Scene::cameras
  PrunedScene pruned;      ///< what goes to the device
  SceneFeatures features;
  std::vector<LightGroup> lights;
  bool hasLateLight = false;  ///< see light_groups.h
  /// Whose buffers there are: `features`, and generalBufferFeatures where a general program starts.
  SceneFeatures buffers;
  std::uint32_t compactChunk = 0;
  int workGroup = 0;
};
/// Throws InputError: no such camera, a work-group that the device cannot have. `texels`: see pruneScene.
Decisions decide(const Scene& scene, const Settings& settings, const DeviceInfo& device,
                 TexelFacts* texels = nullptr);

/// What is traced of the picture, on the device, and the order of its pixels.
struct PictureBuffers {
  Buffer order, film, aovs;
  Buffer passOrder, passBlocks;  ///< with Settings::adaptive

  void report(std::vector<BufferStats>& out) const;
};
/// Throws ClError where the picture is too large for the device, before anything that takes time.
PictureBuffers allocatePicture(Compute& compute, const Settings& settings, const Decisions& decisions,
                               Compute::Memory memory);

/// The tree, or with --search array the triangles in their order.
TriTree buildTree(const Scene& scene, const Decisions& decisions);

/// Scene and queues on the device.
struct SceneBuffers {
  DeviceScene scene;
  RayQueues queues;

  void report(std::vector<BufferStats>& out) const;
};
/// Throws ClError that names the buffer that does not fit. `consumed`: see uploadScene.
SceneBuffers allocateScene(Compute& compute, const Scene& scene, const Settings& settings,
                           const Decisions& decisions, TriTree tree, Scene* consumed = nullptr);

/// Rays in flight: never more than the picture has samples times the rays that a hit can send out (two at
/// least), never fewer than what a long run sends out, nor more than the device's loops allow.
std::uint32_t queueCapacity(const Settings& settings, const SceneFeatures& features,
                            const DeviceInfo& device);

/// With the sizes that were chosen where the user left them open.
Settings settingsInEffect(const Settings& settings, const Decisions& decisions, const RayQueues& queues);

}  // namespace whittle
