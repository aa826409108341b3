// Sample counts by block, and their growth.
#include "wavefront/sample_counts.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>

namespace whittle {

std::uint32_t SampleCounts::pixelsOf(std::size_t block) const {
  return static_cast<std::uint32_t>(std::min<std::size_t>(FILM_BLOCK, pixels_ - block * FILM_BLOCK));
}

std::uint64_t SampleCounts::total() const {
  std::uint64_t sum = 0;
  for (std::size_t b = 0; b < blocks(); ++b) sum += std::uint64_t{counts_[b]} * pixelsOf(b);
  return sum;
}

std::uint32_t SampleCounts::least() const { return *std::min_element(counts_.begin(), counts_.end()); }
std::uint32_t SampleCounts::most() const { return *std::max_element(counts_.begin(), counts_.end()); }

SamplePass uniformPass(const SampleCounts& counts, std::uint32_t samples) {
  assert(counts.least() == counts.most());
  SamplePass pass{counts.ofBlock(0), samples, std::vector<std::uint32_t>(counts.blocks())};
  std::iota(pass.blocks.begin(), pass.blocks.end(), 0U);
  return pass;
}

std::vector<SamplePass> adaptivePasses(const SampleCounts& counts, const std::vector<double>& blockVariances,
                                       std::uint64_t budget, std::uint64_t limit) {
  const double behind = counts.mean() / 8.0;
  std::vector<std::uint32_t> order(counts.blocks());
  std::iota(order.begin(), order.end(), 0U);
  const auto lags = [&](std::uint32_t b) { return counts.ofBlock(b) < behind; };
  // Twice the samples halve a block's variance, and cost as many as it has.
  const auto gain = [&](std::uint32_t b) {
    return blockVariances[b] / (static_cast<double>(counts.ofBlock(b)) * counts.pixelsOf(b));
  };
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return lags(a) != lags(b) ? lags(a) : gain(a) > gain(b);
  });
  // By the samples that the blocks have, and get.
  std::map<std::pair<std::uint32_t, std::uint32_t>, SamplePass> passes;
  std::uint64_t given = 0;
  for (const std::uint32_t b : order) {
    const std::uint32_t n = counts.ofBlock(b);
    const std::uint64_t cost = std::uint64_t{n} * counts.pixelsOf(b);
    if (given > 0 && given + cost > budget && budget < limit) break;
    if (!lags(b) && !(gain(b) > 0.0)) break;  // nor does any that follows
    const auto samples =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(n, (limit - given) / counts.pixelsOf(b)));
    if (samples == 0) break;
    given += std::uint64_t{samples} * counts.pixelsOf(b);
    SamplePass& pass = passes[{n, samples}];
    pass.firstSample = n;
    pass.samples = samples;
    pass.blocks.push_back(b);
  }
  std::vector<SamplePass> list;
  for (auto& [key, pass] : passes) {
    std::sort(pass.blocks.begin(), pass.blocks.end());
    list.push_back(std::move(pass));
  }
  return list;
}

}  // namespace whittle
