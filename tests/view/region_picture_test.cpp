// Pictures of which only a region is new.
#include "view/region_picture.h"

#include <gtest/gtest.h>

namespace whittle::test {
namespace {

/// Each value says where it is and of which picture.
FloatImage numbered(int width, int height, int channels, float first) {
  FloatImage image{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i) image.pixels.push_back(first + static_cast<float>(i));
  return image;
}

RenderResult resultOf(FloatImage radiance) {
  RenderResult result;
  result.aovs["depth"] = numbered(radiance.width, radiance.height, 1, 7);
  result.aovs["depth"].frame = radiance.frame;
  result.radiance = std::move(radiance);
  return result;
}

bool isInside(const Region& r, int x, int y) {
  return x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
}

TEST(RegionPicture, OutsideStaysAndInsideIsNew) {
  Settings settings;
  settings.width = 12, settings.height = 7;
  settings.crop = Region{3, 2, 5, 4};
  const RenderResult last = resultOf(numbered(12, 7, 3, 1000));
  FloatImage fresh = numbered(5, 4, 3, 0);
  fresh.frame = {12, 7, 3, 2};
  const RenderResult part = resultOf(fresh);
  const RenderResult whole = view::withRegion(&last, part, settings);
  ASSERT_EQ(whole.radiance.pixels.size(), 12U * 7 * 3);
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 12; ++x) {
      const auto at = static_cast<std::size_t>(y * 12 + x);
      if (isInside(*settings.crop, x, y)) {
        const auto own = static_cast<std::size_t>((y - 2) * 5 + x - 3);
        EXPECT_EQ(whole.radiance.pixels[3 * at + 1], part.radiance.pixels[3 * own + 1]) << x << ',' << y;
        EXPECT_EQ(whole.aovs.at("depth").pixels[at], part.aovs.at("depth").pixels[own]);
      } else {
        EXPECT_EQ(whole.radiance.pixels[3 * at + 1], last.radiance.pixels[3 * at + 1]) << x << ',' << y;
        EXPECT_EQ(whole.aovs.at("depth").pixels[at], last.aovs.at("depth").pixels[at]);
      }
    }
}

TEST(RegionPicture, WithNothingBeforeTheRestIsBlack) {
  Settings settings;
  settings.width = 4, settings.height = 3;
  settings.crop = Region{1, 1, 1, 1};
  FloatImage fresh{1, 1, 3, {5, 6, 7}};
  fresh.frame = {4, 3, 1, 1};
  const RenderResult whole = view::withRegion(nullptr, resultOf(fresh), settings);
  float sum = 0;
  for (const float v : whole.radiance.pixels) sum += v;
  EXPECT_EQ(sum, 18);
  EXPECT_EQ(whole.radiance.pixels[3 * 5 + 2], 7);
}

TEST(RegionPicture, ACoarsePartCoversItsRegion) {
  Settings settings;
  settings.width = 16, settings.height = 8;
  settings.crop = Region{5, 3, 6, 4};
  const Region coarse = view::coarseRegion(*settings.crop, 4, 2, 4);
  EXPECT_EQ(coarse, (Region{1, 0, 2, 2}));
  FloatImage fresh = numbered(2, 2, 3, 100);
  fresh.frame = {4, 2, 1, 0};
  const RenderResult last = resultOf(numbered(16, 8, 3, 1000));
  const RenderResult whole = view::withRegion(&last, resultOf(fresh), settings);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x) {
      const auto at = static_cast<std::size_t>(3 * (y * 16 + x));
      const auto own = static_cast<std::size_t>(3 * (y / 4 * 2 + x / 4 - 1));
      EXPECT_EQ(whole.radiance.pixels[at],
                isInside(*settings.crop, x, y) ? fresh.pixels[own] : last.radiance.pixels[at])
          << x << ',' << y;
    }
}

TEST(RegionPicture, CoarseRegionsLieWithinTheCoarsePicture) {
  for (int width = 8; width < 40; ++width)
    for (int x = 0; x < width; ++x)
      for (int w = 1; x + w <= width; ++w) {
        const Region coarse = view::coarseRegion({x, x, w, w}, width / 4, width / 4, 4);
        ASSERT_TRUE(liesWithin(coarse, width / 4, width / 4)) << x << '+' << w << " of " << width;
      }
}

}  // namespace
}  // namespace whittle::test
