// Normals are slopes of the height between the pixels to both sides.
#include "textures/bake.h"

#include <algorithm>
#include <cmath>

#include "png.h"

namespace generator {
namespace {

std::uint8_t unitCode(double v) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255));
}

void addPixel(std::vector<std::uint8_t>& rgba, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  rgba.insert(rgba.end(), {r, g, b, 255});
}

}  // namespace

std::uint8_t srgbCode(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  return unitCode(v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
}

std::vector<std::uint8_t> paintPicture(int width, int height,
                                       const std::function<glm::dvec3(glm::dvec2 uv)>& color) {
  std::vector<std::uint8_t> rgba;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 c = color({(x + 0.5) / width, (y + 0.5) / height});
      addPixel(rgba, srgbCode(c.r), srgbCode(c.g), srgbCode(c.b));
    }
  }
  return encodePng(width, height, rgba);
}

BakedSurface bake(const BakeSize& size, const SurfaceFunction& surface) {
  const int w = size.width, h = size.height;
  std::vector<std::uint8_t> color, normal, roughness;
  std::vector<double> heights;
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const SurfacePoint p = surface({(x + 0.5) / w, (y + 0.5) / h});
      addPixel(color, srgbCode(p.color.r), srgbCode(p.color.g), srgbCode(p.color.b));
      addPixel(roughness, 255, unitCode(p.roughness), 255);
      heights.push_back(p.height);
    }
  }
  const double twoPixels = 2 * size.metres / w;
  const auto heightAt = [&](int x, int y) {
    return heights[static_cast<std::size_t>((y + h) % h) * static_cast<std::size_t>(w) +
                   static_cast<std::size_t>((x + w) % w)];
  };
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const double right = (heightAt(x + 1, y) - heightAt(x - 1, y)) / twoPixels;
      const double up = (heightAt(x, y - 1) - heightAt(x, y + 1)) / twoPixels;
      const glm::dvec3 n = 0.5 * glm::normalize(glm::dvec3(-right, -up, 1)) + 0.5;
      addPixel(normal, unitCode(n.x), unitCode(n.y), unitCode(n.z));
    }
  }
  return {encodePng(w, h, color), encodePng(w, h, normal), encodePng(w, h, roughness)};
}

MaterialSpec withTextures(GltfBuilder& scene, MaterialSpec spec, const BakeSize& size,
                          const SurfaceFunction& surface) {
  const BakedSurface baked = bake(size, surface);
  spec.baseColorTexture.image = scene.addImage(spec.name + " colour", baked.color, false);
  spec.normalTexture.image = scene.addImage(spec.name + " normals", baked.normal, false);
  spec.metallicRoughnessTexture.image = scene.addImage(spec.name + " roughness", baked.roughness, false);
  spec.baseColor = glm::dvec4(1);
  spec.roughness = 1;
  return spec;
}

}  // namespace generator
