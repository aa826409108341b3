// Scene → device structs → buffers. Layouts: kernels/shared/layout.h.
#include "render/device_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "kernels/shared/layout.h"

namespace whittle {
namespace {

static_assert(sizeof(device::Node) == sizeof(TreeNode));
static_assert(sizeof(device::DeviceTriangle) == 48);
static_assert(sizeof(device::DeviceLight) == 64);
static_assert(sizeof(device::DeviceTexture) == 52);
static_assert(sizeof(device::DeviceMaterial) == 112);
static_assert(sizeof(device::DeviceCamera) == 128);

/// Texture slots and texels of the images they use, shared where two slots read the same image.
class TextureAtlas {
 public:
  explicit TextureAtlas(const Scene& scene) : scene_(scene) {}

  /// Index of the slot on the device, -1 for an empty one.
  int add(const TextureSlot& slot) {
    if (!slot.used()) return -1;
    const Image& image = scene_.images[static_cast<std::size_t>(slot.image)];
    device::DeviceTexture t{};
    std::copy(slot.transform.begin(), slot.transform.end(), t.transform);
    t.firstTexel = firstTexel(slot.image);
    t.width = image.width;
    t.height = image.height;
    t.wrapS = static_cast<std::uint32_t>(slot.wrapS);
    t.wrapT = static_cast<std::uint32_t>(slot.wrapT);
    t.nearest = slot.filter == Filter::Nearest;
    t.uvSet = static_cast<std::uint32_t>(slot.uvSet);
    slots.push_back(t);
    return static_cast<int>(slots.size()) - 1;
  }

  std::vector<device::DeviceTexture> slots;
  std::vector<std::uint32_t> texels;

 private:
  std::uint32_t firstTexel(int index) {
    const auto [at, isNew] = first_.try_emplace(index, static_cast<std::uint32_t>(texels.size()));
    if (isNew) {
      const auto& bytes = scene_.images[static_cast<std::size_t>(index)].texels;
      const std::size_t begin = texels.size();
      texels.resize(begin + bytes.size() / 4);
      std::memcpy(texels.data() + begin, bytes.data(), bytes.size() / 4 * 4);
    }
    return at->second;
  }

  const Scene& scene_;
  std::map<int, std::uint32_t> first_;
};

static_assert(static_cast<int>(Wrap::Repeat) == WRAP_REPEAT && static_cast<int>(Wrap::Clamp) == WRAP_CLAMP &&
              static_cast<int>(Wrap::Mirror) == WRAP_MIRROR);
static_assert(static_cast<int>(LightKind::Point) == LIGHT_POINT &&
              static_cast<int>(LightKind::Directional) == LIGHT_DIRECTIONAL &&
              static_cast<int>(LightKind::Spot) == LIGHT_SPOT);

void copy3(float* out, const glm::vec3& v) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

device::DeviceMaterial toDevice(const Material& m, TextureAtlas& atlas) {
  device::DeviceMaterial d{};
  for (int k = 0; k < 4; ++k) d.baseColor[k] = m.baseColor[k];
  copy3(d.emission, m.emission);
  copy3(d.sigma_a, m.volume ? m.sigma_a : glm::vec3(0.0F));
  copy3(d.specularColor, m.specularColor);
  d.metallic = m.metallic;
  d.roughness = m.roughness;
  d.specular = m.specular;
  d.transmission = m.transmission;
  d.ior = m.ior;
  d.alphaCutoff = m.alphaCutoff;
  d.normalScale = m.normalScale;
  d.flags = (m.unlit ? MATERIAL_UNLIT : 0U) | (m.volume ? MATERIAL_VOLUME : 0U) |
            (m.doubleSided ? MATERIAL_DOUBLE_SIDED : 0U) |
            (m.alphaMode == AlphaMode::Mask ? MATERIAL_MASK : 0U) |
            (m.alphaMode == AlphaMode::Blend ? MATERIAL_BLEND : 0U);
  d.baseColorTexture = atlas.add(m.baseColorTexture);
  d.metallicRoughnessTexture = atlas.add(m.metallicRoughnessTexture);
  d.normalTexture = atlas.add(m.normalTexture);
  d.emissionTexture = atlas.add(m.emissionTexture);
  d.specularTexture = atlas.add(m.specularTexture);
  d.specularColorTexture = atlas.add(m.specularColorTexture);
  d.transmissionTexture = atlas.add(m.transmissionTexture);
  return d;
}

std::uint32_t triangleFlags(const Material& m) {
  const bool filters = m.alphaMode == AlphaMode::Blend || (!m.unlit && m.transmission > 0.0F);
  return (m.alphaMode == AlphaMode::Mask ? TRIANGLE_MASKED : 0U) | (filters ? TRIANGLE_FILTERS : 0U);
}

/// False for corners on one line, by the differences that the kernels see; products of two floats are exact
/// in double.
bool hasArea(const glm::vec3& p0, const glm::vec3& p1, const glm::vec3& p2) {
  const glm::dvec3 a(p1 - p0), b(p2 - p0);
  return a.y * b.z != a.z * b.y || a.z * b.x != a.x * b.z || a.x * b.y != a.y * b.x;
}

/// Corners of every triangle. Rounding could open a triangle without area in the plane across a ray: as a
/// point nothing hits it.
std::vector<glm::uvec3> hittableCorners(const Scene& scene) {
  std::vector<glm::uvec3> corners;
  corners.reserve(scene.triangles.size());
  for (const Triangle& t : scene.triangles)
    corners.push_back(hasArea(scene.positions[t.v0], scene.positions[t.v1], scene.positions[t.v2])
                          ? glm::uvec3(t.v0, t.v1, t.v2)
                          : glm::uvec3(t.v0));
  return corners;
}

/// Triangles in leaf order and, last, a degenerate one that nothing hits: what an absent child points to.
std::vector<device::DeviceTriangle> leafTriangles(const Scene& scene, const std::vector<glm::uvec3>& corners,
                                                  const std::vector<std::uint32_t>& order) {
  std::vector<device::DeviceTriangle> out(order.size() + 1);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t material = scene.triangles[order[i]].material;
    for (int k = 0; k < 3; ++k) copy3(out[i].v[k], scene.positions[corners[order[i]][k]]);
    out[i].primitive = order[i];
    out[i].material = material;
    out[i].flags = triangleFlags(scene.materials[material]);
  }
  out.back().primitive = 0xffffffffU;
  return out;
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

std::vector<device::DeviceLight> lightsToDevice(const Scene& scene) {
  std::vector<device::DeviceLight> out;
  const auto versine = [](double angle) {
    const double s = std::sin(0.5 * angle);
    return static_cast<float>(2.0 * s * s);
  };
  for (const Light& l : scene.lights) {
    device::DeviceLight d{};
    copy3(d.intensity, l.intensity);
    copy3(d.position, l.position);
    copy3(d.direction, l.direction);
    d.kind = static_cast<std::uint32_t>(l.kind);
    d.range = l.range;
    d.castsShadows = l.castsShadows;
    d.versineOuter = versine(l.outerConeAngle);
    d.versineInner = versine(l.innerConeAngle);
    out.push_back(d);
  }
  return out;
}

std::string groupOf(const std::string& name) {
  if (name == "nodes" || name == "wideNodes" || name == "leaves") return "tree";
  if (name == "textures" || name == "texels" || name == "linearFromSrgb" || name == "background")
    return "textures";
  return "triangles";
}

}  // namespace

void DeviceScene::report(std::vector<BufferStats>& out) const {
  for (const Buffer* b : buffers())
    if (*b) out.push_back({b->name, groupOf(b->name), b->bytes});
}

DeviceScene uploadScene(Compute& compute, const Scene& scene, const TriTree& tree,
                        const SceneFeatures& features) {
  DeviceScene d;
  d.triangleCount = static_cast<std::uint32_t>(tree.order.size());
  const std::vector<glm::uvec3> hittable = hittableCorners(scene);
  if (features.has(Feature::TREE) && !features.has(Feature::PACKETS))
    d.nodes = compute.upload("nodes", withSentinels(tree));
  if (features.has(Feature::TREE) && features.has(Feature::PACKETS)) {
    const WideTree wide = buildWideTree(tree, scene.positions, hittable);
    if (wide.depth > WIDE_DEPTH)
      throw ClError(fmt::format("the eight-wide tree is {} nodes deep, the kernels have room for {}",
                                wide.depth, WIDE_DEPTH));
    d.wideNodes = compute.upload("wideNodes", wide.nodes);
    d.leaves = compute.upload("leaves", wide.corners);
  }
  d.triangles = compute.upload("triangles", leafTriangles(scene, hittable, tree.order));
  std::vector<std::uint32_t> corners;
  corners.reserve(tree.order.size() * 3 + 3);
  for (const std::uint32_t i : tree.order) {
    const Triangle& t = scene.triangles[i];
    corners.insert(corners.end(), {t.v0, t.v1, t.v2});
  }
  const bool interpolates = features.has(Feature::VERTEX_NORMALS) || features.has(Feature::TEXTURES) ||
                            features.has(Feature::VERTEX_COLORS);
  corners.resize(corners.size() + 3);  // of the degenerate triangle
  if (interpolates) d.corners = compute.upload("corners", corners);
  if (features.has(Feature::VERTEX_NORMALS)) d.normals = compute.upload("normals", scene.normals);
  if (features.has(Feature::NORMAL_TEXTURE)) d.tangents = compute.upload("tangents", scene.tangents);
  if (features.has(Feature::UV0)) d.uv0 = compute.upload("uv0", scene.uv0);
  if (features.has(Feature::UV1)) d.uv1 = compute.upload("uv1", scene.uv1);
  if (features.has(Feature::VERTEX_COLORS)) d.colors = compute.upload("colors", scene.colors);
  TextureAtlas atlas(scene);
  std::vector<device::DeviceMaterial> materials;
  for (const auto& m : scene.materials) materials.push_back(toDevice(m, atlas));
  if (materials.empty()) materials.push_back(toDevice(Material{}, atlas));
  d.materials = compute.upload("materials", materials);
  if (features.has(Feature::TEXTURES)) {
    d.textures = compute.upload("textures", atlas.slots);
    d.texels = compute.upload("texels", atlas.texels);
    d.linearFromSrgb = compute.upload("linearFromSrgb", srgbTable());
  }
  const auto lights = lightsToDevice(scene);
  d.lightCount = static_cast<std::uint32_t>(lights.size());
  d.lights = compute.upload("lights", lights);
  if (features.has(Feature::BACKGROUND_MAP))
    d.background = compute.upload("background", scene.background.map);
  return d;
}

}  // namespace whittle
