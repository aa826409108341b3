// The recursion: Li and Lo of README.md, shadow rays, impulses.
#include "reference/trace.h"

#include <algorithm>
#include <array>
#include <utility>

#include "reference/camera.h"
#include "reference/emitters.h"
#include "reference/lights.h"
#include "reference/ray_notes.h"
#include "reference/sampler.h"
#include "reference/sky.h"
#include "reference/texture.h"
#include "scene/light_size.h"

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

/// Towards a light, from just above the surface; `length` metres of it lie before the light.
struct ShadowRay {
  Ray ray;
  double length;
};

ShadowRay shadowRay(const Surfel& surfel, const Vec3& w_i, double distance) {
  const ShadowRay flat{{surfel.position + surfel.rayOffset * surfel.facing, w_i},
                       distance - 2 * surfel.rayOffset};
  if (!surfel.lift) return flat;
  const Vec3 origin = flat.ray.origin + *surfel.lift;
  if (!std::isfinite(distance) || !(flat.length > 0)) return {{origin, w_i}, flat.length};
  const Vec3 along = flat.length * w_i - *surfel.lift;
  return {{origin, glm::normalize(along)}, glm::length(along)};
}

std::uint32_t roundOf(const Step& step) { return static_cast<std::uint32_t>(step.bounce + step.passed); }

/// Where the sample lies in the square whose dimensions begin there.
Vec2 squareOf(const World& world, const Sample& sample, std::uint32_t dimension) {
  const Settings& s = world.settings;
  return squarePosition(s.sampler, sample.pixel, sample.index, static_cast<std::uint32_t>(s.raysPerPixel),
                        dimension, s.seed);
}

/// The light with that index, by the point of it that is this sample's at this step.
LightSample lightFor(const World& world, const Sample& sample, const Step& step, std::size_t index,
                     const Surfel& lit) {
  const Light& light = world.scene.lights[index];
  const LightSample middle = sampleLight(light, lit.position);
  if (!standsForOthers(light.kind) && !hasSize(light, world.settings)) return middle;
  const std::uint32_t dimension =
      kLightDimension + 8 * (roundOf(step) + kRounds * static_cast<std::uint32_t>(index));
  const Vec2 at = squareOf(world, sample, dimension);
  if (light.kind == LightKind::Surface)
    return sampleEmitter(world.scene, world.settings, world.triangles, world.emitters, lit,
                         squareOf(world, sample, dimension + kChoiceDimension).x, at);
  if (light.kind == LightKind::Sky) return sampleSky(world.scene.background, world.sky, lit, at);
  return spread(light, middle, world.settings, at);
}

/// Of one light what it brings to one side of a surface: `lit`, which is the surfel or turned over.
Vec3 lightOnSide(const World& world, const Sample& sample, const Step& step, std::size_t i,
                 const Surfel& surfel, const Surfel& lit, const Vec3& w_o, RayNotes& notes) {
  const Light& light = world.scene.lights[i];
  const auto [w_i, distance, biradiance] = lightFor(world, sample, step, i, lit);
  const double cosine = glm::dot(lit.n, w_i);
  if (!(cosine > 0 && (lit.lift || glm::dot(lit.facing, w_i) > 0))) return Vec3(0);
  const Vec3 unshadowed =
      surfel.alpha * spreadingBsdf(surfel, w_i, w_o, standsForOthers(light.kind)) * biradiance * cosine;
  if (isDark(unshadowed)) return Vec3(0);
  if (!light.castsShadows || !world.settings.shadows) {
    notes.local(unshadowed);
    return unshadowed;
  }
  ++sample.rays.shadow;
  const Vec3 visible = visibility(world, lit, w_i, distance);
  const Vec3 arrived = isDark(visible) ? Vec3(0) : unshadowed * visible;  // not NaN times 0
  const auto [ray, length] = shadowRay(lit, w_i, distance);
  notes.shadowRay(i, ray, length, unshadowed, arrived);
  return arrived;
}

Vec3 directLight(const World& world, const Sample& sample, const Step& step, const Surfel& surfel,
                 const Vec3& w_o, RayNotes& notes) {
  Vec3 sum(0);
  for (std::size_t i = 0; i < world.scene.lights.size(); ++i) {
    sum += lightOnSide(world, sample, step, i, surfel, surfel, w_o, notes);
    if (surfel.diffuseTransmission > 0)
      sum += lightOnSide(world, sample, step, i, surfel, turnedOver(surfel), w_o, notes);
  }
  return sum;
}

/// Impulses have a limit, what goes straight on another. Surfaces that do both would make thousands of rays
/// of one: after as many of them as there are bounces, impulses that carry little are not followed.
bool isFollowed(const Settings& settings, const Impulse& impulse, const Step& step, const Vec3& share) {
  constexpr double kLittle = 1.0 / 8;
  if (impulse.straight) return step.passed < settings.transparentBounces;
  const bool hasBranched = step.bounce + step.branched >= settings.bounces;
  return step.bounce < settings.bounces && !(hasBranched && maxComponent(share) < kLittle);
}

Vec3 impulseLight(const World& world, const Sample& sample, const Ray& arrived, const Hit& hit,
                  const Surfel& surfel, const Step& step, const Vec3& throughput, RayNotes& notes) {
  const bool hasFacets = surfel.glossy || surfel.coat.glossy;
  const Vec2 facets = hasFacets ? squareOf(world, sample, kGlossDimension + 8 * roundOf(step)) : Vec2(0);
  Impulses impulses = impulsesOf(surfel, -arrived.direction, facets);
  if (world.settings.impulses == ImpulseMode::One) {
    const auto dimension = static_cast<std::uint32_t>(kImpulseDimension + step.bounce + step.passed);
    impulses = chooseOne(carriedBy(impulses, throughput),
                         unit(hash(sample.pixel, sample.index, dimension, world.settings.seed)));
  }
  const bool branches = impulses.count > 1 && (impulses.items[0].straight || impulses.items[1].straight);
  const Step passing{step.bounce, step.passed + 1, std::min(step.branched + (branches ? 1 : 0), 63),
                     hit,         notes.index(),   step.cone};
  Vec3 sum(0), refracted(0);
  for (const Impulse& impulse : impulses.all())
    if (impulse.splits) refracted += throughput * impulse.magnitude;
  bool isCounted = false;  // that what splits has ended
  for (const Impulse& impulse : impulses.all()) {
    const Vec3 share = throughput * impulse.magnitude;
    if (!anyPositive(share)) {
      if (!isDark(share))
        notes.local(share), sum += share;  // NaN: not traced, but the sample counts as not finite
      continue;
    }
    const Vec3 whole = impulse.splits ? refracted : share;
    const bool goesOn = isFollowed(world.settings, impulse, step, whole);
    const bool isWeak = glm::all(glm::lessThanEqual(whole, Vec3(world.settings.cutoff)));
    if (!goesOn || isWeak) {
      if (impulse.splits && std::exchange(isCounted, true)) continue;
      double& ended = goesOn             ? sample.rays.cutOff
                      : impulse.straight ? sample.rays.straight
                                         : sample.rays.bounces;
      ended += maxComponent(whole);
      notes.ended(whole, goesOn);
      continue;
    }
    ++sample.rays.impulse;
    if (impulse.straight) {
      sum += impulse.magnitude * Li(world, sample, arrived, passing, share);
      continue;
    }
    const double side = impulse.through ? -1 : 1;
    const Ray ray{surfel.position + side * surfel.rayOffset * surfel.facing, impulse.w_i};
    const Cone cone = afterImpulse(step.cone, widthAt(step.cone, hit.t), surfel, arrived.direction, impulse);
    const Step next{step.bounce + 1, step.passed, step.branched, {}, notes.index(), cone};
    sum += impulse.magnitude * Li(world, sample, ray, next, share);
  }
  return sum;
}

/// What a hit's place in the order is. A blended surface comes a little earlier than it lies, so that a decal
/// shows that lies exactly in the plane of a wall.
double orderOf(const World& world, const Hit& hit) {
  const Triangle& triangle = world.scene.triangles[hit.triangle];
  const bool coats = world.scene.materials[triangle.material].alphaMode == AlphaMode::Blend;
  return coats ? hit.t * (1 - 0x1p-20) : hit.t;
}

bool isBefore(const World& world, const Hit& a, const Hit& b) {
  const double first = orderOf(world, a), second = orderOf(world, b);
  return first < second || (first == second && a.triangle < b.triangle);
}

/// What lets light through takes its share of it once, even where a ray meets the edge of two triangles.
bool dimsHere(const World& world, const Ray& ray, const Hit& hit) {
  const Material& m = world.scene.materials[world.scene.triangles[hit.triangle].material];
  const bool filters = m.alphaMode == AlphaMode::Blend || (m.transmission > 0 && !m.unlit);
  if (!filters || (hit.barycentric.x != 0 && hit.barycentric.y != 0 && hit.barycentric.z != 0)) return true;
  return ownsHit(ShearedRay(ray), world.triangles.corners(hit.triangle));
}

/// Whether eye and impulse rays see this side of the triangle.
bool showsSide(const World& world, const Ray& ray, const Hit& hit) {
  const Material& m = world.scene.materials[world.scene.triangles[hit.triangle].material];
  const bool lightPasses = m.volume || (m.transmission > 0 && !m.unlit);
  if (m.doubleSided || lightPasses || world.settings.backFaces == BackFaces::Show) return true;
  const auto [p0, p1, p2] = world.triangles.corners(hit.triangle);
  return glm::dot(glm::cross(p1 - p0, p2 - p0), ray.direction) < 0;
}

bool isFiniteInSinglePrecision(const Vec3& v) { return isFinite(Vec3(glm::vec3(v))); }

}  // namespace

std::optional<Hit> nearestSurface(const World& world, const Ray& ray, const std::optional<Hit>& after,
                                  double nearest) {
  constexpr double kCoats = 1 + 0x1p-19;  // what comes before a hit lies before this much of its distance
  std::optional<Hit> best;
  world.triangles.visitHits(ray, std::numeric_limits<double>::infinity(), [&](const Hit& hit) {
    if (orderOf(world, hit) > nearest && (!after || isBefore(world, *after, hit)) &&
        (!best || isBefore(world, hit, *best)) && showsSide(world, ray, hit) &&
        passesMask(world.scene, hit) && dimsHere(world, ray, hit))
      best = hit;
    return best ? best->t * kCoats : std::numeric_limits<double>::infinity();
  });
  return best;
}

Vec3 visibility(const World& world, const Surfel& surfel, const Vec3& w_i, double distance) {
  const ShadowRay shadow = shadowRay(surfel, w_i, distance);
  const Ray& ray = shadow.ray;
  const double length = shadow.length;
  if (!(length > 0)) return Vec3(1);

  // Opacity in units of 2⁻¹⁶ stops: a sum of integers does not depend on the order of the surfaces.
  constexpr std::int64_t kBlocked = 1 << 20;
  std::array<std::int64_t, 3> opacity{};
  world.triangles.visitHits(ray, length, [&](const Hit& hit) {
    if (!(hit.t < length) || !dimsHere(world, ray, hit)) return length;
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

Vec3 Li(const World& world, const Sample& sample, const Ray& ray, const Step& step, const Vec3& throughput,
        std::optional<Hit>* seen) {
  RayNotes notes(sample.tree, ray, step, throughput);
  // The camera's planes concern what the eye sees, straight on.
  const double along = glm::dot(ray.direction, Vec3(world.camera.forward)), znear = world.camera.znear;
  const bool fromEye = step.bounce == 1;
  std::optional<Hit> hit = nearestSurface(world, ray, step.after, fromEye && znear > 0 ? znear / along : 0);
  if (hit && fromEye && world.settings.clipFar && hit->t * along > static_cast<double>(world.camera.zfar))
    hit.reset();
  if (seen) *seen = hit;
  if (!hit && fromEye && world.settings.alpha) {
    if (sample.transmittance) *sample.transmittance += (throughput.x + throughput.y + throughput.z) / 3;
    return Vec3(0);
  }
  if (!hit) {
    const Vec3 background = backgroundRadiance(world.scene.background, ray.direction);
    notes.local(background);
    return background;
  }
  const Surfel surfel = makeSurfel(world.scene, world.settings, world.triangles, ray, *hit,
                                   {&world.levels, widthAt(step.cone, hit->t)});
  const Vec3 kept = absorption(surfel, hit->t - (step.after ? step.after->t : 0));
  notes.meets(world, ray, *hit, surfel, kept);
  Vec3 radiance = surfel.alpha * (surfel.unlit ? surfel.baseColor : surfel.emission);
  if (!surfel.unlit) {
    const double ambient = ambientOf(world.scene, world.settings);
    if (ambient > 0) radiance += surfel.alpha * ambient * ambientReflectance(surfel, -ray.direction);
    notes.local(radiance);
    radiance += directLight(world, sample, step, surfel, -ray.direction, notes);
  } else {
    notes.local(radiance);
  }
  radiance += impulseLight(world, sample, ray, *hit, surfel, step, throughput * kept, notes);
  return kept * radiance;
}

namespace {

std::uint32_t pixelIndex(const World& world, int x, int y) {
  return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(world.settings.width) + x;
}

Ray eyeRayOf(const World& world, int x, int y, std::uint32_t sample) {
  const Settings& s = world.settings;
  const Vec2 within = samplePosition(s.sampler, pixelIndex(world, x, y), sample,
                                     static_cast<std::uint32_t>(s.raysPerPixel), s.seed);
  const Ray pinhole = eyeRay(world.camera, Vec2(x, y) + within, s.width, s.height);
  if (!(s.aperture > 0)) return pinhole;
  return throughLens(world.camera, pinhole, s.aperture, s.focusDistance.value_or(1.0F),
                     squarePosition(s.sampler, pixelIndex(world, x, y), sample,
                                    static_cast<std::uint32_t>(s.raysPerPixel), kLensDimension, s.seed));
}

Step eyeStep(const World& world, const Ray& ray, std::uint32_t sample) {
  return {.cone = eyeCone(world.camera, world.settings, ray, sample)};
}

}  // namespace

RayTree treeOfSample(const World& world, int x, int y, std::uint32_t sample) {
  RayTree tree;
  RayCounts rays;
  const Sample traced{pixelIndex(world, x, y), sample, rays, nullptr, &tree};
  const Ray ray = eyeRayOf(world, x, y, sample);
  const Vec3 radiance = Li(world, traced, ray, eyeStep(world, ray, sample), Vec3(1));
  tree.radiance = isFiniteInSinglePrecision(radiance) ? radiance : Vec3(0);
  return tree;
}

PixelResult traceOnePixel(const World& world, int x, int y, RayCounts& rays) {
  const std::uint32_t pixel = pixelIndex(world, x, y);
  const auto count = static_cast<std::uint32_t>(world.settings.raysPerPixel);
  PixelResult result;
  for (std::uint32_t s = 0; s < count; ++s) {
    const Ray ray = eyeRayOf(world, x, y, s);
    ++rays.primary;
    double transmittance = 0;
    const Vec3 radiance = Li(world, {pixel, s, rays, &transmittance}, ray, eyeStep(world, ray, s), Vec3(1),
                             s == 0 ? &result.seen : nullptr);
    if (isFiniteInSinglePrecision(radiance)) {
      result.radiance += radiance;
      result.transmittance += transmittance;
    } else {
      ++result.nonFinite;
    }
  }
  result.radiance /= count;
  result.transmittance /= count;
  return result;
}

}  // namespace whittle::reference
