// From the triangles to their materials, from those to the images and vertices they read.
#include "analysis/scene_use.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

#include "analysis/image_merge.h"
#include "analysis/light_reach.h"
#include "analysis/material_use.h"

namespace whittle {
namespace {

using Range = tbb::blocked_range<std::size_t>;
using Flags = std::vector<std::uint8_t>;
constexpr std::size_t kGrain = 1 << 14;  ///< triangles of a task

std::vector<std::uint32_t> identity(std::size_t count) {
  std::vector<std::uint32_t> table(count);
  std::iota(table.begin(), table.end(), 0U);
  return table;
}

/// Which materials some triangle has.
Flags usedMaterials(const Scene& scene) {
  return tbb::parallel_reduce(
      Range(0, scene.triangles.size(), kGrain), Flags(scene.materials.size()),
      [&](const Range& range, Flags used) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) used[scene.triangles[i].material] = 1;
        return used;
      },
      [](Flags a, const Flags& b) {
        for (std::size_t i = 0; i < a.size(); ++i) a[i] |= b[i];
        return a;
      });
}

/// Bounds of the alpha of the vertices of each material's triangles; a least of -infinity where one is not
/// finite.
std::vector<AlphaBounds> vertexAlphas(const Scene& scene) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  using Bounds = std::vector<AlphaBounds>;
  return tbb::parallel_reduce(
      Range(0, scene.triangles.size(), kGrain), Bounds(scene.materials.size(), AlphaBounds{inf, -inf}),
      [&](const Range& range, Bounds bounds) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const Triangle& t = scene.triangles[i];
          AlphaBounds& own = bounds[t.material];
          for (const std::uint32_t v : {t.v0, t.v1, t.v2}) {
            const float a = scene.colors[v].a;
            own.least = std::min(own.least, std::isfinite(a) ? a : -inf);
            own.greatest = std::max(own.greatest, std::isfinite(a) ? a : inf);
          }
        }
        return bounds;
      },
      [](Bounds a, const Bounds& b) {
        for (std::size_t i = 0; i < a.size(); ++i)
          a[i] = {std::min(a[i].least, b[i].least), std::max(a[i].greatest, b[i].greatest)};
        return a;
      });
}

/// Needless masks and blends become opaque. `read`: the materials as read, `used`: those that triangles have.
void dropNeedlessAlpha(const Scene& scene, const Flags& used, std::vector<Material>& read, Trimmed& trimmed) {
  std::vector<AlphaBounds> colours;
  std::unordered_map<int, int> leastTexels;  // by image
  for (std::size_t i = 0; i < read.size(); ++i) {
    Material& m = read[i];
    AlphaSource source;
    const auto needless = [&] { return maskIsNeedless(m, source) || blendIsNeedless(m, source); };
    if (!used[i] || !needless()) continue;  // not even by its factor
    if (m.baseColorTexture.used()) {
      const auto [at, isNew] = leastTexels.try_emplace(m.baseColorTexture.image, 0);
      if (isNew) at->second = leastAlpha(scene.images[static_cast<std::size_t>(at->first)]);
      source.leastTexel = at->second;
    }
    if (!needless()) continue;
    source.coloured = !scene.colors.empty();
    if (source.coloured && m.alphaMode == AlphaMode::Mask) {
      if (colours.empty()) colours = vertexAlphas(scene);
      source.colours = colours[i];
    }
    if (!needless()) continue;
    ++(m.alphaMode == AlphaMode::Mask ? trimmed.needlessMasks : trimmed.needlessBlends);
    m.alphaMode = AlphaMode::Opaque;
    m.alphaCutoff = Material{}.alphaCutoff;
  }
}

/// Slots of alike images name one of them.
void shareImages(const Scene& scene, const Flags& used, std::vector<Material>& read, Trimmed& trimmed) {
  Flags wanted(scene.images.size());
  for (std::size_t i = 0; i < read.size(); ++i)
    for (const TextureSlot* slot : readSlots(std::as_const(read[i])))
      if (used[i] && slot->used()) wanted[static_cast<std::size_t>(slot->image)] = 1;
  const auto first = firstAlike(scene.images, wanted);
  for (Material& m : read)
    for (TextureSlot* slot : readSlots(m))
      if (slot->used()) slot->image = static_cast<int>(first[static_cast<std::size_t>(slot->image)]);
  trimmed.images.all = scene.images.size();
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    trimmed.images.unused += !wanted[i];
    trimmed.images.alike += first[i] != i;
  }
}

/// One of each kind of material that triangles have.
void keepMaterials(const Flags& used, const std::vector<Material>& read, SceneUse& use) {
  std::unordered_map<std::string, std::uint32_t> known;
  use.materialOf.assign(read.size(), kNotUsed);
  use.trimmed.materials.all = read.size();
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (!used[i]) {
      ++use.trimmed.materials.unused;
      continue;
    }
    const auto [at, isNew] =
        known.try_emplace(bitsOf(read[i]), static_cast<std::uint32_t>(use.materials.size()));
    if (isNew) use.materials.push_back(read[i]);
    use.trimmed.materials.alike += !isNew;
    use.materialOf[i] = at->second;
  }
}

/// The images that kept materials read, and their slots' numbers of them.
void keepImages(std::size_t imageCount, SceneUse& use) {
  std::vector<std::uint32_t> imageOf(imageCount, kNotUsed);
  for (Material& m : use.materials)
    for (TextureSlot* slot : readSlots(m)) {
      if (!slot->used()) continue;
      std::uint32_t& at = imageOf[static_cast<std::size_t>(slot->image)];
      if (at == kNotUsed) {
        at = static_cast<std::uint32_t>(use.images.size());
        use.images.push_back(static_cast<std::uint32_t>(slot->image));
      }
      slot->image = static_cast<int>(at);
    }
}

/// Only lights that end somewhere ask where the triangles are; to the others they are anywhere.
LitBounds boundsForLights(const Scene& scene, const Flags& lit) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  const bool asked = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& l) {
    return l.kind == LightKind::Spot || (l.kind == LightKind::Point && l.range < inf);
  });
  if (asked) return litBounds(scene, lit);
  LitBounds bounds;
  if (std::find(lit.begin(), lit.end(), 1) != lit.end()) bounds = {glm::vec3(-inf), glm::vec3(inf)};
  return bounds;
}

void keepLights(const Scene& scene, SceneUse& use) {
  use.trimmed.lights = scene.lights.size();
  if (scene.lights.empty()) return;
  Flags lit(scene.materials.size());
  for (std::size_t i = 0; i < lit.size(); ++i)
    lit[i] = use.materialOf[i] != kNotUsed && !use.materials[use.materialOf[i]].unlit;
  const LitBounds bounds = boundsForLights(scene, lit);
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const std::string reason = whyDark(scene.lights[i], bounds);
    if (reason.empty())
      use.lights.push_back(i);
    else
      use.trimmed.droppedLights.push_back({i, scene.lights[i].name, reason});
  }
}

/// Leaves out the vertices that no triangle has, if there are any and vertices carry anything at all.
void keepVertices(const Scene& scene, SceneUse& use) {
  const std::size_t count = scene.positions.size();
  use.trimmed.vertices.all = use.vertexCount = count;
  if (scene.normals.empty() && scene.colors.empty() && use.images.empty()) return;
  Flags used(count);
  tbb::parallel_for(Range(0, scene.triangles.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Triangle& t = scene.triangles[i];
      for (const std::uint32_t v : {t.v0, t.v1, t.v2})
        std::atomic_ref(used[v]).store(1, std::memory_order_relaxed);
    }
  });
  const auto unused = static_cast<std::size_t>(std::count(used.begin(), used.end(), 0));
  if (unused == 0) return;
  use.trimmed.vertices.unused = unused;
  use.vertexCount = count - unused;
  use.vertexOf.resize(count);
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < count; ++v) use.vertexOf[v] = used[v] ? next++ : kNotUsed;
}

}  // namespace

SceneUse wholeScene(const Scene& scene) {
  SceneUse use;
  use.materials = scene.materials;
  use.materialOf = identity(scene.materials.size());
  use.images = identity(scene.images.size());
  use.lights = identity(scene.lights.size());
  use.vertexCount = scene.positions.size();
  use.trimmed.materials.all = scene.materials.size();
  use.trimmed.images.all = scene.images.size();
  use.trimmed.vertices.all = scene.positions.size();
  use.trimmed.lights = scene.lights.size();
  return use;
}

SceneUse useOf(const Scene& scene, const Settings& settings) {
  if (settings.keepAllFeatures) return wholeScene(scene);
  SceneUse use;
  use.sharesSlots = true;
  const Flags used = usedMaterials(scene);
  std::vector<Material> read;
  read.reserve(scene.materials.size());
  for (const Material& m : scene.materials) read.push_back(asRead(m, settings));
  shareImages(scene, used, read, use.trimmed);
  dropNeedlessAlpha(scene, used, read, use.trimmed);
  keepMaterials(used, read, use);
  keepImages(scene.images.size(), use);
  keepLights(scene, use);
  keepVertices(scene, use);
  use.narrowCorners = use.vertexCount <= kNarrowVertices;
  return use;
}

}  // namespace whittle
