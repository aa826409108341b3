// Renders one after the other on one device: what two of them have in common is opened, compiled, built and
// uploaded once. What a window needs, where a camera moves or a switch is thrown.
#pragma once

#include <memory>
#include <vector>

#include "render/renderer.h"
#include "scene/ray_tree.h"
#include "wavefront/device_scene.h"

namespace whittle {

/// What the last render could not take over from the one before.
struct RenderWork {
  bool device = false;         ///< opened
  int programs = 0;            ///< compiled, or loaded from the platform's cache
  bool scene = false;          ///< the tree built and the scene uploaded
  TableChanges tables;         ///< uploaded though the scene was not
  std::size_t texelReads = 0;  ///< how often the analysis went through the texels of an image
  bool queues = false;         ///< allocated
  bool picture = false;        ///< allocated

  /// Of two renders.
  void add(const RenderWork& other);
};

class RenderSession {
 public:
  RenderSession();
  ~RenderSession();
  RenderSession(RenderSession&&) noexcept;
  RenderSession& operator=(RenderSession&&) noexcept;

  /// As the free function of the same name, with the same bits whatever was rendered before. `scene`: the
  /// same as last time with other cameras, lights, factors of materials, and radiance and rotation of the
  /// background at most (setAppearance), unless sceneChanged was called. What a throw leaves behind is good
  /// for the next render.
  RenderResult render(const Scene& scene, const Settings& settings, const RenderHooks& hooks = {});
  /// What became of the rays of a pixel (x from the left, y from the top), sample by sample: the kernels'
  /// numbers, RayTree::radiance as the film got it. `samples`: at most so many of settings.raysPerPixel.
  /// Throws as render.
  std::vector<RayTree> explain(const Scene& scene, const Settings& settings, int x, int y,
                               const RenderHooks& hooks = {}, int samples = kAllSamples);
  /// Opens the device that a render with these settings and hooks would open, so that one that follows need
  /// not: while the scene is read, from another thread. Throws as render.
  void open(const Settings& settings, const RenderHooks& hooks = {});
  /// The next scene differs from the last in more than that.
  void sceneChanged();
  /// The next scene has the same images and surroundings as the last, but other meshes.
  void meshesMoved();
  /// Everything on the device is let go and the device closed, as after it was lost.
  void close();

  const RenderWork& work() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace whittle
