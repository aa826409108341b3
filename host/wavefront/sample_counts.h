// How many samples each part of a picture has, and which parts get more: block by block, FILM_BLOCK pixels
// along the pixel order (8×8 pixels as a rule).
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/shared/layout.h"

namespace whittle {

/// Samples of each pixel before some get more than others.
inline constexpr std::uint32_t kPilotSamples = 16;

class SampleCounts {
 public:
  explicit SampleCounts(std::size_t pixels)
      : pixels_(pixels), counts_((pixels + FILM_BLOCK - 1) / FILM_BLOCK, 0) {}

  std::size_t pixels() const { return pixels_; }
  std::size_t blocks() const { return counts_.size(); }
  /// Pixels of a block: the last may be shorter.
  std::uint32_t pixelsOf(std::size_t block) const;
  std::uint32_t ofBlock(std::size_t block) const { return counts_[block]; }
  std::uint32_t ofPixel(std::size_t pixel) const { return counts_[pixel / FILM_BLOCK]; }
  void add(std::size_t block, std::uint32_t samples) { counts_[block] += samples; }

  std::uint64_t total() const;  ///< samples of the picture
  double mean() const { return static_cast<double>(total()) / static_cast<double>(pixels_); }
  std::uint32_t least() const;
  std::uint32_t most() const;

 private:
  std::size_t pixels_;
  std::vector<std::uint32_t> counts_;
};

/// Blocks that have the same samples and get the same further ones.
struct SamplePass {
  std::uint32_t firstSample = 0;
  std::uint32_t samples = 0;
  std::vector<std::uint32_t> blocks;  ///< ascending
};

/// The same for every block; all must have as many so far.
SamplePass uniformPass(const SampleCounts& counts, std::uint32_t samples);

/// Doubles the samples of the blocks where that takes most off the picture's error for each sample, until
/// `budget` samples are given out, or one block's if that is more. No more than `limit` are: the block that
/// would go beyond gets what is left. No passes where no block varies, or for less than a block. Blocks that
/// lag behind an eighth of the mean come first, whatever their variance says: few samples can miss what is
/// small. blockVariances: see film.h. Choosing by the variance of the very samples that are kept biases the
/// mean (Kirk and Arvo 1991); choosing whole blocks, from 16 samples of each pixel on, keeps that far below
/// the error itself.
std::vector<SamplePass> adaptivePasses(const SampleCounts& counts, const std::vector<double>& blockVariances,
                                       std::uint64_t budget, std::uint64_t limit);

}  // namespace whittle
