// Scene → device structs → buffers. Layouts: kernels/shared/layout.h.
#include "wavefront/device_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

#include "kernels/shared/layout.h"
#include "scene/emitters.h"
#include "scene/free_array.h"
#include "scene/machine_memory.h"
#include "scene/material_predicates.h"

namespace whittle {
namespace {

static_assert(sizeof(device::Node) == sizeof(TreeNode));
static_assert(sizeof(device::DeviceTriangle) == 48);
static_assert(sizeof(device::DeviceLight) == 64);
static_assert(sizeof(device::DeviceTexture) == 52);
static_assert(sizeof(device::DeviceCamera) == 176);

/// Texture slots and texels of the images they use, shared where two slots are the same or read
/// the same image.
class TextureAtlas {
 public:
  TextureAtlas(const Scene& scene, const PrunedScene& pruned) : scene_(scene), pruned_(pruned) {}

  /// Index of the slot on the device, -1 for an empty one.
  int add(const TextureSlot& slot, bool isLinear) {
    if (!slot.used()) return -1;
    const Image& image = imageOf(slot.image);
    const bool isDeep = readsDeepTexels(image, isLinear);
    device::DeviceTexture t{};
    std::copy(slot.transform.begin(), slot.transform.end(), t.transform);
    t.firstTexel = firstTexel(slot.image, isDeep);
    t.width = image.width;
    t.height = image.height;
    t.wrapS = static_cast<std::uint32_t>(slot.wrapS);
    t.wrapT = static_cast<std::uint32_t>(slot.wrapT);
    t.flags = (slot.filter == Filter::Nearest ? TEXTURE_NEAREST : 0U) | (isDeep ? TEXTURE_DEEP : 0U);
    t.uvSet = static_cast<std::uint32_t>(slot.uvSet);
    return indexOf(t);
  }

  /// The texels of all images as words, the first channel lowest; they go from the images to the device
  /// without another copy in between, an image after the other.
  Buffer upload(Compute& compute, Scene* consumed) const {
    static_assert(std::endian::native == std::endian::little);
    Buffer buffer = compute.allocate("texels", std::size_t{words_} * 4);
    for (auto next = first_.begin(); next != first_.end();) {
      const auto& [key, word] = *next;
      const Image& image = imageOf(key.first);
      const std::size_t at = std::size_t{word} * 4;
      key.second ? compute.write(buffer, at, std::as_bytes(std::span(image.deepTexels)))
                 : compute.write(buffer, at, std::as_bytes(std::span(image.texels)));
      const int index = key.first;
      ++next;
      const bool whole = next == first_.end() || next->first.first != index;
      if (!whole || !consumed) continue;
      Image& taken = consumed->images[pruned_.images[static_cast<std::size_t>(index)]];
      freeArray(taken.texels);
      freeArray(taken.deepTexels);
    }
    return buffer;
  }

  std::vector<device::DeviceTexture> slots;

 private:
  const Image& imageOf(int index) const {
    return scene_.images[pruned_.images[static_cast<std::size_t>(index)]];
  }

  int indexOf(const device::DeviceTexture& t) {
    const std::string bits(reinterpret_cast<const char*>(&t), sizeof(t));
    const auto [at, isNew] = known_.try_emplace(bits, static_cast<int>(slots.size()));
    if (!isNew && pruned_.sharesSlots) return at->second;
    slots.push_back(t);
    return static_cast<int>(slots.size()) - 1;
  }

  /// An image that colours and other values read is there in both forms.
  std::uint32_t firstTexel(int index, bool isDeep) {
    const auto [at, isNew] = first_.try_emplace({index, isDeep}, words_);
    const Image& image = imageOf(index);
    if (isNew)
      words_ += static_cast<std::uint32_t>(isDeep ? image.deepTexels.size() / 2 : image.texels.size() / 4);
    return at->second;
  }

  const Scene& scene_;
  const PrunedScene& pruned_;
  std::map<std::pair<int, bool>, std::uint32_t> first_;  ///< word, by image and whether it is deep
  std::uint32_t words_ = 0;                              ///< of all of them
  std::unordered_map<std::string, int> known_;           ///< slots by their bits
};

static_assert(static_cast<int>(Wrap::Repeat) == WRAP_REPEAT && static_cast<int>(Wrap::Clamp) == WRAP_CLAMP &&
              static_cast<int>(Wrap::Mirror) == WRAP_MIRROR);

void copy3(float* out, const glm::vec3& v) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

constexpr bool isLinear(int encoding) { return encoding == device::LINEAR; }

device::DeviceMaterial toDevice(const Material& m, TextureAtlas& atlas) {
  device::DeviceMaterial d{};
#define WHITTLE_VECTOR(name, size) \
  for (int k = 0; k < size; ++k) d.name[k] = m.name[k];
#define WHITTLE_SCALAR(name) d.name = m.name;
#define WHITTLE_INDEX(slot, FEATURE, encoding, factor, OTHERS) \
  d.slot = atlas.add(m.slot, isLinear(device::slot##Encoding));
  WHITTLE_MATERIAL_FACTORS(WHITTLE_VECTOR, WHITTLE_SCALAR)
  WHITTLE_TEXTURE_SLOTS(WHITTLE_INDEX)
#undef WHITTLE_VECTOR
#undef WHITTLE_SCALAR
#undef WHITTLE_INDEX
  if (!m.volume) copy3(d.sigma_a, glm::vec3(0.0F));
  d.flags = (m.unlit ? MATERIAL_UNLIT : 0U) | (m.volume ? MATERIAL_VOLUME : 0U) |
            (m.doubleSided ? MATERIAL_DOUBLE_SIDED : 0U) | (isMasked(m) ? MATERIAL_MASK : 0U) |
            (blends(m) ? MATERIAL_BLEND : 0U);
  return d;
}

std::uint32_t triangleFlags(const Material& m) {
  return (isMasked(m) ? TRIANGLE_MASKED : 0U) | (filters(m) ? TRIANGLE_FILTERS : 0U) |
         (blends(m) ? TRIANGLE_COATS : 0U) | (showsFrontOnly(m) ? TRIANGLE_ONE_SIDED : 0U);
}

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

/// Triangles in leaf order and, last, a degenerate one that nothing hits: what an absent child points to.
/// They are made some at a time: all of them would be more than the tree.
Buffer uploadTriangles(Compute& compute, const Scene& scene, const PrunedScene& pruned,
                       const std::vector<std::uint32_t>& order) {
  constexpr std::size_t kAtOnce = 1 << 16;
  const std::size_t all = order.size() + 1;
  Buffer buffer = compute.allocate("triangles", all * sizeof(device::DeviceTriangle));
  std::vector<device::DeviceTriangle> out(std::min(kAtOnce, all));
  for (std::size_t first = 0; first < all; first += out.size()) {
    out.assign(std::min(kAtOnce, all - first), device::DeviceTriangle{});
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (first + i == order.size()) {
        out[i].primitive = 0xffffffffU;
        continue;
      }
      const std::uint32_t triangle = order[first + i];
      const std::uint32_t material = pruned.materialOf[scene.triangles[triangle].material];
      const std::array<glm::vec3, 3> corners = hittableCorners(scene, triangle);
      for (std::size_t k = 0; k < 3; ++k) copy3(out[i].v[k], corners[k]);
      out[i].primitive = triangle;
      out[i].material = material;
      out[i].flags = triangleFlags(pruned.materials[material]);
    }
    compute.write(buffer, first * sizeof(device::DeviceTriangle), std::as_bytes(std::span(out)));
  }
  return buffer;
}

std::vector<TreeNode> withSentinels(const TriTree& tree) {
  std::vector<TreeNode> nodes = tree.nodes;
  const auto sentinel = ~static_cast<std::int32_t>(tree.order.size() << 4);
  for (auto& node : nodes)
    for (int c = 0; c < 2; ++c)
      if (!(node.lo[c][0] <= node.hi[c][0])) node.child[c] = sentinel;
  return nodes;
}

std::vector<float> srgbTable() {
  std::vector<float> table(256);
  for (int i = 0; i < 256; ++i) {
    const double s = i / 255.0;
    table[static_cast<std::size_t>(i)] =
        static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
  return table;
}

/// emittersOf with the places of their triangles in leaf order.
std::vector<device::DeviceEmitter> emittersToDevice(const Scene& scene,
                                                    const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> leafOf(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) leafOf[order[i]] = i;
  std::vector<device::DeviceEmitter> out;
  for (const Emitter& e : emittersOf(scene)) out.push_back({leafOf[e.triangle], e.until, e.inverseDensity});
  return out;
}

std::vector<device::DeviceLight> lightsToDevice(const Scene& scene, const PrunedScene& pruned,
                                                std::size_t emitters) {
  std::vector<device::DeviceLight> out;
  const auto versine = [](double angle) {
    const double s = std::sin(0.5 * angle);
    return static_cast<float>(2.0 * s * s);
  };
  for (const std::uint32_t i : pruned.lights) {
    const Light& l = scene.lights[i];
    device::DeviceLight d{};
    copy3(d.intensity, l.intensity);
    copy3(d.position, l.position);
    copy3(d.direction, l.direction);
    d.kind = static_cast<std::uint32_t>(l.kind);
    d.range = l.range;
    d.castsShadows = l.castsShadows;
    d.versineOuter = versine(l.outerConeAngle);
    d.versineInner = versine(l.innerConeAngle);
    d.index = i;
    d.emitters = static_cast<std::uint32_t>(emitters);
    out.push_back(d);
  }
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

/// Two in a word, the first in its low half.
std::vector<std::uint32_t> packedCorners(const std::vector<std::uint32_t>& corners) {
  std::vector<std::uint32_t> words((corners.size() + 1) / 2);
  for (std::size_t i = 0; i < corners.size(); ++i) words[i / 2] |= corners[i] << (i % 2 * 16);
  return words;
}

/// Vertices of every triangle in leaf order, and of the degenerate one; some at a time.
Buffer uploadCorners(Compute& compute, const Scene& scene, const PrunedScene& pruned,
                     const std::vector<std::uint32_t>& order) {
  constexpr std::size_t kAtOnce = 1 << 16;  // even, so that two corners in a word are of one part
  const std::size_t all = 3 * order.size() + 3, words = pruned.narrowCorners ? (all + 1) / 2 : all;
  Buffer buffer = compute.allocate("corners", words * sizeof(std::uint32_t));
  std::vector<std::uint32_t> part;
  std::size_t word = 0;
  const auto write = [&] {
    if (pruned.narrowCorners) part = packedCorners(part);
    compute.write(buffer, word * sizeof(std::uint32_t), std::as_bytes(std::span(part)));
    word += part.size();
    part.clear();
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Triangle& t = scene.triangles[order[i]];
    for (const std::uint32_t v : {t.v0, t.v1, t.v2})
      part.push_back(pruned.vertexOf.empty() ? v : pruned.vertexOf[v]);
    if ((i + 1) % kAtOnce == 0) write();
  }
  part.resize(part.size() + 3);
  write();
  return buffer;
}

std::string groupOf(const std::string& name) {
  if (name == "nodes" || name == "bvh8Nodes" || name == "leaves") return "tree";
  if (name == "textures" || name == "texels" || name == "linearFromSrgb" || name == "background")
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
                        const SceneFeatures& sceneFeatures, Scene* consumed) {
  const auto features = SceneFeatures::ofBits(sceneFeatures.bits() & kSceneBufferFeatures);
  DeviceScene d;
  d.triangleCount = static_cast<std::uint32_t>(tree.order.size());
  if (features.has(Feature::TREE) && !features.has(Feature::PACKETS))
    d.nodes = compute.upload("nodes", withSentinels(tree));
  if (features.has(Feature::TREE) && features.has(Feature::PACKETS)) {
    const Bvh8 wide = buildBvh8(tree);
    freeArray(tree.nodes);
    returnFreedMemory();  // of the parts that the wide tree was put together from
    if (wide.depth > BVH8_DEPTH)
      throw ClError(fmt::format("the eight-wide tree is {} nodes deep, the kernels have room for {}",
                                wide.depth, BVH8_DEPTH));
    d.bvh8Nodes = compute.upload("bvh8Nodes", wide.nodes);
    d.leaves = compute.allocate("leaves", leafFloats(tree) * sizeof(float));
    eachLeafPart(
        wide, tree, [&](std::uint32_t t) { return hittableCorners(scene, t); },
        [&](std::size_t first, std::span<const float> part) {
          compute.write(d.leaves, first * sizeof(float), std::as_bytes(part));
        });
  }
  d.triangles = uploadTriangles(compute, scene, pruned, tree.order);
  const bool interpolates = features.has(Feature::VERTEX_NORMALS) || features.has(Feature::TEXTURES) ||
                            features.has(Feature::VERTEX_COLORS);
  if (interpolates) {
    Buffer corners = uploadCorners(compute, scene, pruned, tree.order);
    (pruned.narrowCorners ? d.corners : d.indices32) = std::move(corners);
  }
  if (features.has(Feature::VERTEX_NORMALS))
    d.normals = uploadVertices(compute, "normals", scene.normals, pruned);
  if (consumed) freeArray(consumed->normals);
  if (features.has(Feature::NORMAL_TEXTURE))
    d.tangents = uploadVertices(compute, "tangents", scene.tangents, pruned);
  if (consumed) freeArray(consumed->tangents);
  if (features.has(Feature::UV0)) d.uv0 = uploadVertices(compute, "uv0", scene.uv0, pruned);
  if (consumed) freeArray(consumed->uv0);
  if (features.has(Feature::UV1)) d.uv1 = uploadVertices(compute, "uv1", scene.uv1, pruned);
  if (consumed) freeArray(consumed->uv1);
  if (features.has(Feature::VERTEX_COLORS))
    d.colors = scene.colors.empty() ? Buffer{} : uploadVertices(compute, "colors", scene.colors, pruned);
  TextureAtlas atlas(scene, pruned);
  std::vector<device::DeviceMaterial> materials;
  for (const auto& m : pruned.materials) materials.push_back(toDevice(m, atlas));
  if (materials.empty()) materials.push_back(toDevice(Material{}, atlas));
  d.materials = compute.upload("materials", materials);
  if (features.has(Feature::TEXTURES)) {
    d.textures = compute.upload("textures", atlas.slots);
    d.texels = atlas.upload(compute, consumed);
    d.linearFromSrgb = compute.upload("linearFromSrgb", srgbTable());
  }
  std::vector<device::DeviceEmitter> emitters;
  if (features.has(Feature::SURFACE_LIGHTS)) emitters = emittersToDevice(scene, tree.order);
  if (!emitters.empty()) d.emitters = compute.upload("emitters", emitters);
  const auto lights = lightsToDevice(scene, pruned, emitters.size());
  d.lightCount = static_cast<std::uint32_t>(lights.size());
  d.lights = compute.upload("lights", lights);
  if (features.has(Feature::BACKGROUND_MAP))
    d.backgroundMap = compute.upload("background", scene.background.map);
  return d;
}

}  // namespace whittle
