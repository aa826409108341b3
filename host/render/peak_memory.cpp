// See peak_memory.h. The phases are those of render/render_session.cpp and wavefront/device_scene.cpp, in
// their order.
#include "render/peak_memory.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <string_view>
#include <vector>

#include "bvh/prim_ref.h"
#include "bvh/tri_tree.h"
#include "kernels/shared/layout.h"
#include "wavefront/film.h"

namespace whittle {
namespace {

template <class T>
std::uint64_t bytesOf(const std::vector<T>& array) {
  return array.size() * sizeof(T);
}

std::uint64_t bytesOf(const Scene& s) {
  std::uint64_t bytes = bytesOf(s.positions) + bytesOf(s.normals) + bytesOf(s.tangents) + bytesOf(s.uv0) +
                        bytesOf(s.uv1) + bytesOf(s.colors) + bytesOf(s.triangles) + bytesOf(s.materials) +
                        bytesOf(s.lights) + bytesOf(s.background.map);
  for (const Image& image : s.images) bytes += bytesOf(image.texels) + bytesOf(image.deepTexels);
  return bytes;
}

/// The images that are let go when the device has them.
std::uint64_t uploadedImages(const Scene& scene, const RenderPlan& plan) {
  if (!plan.features.has(Feature::TEXTURES)) return 0;
  std::uint64_t bytes = 0;
  for (const std::uint32_t i : plan.pruned.images)
    bytes += bytesOf(scene.images[i].texels) + bytesOf(scene.images[i].deepTexels);
  return bytes;
}

/// Those that are on both sides at once: as many as there are threads, the largest of them at worst.
std::uint64_t imagesOnTheWay(const Scene& scene) {
  std::vector<std::uint64_t> bytes;
  for (const Image& image : scene.images) bytes.push_back(bytesOf(image.texels) + bytesOf(image.deepTexels));
  std::sort(bytes.begin(), bytes.end(), std::greater());
  bytes.resize(std::min(bytes.size(), static_cast<std::size_t>(tbb::this_task_arena::max_concurrency())));
  return std::accumulate(bytes.begin(), bytes.end(), std::uint64_t{0});
}

std::uint64_t pixelsOf(const Settings& s) { return tracedRegion(s).pixels(); }

/// Of the device's buffers; of queues the part that the picture's samples reach.
class DeviceBytes {
 public:
  explicit DeviceBytes(const RenderPlan& plan) : plan_(plan) {}

  std::uint64_t named(std::string_view name) const {
    return sum([&](const BufferStats& b) { return b.name == name; });
  }
  std::uint64_t all() const {
    const double samples = static_cast<double>(pixelsOf(plan_.settings)) * plan_.settings.raysPerPixel;
    const double reached = std::min(1.0, samples / plan_.settings.wavefront);
    const std::uint64_t queues = sum([](const BufferStats& b) { return b.group == "queues"; });
    return sum([](const BufferStats& b) { return b.group != "queues"; }) +
           static_cast<std::uint64_t>(reached * static_cast<double>(queues));
  }

 private:
  template <class Counts>
  std::uint64_t sum(const Counts& counts) const {
    std::uint64_t bytes = 0;
    for (const BufferStats& b : plan_.buffers) bytes += counts(b) ? b.bytes : 0;
    return bytes;
  }

  const RenderPlan& plan_;
};

/// What the upload of the geometry holds beside the scene, at its most; of `tree`, which it takes, the order
/// stays.
std::uint64_t uploadBytes(const RenderPlan& plan, std::uint64_t tree, std::uint64_t order) {
  const DeviceBytes device(plan);
  const std::uint64_t wide = device.named("bvh8Nodes"), leaves = device.named("leaves");
  const std::uint64_t planned = 44 * plan.treeNodes;
  const std::uint64_t made = device.named("nodes") + leaves + wide + device.named("triangles");
  if (wide == 0) return tree + device.named("nodes") + made;
  return std::max({tree + planned + wide, tree + 2 * wide, order + wide + made});
}

}  // namespace

std::uint64_t pictureBytes(const Settings& settings) {
  constexpr std::uint64_t kOrder = sizeof(std::uint32_t), kPicture = 3 * sizeof(float),
                          kAlpha = sizeof(float);
  const std::uint64_t passes = settings.adaptive || settings.resumable ? kOrder : 0;
  const std::uint64_t film = filmPlanes(settings, settings.alpha) * sizeof(float);
  const std::uint64_t saved = settings.resumable ? 2 * film : 0;  // on this side, and as a file's bytes
  return pixelsOf(settings) * (film + saved + kOrder + passes + kPicture + (settings.alpha ? kAlpha : 0));
}

std::uint64_t peakBytes(const Scene& scene, const RenderPlan& plan, std::uint64_t loadBytes) {
  const DeviceBytes device(plan);
  const std::uint64_t triangles = scene.triangles.size(), pixels = pixelsOf(plan.settings);
  const std::uint64_t channels = plan.settings.alpha ? 4 : 3;
  const std::uint64_t order = plan.treeNodes > 0 ? sizeof(std::uint32_t) * triangles : 0;
  const std::uint64_t tree = sizeof(TreeNode) * plan.treeNodes + order;
  const std::uint64_t build = tree + (plan.treeNodes > 0 ? (sizeof(PrimRef) + 12) * triangles : 0);
  const std::uint64_t upload = uploadBytes(plan, tree, order);
  // Attributes and images leave this side when they have come to the other.
  const std::uint64_t attributes =
      bytesOf(scene.normals) + bytesOf(scene.tangents) + bytesOf(scene.uv0) + bytesOf(scene.uv1);
  const std::uint64_t whole = bytesOf(scene), drawn = whole - attributes - uploadedImages(scene, plan);
  const std::uint64_t largest =
      std::max({bytesOf(scene.normals), bytesOf(scene.tangents), imagesOnTheWay(scene)});
  const std::uint64_t uploading = drawn + device.all() + largest;
  // The order of the pixels is made on this side; the picture comes when everything is still there.
  // Of each pixel what PixelRecorder holds, and its pictures.
  const std::uint64_t recorded =
      plan.settings.bounceAov || plan.settings.costAov ? (4 + 3) * sizeof(float) * pixels : 0;
  const std::uint64_t rendering =
      recorded + drawn + device.all() + channels * sizeof(float) * pixels +
      (device.named("aovs") > 0 ? device.named("aovs") * 2 + device.named("pixelOrder") : 0);
  // Encoding: the picture once more, as codes or as floats that do not compress.
  // Glare is a picture more, made of three.
  const std::uint64_t glare =
      plan.settings.bloom.strength > 0.0F ? std::uint64_t{4} * 3 * sizeof(float) * pixels : 0;
  const std::uint64_t writing = drawn + 2 * channels * sizeof(float) * pixels + glare;
  const std::uint64_t own = std::max({whole + build, whole + upload, uploading, rendering, writing});
  return std::max(kProgramBytes + kRuntimeBytes + own, loadBytes);
}

}  // namespace whittle
