// Images sorted by size and a hash of their texels; only neighbours with equal keys are compared.
#include "analysis/duplicate_images.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <map>
#include <span>
#include <tuple>

#include "scene/hash.h"

namespace whittle {
namespace {

/// The 8-bit texels follow from deep ones.
std::uint64_t hashOf(const Image& image) {
  return whittle::hashOf(image.isDeep() ? std::as_bytes(std::span(image.deepTexels))
                                        : std::as_bytes(std::span(image.texels)));
}

bool areAlike(const std::vector<Image>& images, std::uint32_t a, std::uint32_t b, TexelFacts& facts) {
  const auto [at, isNew] = facts.areAlike.try_emplace({a, b}, false);
  if (isNew) {
    at->second = images[a].texels == images[b].texels && images[a].deepTexels == images[b].deepTexels;
    facts.reads += 2;
  }
  return at->second;
}

struct Key {
  int width, height;
  std::uint64_t hash;
  std::uint32_t index;

  auto picture() const { return std::tie(width, height, hash); }
  bool operator<(const Key& other) const {
    return std::tie(width, height, hash, index) <
           std::tie(other.width, other.height, other.hash, other.index);
  }
};

}  // namespace

std::vector<std::uint32_t> firstAlike(const std::vector<Image>& images,
                                      const std::vector<std::uint8_t>& wanted, TexelFacts& facts) {
  std::vector<std::uint32_t> first(images.size());
  std::map<std::pair<int, int>, int> ofSize;
  for (std::uint32_t i = 0; i < images.size(); ++i) {
    first[i] = i;
    if (wanted[i]) ++ofSize[{images[i].width, images[i].height}];
  }
  std::vector<Key> keys;
  for (std::uint32_t i = 0; i < images.size(); ++i)
    if (wanted[i] && ofSize[{images[i].width, images[i].height}] > 1)
      keys.push_back({images[i].width, images[i].height, 0, i});
  facts.hashes.resize(images.size());
  for (const Key& key : keys) facts.reads += !facts.hashes[key.index];
  tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t k) {
    auto& hash = facts.hashes[keys[k].index];  // each image's own
    if (!hash) hash = hashOf(images[keys[k].index]);
    keys[k].hash = *hash;
  });
  std::sort(keys.begin(), keys.end());
  for (std::size_t k = 1; k < keys.size(); ++k) {
    const std::uint32_t before = first[keys[k - 1].index];
    if (keys[k].picture() == keys[k - 1].picture() && areAlike(images, before, keys[k].index, facts))
      first[keys[k].index] = before;
  }
  return first;
}

std::uint8_t leastAlpha(const std::vector<Image>& images, std::size_t index, TexelFacts& facts) {
  facts.leastAlphas.resize(images.size());
  auto& known = facts.leastAlphas[index];
  if (known) return *known;
  const Image& image = images[index];
  ++facts.reads;
  using Range = tbb::blocked_range<std::size_t>;
  known = tbb::parallel_reduce(
      Range(0, image.texels.size() / 4, 1 << 16), std::uint8_t{255},
      [&](const Range& range, std::uint8_t least) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
          least = std::min(least, image.texels[4 * i + 3]);
        return least;
      },
      [](std::uint8_t a, std::uint8_t b) { return std::min(a, b); });
  return *known;
}

}  // namespace whittle
