// See agreement.h.
#include "support/agreement.h"
#include "wavefront/camera_to_device.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reference/camera.h"
#include "reference/sampler.h"
#include "reference/trace.h"
#include "scene/camera.h"
#include "support/pictures.h"
#include "support/random_scenes.h"

namespace whittle::test {
namespace {

using reference::Vec2;
using reference::Vec3;

/// How far eye rays are moved, radians. A direction in single precision is off by up to 1.5e-7; a hit 5 m
/// away, rounded, moves by 3e-7 m, which on a ball of 0.25 m turns the next ray by as much as 2e-6.
constexpr double kMove = 2e-6;
/// Moved copies of each ray: all miss an edge that lies beside the ray with probability 2^-32.
constexpr int kMoved = 32;
/// The same for a light, m: it may lie in a surface, and rounding then decides whether that surface is
/// in its way.
constexpr float kMoveLight = 1e-6F;
/// Share of the mean radiance beyond which a pixel is an outlier: ten times the RMSE that is asked for.
constexpr double kOutlier = 1e-3;

/// What the reference says around a pixel.
struct Neighbourhood {
  Vec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  std::uint64_t fewImpulse = ~0ULL, mostImpulse = 0, fewShadow = ~0ULL, mostShadow = 0;
};

class Surroundings {
 public:
  Surroundings(const Scene& scene, const Settings& settings)
      : scene_(scene),
        lights_(scene.lights),
        triangles_(scene_),
        world_{scene_, settings, triangles_, scene_.cameras[findCamera(scene, settings.camera)]} {}

  Neighbourhood of(std::size_t pixel, int copies = kMoved) {
    Neighbourhood around;
    Rng rng(pixel);
    for (int i = 0; i < copies; ++i) {
      for (std::size_t k = 0; k < lights_.size(); ++k)
        scene_.lights[k].position = lights_[k].position + rng.inBox(kMoveLight);
      RayCounts rays;
      const Vec3 radiance = trace(static_cast<std::uint32_t>(pixel), rng, rays);
      around.low = glm::min(around.low, radiance);
      around.high = glm::max(around.high, radiance);
      around.fewImpulse = std::min(around.fewImpulse, rays.impulse);
      around.mostImpulse = std::max(around.mostImpulse, rays.impulse);
      around.fewShadow = std::min(around.fewShadow, rays.shadow);
      around.mostShadow = std::max(around.mostShadow, rays.shadow);
    }
    return around;
  }

 private:
  Vec3 trace(std::uint32_t pixel, Rng& rng, RayCounts& rays) const {
    const Settings& s = world_.settings;
    const auto width = static_cast<std::uint32_t>(s.width),
               count = static_cast<std::uint32_t>(s.raysPerPixel);
    Vec3 sum(0);
    for (std::uint32_t k = 0; k < count; ++k) {
      const Vec2 at =
          Vec2(pixel % width, pixel / width) + reference::samplePosition(s.sampler, pixel, k, count, s.seed);
      reference::Ray ray = reference::eyeRay(world_.camera, at, s.width, s.height);
      ray.direction = glm::normalize(ray.direction + kMove * Vec3(rng.inBox(1)));
      sum += reference::Li(world_, {pixel, k, rays}, ray,
                           {.cone = reference::eyeCone(world_.camera, s, ray, k)}, Vec3(1));
    }
    return sum / static_cast<double>(count);
  }

  Scene scene_;
  std::vector<Light> lights_;  ///< where they are
  reference::TriangleIndex triangles_;
  reference::World world_;
};

Vec3 pixelOf(const FloatImage& image, std::size_t i) {
  return {image.pixels[3 * i], image.pixels[3 * i + 1], image.pixels[3 * i + 2]};
}

bool samePrimitive(const Agreement& a, std::size_t i) {
  return a.kernel.aovs.at("primitive").pixels[i] == a.reference.primitive.pixels[i];
}

bool sameHit(const Agreement& a, std::size_t i) {
  if (samePrimitive(a, i)) return true;
  const double depth = a.reference.depth.pixels[i];
  return std::abs(a.kernel.aovs.at("depth").pixels[i] - depth) <= 1e-4 * depth;
}

/// Whether `found` lies in what the reference says nearby; the moved rays need not have met its extremes.
bool explains(const Neighbourhood& around, const Vec3& found, double mean) {
  const Vec3 slack = 0.5 * (around.high - around.low) + Vec3(kOutlier * mean);
  return glm::all(glm::greaterThanEqual(found, around.low - slack)) &&
         glm::all(glm::lessThanEqual(found, around.high + slack));
}

std::uint64_t apart(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : b - a; }

void addLoose(Agreement& a, const Neighbourhood& around) {
  a.looseImpulse += around.mostImpulse - around.fewImpulse;
  a.looseShadow += around.mostShadow - around.fewShadow;
}

void judgePixels(Surroundings& surroundings, Agreement& a) {
  for (std::size_t i = 0; i < a.pixels; ++i) {
    const Vec3 found = pixelOf(a.kernel.radiance, i), expected = pixelOf(a.reference.radiance, i);
    const bool same = sameHit(a, i);
    a.differentHits += !same;
    if (same) a.rmseSameHit += glm::dot(found - expected, found - expected) / 3;
    if (same && reference::maxComponent(glm::abs(found - expected)) <= kOutlier * a.mean) {
      a.rmse += glm::dot(found - expected, found - expected) / 3;
      continue;
    }
    ++a.outliers;
    const Neighbourhood around = surroundings.of(i);
    addLoose(a, around);
    if (explains(around, found, a.mean)) continue;
    if (same && !samePrimitive(a, i)) continue;  // of two faces in one plane either may show
    ++a.unexplained;
    fmt::print("pixel ({}, {}): {} {} {}, reference {} {} {}, nearby {} {} {} to {} {} {}\n",
               i % a.reference.radiance.width, i / a.reference.radiance.width, found.x, found.y, found.z,
               expected.x, expected.y, expected.z, around.low.x, around.low.y, around.low.z, around.high.x,
               around.high.y, around.high.z);
  }
  a.rmseSameHit =
      std::sqrt(a.rmseSameHit / static_cast<double>(std::max<std::size_t>(1, a.pixels - a.differentHits)));
  a.rmse = std::sqrt(a.rmse / static_cast<double>(std::max<std::size_t>(1, a.pixels - a.outliers)));
}

/// A light in the plane of a surface shines on it or not, by rounding, without a difference that is seen.
/// Where the outliers do not account for the rays, all pixels are asked.
void judgeCounts(Surroundings& surroundings, Agreement& a) {
  const auto& rays = a.kernel.stats.rays;
  if (apart(rays.impulse, a.reference.rays.impulse) <= a.looseImpulse &&
      apart(rays.shadow, a.reference.rays.shadow) <= a.looseShadow)
    return;
  a.looseImpulse = a.looseShadow = 0;
  for (std::size_t i = 0; i < a.pixels; ++i) addLoose(a, surroundings.of(i, 8));
}

}  // namespace

Agreement compareWithReference(const Scene& scene, Settings settings) {
  // What was hit comes from the whole kernels, one program for all scenes. What is judged are those that the
  // scene gets.
  Settings labelled = settings;
  labelled.aovs = labelled.keepAllFeatures = true;
  labelled.relaxedArithmetic = false;
  RenderResult labels = renderOnDevice(scene, labelled);
  settings.aovs = settings.aovs || settings.keepAllFeatures;
  RenderResult kernel =
      settings.keepAllFeatures && !settings.relaxedArithmetic ? labels : renderOnDevice(scene, settings);
  if (!settings.relaxedArithmetic) {
    EXPECT_EQ(differingPixels(kernel.radiance, labels.radiance), 0U) << "specialised kernels, whole ones";
  }
  kernel.aovs = std::move(labels.aovs);
  settings.aovs = true;
  Agreement a{std::move(kernel), renderReference(scene, settings)};
  a.pixels = a.reference.depth.pixels.size();
  for (const float value : a.reference.radiance.pixels) a.mean += static_cast<double>(value);
  a.mean /= static_cast<double>(a.reference.radiance.pixels.size());
  Surroundings surroundings(scene, settings);
  judgePixels(surroundings, a);
  judgeCounts(surroundings, a);
  return a;
}

void expectAgreement(const Agreement& a, const std::string& name, std::size_t outliers,
                     std::size_t unexplained) {
  const auto& rays = a.kernel.stats.rays;
  const RayCounts& expected = a.reference.rays;
  fmt::print(
      "{}: mean {:.4g}, rmse/mean {:.2e}, with outliers {:.2e}, other hits {}, outliers {}, impulse {} "
      "(reference {}, loose {}), "
      "shadow {} (reference {}, loose {})\n",
      name, a.mean, a.rmse / a.mean, a.rmseSameHit / a.mean, a.differentHits, a.outliers, rays.impulse,
      expected.impulse, a.looseImpulse, rays.shadow, expected.shadow, a.looseShadow);
  // A ray within rounding of a silhouette may take either side: one pixel of so small a picture.
  EXPECT_LE(a.differentHits, std::max<std::size_t>(1, a.pixels / 100000)) << name;
  EXPECT_LE(a.outliers, outliers) << name;
  EXPECT_LE(a.unexplained, unexplained) << name;
  EXPECT_LE(a.rmse, 1e-4 * a.mean) << name;
  EXPECT_EQ(rays.primary, expected.primary) << name;
  EXPECT_LE(apart(rays.impulse, expected.impulse), a.looseImpulse) << name;
  EXPECT_LE(apart(rays.shadow, expected.shadow), a.looseShadow) << name;
  EXPECT_EQ(a.kernel.stats.dropped, 0U) << name;
  EXPECT_EQ(a.kernel.stats.nonFinite, a.reference.nonFinite) << name;
}

}  // namespace whittle::test
