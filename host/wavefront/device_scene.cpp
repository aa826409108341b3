// Scene → device structs → buffers. Layouts: kernels/shared/layout.h.
#include "wavefront/device_scene.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "image/srgb.h"
#include "kernels/shared/layout.h"
#include "scene/free_array.h"
#include "scene/machine_memory.h"
#include "scene/sky_light.h"

namespace whittle {
namespace {

static_assert(sizeof(device::Node) == sizeof(TreeNode));
static_assert(sizeof(device::DeviceTriangle) == 12);
static_assert(sizeof(device::DeviceCamera) == 176);

/// False for corners on one line, by the differences that the kernels see; products of two floats are exact
/// in double.
bool hasArea(const glm::vec3& p0, const glm::vec3& p1, const glm::vec3& p2) {
  const glm::dvec3 a(p1 - p0), b(p2 - p0);
  return a.y * b.z != a.z * b.y || a.z * b.x != a.x * b.z || a.x * b.y != a.y * b.x;
}

/// Rounding could open a triangle without area in the plane across a ray: as a point nothing hits it.
std::array<glm::vec3, 3> hittableCorners(const Scene& scene, std::uint32_t triangle) {
  const Triangle& t = scene.triangles[triangle];
  const glm::vec3 &p0 = scene.positions[t.v0], &p1 = scene.positions[t.v1], &p2 = scene.positions[t.v2];
  return hasArea(p0, p1, p2) ? std::array{p0, p1, p2} : std::array{p0, p0, p0};
}

constexpr std::size_t kTrianglesAtOnce = 1 << 16;

template <class Work>
void inParallel(std::size_t count, const Work& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1 << 12), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) work(i);
  });
}

/// Its place in its leaf stays.
void setSurface(device::DeviceTriangle& triangle, const SurfaceKind& surface) {
  triangle.material = surface.material;
  triangle.flags = surface.flags | (triangle.flags & TRIANGLE_PLACE_BITS);
}

/// Triangles in leaf order and, last, a degenerate one that nothing hits: what an absent child points to.
/// `places`: see leafPlaces; empty without PACKETS.
Buffer uploadTriangles(Compute& compute, const Scene& scene, const std::vector<SurfaceKind>& surfaces,
                       const std::vector<std::uint32_t>& order, const std::vector<std::uint8_t>& places) {
  const std::size_t all = order.size() + 1;
  Buffer buffer = compute.allocate("triangles", all * sizeof(device::DeviceTriangle));
  const auto make = [&](std::size_t at) {
    if (at == order.size()) return device::DeviceTriangle{0xffffffffU, 0, 0};
    device::DeviceTriangle out{order[at], places.empty() ? 0U : std::uint32_t{places[at]} << TRIANGLE_PLACE,
                               0};
    setSurface(out, surfaces[scene.triangles[out.primitive].material]);
    return out;
  };
  compute.writeItems<device::DeviceTriangle>(
      buffer, all, [&](std::size_t first, std::span<device::DeviceTriangle> items) {
        inParallel(items.size(), [&](std::size_t i) { items[i] = make(first + i); });
      });
  return buffer;
}

/// Corners leaf by leaf.
Buffer uploadLeaves(Compute& compute, const Scene& scene, const Bvh8& wide, const TriTree& tree) {
  Buffer buffer = compute.allocate("leaves", leafFloats(tree) * sizeof(float));
  const CornersOf corners = [&](std::uint32_t t) { return hittableCorners(scene, t); };
  if (buffer.shared)
    makeLeaves(wide, tree, corners, {reinterpret_cast<float*>(buffer.shared), leafFloats(tree)});
  else
    eachLeafPart(wide, tree, corners, [&](std::size_t first, std::span<const float> part) {
      compute.write(buffer, first * sizeof(float), std::as_bytes(part));
    });
  return buffer;
}

/// Corners triangle after triangle and, last, of the degenerate one.
Buffer uploadLeaves(Compute& compute, const Scene& scene, const TriTree& tree) {
  using Corners = std::array<glm::vec3, 3>;
  static_assert(sizeof(Corners) == 9 * sizeof(float));
  Buffer buffer = compute.allocate("leaves", leafFloats(tree) * sizeof(float));
  compute.writeItems<Corners>(
      buffer, tree.order.size() + 1, [&](std::size_t first, std::span<Corners> items) {
        inParallel(items.size(), [&](std::size_t i) {
          const std::size_t at = first + i;
          items[i] = at < tree.order.size() ? hittableCorners(scene, tree.order[at]) : Corners{};
        });
      });
  return buffer;
}

/// The same triangles with other surfaces: read back, changed and written, some at a time.
void changeSurfaces(Compute& compute, const Scene& scene, const std::vector<SurfaceKind>& surfaces,
                    const Buffer& triangles) {
  const std::size_t all = triangles.bytes / sizeof(device::DeviceTriangle) - 1;  // but for the degenerate one
  std::vector<device::DeviceTriangle> part(std::min(kTrianglesAtOnce, all));
  for (std::size_t first = 0; first < all; first += part.size()) {
    part.resize(std::min(kTrianglesAtOnce, all - first));
    const std::size_t at = first * sizeof(device::DeviceTriangle);
    compute.read(triangles, at, part.size() * sizeof(device::DeviceTriangle), part.data());
    for (device::DeviceTriangle& t : part) setSurface(t, surfaces[scene.triangles[t.primitive].material]);
    compute.write(triangles, at, std::as_bytes(std::span(part)));
  }
}

UninitializedVector<TreeNode> withSentinels(const TriTree& tree) {
  UninitializedVector<TreeNode> nodes = tree.nodes;
  const auto sentinel = ~static_cast<std::int32_t>(tree.order.size() << 4);
  for (auto& node : nodes)
    for (int c = 0; c < 2; ++c)
      if (!(node.lo[c][0] <= node.hi[c][0])) node.child[c] = sentinel;
  return nodes;
}

std::vector<float> srgbTable() {
  std::vector<float> table(256);
  for (int i = 0; i < 256; ++i)
    table[static_cast<std::size_t>(i)] = static_cast<float>(srgbDecode(i / 255.0));
  return table;
}

/// With the places of their triangles in leaf order.
std::vector<device::DeviceEmitter> emittersToDevice(const std::vector<Emitter>& emitters,
                                                    const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> leafOf(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) leafOf[order[i]] = i;
  std::vector<device::DeviceEmitter> out;
  out.reserve(emitters.size());
  for (const Emitter& e : emitters)
    out.push_back({leafOf[e.triangle], e.until, e.inverseDensity, e.twoSided ? 1U : 0U});
  return out;
}

/// An attribute of the vertices that are used, in their order on the device. One that is kept though the
/// scene has none is 0 everywhere, which is as good as none: a renderer that leaves nothing out has one form
/// of vertex.
template <typename T>
Buffer uploadVertices(Compute& compute, const std::string& name, const std::vector<T>& all,
                      const PrunedScene& pruned) {
  if (all.empty()) return compute.upload(name, std::vector<T>(pruned.vertexCount, T(0)));
  if (pruned.vertexOf.empty()) return compute.upload(name, all);
  std::vector<T> used(pruned.vertexCount);
  for (std::size_t v = 0; v < all.size(); ++v)
    if (pruned.vertexOf[v] != kNotUsed) used[pruned.vertexOf[v]] = all[v];
  return compute.upload(name, used);
}

/// Vertices of every triangle in leaf order, and of the degenerate one; narrow ones two in a word, the first
/// in its low half.
Buffer uploadCorners(Compute& compute, const Scene& scene, const PrunedScene& pruned,
                     const std::vector<std::uint32_t>& order) {
  const std::size_t all = 3 * order.size() + 3, words = pruned.narrowCorners ? (all + 1) / 2 : all;
  Buffer buffer = compute.allocate("corners", words * sizeof(std::uint32_t));
  const auto corner = [&](std::size_t at) {
    if (at / 3 >= order.size()) return std::uint32_t{0};
    const Triangle& t = scene.triangles[order[at / 3]];
    const std::uint32_t v = at % 3 == 0 ? t.v0 : at % 3 == 1 ? t.v1 : t.v2;
    return pruned.vertexOf.empty() ? v : pruned.vertexOf[v];
  };
  compute.writeItems<std::uint32_t>(buffer, words, [&](std::size_t first, std::span<std::uint32_t> items) {
    inParallel(items.size(), [&](std::size_t i) {
      const std::size_t word = first + i;
      items[i] = pruned.narrowCorners ? corner(2 * word) | corner(2 * word + 1) << 16U : corner(word);
    });
  });
  return buffer;
}

std::string groupOf(const std::string& name) {
  if (name == "nodes" || name == "bvh8Nodes") return "tree";
  if (name == "textures" || name == "texels" || name == "linearFromSrgb" || name == "background" ||
      name == "sky")
    return "textures";
  return "triangles";
}

}  // namespace

std::vector<const Buffer*> DeviceScene::buffers() const {
  std::vector<const Buffer*> all;
  const auto add = [&](const auto& argument) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(argument)>, Buffer>) all.push_back(&argument);
  };
  std::apply([&](const auto&... argument) { (add(argument), ...); }, arguments());
  return all;
}

void DeviceScene::report(std::vector<BufferStats>& out) const {
  for (const Buffer* b : buffers())
    if (*b) out.push_back({b->name, groupOf(b->name), b->bytes});
}

DeviceScene uploadScene(Compute& compute, const Scene& scene, const PrunedScene& pruned, TriTree tree,
                        const SceneFeatures& sceneFeatures, Scene* consumed, DeviceScene stays) {
  const auto features = SceneFeatures::ofBits(sceneFeatures.bits() & kSceneBufferFeatures);
  DeviceScene d;
  d.triangleCount = static_cast<std::uint32_t>(tree.order.size());
  std::vector<std::uint8_t> places;
  const bool hasTree = features.has(Feature::TREE);
  if (features.has(Feature::PACKETS)) {
    const Bvh8 wide = hasTree ? buildBvh8(tree) : buildLeaves(tree);
    freeArray(tree.nodes);
    returnFreedMemory();  // of the parts that the wide tree was put together from
    if (wide.depth > BVH8_DEPTH)
      throw ClError(fmt::format("the eight-wide tree is {} nodes deep, the kernels have room for {}",
                                wide.depth, BVH8_DEPTH));
    if (hasTree) d.bvh8Nodes = compute.upload("bvh8Nodes", wide.nodes);
    d.leaves = uploadLeaves(compute, scene, wide, tree);
    places = leafPlaces(wide, tree);
  } else {
    if (hasTree) d.nodes = compute.upload("nodes", withSentinels(tree));
    d.leaves = uploadLeaves(compute, scene, tree);
  }
  d.tables = tablesOf(scene, pruned);
  d.triangles = uploadTriangles(compute, scene, d.tables.surfaces, tree.order, places);
  freeArray(places);
  const bool interpolates = features.has(Feature::VERTEX_NORMALS) || features.has(Feature::TEXTURES) ||
                            features.has(Feature::VERTEX_COLORS);
  if (interpolates) {
    Buffer corners = uploadCorners(compute, scene, pruned, tree.order);
    (pruned.narrowCorners ? d.corners : d.indices32) = std::move(corners);
  }
  if (features.has(Feature::VERTEX_NORMALS))
    d.normals = uploadVertices(compute, "normals", scene.normals, pruned);
  if (consumed) freeArray(consumed->normals);
  const bool laysLayers = features.has(Feature::CLEARCOAT) || features.has(Feature::ANISOTROPY);
  if (features.has(Feature::NORMAL_TEXTURE) || (laysLayers && !scene.tangents.empty()))
    d.tangents = uploadVertices(compute, "tangents", scene.tangents, pruned);
  if (consumed) freeArray(consumed->tangents);
  if (features.has(Feature::UV0)) d.uv0 = uploadVertices(compute, "uv0", scene.uv0, pruned);
  if (consumed) freeArray(consumed->uv0);
  if (features.has(Feature::UV1)) d.uv1 = uploadVertices(compute, "uv1", scene.uv1, pruned);
  if (consumed) freeArray(consumed->uv1);
  if (features.has(Feature::VERTEX_COLORS))
    d.colors = scene.colors.empty() ? Buffer{} : uploadVertices(compute, "colors", scene.colors, pruned);
  d.materials = compute.upload("materials", d.tables.materials);
  if (features.has(Feature::TEXTURES)) {
    d.textures = compute.upload("textures", d.tables.textures);
    d.texels =
        stays.texels ? std::move(stays.texels) : uploadTexels(compute, scene, d.tables.texels, consumed);
    d.linearFromSrgb = compute.upload("linearFromSrgb", srgbTable());
  }
  if (!d.tables.emitters.empty())
    d.emitters = compute.upload("emitters", emittersToDevice(d.tables.emitters, tree.order));
  d.lights = compute.upload("lights", d.tables.lights);
  if (features.has(Feature::BACKGROUND_MAP))
    d.backgroundMap = stays.backgroundMap ? std::move(stays.backgroundMap)
                                          : compute.upload("background", scene.background.map);
  if (features.has(Feature::BACKGROUND_MAP) && features.has(Feature::SKY_LIGHTS))
    d.sky = stays.sky ? std::move(stays.sky) : compute.upload("sky", skyTableOf(scene.background).until);
  return d;
}

std::array<glm::vec3, 3> readCorners(Compute& compute, const DeviceScene& scene, std::uint32_t index,
                                     const device::DeviceTriangle& triangle) {
  const std::uint32_t place = triangle.flags >> TRIANGLE_PLACE, lane = place & 7U,
                      stride = (place >> 3U & 7U) + 1;
  std::vector<float> leaf(std::size_t{9} * stride);
  compute.read(scene.leaves, std::size_t{9} * (index - lane) * sizeof(float), leaf.size() * sizeof(float),
               leaf.data());
  std::array<glm::vec3, 3> corners;
  for (std::uint32_t k = 0; k < 3; ++k)
    for (std::uint32_t a = 0; a < 3; ++a) corners[k][static_cast<int>(a)] = leaf[(3 * k + a) * stride + lane];
  return corners;
}

DeviceScene imagesOf(DeviceScene&& scene) {
  DeviceScene images;
  images.texels = std::move(scene.texels);
  images.backgroundMap = std::move(scene.backgroundMap);
  images.sky = std::move(scene.sky);
  return images;
}

TableChanges takeOver(Compute& compute, const Scene& scene, DeviceTables tables, DeviceScene& d) {
  assert(tables.texels == d.tables.texels);
  const auto take = [&](const char* name, auto DeviceTables::*table, Buffer DeviceScene::*buffer) {
    if (haveSameBits(tables.*table, d.tables.*table)) return false;
    d.*buffer = compute.upload(name, tables.*table);
    d.tables.*table = std::move(tables.*table);
    return true;
  };
  TableChanges changes;
  changes.lights = take("lights", &DeviceTables::lights, &DeviceScene::lights);
  changes.materials = take("materials", &DeviceTables::materials, &DeviceScene::materials);
  changes.textures = take("textures", &DeviceTables::textures, &DeviceScene::textures);
  changes.triangles = tables.surfaces != d.tables.surfaces;
  if (changes.triangles) {
    changeSurfaces(compute, scene, tables.surfaces, d.triangles);
    d.tables.surfaces = std::move(tables.surfaces);
  }
  return changes;
}

}  // namespace whittle
