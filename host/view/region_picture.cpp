// See region_picture.h.
#include "view/region_picture.h"

#include <algorithm>

namespace whittle::view {
namespace {

/// The image in this size, each pixel the one that covers it; black for none.
FloatImage inSize(const FloatImage* image, int width, int height, int channels) {
  if (image && image->width == width && image->height == height && image->channels == channels) return *image;
  FloatImage out{width, height, channels, {}};
  const auto n = static_cast<std::size_t>(channels);
  out.pixels.resize(static_cast<std::size_t>(width) * height * n);
  if (!image || image->channels != channels || image->pixels.empty()) return out;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int fromX = x * image->width / width, fromY = y * image->height / height;
      std::copy_n(&image->pixels[(static_cast<std::size_t>(fromY) * image->width + fromX) * n], n,
                  &out.pixels[(static_cast<std::size_t>(y) * width + x) * n]);
    }
  return out;
}

/// `part` over its place.
FloatImage pasted(FloatImage whole, const FloatImage& part, const Region& region) {
  const auto n = static_cast<std::size_t>(whole.channels);
  for (int y = region.y; y < region.y + region.height; ++y)
    for (int x = region.x; x < region.x + region.width; ++x) {
      const int fromX = std::clamp(x * part.frame.width / whole.width - part.frame.x, 0, part.width - 1);
      const int fromY = std::clamp(y * part.frame.height / whole.height - part.frame.y, 0, part.height - 1);
      std::copy_n(&part.pixels[(static_cast<std::size_t>(fromY) * part.width + fromX) * n], n,
                  &whole.pixels[(static_cast<std::size_t>(y) * whole.width + x) * n]);
    }
  return whole;
}

}  // namespace

Region coarseRegion(const Region& r, int coarseWidth, int coarseHeight, int factor) {
  Region coarse{std::min(r.x / factor, coarseWidth - 1), std::min(r.y / factor, coarseHeight - 1), 0, 0};
  const auto end = [&](int fine, int side) { return std::min((fine + factor - 1) / factor, side); };
  coarse.width = std::max(1, end(r.x + r.width, coarseWidth) - coarse.x);
  coarse.height = std::max(1, end(r.y + r.height, coarseHeight) - coarse.y);
  return coarse;
}

RenderResult withRegion(const RenderResult* last, const RenderResult& part, const Settings& settings) {
  const Region region = tracedRegion(settings);
  const auto joinedWith = [&](const FloatImage* before, const FloatImage& now) {
    return pasted(inSize(before, settings.width, settings.height, now.channels), now, region);
  };
  RenderResult result;
  result.stats = part.stats;
  result.radiance = joinedWith(last ? &last->radiance : nullptr, part.radiance);
  if (!part.alpha.pixels.empty()) result.alpha = joinedWith(last ? &last->alpha : nullptr, part.alpha);
  for (const auto& [name, image] : part.aovs) {
    const auto before = last ? last->aovs.find(name) : part.aovs.end();
    const bool isThere = last && before != last->aovs.end();
    result.aovs[name] = joinedWith(isThere ? &before->second : nullptr, image);
  }
  return result;
}

}  // namespace whittle::view
