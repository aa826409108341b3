// Texture lookups in double precision: wrap modes, filters, sRGB.
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

}  // namespace

double srgbToLinear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Vec4 sampleTexture(const Scene& scene, const TextureSlot& slot, const Vec2& uv, Encoding encoding) {
  if (!slot.used()) return Vec4(1);
  const Image& image = scene.images[slot.image];
  const auto& m = slot.transform;
  double u = m[0] * uv.x + m[1] * uv.y + m[2];
  double v = m[3] * uv.x + m[4] * uv.y + m[5];
  if (!std::isfinite(u) || !std::isfinite(v)) return texel(image, 0, 0, encoding);
  u = wrapCoordinate(u, slot.wrapS);
  v = wrapCoordinate(v, slot.wrapT);
  if (slot.filter == Filter::Nearest) {
    return texel(image, wrapTexel(static_cast<int>(u * image.width), image.width, slot.wrapS),
                 wrapTexel(static_cast<int>(v * image.height), image.height, slot.wrapT), encoding);
  }
  const Between x = texelsAt(u, image.width, slot.wrapS);
  const Between y = texelsAt(v, image.height, slot.wrapT);
  const Vec4 top =
      glm::mix(texel(image, x.lower, y.lower, encoding), texel(image, x.upper, y.lower, encoding), x.weight);
  const Vec4 bottom =
      glm::mix(texel(image, x.lower, y.upper, encoding), texel(image, x.upper, y.upper, encoding), x.weight);
  return glm::mix(top, bottom, y.weight);
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
