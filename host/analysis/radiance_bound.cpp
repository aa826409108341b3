// The bound, after host/reference/README.md. L bounds the radiance along any ray, however often it is
// reflected, if it is at least the background and, for each material, what a surface sends back when L
// arrives along its impulses:
//
//   a [emission + direct + (magnitudes of its impulses) L] + (1 − a) L
//
// A coat that reflects R leaves 1 − R to what lies below it, so the same holds for R. Fibres add what they
// scatter.
//
// A surface shares one unit of light between what it scatters and its impulses, so the terms do not add up:
// the expression is linear in each of coverage a, metallic m, transmission τ and the Fresnel reflectance F,
// so that its maximum is at an end of each one's range. It is convex in L, and so is the largest over all
// materials: the least L that satisfies all of them is found by bisection. There is none where something
// that emits also reflects or lets through everything: two mirrors that glow add up for ever. A hall of
// mirrors that do not glow adds nothing.
//
// An impulse of throughput T that is not followed takes at most T L from its sample; these are added up over
// the picture. Absorption only takes away. Samples that are not finite are not meant.
#include "analysis/radiance_bound.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <utility>

#include "analysis/largest_biradiance.h"
#include "kernels/shared/layout.h"
#include "scene/material_factors.h"
#include "scene/material_predicates.h"
#include "scene/sky_light.h"

namespace whittle {
namespace {

/// Shares of single precision may sum to a little more than 1 at each hit.
constexpr double kRounding = 1 + 1e-5;

/// 0 · ∞ = 0: light that does not count need not be bounded.
double times(double share, double radiance) { return share == 0 ? 0 : share * radiance; }

/// The ends of a factor's range: a texture may scale it down to 0.
struct Interval {
  double low, high;
};
Interval rangeOf(float factor, bool textured) {
  const double high = std::clamp(static_cast<double>(factor), 0.0, 1.0);
  return {textured ? 0 : high, high};
}

/// Upper bounds on what a material does anywhere on it.
struct Surface {
  glm::dvec3 own{0};        ///< radiance that it gives off by itself
  glm::dvec3 color{0};      ///< of its metal and of what it lets through
  glm::dvec3 matte{0};      ///< direct light that Lambert's part would return, were it all
  glm::dvec3 highlight{0};  ///< the same for the microfacet lobe
  Interval metallic{0, 0}, transmission{0, 0};
  double specular = 0;
  bool smooth = false, rough = false, volume = false, blends = false;
  glm::dvec3 sheen{0};          ///< direct light that its fibres return
  glm::dvec3 coatHighlight{0};  ///< the same for the lobe of a coat, were it to reflect all
  double coat = 0;              ///< the most that the coat reflects
  bool coatReflects = false;    ///< sends out impulses
  bool glossy = false;          ///< where it is rough it sends out impulses too
  bool turnsRays = false;       ///< sends out impulses that do not go straight on
};

/// D V cos for microfacets of at least this alpha. D = α²/(π ((n·h)²(α² − 1) + 1)²) is largest at n·h = 1,
/// which single precision exceeds by up to 3e-7; V cosᵢ <= ½ / sqrt(α² + (1 − α²) cos²ₒ) <= ½/α.
double largestLobe(double alpha) {
  const double a2 = alpha * alpha, least = a2 - 7e-7;
  return a2 / (std::numbers::pi * least * least) * 0.5 / alpha;
}

/// D V cos of fibres of at least this roughness: D is largest across the normal; V cosᵢ <= 1/(4 cosₒ (1 +
/// Λ(cosₒ))), which is at most 0.39 for the roughest fibres (host/reference/sheen.cpp).
double largestFibreLobe(double roughness) {
  const double least = std::max(roughness, 0.07);
  return (2 + 1 / (least * least)) / (2 * std::numbers::pi) * 0.4;
}

/// In range. A base colour (`color`: with the vertices') may be any that is not negative; metallic and
/// roughness are clamped where they are read.
bool isUsual(const Material& m, const glm::dvec3& color) {
  Material bounded = m;
  bounded.baseColor = glm::vec4(1);
  bounded.metallic = bounded.roughness = 1;
  return isInRange(bounded) && color.x >= 0 && color.y >= 0 && color.z >= 0 &&
         std::isfinite(color.x + color.y + color.z);
}

/// What reaches a material.
struct Arriving {
  glm::dvec3 biradiance;  ///< of all lights with a place or a direction
  glm::dvec3 allAround;   ///< radiance from all sides
};

/// What lies over a surface; s: what lies below.
void addLayers(const Material& m, const Settings& settings, const Arriving& arriving, Surface& s) {
  const float mirrorRoughness = settings.mirrorRoughness;
  s.coat = std::clamp(static_cast<double>(m.clearcoat), 0.0, 1.0);
  s.coatReflects = coatCanReflect(m, reflectingRoughness(settings));
  const bool isRough = coatCanBeRough(m, mirrorRoughness);
  const float least = coatCanReflect(m, mirrorRoughness) ? mirrorRoughness : m.clearcoatRoughness;
  const double lobe = largestLobe(std::max(static_cast<double>(least) * least, 1e-3));
  const double fibres =
      largestFibreLobe(m.sheenRoughnessTexture.used() ? 0 : static_cast<double>(m.sheenRoughness));
  for (int c = 0; c < 3; ++c) {
    const double around = arriving.allAround[c],
                 color = hasSheen(m) ? static_cast<double>(m.sheenColor[c]) : 0;
    s.sheen[c] = times(color, times(fibres, arriving.biradiance[c]) + around);
    if (isRough) s.coatHighlight[c] = times(lobe, arriving.biradiance[c]) + around;
  }
}

/// vertexColor: the largest of the scene.
Surface surfaceOf(const Material& m, const Settings& settings, const glm::dvec3& vertexColor,
                  const Arriving& arriving) {
  const float mirrorRoughness = settings.mirrorRoughness;
  Surface s;
  s.color = glm::dvec3(m.baseColor) * vertexColor;
  s.blends = blends(m);
  s.own = isLit(m) ? glm::dvec3(m.emission) : s.color;
  if (!isUsual(m, s.color)) s.own = glm::dvec3(std::numeric_limits<double>::infinity());
  if (!isLit(m)) return s;
  const bool textured = m.metallicRoughnessTexture.used();
  const Interval roughness = rangeOf(m.roughness, textured);
  s.smooth = canBeSmooth(m, mirrorRoughness) && mirrorRoughness > 0;
  s.rough = canBeRough(m, mirrorRoughness);
  s.metallic = rangeOf(m.metallic, textured);
  s.transmission = rangeOf(m.transmission, m.transmissionTexture.used());
  s.specular = m.specular;
  s.volume = m.volume;
  s.glossy = settings.glossy;
  s.turnsRays = canReflect(m, reflectingRoughness(settings)) || refracts(m);
  const double least = std::max(roughness.low, s.smooth ? static_cast<double>(mirrorRoughness) : 0.0);
  const double lobe = largestLobe(std::max(least * least, 1e-3));
  for (int c = 0; c < 3; ++c) {
    const double around = arriving.allAround[c];
    // What is sent back to one side comes from the other with another colour, none of it from both.
    const double through = transmitsDiffusely(m) ? static_cast<double>(m.diffuseTransmissionColor[c]) : 0.0;
    const double matte = std::max(s.color[c], through);
    s.matte[c] = times(matte / std::numbers::pi, arriving.biradiance[c]) + around * matte;
    s.highlight[c] = times(lobe, arriving.biradiance[c]) + around * std::max(1.0, s.color[c]);
  }
  if (isIridescent(m)) s.specular = 1;
  addLayers(m, settings, arriving, s);
  return s;
}

/// What channel c of a dielectric (metallic 0) or a metal (1) of transmission `tau` sends back
/// when L arrives.
double returnedBySmooth(const Surface& s, int c, double metallic, double tau, double L) {
  const double dielectric = std::max(L, times(1 - tau, s.matte[c]) + times(tau * s.color[c], L));
  return times(1 - metallic, dielectric) + times(metallic * std::max(1.0, s.color[c]), L);
}

/// A rough one lets light through, and reflects what is totally reflected inside a solid, or with
/// gloss everything.
double returnedByRough(const Surface& s, int c, double metallic, double tau, double L) {
  const bool reflects = s.glossy || (s.volume && tau > 0);
  const double matte = times(1 - tau, s.matte[c]);
  const double lobe = s.highlight[c] + (s.glossy ? L : 0);  // its share of the light is one and the same
  const double scattered = std::max(matte, times(1 - s.specular, matte) + times(s.specular, lobe));
  const double through = times(std::max(tau * s.color[c], reflects ? 1.0 : 0.0), L);
  const double metal = std::max(1.0, s.color[c]) * (s.highlight[c] + (reflects ? L : 0));
  return times(1 - metallic, scattered + through) + times(metallic, metal);
}

double returned(const Surface& s, int c, double L) {
  double most = 0;
  for (const double metallic : {s.metallic.low, s.metallic.high})
    for (const double tau : {s.transmission.low, s.transmission.high}) {
      if (s.smooth) most = std::max(most, returnedBySmooth(s, c, metallic, tau, L));
      if (s.rough) most = std::max(most, returnedByRough(s, c, metallic, tau, L));
    }
  const double below = s.own[c] + most + s.sheen[c];
  const double coated =
      times(1 - s.coat, below) + times(s.coat, s.coatHighlight[c] + (s.coatReflects ? L : 0));
  const double radiance = std::max(below, coated);
  return s.blends ? std::max(radiance, L) : radiance;
}

glm::dvec3 largestBackground(const Background& background) {
  glm::dvec3 largest(background.map.empty() ? 1.0 : 0.0);
  for (std::size_t i = 0; i < background.map.size(); ++i) {
    double& channel = largest[static_cast<int>(i % 3)];
    channel = std::max(channel, static_cast<double>(background.map[i]));
  }
  return largest * glm::dvec3(background.radiance);
}

/// Of the ambient term, or of what may arrive from the sky, in the mean of its samples.
glm::dvec3 radianceAllAround(const Scene& scene, const Settings& settings) {
  if (hasSkyLight(scene)) return largestBackground(scene.background);
  return glm::dvec3(ambientOf(scene, settings));
}

/// All materials that some triangle has.
std::vector<Surface> surfacesOf(const Scene& scene, const Settings& settings) {
  glm::dvec3 vertexColor(1), least(0);
  for (const glm::vec4& color : scene.colors) {
    vertexColor = glm::max(vertexColor, glm::dvec3(color));
    least = glm::min(least, glm::dvec3(color));
  }
  if (least != glm::dvec3(0)) vertexColor = least;  // not usual
  std::vector<bool> used(scene.materials.size(), false);
  for (const Triangle& t : scene.triangles) used[t.material] = true;
  const std::vector<glm::dvec3> biradiance = largestBiradiance(scene, settings);
  const glm::dvec3 allAround = radianceAllAround(scene, settings);
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (used[i])
      surfaces.push_back(surfaceOf(scene.materials[i], settings, vertexColor, {biradiance[i], allAround}));
  return surfaces;
}

/// What may differ between the two sides of `isBound` by rounding, and how far above what one hit returns a
/// bound is looked for: beyond that it is of no use.
constexpr double kSlack = 1 + 1e-12, kFarthest = 1e6;

/// The least L with f(L) <= L, for a convex f that rises; infinite: there is none below kFarthest f(0).
template <typename F>
double leastBound(const F& f) {
  const auto isBound = [&](double radiance) { return f(radiance) <= radiance * kSlack; };
  double low = f(0.0);
  if (low == 0.0 || !std::isfinite(low) || isBound(low)) return low;
  double high = low * kFarthest;
  if (!isBound(high)) return std::numeric_limits<double>::infinity();
  while (high > low * (1 + 1e-9)) {
    const double middle = std::sqrt(low) * std::sqrt(high);
    (isBound(middle) ? high : low) = middle;
  }
  return high;
}

glm::dvec3 boundOf(const std::vector<Surface>& surfaces, const glm::dvec3& background) {
  glm::dvec3 bound;
  for (int c = 0; c < 3; ++c)
    bound[c] = kRounding * leastBound([&](double arriving) {
                 double most = background[c];
                 for (const Surface& s : surfaces) most = std::max(most, returned(s, c, arriving));
                 return most;
               });
  return bound;
}

/// The most that a surface which reflects or refracts sends back of `arriving`, without what it
/// gives off itself.
glm::dvec3 largestImpulses(std::vector<Surface> surfaces, const glm::dvec3& arriving) {
  glm::dvec3 most(0);
  for (Surface& s : surfaces) {
    if (!s.turnsRays) continue;
    s.own = s.matte = s.highlight = s.sheen = s.coatHighlight = glm::dvec3(0);
    for (int c = 0; c < 3; ++c) most[c] = std::max(most[c], returned(s, c, arriving[c]));
  }
  return most;
}

}  // namespace

glm::dvec3 radianceBound(const Scene& scene, const Settings& settings) {
  return boundOf(surfacesOf(scene, settings), largestBackground(scene.background));
}

double meanRadiance(const FloatImage& radiance) {
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i + 2 < radiance.pixels.size(); i += 3)
    sum += glm::dvec3(radiance.pixels[i], radiance.pixels[i + 1], radiance.pixels[i + 2]);
  const std::size_t pixels = radiance.pixels.size() / 3;
  return std::max(sum.x, std::max(sum.y, sum.z)) / static_cast<double>(pixels);
}

EndedThroughput endedThroughput(const EndedUnits& units) {
  const auto throughput = [&](std::size_t kind) {
    return static_cast<double>(units[kind]) / static_cast<double>(ENDED_UNITS);
  };
  return {throughput(ENDED_CUTOFF), throughput(ENDED_BOUNCES), throughput(ENDED_STRAIGHT)};
}

double biasBound(const Scene& scene, const Settings& settings, double endedPerSample) {
  return BiasBound(scene, settings)(endedPerSample);
}

double BiasBound::operator()(double endedPerSample) {
  const bool counts = settings_.bounces > 1;
  if (endedPerSample == 0.0 && counts) return 0;
  if (!std::exchange(isKnown_, true)) {
    const std::vector<Surface> surfaces = surfacesOf(scene_, settings_);
    bound_ = boundOf(surfaces, largestBackground(scene_.background));
    if (!counts) impulses_ = largestImpulses(surfaces, bound_);
  }
  glm::dvec3 lost = impulses_;
  for (int c = 0; c < 3; ++c) lost[c] += times(endedPerSample, bound_[c]);
  return std::max(lost.x, std::max(lost.y, lost.z));
}

}  // namespace whittle
