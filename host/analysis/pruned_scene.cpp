// From the triangles to their materials, from those to the images and vertices they read.
#include "analysis/pruned_scene.h"

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

#include "analysis/light_reach.h"
#include "analysis/material_use.h"
#include "scene/material_predicates.h"
#include "scene/sky_light.h"

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

/// Bounds of the alpha of the vertices of each material's triangles; a least of -infinity where one
/// is not finite.
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
void dropNeedlessAlpha(const Scene& scene, const Flags& used, std::vector<Material>& read, TexelFacts& texels,
                       PruningReport& pruning) {
  std::vector<AlphaBounds> colours;
  for (std::size_t i = 0; i < read.size(); ++i) {
    Material& m = read[i];
    AlphaSource source;
    const auto needless = [&] { return maskIsNeedless(m, source) || blendIsNeedless(m, source); };
    if (!used[i] || !needless()) continue;  // not even by its factor
    if (m.baseColorTexture.used()) {
      const auto image = static_cast<std::size_t>(m.baseColorTexture.image);
      source.leastTexel = leastAlpha(scene.images, image, texels);
    }
    if (!needless()) continue;
    source.coloured = !scene.colors.empty();
    if (source.coloured && isMasked(m)) {
      if (colours.empty()) colours = vertexAlphas(scene);
      source.colours = colours[i];
    }
    if (!needless()) continue;
    ++(isMasked(m) ? pruning.needlessMasks : pruning.needlessBlends);
    m.alphaMode = AlphaMode::Opaque;
    m.alphaCutoff = Material{}.alphaCutoff;
  }
}

/// Slots of alike images name one of them.
void shareImages(const Scene& scene, const Flags& used, std::vector<Material>& read, TexelFacts& texels,
                 PruningReport& pruning) {
  Flags wanted(scene.images.size());
  for (std::size_t i = 0; i < read.size(); ++i)
    for (const auto slot : kTextureSlots)
      if (used[i] && (read[i].*slot).used()) wanted[static_cast<std::size_t>((read[i].*slot).image)] = 1;
  const auto first = firstAlike(scene.images, wanted, texels);
  for (Material& m : read)
    for (const auto slot : kTextureSlots)
      if (int& image = (m.*slot).image; image >= 0)
        image = static_cast<int>(first[static_cast<std::size_t>(image)]);
  pruning.images.all = scene.images.size();
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    pruning.images.unused += !wanted[i];
    pruning.images.alike += first[i] != i;
  }
}

/// One of each kind of material that triangles have.
void keepMaterials(const Flags& used, const std::vector<Material>& read, PrunedScene& pruned) {
  std::unordered_map<std::string, std::uint32_t> known;
  pruned.materialOf.assign(read.size(), kNotUsed);
  pruned.pruning.materials.all = read.size();
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (!used[i]) {
      ++pruned.pruning.materials.unused;
      continue;
    }
    const auto [at, isNew] =
        known.try_emplace(bitsOf(read[i]), static_cast<std::uint32_t>(pruned.materials.size()));
    if (isNew) pruned.materials.push_back(read[i]);
    pruned.pruning.materials.alike += !isNew;
    pruned.materialOf[i] = at->second;
  }
}

/// The images that kept materials read, and their slots' numbers of them.
void keepImages(std::size_t imageCount, PrunedScene& pruned) {
  std::vector<std::uint32_t> imageOf(imageCount, kNotUsed);
  for (Material& m : pruned.materials)
    for (const auto slot : kTextureSlots) {
      int& image = (m.*slot).image;
      if (image < 0) continue;
      std::uint32_t& at = imageOf[static_cast<std::size_t>(image)];
      if (at == kNotUsed) {
        at = static_cast<std::uint32_t>(pruned.images.size());
        pruned.images.push_back(static_cast<std::uint32_t>(image));
      }
      image = static_cast<int>(at);
    }
}

/// Only lights that end somewhere ask where the triangles are; to the others they are anywhere.
LitBounds boundsForLights(const Scene& scene, const Flags& lit) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  const bool asked = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& l) {
    return typeOf(l.kind).hasCone || (typeOf(l.kind).isPlaced && l.range < inf);
  });
  if (asked) return litBounds(scene, lit);
  LitBounds bounds;
  if (std::find(lit.begin(), lit.end(), 1) != lit.end()) bounds = {glm::vec3(-inf), glm::vec3(inf)};
  return bounds;
}

void keepLights(const Scene& scene, PrunedScene& pruned) {
  pruned.pruning.lights = scene.lights.size();
  if (scene.lights.empty()) return;
  Flags lit(scene.materials.size());
  for (std::size_t i = 0; i < lit.size(); ++i)
    lit[i] = pruned.materialOf[i] != kNotUsed && isLit(pruned.materials[pruned.materialOf[i]]);
  const LitBounds bounds = boundsForLights(scene, lit);
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const bool isDarkSky = scene.lights[i].kind == LightKind::Sky && isBlack(scene.background);
    const std::string reason = isDarkSky ? "the background is black" : whyDark(scene.lights[i], bounds);
    if (reason.empty())
      pruned.lights.push_back(i);
    else
      pruned.pruning.droppedLights.push_back({i, scene.lights[i].name, reason});
  }
}

void lightBothSides(PrunedScene& pruned) {
  if (std::none_of(pruned.materials.begin(), pruned.materials.end(), transmitsDiffusely)) return;
  std::vector<std::uint32_t> twice;
  for (const std::uint32_t light : pruned.lights) twice.insert(twice.end(), 2, light);
  pruned.lights = std::move(twice);
}

/// Leaves out the vertices that no triangle has, if there are any and vertices carry anything at all.
void keepVertices(const Scene& scene, PrunedScene& pruned) {
  const std::size_t count = scene.positions.size();
  pruned.pruning.vertices.all = pruned.vertexCount = count;
  if (scene.normals.empty() && scene.colors.empty() && pruned.images.empty()) return;
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
  pruned.pruning.vertices.unused = unused;
  pruned.vertexCount = count - unused;
  pruned.vertexOf.resize(count);
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < count; ++v) pruned.vertexOf[v] = used[v] ? next++ : kNotUsed;
}

}  // namespace

PrunedScene unprunedScene(const Scene& scene) {
  PrunedScene pruned;
  pruned.materials = scene.materials;
  pruned.materialOf = identity(scene.materials.size());
  pruned.images = identity(scene.images.size());
  pruned.lights = identity(scene.lights.size());
  lightBothSides(pruned);
  pruned.vertexCount = scene.positions.size();
  pruned.pruning.materials.all = scene.materials.size();
  pruned.pruning.images.all = scene.images.size();
  pruned.pruning.vertices.all = scene.positions.size();
  pruned.pruning.lights = scene.lights.size();
  return pruned;
}

PrunedScene pruneScene(const Scene& scene, const Settings& settings, TexelFacts* texels) {
  if (settings.keepAllFeatures) {
    PrunedScene whole = unprunedScene(scene);
    if (settings.textureFilter == TextureFilter::None)
      for (Material& m : whole.materials) dropLevels(m);
    return whole;
  }
  PrunedScene pruned;
  pruned.sharesSlots = true;
  const Flags used = usedMaterials(scene);
  std::vector<Material> read;
  read.reserve(scene.materials.size());
  for (const Material& m : scene.materials) read.push_back(asRead(m, settings));
  TexelFacts own;
  TexelFacts& known = texels ? *texels : own;
  shareImages(scene, used, read, known, pruned.pruning);
  dropNeedlessAlpha(scene, used, read, known, pruned.pruning);
  keepMaterials(used, read, pruned);
  keepImages(scene.images.size(), pruned);
  keepLights(scene, pruned);
  lightBothSides(pruned);
  keepVertices(scene, pruned);
  pruned.narrowCorners = pruned.vertexCount <= kNarrowVertices;
  return pruned;
}

}  // namespace whittle
