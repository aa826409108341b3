// Scattering in double precision. Metallic-roughness after the glTF 2.0 specification, appendix B (GGX,
// height-correlated Smith, Schlick); mirror directions after Whitted 1980.
#include "reference/bsdf.h"

#include <algorithm>
#include <optional>

namespace whittle::reference {
namespace {

constexpr double kMinAlpha = 1e-3;  // keeps the highlight finite where even r = 0 counts as rough

double alphaOf(const Surfel& s) { return std::max(square(s.roughness), kMinAlpha); }

/// Microfacet distribution times visibility: GGX, Walter et al. 2007; height-correlated Smith, Heitz 2014.
double microfacets(double alpha, double nh, double ni, double no) {
  const double a2 = alpha * alpha;
  const double D = a2 / (kPi * square(nh * nh * (a2 - 1) + 1));
  const double V = 0.5 / (ni * std::sqrt(a2 + (1 - a2) * no * no) + no * std::sqrt(a2 + (1 - a2) * ni * ni));
  return D * V;
}

Vec3 mirrored(const Vec3& w_o, const Vec3& n) { return 2 * glm::dot(n, w_o) * n - w_o; }

std::optional<Vec3> refracted(const Vec3& w_o, const Vec3& n, double eta) {
  const double cosI = glm::dot(n, w_o);
  if (totallyReflected(cosI, eta)) return std::nullopt;
  const double cosT = std::sqrt(1 - std::max(0.0, 1 - cosI * cosI) / (eta * eta));
  return glm::normalize(-w_o / eta + (cosI / eta - cosT) * n);
}

Vec3 reflectedDirection(const Surfel& surfel, const Vec3& w_o) {
  const Vec3 w_i = mirrored(w_o, surfel.n);
  return glm::dot(surfel.facing, w_i) > 0 ? w_i : mirrored(w_o, surfel.facing);
}

/// Where light seen through the surface comes from; nothing at total reflection.
std::optional<Vec3> transmittedDirection(const Surfel& surfel, const Vec3& w_o) {
  if (!surfel.volume || surfel.eta == 1) return -w_o;
  const auto w_i = refracted(w_o, surfel.n, surfel.eta);
  if (w_i && glm::dot(surfel.facing, *w_i) >= 0) return refracted(w_o, surfel.facing, surfel.eta);
  return w_i;
}

/// The normal of a microfacet that w_o sees, by how much of w_o each takes up: Heitz, "Sampling the GGX
/// Distribution of Visible Normals", JCGT 2018; by spherical caps, Dupuy and Benyoub 2023.
Vec3 visibleNormal(const Surfel& s, const Vec3& w_o, const Vec2& u) {
  const auto [right, up] = basisAbout(s.n);
  const double alpha = alphaOf(s), angle = 2 * kPi * u.x;
  const Vec3 seen =
      glm::normalize(Vec3(alpha * glm::dot(right, w_o), alpha * glm::dot(up, w_o), glm::dot(s.n, w_o)));
  const double z = (1 - u.y) * (1 + seen.z) - seen.z, across = std::sqrt(std::max(0.0, 1 - z * z));
  const Vec3 cap = Vec3(across * std::cos(angle), across * std::sin(angle), z) + seen;
  return glm::normalize(alpha * cap.x * right + alpha * cap.y * up + cap.z * s.n);
}

/// Smith's Λ (Heitz 2014).
double hidden(const Surfel& s, const Vec3& w) {
  const double c2 = square(glm::dot(s.n, w));
  return (std::sqrt(1 + square(alphaOf(s)) * std::max(0.0, 1 - c2) / c2) - 1) / 2;
}

/// Towards w_i from the sampled normal: G2/G1, height-correlated; 0 below the surface.
double reflectedShare(const Surfel& s, const Vec3& w_o, const Vec3& w_i) {
  if (!(glm::dot(s.n, w_i) > 0 && glm::dot(s.facing, w_i) > 0)) return 0;
  return (1 + hidden(s, w_o)) / (1 + hidden(s, w_o) + hidden(s, w_i));
}

/// Where a glossy surfel sends what goes through one of its facets, and G1 of the way there.
std::optional<Vec3> transmittedByFacet(const Surfel& s, const Vec3& w_o, const Vec3& facet, double& share) {
  if (!s.volume || s.eta == 1) return -w_o;
  const auto w_i = refracted(w_o, facet, s.eta);
  if (!w_i || !(glm::dot(s.facing, *w_i) < 0 && glm::dot(s.n, *w_i) < 0)) return std::nullopt;
  share = 1 / (1 + hidden(s, *w_i));
  return w_i;
}

}  // namespace

Vec3 spreadingBsdf(const Surfel& s, const Vec3& w_i, const Vec3& w_o, bool withoutGloss) {
  const double no = glm::dot(s.n, w_o);
  const Vec3 diffuse = (1 - s.transmission) * s.baseColor / kPi;
  if (s.smooth) return (1 - s.metallic) * (1.0 - s.fresnel.reflectance(no, s.eta)) * diffuse;

  const double ni = glm::dot(s.n, w_i);
  const Vec3 h = glm::normalize(w_i + w_o);
  const double oh = glm::dot(w_o, h);
  const double lobe = withoutGloss && s.glossy ? 0.0 : microfacets(alphaOf(s), glm::dot(s.n, h), ni, no);
  const Vec3 dielectric = schlick(s.fresnel.f0, s.fresnel.f90, oh);
  const Vec3 metal = schlick(s.baseColor, Vec3(1), oh);
  return (1 - s.metallic) * ((1 - maxComponent(dielectric)) * diffuse + dielectric * lobe) +
         s.metallic * metal * lobe;
}

Impulses impulsesOf(const Surfel& s, const Vec3& w_o, const Vec2& facets) {
  const Vec3 n = s.glossy ? visibleNormal(s, w_o, facets) : s.n;
  const double cosine = std::min(1.0, glm::dot(n, w_o));
  const bool isOpaqueGloss = s.glossy && !(s.transmission > 0);  // as its highlight has it
  const Vec3 dielectric =
      isOpaqueGloss ? schlick(s.fresnel.f0, s.fresnel.f90, cosine) : s.fresnel.reflectance(cosine, s.eta);
  Impulse straight{-w_o, Vec3(1 - s.alpha), true, true};
  Impulse transmission{-w_o, Vec3(0), true, !s.volume || s.eta == 1};
  Impulse reflection{w_o, Vec3(0), false};

  double share = 1;
  const auto beyond = !(s.transmission > 0) || s.unlit ? std::nullopt
                      : s.glossy                       ? transmittedByFacet(s, w_o, n, share)
                                                       : transmittedDirection(s, w_o);
  if (beyond) {
    transmission.w_i = *beyond;
    transmission.magnitude =
        share * s.alpha * (1 - s.metallic) * s.transmission * s.baseColor * (1.0 - dielectric);
  }
  const bool refracts = s.volume && s.transmission > 0 && s.eta != 1 && s.eta > 0;
  const bool reflectedInside = refracts && totallyReflected(cosine, s.eta);
  if ((s.smooth || s.glossy || reflectedInside) && !s.unlit) {
    const Vec3 metal = schlick(s.baseColor, Vec3(1), cosine);
    reflection.w_i = s.glossy ? mirrored(w_o, n) : reflectedDirection(s, w_o);
    reflection.magnitude = (s.glossy ? reflectedShare(s, w_o, reflection.w_i) : 1) * s.alpha *
                           ((1 - s.metallic) * dielectric + s.metallic * metal);
  }
  if (!s.volume && s.alpha < 1) {  // what comes through a sheet goes on the same way: one ray does for both
    straight.magnitude += transmission.magnitude;
    transmission.magnitude = Vec3(0);
  }
  Impulses impulses;
  impulses.add(straight);
  if (!(anyPositive(straight.magnitude) && anyPositive(transmission.magnitude))) impulses.add(reflection);
  impulses.add(transmission);
  return impulses;
}

Impulses chooseOne(const Impulses& impulses, double u) {
  if (impulses.count < 2) return impulses;
  const double first = luminance(impulses.items[0].magnitude);
  const double p = first / (first + luminance(impulses.items[1].magnitude));
  Impulse chosen = u < p ? impulses.items[0] : impulses.items[1];
  chosen.magnitude /= u < p ? p : 1 - p;
  Impulses one;
  one.add(chosen);
  return one;
}

}  // namespace whittle::reference
