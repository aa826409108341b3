// See texture_levels.h.
#include "reference/texture_levels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reference/texture.h"

namespace whittle::reference {
namespace {

/// How much of texel `from` of n lies in texel `to` of m, both rows as long as n·m.
double overlap(long long from, long long n, long long to, long long m) {
  return static_cast<double>(
      std::max(0LL, std::min((from + 1) * m, (to + 1) * n) - std::max(from * m, to * n)));
}

const std::array<double, 256> kLight = [] {
  std::array<double, 256> light{};
  for (std::size_t code = 0; code < light.size(); ++code)
    light[code] = srgbToLinear(static_cast<double>(code) / 255.0);
  return light;
}();

double encoded(double linear) {
  return linear <= 0.04045 / 12.92 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Half way, give or take the rounding of a mean, to the even neighbour.
double nearestEven(double value) {
  constexpr double kRounding = 1e-9;
  const double below = std::floor(value);
  if (std::abs(value - below - 0.5) < kRounding) return 2 * std::round(below / 2 + 0.25);
  return std::round(value);
}

template <class Code>
Code channelMean(const Image& image, const std::vector<Code>& codes, const Mean& mean, int x, int y,
                 int width, int height, int channel) {
  const bool isColor = channel < 3 && mean.encoding == Encoding::Srgb;
  double sum = 0, all = 0, alphas = 0, byAlpha = 0;
  const int firstX = x * image.width / width, firstY = y * image.height / height;
  for (int j = firstY; j < std::min(image.height, firstY + 3); ++j)
    for (int i = firstX; i < std::min(image.width, firstX + 3); ++i) {
      const double share = overlap(i, image.width, x, width) * overlap(j, image.height, y, height);
      const Code* texel = &codes[4 * (static_cast<std::size_t>(j) * image.width + i)];
      const double value = isColor ? kLight[texel[channel] & 255U] : texel[channel];
      sum += share * value;
      byAlpha += share * texel[3] * value;
      alphas += share * texel[3];
      all += share;
    }
  const double average = isColor && mean.byAlpha && alphas > 0 ? byAlpha / alphas : sum / all;
  return static_cast<Code>(nearestEven(isColor ? 255 * encoded(average) : average));
}

template <class Code>
std::vector<Code> smallerTexels(const Image& image, const std::vector<Code>& codes, const Mean& mean,
                                int width, int height) {
  std::vector<Code> out(std::size_t{4} * width * height);
  tbb::parallel_for(0, height, [&](int y) {
    Code* at = &out[std::size_t{4} * y * width];
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 4; ++c) *at++ = channelMean(image, codes, mean, x, y, width, height, c);
  });
  return out;
}

}  // namespace

Image smaller(const Image& image, const Mean& mean) {
  const int width = std::max(1, image.width / 2), height = std::max(1, image.height / 2);
  Image out{image.name, width, height, {}, {}};
  if (readsDeepTexels(image, mean.encoding == Encoding::Linear))
    out.deepTexels = smallerTexels(image, image.deepTexels, mean, width, height);
  else
    out.texels = smallerTexels(image, image.texels, mean, width, height);
  return out;
}

Mean meanOfBaseColor(const Material& material) {
  return {Encoding::Srgb, material.alphaMode != AlphaMode::Opaque};
}

TextureLevels::TextureLevels(const Scene& scene, const Settings& settings)
    : probes_(settings.textureFilter == TextureFilter::Anisotropic ? 4 : 1) {
  if (settings.textureFilter == TextureFilter::None) return;
  for (const Material& m : scene.materials)
    for (std::size_t i = 0; i < kTextureSlots.size(); ++i) {
      const TextureSlot& slot = m.*kTextureSlots[i];
      if (!slot.used() || !slot.hasLevels) continue;
      Mean mean{kSlotIsLinear[i] ? Encoding::Linear : Encoding::Srgb, false};
      if (kTextureSlots[i] == &Material::baseColorTexture) mean = meanOfBaseColor(m);
      Pyramid& pyramid = pyramids_[{slot.image, mean}];
      if (!pyramid.levels.empty()) continue;
      const Image* last = &scene.images[slot.image];
      pyramid.made.reserve(32);  // their addresses stay
      pyramid.levels.push_back(last);
      while (last->width > 1 || last->height > 1) {
        pyramid.made.push_back(smaller(*last, mean));
        last = &pyramid.made.back();
        pyramid.levels.push_back(last);
      }
    }
}

const std::vector<const Image*>* TextureLevels::of(const TextureSlot& slot, const Mean& mean) const {
  if (!slot.hasLevels) return nullptr;
  const auto found = pyramids_.find({slot.image, mean});
  return found == pyramids_.end() ? nullptr : &found->second.levels;
}

}  // namespace whittle::reference
