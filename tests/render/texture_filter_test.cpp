// Textures filtered by what a ray stands for: kernels against the reference, mirrors against what they show,
// shimmer and error against pictures of many rays, and nothing of it where nothing needs it.
#include <cmath>

#include "analysis/scene_features.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

/// Checks of `side` texels.
Image checkers(int width, int height, int side = 1) {
  Image image{"checkers", width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint8_t code = (x / side + y / side) % 2 ? 230 : 20;
      image.texels.insert(image.texels.end(), {code, static_cast<std::uint8_t>(code / 2), 60, 255});
    }
  return image;
}

/// Shows its texture as it is: no light is needed.
Material shown() {
  Material m = lambert(glm::vec3(1));
  m.unlit = true;
  m.doubleSided = true;
  m.baseColorTexture.image = 0;
  return m;
}

/// A floor from before the eye to far away, a check every `size` metres.
Scene checkerFloor(float size = 0.25F) {
  Scene scene;
  addFloor(scene, shown(), 0);
  for (const glm::vec3& p : scene.positions) scene.uv0.emplace_back(p.x / (2 * size), p.z / (2 * size));
  scene.images = {checkers(2, 2)};
  Camera camera;
  camera.position = {0.1F, 1, 0.2F};
  aim(camera, {0.1, -0.3, -1});
  scene.cameras = {camera};
  return scene;
}

/// A row of `count` balls with vertex normals, each of its own material.
void addBall(Scene& scene, const Material& material, const glm::vec3& centre, float radius) {
  constexpr int kAround = 24, kUp = 12;
  const std::uint32_t m = addMaterial(scene, material);
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  scene.normals.resize(first, glm::vec3(0));
  for (int j = 0; j <= kUp; ++j)
    for (int i = 0; i <= kAround; ++i) {
      const float a = 2 * 3.14159265F * static_cast<float>(i) / kAround,
                  b = 3.14159265F * static_cast<float>(j) / kUp;
      const glm::vec3 n(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
      scene.positions.push_back(centre + radius * n);
      scene.normals.push_back(n);
      scene.uv0.emplace_back(static_cast<float>(i) / 4, static_cast<float>(j) / 4);
    }
  for (int j = 0; j < kUp; ++j)
    for (int i = 0; i < kAround; ++i) {
      const std::uint32_t v = first + static_cast<std::uint32_t>(j * (kAround + 1) + i), w = v + kAround + 1;
      scene.triangles.push_back({v, v + 1, w, m});
      scene.triangles.push_back({v + 1, w + 1, w, m});
    }
}

/// The floor with a mirror ball, a glass ball and a pane on it, a sky and a lamp.
Scene ballsOnFloor() {
  Scene scene = checkerFloor(0.1F);
  scene.materials[0] = lambert(glm::vec3(0.9F));
  scene.materials[0].baseColorTexture.image = 0;
  addBall(scene, mirror({0.9F, 0.8F, 0.7F}), {-0.7F, 0.5F, -2}, 0.5F);
  Material solid = glass(1.5F, true);
  addBall(scene, solid, {0.7F, 0.5F, -1.8F}, 0.5F);
  Material pane = glass(1, false);
  pane.specular = 0;
  pane.doubleSided = true;
  addQuad(scene, addMaterial(scene, pane), {-0.3F, 0.01F, -1.2F}, {0.6F, 0, 0}, {0, 0.6F, 0});
  scene.uv0.resize(scene.positions.size());
  scene.normals.resize(scene.positions.size(), glm::vec3(0));
  scene.lights = {pointLight({1, 3, 2}, 30)};
  scene.background.radiance = {0.1F, 0.2F, 0.4F};
  return scene;
}

Settings smallPicture(TextureFilter filter, int bounces = 1) {
  Settings settings;
  settings.width = 96;
  settings.height = 54;
  settings.bounces = bounces;
  settings.textureFilter = filter;
  return settings;
}

double rmse(const FloatImage& a, const FloatImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double d = static_cast<double>(a.pixels[i] - b.pixels[i]);
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

/// The right picture, of many rays that read textures as they are.
FloatImage ofManyRays(const Scene& scene, Settings settings) {
  settings.textureFilter = TextureFilter::None;
  settings.raysPerPixel = 400;
  settings.sampler = Sampler::Sobol;
  return renderOnDevice(scene, settings).radiance;
}

TEST(TextureFilter, AgreesWithTheReference) {
  for (const TextureFilter filter : {TextureFilter::Mip, TextureFilter::Anisotropic})
    for (const int rays : {1, 3}) {
      Settings settings = smallPicture(filter, 6);
      settings.raysPerPixel = rays;
      expectAgreement(compareWithReference(ballsOnFloor(), settings), "balls on a floor", 0);
    }
}

/// Sides of 5 and 3, clamped and mirrored, a transform that shears, a camera without perspective.
TEST(TextureFilter, AgreesWithTheReferenceOnOddPictures) {
  Scene scene = checkerFloor();
  scene.images = {checkers(5, 3)};
  scene.cameras[0].orthographic = true;
  scene.cameras[0].ymag = 3;
  for (const Wrap wrap : {Wrap::Repeat, Wrap::Mirror, Wrap::Clamp}) {
    TextureSlot& slot = scene.materials[0].baseColorTexture;
    slot.wrapS = slot.wrapT = wrap;
    slot.transform = {0.9F, 0.7F, 0.1F, -0.4F, 1.1F, 0.6F};
    expectAgreement(compareWithReference(scene, smallPicture(TextureFilter::Anisotropic)), "odd sides", 0);
  }
}

/// Where no pixel is larger than a texel nothing changes; and with --texture-filter none the code may stay.
TEST(TextureFilter, WhatIsMagnifiedKeepsItsBits) {
  Scene scene = checkerFloor(8);
  scene.cameras[0].yfov = 0.3F;
  const RenderResult plain = renderOnDevice(scene, smallPicture(TextureFilter::None));
  for (const TextureFilter filter : {TextureFilter::Mip, TextureFilter::Anisotropic})
    EXPECT_EQ(renderOnDevice(scene, smallPicture(filter)).radiance.pixels, plain.radiance.pixels);
  Scene fine = ballsOnFloor();
  Settings none = smallPicture(TextureFilter::None, 6);
  const RenderResult without = renderOnDevice(fine, none);
  none.keepAllFeatures = true;
  EXPECT_EQ(renderOnDevice(fine, none).radiance.pixels, without.radiance.pixels);
  EXPECT_NE(renderOnDevice(fine, smallPicture(TextureFilter::Mip, 6)).radiance.pixels,
            without.radiance.pixels)
      << "or the test shows nothing";
}

TEST(TextureFilter, LanesThreadsAndQueuesGiveTheSameBits) {
  const Scene scene = ballsOnFloor();
  Settings settings = smallPicture(TextureFilter::Anisotropic, 6);
  settings.raysPerPixel = 3;
  const RenderResult whole = renderOnDevice(scene, settings);
  Settings other = settings;
  other.lanes = Lanes::One;
  EXPECT_EQ(renderOnDevice(scene, other).radiance.pixels, whole.radiance.pixels);
  other = settings;
  other.wavefront = 1024;
  EXPECT_EQ(renderOnDevice(scene, other).radiance.pixels, whole.radiance.pixels);
  other = settings;
  other.keepAllFeatures = true;
  EXPECT_EQ(renderOnDevice(scene, other).radiance.pixels, whole.radiance.pixels);
}

/// What a flat mirror shows is filtered as what lies as far behind it: the way is as long.
TEST(TextureFilter, AMirrorShowsWhatLiesAsFarBehindIt) {
  const auto wall = [](float z, float forwards) {
    Scene scene;
    addQuad(scene, addMaterial(scene, shown()), {-20, -20, z}, {40, 0, 0}, {0, 40, 0});
    for (const glm::vec3& p : scene.positions) scene.uv0.emplace_back(4 * p.x, 4 * p.y + forwards);
    scene.images = {checkers(16, 16)};
    Camera camera;
    aim(camera, {0.2, 0.1, -1});
    scene.cameras = {camera};
    return scene;
  };
  Scene mirrored = wall(3, 0);
  addQuad(mirrored, addMaterial(mirrored, mirror(glm::vec3(1))), {-20, -20, -2}, {40, 0, 0}, {0, 40, 0});
  mirrored.uv0.resize(mirrored.positions.size());
  const Settings settings = smallPicture(TextureFilter::Anisotropic, 2);
  const FloatImage seen = renderOnDevice(mirrored, settings).radiance;
  const FloatImage behind = renderOnDevice(wall(-7, 0), settings).radiance;
  // Rounding of a place 7 m away by 5e-7 m, of a texel of 0.0156 m.
  EXPECT_LT(rmse(seen, behind), 2e-4);
  EXPECT_GT(rmse(seen, renderOnDevice(wall(-7, 0), smallPicture(TextureFilter::None)).radiance), 0.02)
      << "or the test shows nothing";
}

/// A floor of checks, many to a pixel far away, seen again from a quarter of a pixel aside. At one ray a
/// pixel that moves nothing but each pixel's share of checks: at most its edges', a quarter of the contrast
/// at the foot of the picture and nothing where many checks share a pixel. Read as they are, checks come and
/// go.
TEST(TextureFilter, AFloorDoesNotShimmer) {
  const auto shimmer = [](TextureFilter filter) {
    Scene scene = checkerFloor(0.05F);
    Settings settings = smallPicture(filter);
    settings.crop = Region{0, 5, 96, 30};  // below the horizon, far away
    const FloatImage before = renderOnDevice(scene, settings).radiance;
    Camera& camera = scene.cameras[0];
    const float pixel = 2 * std::tan(camera.yfov / 2) / static_cast<float>(settings.height);
    aim(camera, glm::dvec3(camera.forward + 0.25F * pixel * camera.right));
    return rmse(before, renderOnDevice(scene, settings).radiance);
  };
  const double none = shimmer(TextureFilter::None);
  EXPECT_GT(none, 0.05) << "or the test shows nothing";
  EXPECT_LT(shimmer(TextureFilter::Mip), none / 6);
  // Checks of a single texel are the worst for lookups one and a half apart.
  EXPECT_LT(shimmer(TextureFilter::Anisotropic), none / 2);
}

/// Error with the filter over that without it.
double shareOfError(const Scene& scene, Settings settings, int rays) {
  const FloatImage right = ofManyRays(scene, settings);
  settings.raysPerPixel = rays;
  settings.sampler = Sampler::Sobol;
  settings.textureFilter = TextureFilter::None;
  const double before = rmse(renderOnDevice(scene, settings).radiance, right);
  settings.textureFilter = TextureFilter::Anisotropic;
  return rmse(renderOnDevice(scene, settings).radiance, right) / before;
}

/// Where a pixel has several texels: a floor of checks in the distance, and the bricks of the scene of
/// textures. Edges of things are not in the picture: no texture filter can smooth them.
TEST(TextureFilter, HalvesTheError) {
  Scene floor = checkerFloor(0.05F);
  floor.images = {checkers(64, 64, 32)};
  Settings settings = smallPicture(TextureFilter::None, 4);
  settings.crop = Region{0, 12, 96, 24};
  EXPECT_LT(shareOfError(floor, settings, 1), 0.5);
  EXPECT_LT(shareOfError(floor, settings, 4), 0.5);
  settings.crop = Region{0, 0, 96, 20};
  EXPECT_LT(shareOfError(ownScene("textured"), settings, 1), 0.5);
}

/// Searches read the largest level, so what a mask cuts out is cut out alike.
TEST(TextureFilter, CutOutsKeepTheirShape) {
  Scene scene = ownScene("textured");
  Settings settings = smallPicture(TextureFilter::None, 2);
  settings.aovs = true;
  const RenderResult none = renderOnDevice(scene, settings);
  settings.textureFilter = TextureFilter::Anisotropic;
  const RenderResult filtered = renderOnDevice(scene, settings);
  EXPECT_EQ(filtered.aovs.at("primitive").pixels, none.aovs.at("primitive").pixels);
}

std::uint64_t bytesOf(const RenderResult& result, const std::string& name) {
  for (const BufferStats& b : result.stats.buffers)
    if (b.name == name) return b.bytes;
  return 0;
}

bool isFiltered(const Scene& scene, const Settings& settings) {
  return SceneFeatures::analyse(scene, settings, {true}).has(Feature::TEXTURE_LEVELS);
}

TEST(TextureFilter, IsLeftOutWhereNothingNeedsIt) {
  Scene scene = checkerFloor();
  scene.images = {checkers(8, 4)};
  const Settings settings = smallPicture(TextureFilter::Mip);
  EXPECT_TRUE(isFiltered(scene, settings));
  EXPECT_EQ(bytesOf(renderOnDevice(scene, settings), "texels"), 4 * (8 * 4 + 4 * 2 + 2 * 1 + 1 * 1));
  EXPECT_FALSE(isFiltered(scene, smallPicture(TextureFilter::None)));
  EXPECT_EQ(bytesOf(renderOnDevice(scene, smallPicture(TextureFilter::None)), "texels"), 4 * 8 * 4);
  scene.materials[0].baseColorTexture.hasLevels = false;
  EXPECT_FALSE(isFiltered(scene, settings)) << "its sampler wants the texels";
  scene.materials[0].baseColorTexture.hasLevels = true;
  scene.images = {checkers(1, 1)};
  EXPECT_FALSE(isFiltered(scene, settings)) << "a single texel";
  EXPECT_FALSE(isFiltered(ownScene("cornell_box"), settings)) << "no texture";
}

/// A sampler that wants texels: they are drawn as they are beside a texture that is filtered.
TEST(TextureFilter, NearestSamplersAreDrawnAsTheyAre) {
  Scene scene = checkerFloor(0.05F);
  TextureSlot& slot = scene.materials[0].baseColorTexture;
  slot.hasLevels = false;
  slot.filter = Filter::Nearest;
  Material filtered = shown();
  addQuad(scene, addMaterial(scene, filtered), {2, 0, -9}, {4, 0, 0}, {0, 4, 0});
  for (int i = 0; i < 4; ++i) scene.uv0.emplace_back(i < 2 ? 0 : 9, i % 2 ? 0 : 9);
  const Settings settings = smallPicture(TextureFilter::Anisotropic);
  const Agreement agreement = compareWithReference(scene, settings);
  EXPECT_TRUE(isFiltered(scene, settings));
  const FloatImage none = renderOnDevice(scene, smallPicture(TextureFilter::None)).radiance;
  std::size_t same = 0, floor = 0;
  for (std::size_t i = 0; i < agreement.pixels; ++i) {
    if (!(agreement.kernel.aovs.at("primitive").pixels[i] >= 0 &&
          agreement.kernel.aovs.at("primitive").pixels[i] < 2))
      continue;
    ++floor;
    same += agreement.kernel.radiance.pixels[3 * i] == none.pixels[3 * i];
  }
  EXPECT_GT(floor, 1000U);
  EXPECT_EQ(same, floor);
}

}  // namespace
}  // namespace whittle::test
