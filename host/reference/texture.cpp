// Texture lookups in double precision: wrap modes, filters, sRGB, footprints.
#include "reference/texture.h"

#include <algorithm>
#include <cmath>

namespace whittle::reference {
namespace {

double wrapCoordinate(double u, Wrap wrap) {
  switch (wrap) {
    case Wrap::Repeat:
      return u - std::floor(u);
    case Wrap::Clamp:
      return std::clamp(u, 0.0, 1.0);
    case Wrap::Mirror:
      break;
  }
  u -= 2 * std::floor(u / 2);
  return u > 1 ? 2 - u : u;
}

/// A texel index one step outside: the other end for Repeat; the same texel again for Clamp and for Mirror.
int wrapTexel(int i, int size, Wrap wrap) {
  return wrap == Wrap::Repeat ? (i % size + size) % size : std::clamp(i, 0, size - 1);
}

Vec4 texel(const Image& image, int x, int y, Encoding encoding) {
  const std::size_t first = 4 * (static_cast<std::size_t>(y) * image.width + x);
  if (readsDeepTexels(image, encoding == Encoding::Linear)) {
    const std::uint16_t* deep = &image.deepTexels[first];
    return Vec4(deep[0], deep[1], deep[2], deep[3]) / 65535.0;
  }
  const std::uint8_t* rgba = &image.texels[first];
  Vec4 value = Vec4(rgba[0], rgba[1], rgba[2], rgba[3]) / 255.0;
  for (int i = 0; i < 3 && encoding == Encoding::Srgb; ++i) value[i] = srgbToLinear(value[i]);
  return value;
}

/// Two neighbouring texel indices and how far between their centres.
struct Between {
  int lower, upper;
  double weight;  ///< of the upper
};

Between texelsAt(double u, int size, Wrap wrap) {
  const double x = u * size - 0.5;
  const int lower = static_cast<int>(std::floor(x));
  return {wrapTexel(lower, size, wrap), wrapTexel(lower + 1, size, wrap), x - lower};
}

Vec2 transformed(const TextureSlot& slot, const Vec2& uv, double translation) {
  const auto& m = slot.transform;
  return {m[0] * uv.x + m[1] * uv.y + translation * m[2], m[3] * uv.x + m[4] * uv.y + translation * m[5]};
}

bool isFinite(const Vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }

Vec4 nearestTexel(const Image& image, const TextureSlot& slot, const Vec2& at, Encoding encoding) {
  const double u = wrapCoordinate(at.x, slot.wrapS), v = wrapCoordinate(at.y, slot.wrapT);
  return texel(image, wrapTexel(static_cast<int>(u * image.width), image.width, slot.wrapS),
               wrapTexel(static_cast<int>(v * image.height), image.height, slot.wrapT), encoding);
}

Vec4 bilinear(const Image& image, const TextureSlot& slot, const Vec2& at, Encoding encoding) {
  const Between x = texelsAt(wrapCoordinate(at.x, slot.wrapS), image.width, slot.wrapS);
  const Between y = texelsAt(wrapCoordinate(at.y, slot.wrapT), image.height, slot.wrapT);
  const Vec4 top =
      glm::mix(texel(image, x.lower, y.lower, encoding), texel(image, x.upper, y.lower, encoding), x.weight);
  const Vec4 bottom =
      glm::mix(texel(image, x.lower, y.upper, encoding), texel(image, x.upper, y.upper, encoding), x.weight);
  return glm::mix(top, bottom, y.weight);
}

/// Texels between two lookups in a row, at most.
constexpr double kProbeDistance = 1.5;

/// The axes of an ellipse: the longer one, and how long the shorter one is.
struct Ellipse {
  Vec2 axis;
  double length, width;
};

/// That two vectors span: the eigenvectors of a aᵀ + b bᵀ.
Ellipse spanned(const Vec2& a, const Vec2& b) {
  const double angle =
      std::atan2(2 * (a.x * a.y + b.x * b.y), a.x * a.x + b.x * b.x - a.y * a.y - b.y * b.y) / 2;
  const Vec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
  return {along, std::hypot(glm::dot(a, along), glm::dot(b, along)),
          std::hypot(glm::dot(a, across), glm::dot(b, across))};
}

/// Where a footprint so many texels of the largest level wide lies between two of them.
struct Levels {
  const Image *larger, *smaller;
  double between;
};

Levels levelsFor(const std::vector<const Image*>& levels, double width) {
  const std::size_t last = levels.size() - 1;
  const auto lower = static_cast<std::size_t>(std::floor(std::log2(width)));
  if (lower >= last) return {levels[last], levels[last], 0};
  return {levels[lower], levels[lower + 1], width / std::exp2(lower) - 1};
}

/// How much of lookup i of `count` is in the smaller level, if `inSmaller` of them are, from outside: each
/// pair alike.
double partInSmaller(int i, int count, double inSmaller) {
  const int farther = 2 * std::min(i, count - 1 - i);
  const int own = 2 * i == count - 1 ? 1 : 2;
  return std::clamp((inSmaller - farther) / own, 0.0, 1.0);
}

}  // namespace

double srgbToLinear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Vec4 sampleTexture(const Scene& scene, const TextureSlot& slot, const Vec2& uv, Encoding encoding) {
  if (!slot.used()) return Vec4(1);
  const Image& image = scene.images[slot.image];
  const Vec2 at = transformed(slot, uv, 1);
  if (!isFinite(at)) return texel(image, 0, 0, encoding);
  return slot.filter == Filter::Nearest ? nearestTexel(image, slot, at, encoding)
                                        : bilinear(image, slot, at, encoding);
}

Vec4 filteredTexture(const Scene& scene, const TextureLevels& levels, const TextureSlot& slot, const Vec2& uv,
                     const Footprint& footprint, const Mean& mean) {
  const auto* own = slot.used() ? levels.of(slot, mean) : nullptr;
  if (!own || own->size() == 1) return sampleTexture(scene, slot, uv, mean.encoding);
  const Vec2 size(own->front()->width, own->front()->height);
  const Ellipse seen =
      spanned(transformed(slot, footprint.one, 0) * size, transformed(slot, footprint.other, 0) * size);
  const Vec2 at = transformed(slot, uv, 1);
  if (!(seen.length > 1) || !isFinite(at)) return sampleTexture(scene, slot, uv, mean.encoding);
  const double length = std::min(seen.length, 65536.0);
  const int most = levels.probes();
  const double least = most > 1 ? length / (kProbeDistance * most) : length;
  const double width = std::min(length, std::max({1.0, seen.width, least}));
  const int count =
      std::clamp(static_cast<int>(std::ceil(length / (kProbeDistance * width) - 1e-4)), 1, most);
  const auto [larger, smaller, between] = levelsFor(*own, width);
  Vec4 sum(0);
  for (int i = 0; i < count; ++i) {
    const Vec2 place = at + ((i + 0.5) / count - 0.5) * (length - width) * seen.axis / size;
    const double part = partInSmaller(i, count, between * count);
    if (part < 1) sum += (1 - part) * bilinear(*larger, slot, place, mean.encoding);
    if (part > 0) sum += part * bilinear(*smaller, slot, place, mean.encoding);
  }
  return sum / static_cast<double>(count);
}

Vec3 backgroundRadiance(const Background& background, const Vec3& direction) {
  const Vec3 constant(background.radiance);
  if (background.map.empty()) return constant;
  const double turns = std::remainder(background.rotation, 360.0) / 360.0;
  const double u = 0.5 + turns + std::atan2(direction.x, -direction.z) / (2 * kPi);
  const double v = std::acos(std::clamp(direction.y, -1.0, 1.0)) / kPi;
  const Between x = texelsAt(u, background.width, Wrap::Repeat);
  const Between y = texelsAt(v, background.height, Wrap::Clamp);
  const auto at = [&](int i, int j) {
    const float* rgb = &background.map[3 * (static_cast<std::size_t>(j) * background.width + i)];
    return Vec3(rgb[0], rgb[1], rgb[2]);
  };
  const Vec3 top = glm::mix(at(x.lower, y.lower), at(x.upper, y.lower), x.weight);
  const Vec3 bottom = glm::mix(at(x.lower, y.upper), at(x.upper, y.upper), x.weight);
  return constant * glm::mix(top, bottom, y.weight);
}

}  // namespace whittle::reference
