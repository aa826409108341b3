// See device_tables.h.
#include "wavefront/device_tables.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

#include "scene/free_array.h"
#include "scene/material_predicates.h"

namespace whittle {
namespace {

static_assert(sizeof(device::DeviceLight) == 68);
static_assert(sizeof(device::DeviceTexture) == 56);

std::size_t wordsOf(const Image& image, bool isDeep, Averaging levels) {
  const std::size_t texels = levels == Averaging::None ? static_cast<std::size_t>(image.width) * image.height
                                                       : texelsOfLevels(image.width, image.height);
  return texels * (isDeep ? 2 : 1);
}

/// An image as some slots read it.
struct Form {
  int image = 0;  ///< of PrunedScene::images
  bool isDeep = false;
  Averaging levels = Averaging::None;
  auto operator<=>(const Form&) const = default;
};

/// Texture slots and the places of the texels they read, shared where two slots are the same or read the same
/// image.
class TextureAtlas {
 public:
  TextureAtlas(const Scene& scene, const PrunedScene& pruned) : scene_(scene), pruned_(pruned) {}

  /// Index of the slot on the device, -1 for an empty one. `levels`: how its smaller levels are made, if it
  /// has any.
  int add(const TextureSlot& slot, bool isLinear, Averaging levels) {
    if (!slot.used()) return -1;
    const Image& image = scene_.images[pruned_.images[static_cast<std::size_t>(slot.image)]];
    const bool isDeep = readsDeepTexels(image, isLinear);
    device::DeviceTexture t{};
    std::copy(slot.transform.begin(), slot.transform.end(), t.transform);
    const bool isOne = !slot.hasLevels || levelCount(image.width, image.height) == 1;
    t.firstTexel = firstTexel({slot.image, isDeep, isOne ? Averaging::None : levels}, image);
    t.levels = isOne ? 1U : static_cast<std::uint32_t>(levelCount(image.width, image.height));
    t.width = image.width;
    t.height = image.height;
    t.wrapS = static_cast<std::uint32_t>(slot.wrapS);
    t.wrapT = static_cast<std::uint32_t>(slot.wrapT);
    t.flags = (slot.filter == Filter::Nearest ? TEXTURE_NEAREST : 0U) | (isDeep ? TEXTURE_DEEP : 0U);
    t.uvSet = static_cast<std::uint32_t>(slot.uvSet);
    return indexOf(t);
  }

  std::vector<TexelRange> ranges() const {
    std::vector<TexelRange> ranges;
    for (const auto& [key, word] : first_)
      ranges.push_back({pruned_.images[static_cast<std::size_t>(key.image)], key.isDeep, word, key.levels});
    return ranges;
  }

  std::vector<device::DeviceTexture> slots;

 private:
  int indexOf(const device::DeviceTexture& t) {
    const std::string bits(reinterpret_cast<const char*>(&t), sizeof(t));
    const auto [at, isNew] = known_.try_emplace(bits, static_cast<int>(slots.size()));
    if (!isNew && pruned_.sharesSlots) return at->second;
    slots.push_back(t);
    return static_cast<int>(slots.size()) - 1;
  }

  /// An image that colours and other values read is there in both forms.
  std::uint32_t firstTexel(const Form& form, const Image& image) {
    const auto [at, isNew] = first_.try_emplace(form, words_);
    if (isNew) words_ += static_cast<std::uint32_t>(wordsOf(image, form.isDeep, form.levels));
    return at->second;
  }

  const Scene& scene_;
  const PrunedScene& pruned_;
  std::map<Form, std::uint32_t> first_;         ///< word
  std::uint32_t words_ = 0;                     ///< of all of them
  std::unordered_map<std::string, int> known_;  ///< slots by their bits
};

static_assert(static_cast<int>(Wrap::Repeat) == WRAP_REPEAT && static_cast<int>(Wrap::Clamp) == WRAP_CLAMP &&
              static_cast<int>(Wrap::Mirror) == WRAP_MIRROR);

constexpr bool isLinear(int encoding) { return encoding == device::LINEAR; }

/// How a slot of a material is averaged. Of a surface with holes only what is there lends its colour.
Averaging averagingOf(const Material& m, const TextureSlot& slot, int encoding) {
  if (isLinear(encoding)) return Averaging::Linear;
  const bool hasHoles = &slot == &m.baseColorTexture && m.alphaMode != AlphaMode::Opaque;
  return hasHoles ? Averaging::ColorsByAlpha : Averaging::Colors;
}

device::DeviceMaterial toDevice(const Material& m, TextureAtlas& atlas) {
  device::DeviceMaterial d{};
#define WHITTLE_VECTOR(name, size, ...) \
  for (int k = 0; k < size; ++k) d.name[k] = m.name[k];
#define WHITTLE_SCALAR(name, ...) d.name = m.name;
#define WHITTLE_INDEX(slot, FEATURE, encoding, factor, OTHERS) \
  d.slot =                                                     \
      atlas.add(m.slot, isLinear(device::slot##Encoding), averagingOf(m, m.slot, device::slot##Encoding));
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

std::vector<device::DeviceLight> lightsToDevice(const Scene& scene, const PrunedScene& pruned,
                                                std::size_t emitters) {
  std::vector<device::DeviceLight> out;
  const auto versine = [](double angle) {
    const double s = std::sin(0.5 * angle);
    return static_cast<float>(2.0 * s * s);
  };
  for (std::size_t at = 0; at < pruned.lights.size(); ++at) {
    const std::uint32_t i = pruned.lights[at];
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
    d.behind = at > 0 && pruned.lights[at - 1] == i;
    d.emitters = static_cast<std::uint32_t>(emitters);
    out.push_back(d);
  }
  return out;
}

std::vector<SurfaceKind> surfacesOf(const PrunedScene& pruned) {
  std::vector<SurfaceKind> surfaces;
  surfaces.reserve(pruned.materialOf.size());
  for (const std::uint32_t m : pruned.materialOf)
    surfaces.push_back(m == kNotUsed ? SurfaceKind{} : SurfaceKind{m, triangleFlags(pruned.materials[m])});
  return surfaces;
}

}  // namespace

DeviceTables tablesOf(const Scene& scene, const PrunedScene& pruned) {
  DeviceTables tables;
  TextureAtlas atlas(scene, pruned);
  for (const Material& m : pruned.materials) tables.materials.push_back(toDevice(m, atlas));
  if (tables.materials.empty()) tables.materials.push_back(toDevice(Material{}, atlas));
  tables.texels = atlas.ranges();
  tables.textures = std::move(atlas.slots);
  const bool glows = std::any_of(pruned.lights.begin(), pruned.lights.end(),
                                 [&](std::uint32_t i) { return scene.lights[i].kind == LightKind::Surface; });
  if (glows) tables.emitters = emittersOf(scene);
  tables.lights = lightsToDevice(scene, pruned, tables.emitters.size());
  tables.surfaces = surfacesOf(pruned);
  return tables;
}

namespace {

/// The texels of an image and its smaller levels; in place where the memory is shared, and then from any
/// thread.
void uploadRange(Compute& compute, const Buffer& buffer, const Image& image, const TexelRange& r) {
  std::size_t at = std::size_t{r.first} * 4;
  const auto write = [&](std::span<const std::byte> level) {
    if (buffer.shared)
      std::copy(level.begin(), level.end(), buffer.shared + at);
    else
      compute.write(buffer, at, level);
    at += level.size();
  };
  write(r.isDeep ? std::as_bytes(std::span(image.deepTexels)) : std::as_bytes(std::span(image.texels)));
  eachSmallerLevel(image, r.levels, r.isDeep, write);
}

}  // namespace

Buffer uploadTexels(Compute& compute, const Scene& scene, const std::vector<TexelRange>& ranges,
                    Scene* consumed) {
  static_assert(std::endian::native == std::endian::little);
  std::size_t all = 0;
  for (const TexelRange& r : ranges)
    all = std::max(all, std::size_t{r.first} * 4 + 4 * wordsOf(scene.images[r.image], r.isDeep, r.levels));
  Buffer buffer = compute.allocate("texels", all);
  if (!buffer.handle.get()) return buffer;  // sizes alone are asked for
  // The ranges of an image lie behind one another.
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < ranges.size(); ++i)
    if (i == 0 || ranges[i - 1].image != ranges[i].image) begins.push_back(i);
  const auto upload = [&](std::size_t k) {
    const std::size_t end = k + 1 < begins.size() ? begins[k + 1] : ranges.size();
    for (std::size_t i = begins[k]; i < end; ++i)
      uploadRange(compute, buffer, scene.images[ranges[i].image], ranges[i]);
    if (!consumed) return;
    Image& taken = consumed->images[ranges[begins[k]].image];
    freeArray(taken.texels);
    freeArray(taken.deepTexels);
  };
  if (buffer.shared)
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, begins.size(), 1),
        [&](const auto& range) {
          for (std::size_t k = range.begin(); k < range.end(); ++k) upload(k);
        },
        tbb::simple_partitioner{});
  else
    for (std::size_t k = 0; k < begins.size(); ++k) upload(k);
  return buffer;
}

}  // namespace whittle
