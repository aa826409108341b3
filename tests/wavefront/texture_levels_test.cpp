// Levels of textures as the device gets them: pictures whose means are known, and the reference's own levels.
#include "wavefront/texture_levels.h"

#include <gtest/gtest.h>

#include <numeric>

#include "reference/texture_levels.h"
#include "support/random_scenes.h"

namespace whittle::test {
namespace {

template <typename Code>
std::vector<std::vector<Code>> levelsOf(const Image& image, Averaging averaging) {
  std::vector<std::vector<Code>> levels;
  eachSmallerLevel(image, averaging, sizeof(Code) == 2, [&](std::span<const std::byte> bytes) {
    const Code* codes = reinterpret_cast<const Code*>(bytes.data());
    levels.emplace_back(codes, codes + bytes.size() / sizeof(Code));
  });
  return levels;
}

Image filled(int width, int height, std::array<std::uint8_t, 4> texel) {
  Image image{"", width, height, {}};
  for (int i = 0; i < width * height; ++i)
    image.texels.insert(image.texels.end(), texel.begin(), texel.end());
  return image;
}

Image randomImage(int width, int height, bool isDeep, Rng& rng) {
  Image image{"", width, height, {}};
  for (int i = 0; i < 4 * width * height; ++i) {
    const auto code = static_cast<std::uint16_t>(rng.bits());
    if (isDeep) image.deepTexels.push_back(code);
    image.texels.push_back(static_cast<std::uint8_t>(code >> 8));
  }
  return image;
}

constexpr std::array kAveragings{Averaging::Linear, Averaging::Colors, Averaging::ColorsByAlpha};
constexpr std::array<std::pair<int, int>, 6> kSizes{{{8, 8}, {5, 3}, {1, 7}, {13, 1}, {2, 9}, {1, 1}}};

TEST(TextureLevels, EndInASingleTexel) {
  for (const auto& [width, height] : kSizes) {
    const auto levels = levelsOf<std::uint8_t>(filled(width, height, {1, 2, 3, 4}), Averaging::Linear);
    std::size_t texels = static_cast<std::size_t>(width) * height;
    for (const auto& level : levels) texels += level.size() / 4;
    EXPECT_EQ(static_cast<int>(levels.size()) + 1, levelCount(width, height));
    EXPECT_EQ(texels, texelsOfLevels(width, height));
    if (!levels.empty()) {
      EXPECT_EQ(levels.back().size(), 4U);
    }
  }
  EXPECT_EQ(levelCount(5, 3), 3);
  EXPECT_EQ(texelsOfLevels(5, 3), 15U + 2 + 1);
}

TEST(TextureLevels, WhatIsConstantStaysSo) {
  for (const Averaging averaging : kAveragings)
    for (const auto& [width, height] : kSizes)
      for (int code = 0; code < 256; ++code) {
        const auto c = static_cast<std::uint8_t>(code);
        const std::array<std::uint8_t, 4> texel{c, static_cast<std::uint8_t>(255 - c), 77, c};
        for (const auto& level : levelsOf<std::uint8_t>(filled(width, height, texel), averaging))
          for (std::size_t i = 0; i < level.size(); ++i)
            ASSERT_EQ(level[i], texel[i % 4]) << width << " by " << height;
      }
}

TEST(TextureLevels, ACheckerboardBecomesItsMean) {
  Image image = filled(8, 8, {0, 0, 0, 255});
  for (std::size_t i = 0; i < 64; ++i)
    if ((i + i / 8) % 2) std::fill_n(&image.texels[4 * i], 3, std::uint8_t{255});
  // Half the light: 1.055 · ½^(1/2.4) − 0.055 = 0.7354 of 255. Half way between codes: to the even one.
  for (const auto& [averaging, code] : {std::pair{Averaging::Colors, 188}, {Averaging::Linear, 128}})
    for (const auto& level : levelsOf<std::uint8_t>(image, averaging))
      for (std::size_t i = 0; i < level.size(); ++i) ASSERT_EQ(level[i], i % 4 == 3 ? 255 : code);
}

/// One bright texel of an odd picture, wherever it is, counts as much as any other: the last level is the
/// mean.
TEST(TextureLevels, EveryTexelOfAnOddPictureCountsAlike) {
  for (const auto& [width, height] : {std::pair{5, 3}, {7, 7}, {1, 9}, {6, 11}}) {
    const int texels = width * height;
    for (int i = 0; i < texels; ++i) {
      Image image = filled(width, height, {0, 0, 0, 0});
      image.deepTexels.assign(image.texels.size(), 0);
      image.deepTexels[static_cast<std::size_t>(4 * i)] = 60000;
      const auto levels = levelsOf<std::uint16_t>(image, Averaging::Linear);
      // Half a code for each level that was rounded.
      EXPECT_NEAR(levels.back()[0], 60000.0 / texels, 0.5 * static_cast<double>(levels.size()))
          << width << ' ' << i;
    }
  }
}

/// Clear green around opaque red: no green shows.
TEST(TextureLevels, WhatIsClearLendsNoColour) {
  Image image = filled(4, 4, {0, 255, 0, 0});
  for (const std::size_t i : {0U, 7U, 9U}) {
    const std::array<std::uint8_t, 4> red{200, 0, 0, 255};
    std::copy(red.begin(), red.end(), &image.texels[4 * i]);
  }
  const auto levels = levelsOf<std::uint8_t>(image, Averaging::ColorsByAlpha);
  EXPECT_EQ(levels[1], (std::vector<std::uint8_t>{200, 0, 0, 48})) << "alpha 3/16 of 255, rounded";
  EXPECT_EQ(levels[0][3], 64) << "one of four";
  EXPECT_GT(levelsOf<std::uint8_t>(image, Averaging::Colors)[1][1], 200) << "or the test shows nothing";
  EXPECT_EQ(levelsOf<std::uint8_t>(filled(2, 2, {9, 8, 7, 0}), Averaging::ColorsByAlpha)[0],
            (std::vector<std::uint8_t>{9, 8, 7, 0}));
}

/// Normals are averaged as vectors: 2 c − 1 of the mean of codes is the mean of vectors.
TEST(TextureLevels, NormalsAreAveragedAsVectors) {
  Image image = filled(2, 1, {255, 128, 255, 255});
  image.texels[4] = 0;
  const auto level = levelsOf<std::uint8_t>(image, Averaging::Linear)[0];
  EXPECT_NEAR(2 * level[0] / 255.0 - 1, 0, 1.01 / 255) << "from left and right: neither";
  EXPECT_EQ(level[2], 255);
}

/// Where sRGB is straight, the mean of a few codes lies half way between two others as often as not.
TEST(TextureLevels, HalvesAreRoundedAsInTheReference) {
  Rng rng(6);
  for (const auto& [width, height] : {std::pair{64, 64}, {33, 15}}) {
    Image image = randomImage(width, height, false, rng);
    for (std::uint8_t& code : image.texels) code = static_cast<std::uint8_t>(code % 10);
    Image expected = image;
    for (const auto& level : levelsOf<std::uint8_t>(image, Averaging::Colors)) {
      expected = reference::smaller(expected, {reference::Encoding::Srgb, false});
      ASSERT_EQ(level, expected.texels) << width << " by " << height;
    }
  }
  const auto dark = levelsOf<std::uint8_t>(filled(1, 2, {0, 3, 0, 0}), Averaging::Colors)[0];
  EXPECT_EQ(dark[1], 3);
  Image two = filled(2, 1, {0, 2, 6, 255});
  two.texels[4] = 1, two.texels[5] = 3, two.texels[6] = 7;
  EXPECT_EQ(levelsOf<std::uint8_t>(two, Averaging::Colors)[0], (std::vector<std::uint8_t>{0, 2, 6, 255}))
      << "of 0.5, 2.5 and 6.5 the even neighbours";
}

TEST(TextureLevels, AreThoseOfTheReference) {
  Rng rng(5);
  for (const auto& [width, height] : {std::pair{16, 16}, {33, 5}, {7, 63}, {1, 40}, {12, 3}}) {
    const Image image = randomImage(width, height, false, rng), deep = randomImage(width, height, true, rng);
    for (const Averaging averaging : kAveragings) {
      const reference::Mean mean{
          averaging == Averaging::Linear ? reference::Encoding::Linear : reference::Encoding::Srgb,
          averaging == Averaging::ColorsByAlpha};
      Image expected = image;
      for (const auto& level : levelsOf<std::uint8_t>(image, averaging)) {
        expected = reference::smaller(expected, mean);
        ASSERT_EQ(level, expected.texels) << width << " by " << height;
      }
    }
    Image expected = deep;
    for (const auto& level : levelsOf<std::uint16_t>(deep, Averaging::Linear)) {
      expected = reference::smaller(expected, {});
      ASSERT_EQ(level, expected.deepTexels) << width << " by " << height;
    }
  }
}

}  // namespace
}  // namespace whittle::test
