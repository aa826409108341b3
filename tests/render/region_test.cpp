// Settings::crop: a region has the pixels that the whole picture has there, bit for bit, and costs what its
// own pixels cost.
#include <set>

#include "reference/reference.h"
#include "render/render_session.h"
#include "scene/input_error.h"
#include "support/pictures.h"
#include "wavefront/film.h"
#include "wavefront/pixel_order.h"

namespace whittle::test {
namespace {

/// Values of a region's image that differ from those at its place in the whole, and whether size and frame
/// are right.
std::size_t differentInRegion(const FloatImage& part, const FloatImage& whole, const Region& region) {
  EXPECT_EQ(part.width, region.width);
  EXPECT_EQ(part.height, region.height);
  EXPECT_EQ(part.channels, whole.channels);
  EXPECT_EQ(part.frame.width, whole.width);
  EXPECT_EQ(part.frame.height, whole.height);
  EXPECT_EQ(part.frame.x, region.x);
  EXPECT_EQ(part.frame.y, region.y);
  std::size_t different = 0;
  for (int y = 0; y < region.height; ++y)
    for (int x = 0; x < region.width; ++x)
      for (int c = 0; c < whole.channels; ++c) {
        const auto mine = static_cast<std::size_t>((y * region.width + x) * whole.channels + c);
        const auto theirs =
            static_cast<std::size_t>(((region.y + y) * whole.width + region.x + x) * whole.channels + c);
        different += std::memcmp(&part.pixels[mine], &whole.pixels[theirs], sizeof(float)) != 0;
      }
  return different;
}

std::string nameOf(const Region& r) { return fmt::format("{},{},{},{}", r.x, r.y, r.width, r.height); }

/// Of a picture of 96×54: one pixel in each kind of place, edges, sides that no tile divides, all of it.
const std::vector<Region> kRegions{{0, 0, 1, 1},    {95, 53, 1, 1},   {50, 20, 1, 1},
                                   {3, 5, 7, 11},   {0, 50, 96, 4},   {89, 0, 7, 54},
                                   {31, 17, 33, 9}, {64, 32, 32, 22}, {0, 0, 96, 54}};

TEST(PixelOrder, HasEachPixelOfARegionOnce) {
  for (const Region& r :
       {Region{0, 0, 9, 5}, Region{7, 3, 130, 70}, Region{65534, 65534, 1, 1}, Region{5, 9, 1, 300}}) {
    const auto order = makePixelOrder(r);
    std::set<std::uint32_t> seen(order.begin(), order.end());
    EXPECT_EQ(order.size(), r.pixels()) << nameOf(r);
    ASSERT_EQ(seen.size(), r.pixels()) << nameOf(r);
    for (int y = r.y; y < r.y + r.height; ++y)
      for (int x = r.x; x < r.x + r.width; ++x)
        ASSERT_TRUE(seen.contains(static_cast<std::uint32_t>(y) << 16 | static_cast<std::uint32_t>(x)))
            << nameOf(r);
  }
}

TEST(Region, HasThePixelsOfTheWholePicture) {
  const Scene scene = ownScene("cornell_box");
  for (const Sampler sampler : {Sampler::Random, Sampler::Stratified, Sampler::Sobol})
    for (const ImpulseMode impulses : {ImpulseMode::All, ImpulseMode::One}) {
      if (sampler != Sampler::Random && impulses == ImpulseMode::One) continue;
      Settings settings = wholeSettings(4);
      settings.sampler = sampler;
      settings.impulses = impulses;
      settings.raysPerPixel = 4;
      settings.aovs = settings.alpha = true;
      const RenderResult whole = renderOnDevice(scene, settings);
      EXPECT_EQ(whole.radiance.frame.width, 0) << "a whole picture has no frame";
      for (const Region& region : kRegions) {
        settings.crop = region;
        const RenderResult part = renderOnDevice(scene, settings);
        EXPECT_EQ(differentInRegion(part.radiance, whole.radiance, region), 0U) << nameOf(region);
        EXPECT_EQ(differentInRegion(part.alpha, whole.alpha, region), 0U) << nameOf(region);
        for (const auto& [name, image] : part.aovs)
          EXPECT_EQ(differentInRegion(image, whole.aovs.at(name), region), 0U)
              << name << " of " << nameOf(region);
        EXPECT_EQ(part.aovs.size(), whole.aovs.size());
        EXPECT_EQ(part.stats.rays.primary, 4 * region.pixels()) << nameOf(region);
        EXPECT_EQ(part.stats.dropped, 0U);
      }
      settings.crop.reset();
    }
}

TEST(Region, OfOneSampleAndInSmallWavefrontsHasTheSameBits) {
  const Scene scene = ownScene("cornell_box");
  Settings settings = wholeSettings(6);
  const RenderResult whole = renderOnDevice(scene, settings);
  settings.crop = Region{31, 17, 33, 29};
  for (const int wavefront : {600, 1 << 18}) {
    settings.wavefront = wavefront;
    EXPECT_EQ(differentInRegion(renderOnDevice(scene, settings).radiance, whole.radiance, *settings.crop), 0U)
        << wavefront;
  }
}

/// Adaptive samples go where the region's own error is; each pixel is that of the whole picture with as many.
TEST(Region, AdaptivePixelsAreThoseOfTheWholePictureWithTheirSamples) {
  const Scene scene = ownScene("cornell_box");
  Settings settings = wholeSettings(4);
  const Region region{20, 10, 37, 27};
  settings.crop = region;
  settings.raysPerPixel = 40;
  settings.adaptive = settings.aovs = true;
  const RenderResult adaptive = renderOnDevice(scene, settings);
  EXPECT_GT(adaptive.stats.samples.most, adaptive.stats.samples.least);
  const FloatImage& samples = adaptive.aovs.at("samples");
  settings.adaptive = settings.aovs = false;
  settings.crop.reset();
  for (const float n : std::set<float>(samples.pixels.begin(), samples.pixels.end())) {
    settings.raysPerPixel = static_cast<int>(n);
    const FloatImage whole = renderOnDevice(scene, settings).radiance;
    for (int y = 0; y < region.height; ++y)
      for (int x = 0; x < region.width; ++x) {
        const auto mine = static_cast<std::size_t>(y * region.width + x);
        const auto theirs = static_cast<std::size_t>((region.y + y) * whole.width + region.x + x);
        if (samples.pixels[mine] != n) continue;
        ASSERT_EQ(std::memcmp(&adaptive.radiance.pixels[3 * mine], &whole.pixels[3 * theirs], 12), 0)
            << x << ',' << y << " of " << n << " samples";
      }
  }
}

TEST(Region, ATargetErrorIsOfTheRegion) {
  const Scene scene = ownScene("anti_aliasing");
  Settings settings = wholeSettings(2);
  settings.crop = Region{40, 20, 21, 15};
  settings.raysPerPixel = 1 << 14;
  settings.targetErrorRelative = 0.05;
  const RenderResult part = renderOnDevice(scene, settings);
  ASSERT_FALSE(part.stats.error.empty());
  EXPECT_LE(part.stats.error.back().estimate, 0.05 * part.stats.error.back().mean);
  EXPECT_LT(part.stats.samples.most, 1U << 14);
  settings.raysPerPixel = static_cast<int>(part.stats.samples.most);
  settings.targetErrorRelative = 0;
  settings.crop.reset();
  EXPECT_EQ(differentInRegion(part.radiance, renderOnDevice(scene, settings).radiance, {40, 20, 21, 15}), 0U);
}

/// 2.4 GB of film would be the whole picture's.
TEST(Region, OfAHugePictureTakesItsOwnMemoryAlone) {
  const Scene scene = ownScene("cornell_box");
  Settings settings = wholeSettings(2);
  settings.width = 30000, settings.height = 20000;
  settings.aovs = true;
  settings.crop = Region{14000, 9000, 100, 100};
  const RenderResult part = renderOnDevice(scene, settings);
  std::uint64_t film = 0;
  for (const BufferStats& buffer : part.stats.buffers) film += buffer.group == "film" ? buffer.bytes : 0;
  const std::uint64_t planes = filmPlanes(settings, false) + 1 + 8;  // sums, order, auxiliary outputs
  EXPECT_LE(film, 10000 * sizeof(float) * (planes + 1)) << "and coverage at most";
  settings.crop = Region{14050, 9020, 1, 1};
  const RenderResult pixel = renderOnDevice(scene, settings);
  EXPECT_EQ(std::memcmp(&pixel.radiance.pixels[0], &part.radiance.pixels[3 * (20 * 100 + 50)], 12), 0);
}

TEST(Region, SessionsChangeItAndExplainPixelsOfIt) {
  RenderSession session;
  const Scene scene = ownScene("cornell_box");
  Settings settings = onTestDevice(wholeSettings(3));
  const FloatImage whole = session.render(scene, settings, testHooks()).radiance;
  for (const Region& region : {Region{10, 10, 20, 20}, Region{11, 10, 20, 20}, Region{80, 40, 16, 14}}) {
    settings.crop = region;
    EXPECT_EQ(differentInRegion(session.render(scene, settings, testHooks()).radiance, whole, region), 0U);
  }
  const auto trees = session.explain(scene, settings, 85, 45, testHooks());
  ASSERT_EQ(trees.size(), 1U);
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(trees[0].radiance[c], static_cast<double>(whole.pixels[3 * (45 * 96 + 85) + c])) << c;
}

TEST(Region, OutsideThePictureIsRefused) {
  const Scene scene = ownScene("cornell_box");
  for (const Region& region :
       {Region{0, 0, 97, 1}, Region{96, 0, 1, 1}, Region{-1, 0, 2, 2}, Region{0, 53, 1, 2},
        Region{5, 5, 0, 3}, Region{2147483647, 0, 2147483647, 1}}) {
    Settings settings = smallSettings();
    settings.crop = region;
    EXPECT_THROW(renderOnDevice(scene, settings), InputError) << nameOf(region);
  }
}

TEST(Region, OfTheReferenceHasItsPixelsToo) {
  const Scene scene = ownScene("mirror");
  Settings settings = smallSettings(2);
  settings.raysPerPixel = 2;
  const ReferenceResult whole = renderReference(scene, settings);
  settings.crop = Region{31, 17, 33, 9};
  const ReferenceResult part = renderReference(scene, settings);
  EXPECT_EQ(differentInRegion(part.radiance, whole.radiance, *settings.crop), 0U);
  EXPECT_EQ(differentInRegion(part.depth, whole.depth, *settings.crop), 0U);
  EXPECT_EQ(differentInRegion(part.primitive, whole.primitive, *settings.crop), 0U);
  EXPECT_EQ(part.rays.primary, 2U * 33 * 9);
}

}  // namespace
}  // namespace whittle::test
