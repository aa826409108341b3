// The recursion: Li and Lo of README.md, shadow rays, impulses.
#include "reference/trace.h"

#include <array>

#include "reference/camera.h"
#include "reference/lights.h"
#include "reference/sampler.h"
#include "reference/texture.h"

namespace whittle::reference {
namespace {

/// e^(−σ t) where the ray has crossed the inside of a solid, otherwise 1.
Vec3 absorption(const Surfel& surfel, double t) {
  Vec3 kept(1);
  for (int i = 0; i < 3 && surfel.volume && !surfel.front; ++i) {
    if (surfel.sigma_a[i] > 0 && t > 0) kept[i] = std::exp(-surfel.sigma_a[i] * t);
  }
  return kept;
}

Vec3 directLight(const World& world, const Sample& sample, const Surfel& surfel, const Vec3& w_o) {
  Vec3 sum(0);
  for (const Light& light : world.scene.lights) {
    const auto [w_i, distance, biradiance] = sampleLight(light, surfel.position);
    const double cosine = glm::dot(surfel.n, w_i);
    if (!(cosine > 0 && glm::dot(surfel.facing, w_i) > 0)) continue;
    const Vec3 unshadowed = surfel.alpha * spreadingBsdf(surfel, w_i, w_o) * biradiance * cosine;
    if (isDark(unshadowed)) continue;
    if (light.castsShadows && world.settings.shadows) {
      ++sample.rays.shadow;
      const Vec3 visible = visibility(world, surfel, w_i, distance);
      if (!isDark(visible)) sum += unshadowed * visible;  // not NaN times 0
    } else {
      sum += unshadowed;
    }
  }
  return sum;
}

Vec3 impulseLight(const World& world, const Sample& sample, const Surfel& surfel, const Vec3& w_o, int depth,
                  const Vec3& throughput) {
  Impulses impulses = impulsesOf(surfel, w_o);
  if (world.settings.impulses == ImpulseMode::One) {
    impulses = chooseOne(
        impulses, unit(hash(sample.pixel, sample.index, kImpulseDimension + depth, world.settings.seed)));
  }
  Vec3 sum(0);
  for (const Impulse& impulse : impulses.all()) {
    const Vec3 share = throughput * impulse.magnitude;
    if (!anyPositive(share)) {
      if (!isDark(share)) sum += share;  // NaN: not traced, but the sample counts as not finite
      continue;
    }
    if (glm::all(glm::lessThanEqual(share, Vec3(world.settings.cutoff)))) {
      sample.rays.cutOff += maxComponent(share);
      continue;
    }
    ++sample.rays.impulse;
    const double side = impulse.through ? -1 : 1;
    const Ray ray{surfel.position + side * surfel.rayOffset * surfel.facing, impulse.w_i};
    sum += impulse.magnitude * Li(world, sample, ray, depth + 1, share);
  }
  return sum;
}

bool isFiniteInSinglePrecision(const Vec3& v) { return isFinite(Vec3(glm::vec3(v))); }

}  // namespace

std::optional<Hit> nearestSurface(const World& world, const Ray& ray) {
  return world.triangles.nearestHit(ray, [&](const Hit& hit) { return passesMask(world.scene, hit); });
}

Vec3 visibility(const World& world, const Surfel& surfel, const Vec3& w_i, double distance) {
  const Ray ray{surfel.position + surfel.rayOffset * surfel.facing, w_i};
  const double length = distance - 2 * surfel.rayOffset;
  if (!(length > 0)) return Vec3(1);

  // Opacity in units of 2⁻¹⁶ stops: a sum of integers does not depend on the order of the surfaces.
  constexpr std::int64_t kBlocked = 1 << 20;
  std::array<std::int64_t, 3> opacity{};
  world.triangles.visitHits(ray, length, [&](const Hit& hit) {
    if (!(hit.t < length)) return length;
    const Vec3 kept = shadowTransmittance(world.scene, world.triangles, ray, hit);
    bool blocked = true;
    for (int i = 0; i < 3; ++i) {
      opacity[i] += kept[i] > 0x1p-17 ? std::llround(-std::log2(kept[i]) * 0x1p16) : kBlocked + 1;
      blocked = blocked && opacity[i] > kBlocked;
    }
    return blocked ? -1.0 : length;
  });
  Vec3 kept;
  for (int i = 0; i < 3; ++i) {
    kept[i] = opacity[i] > kBlocked ? 0 : std::exp2(-static_cast<double>(opacity[i]) * 0x1p-16);
  }
  return kept;
}

Vec3 Li(const World& world, const Sample& sample, const Ray& ray, int depth, const Vec3& throughput,
        std::optional<Hit>* seen) {
  const std::optional<Hit> hit = nearestSurface(world, ray);
  if (seen) *seen = hit;
  if (!hit) return backgroundRadiance(world.scene.background, ray.direction);
  const Surfel surfel = makeSurfel(world.scene, world.settings, world.triangles, ray, *hit);
  const Vec3 kept = absorption(surfel, hit->t);
  return kept * Lo(world, sample, surfel, -ray.direction, depth, throughput * kept);
}

Vec3 Lo(const World& world, const Sample& sample, const Surfel& surfel, const Vec3& w_o, int depth,
        const Vec3& throughput) {
  Vec3 radiance = surfel.alpha * (surfel.unlit ? surfel.baseColor : surfel.emission);
  if (!surfel.unlit) radiance += directLight(world, sample, surfel, w_o);
  if (depth < world.settings.bounces) radiance += impulseLight(world, sample, surfel, w_o, depth, throughput);
  return radiance;
}

PixelResult traceOnePixel(const World& world, int x, int y, RayCounts& rays) {
  const Settings& settings = world.settings;
  const auto pixel = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(settings.width) + x;
  const auto count = static_cast<std::uint32_t>(settings.raysPerPixel);
  PixelResult result;
  for (std::uint32_t s = 0; s < count; ++s) {
    const Vec2 position = Vec2(x, y) + samplePosition(settings.sampler, pixel, s, count, settings.seed);
    const Ray ray = eyeRay(world.camera, position, settings.width, settings.height);
    ++rays.primary;
    const Vec3 radiance = Li(world, {pixel, s, rays}, ray, 1, Vec3(1), s == 0 ? &result.seen : nullptr);
    if (isFiniteInSinglePrecision(radiance)) {
      result.radiance += radiance;
    } else {
      ++result.nonFinite;
    }
  }
  result.radiance /= count;
  return result;
}

}  // namespace whittle::reference
