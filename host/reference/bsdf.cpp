// Scattering in double precision. Metallic-roughness after the glTF 2.0 specification, appendix B (GGX,
// height-correlated Smith, Schlick); mirror directions after Whitted 1980.
#include "reference/bsdf.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace whittle::reference {
namespace {

constexpr double kMinAlpha = 1e-3;  // keeps the highlight finite where even r = 0 counts as rough

/// GGX about n, with alphas of its own along `tangent` and across it.
struct Facets {
  Vec3 n, tangent, bitangent;
  double along, across;
};

Facets facetsOf(const Coat& coat) {
  const auto [right, up] = basisAbout(coat.n);
  const double alpha = std::max(square(coat.roughness), kMinAlpha);
  return {coat.n, right, up, alpha, alpha};
}

Facets facetsOf(const Surfel& s) {
  const double alpha = std::max(square(s.roughness), kMinAlpha);
  if (s.grain != Vec3(0))
    return {s.n, s.grain, glm::cross(s.n, s.grain), std::lerp(alpha, 1.0, s.stretch), alpha};
  const auto [right, up] = basisAbout(s.n);
  return {s.n, right, up, alpha, alpha};
}

/// w in the facets' frame, stretched by their alphas.
Vec3 stretched(const Facets& f, const Vec3& w) {
  return {f.along * glm::dot(f.tangent, w), f.across * glm::dot(f.bitangent, w), glm::dot(f.n, w)};
}

/// Microfacet distribution times visibility: GGX, Walter et al. 2007; height-correlated Smith, Heitz 2014;
/// with two alphas as in KHR_materials_anisotropy.
double microfacets(const Facets& f, const Vec3& w_o, const Vec3& w_i, const Vec3& h) {
  const Vec3 slope(glm::dot(f.tangent, h) / f.along, glm::dot(f.bitangent, h) / f.across, glm::dot(f.n, h));
  const double D = 1 / (kPi * f.along * f.across * square(glm::dot(slope, slope)));
  const double no = glm::dot(f.n, w_o), ni = glm::dot(f.n, w_i);
  return D * 0.5 / (ni * glm::length(stretched(f, w_o)) + no * glm::length(stretched(f, w_i)));
}

Vec3 mirrored(const Vec3& w_o, const Vec3& n) { return 2 * glm::dot(n, w_o) * n - w_o; }

std::optional<Vec3> refracted(const Vec3& w_o, const Vec3& n, double eta) {
  const double cosI = glm::dot(n, w_o);
  if (totallyReflected(cosI, eta)) return std::nullopt;
  const double cosT = std::sqrt(1 - std::max(0.0, 1 - cosI * cosI) / (eta * eta));
  return glm::normalize(-w_o / eta + (cosI / eta - cosT) * n);
}

Vec3 reflectedDirection(const Vec3& n, const Vec3& facing, const Vec3& w_o) {
  const Vec3 w_i = mirrored(w_o, n);
  return glm::dot(facing, w_i) > 0 ? w_i : mirrored(w_o, facing);
}

/// Where light seen through the surface comes from; nothing at total reflection.
std::optional<Vec3> transmittedDirection(const Surfel& surfel, const Vec3& w_o, double eta) {
  if (!surfel.volume || eta == 1) return -w_o;
  const auto w_i = refracted(w_o, surfel.n, eta);
  if (w_i && glm::dot(surfel.facing, *w_i) >= 0) return refracted(w_o, surfel.facing, eta);
  return w_i;
}

/// The normal of a microfacet that w_o sees, by how much of w_o each takes up: Heitz, "Sampling the GGX
/// Distribution of Visible Normals", JCGT 2018; by spherical caps, Dupuy and Benyoub 2023.
Vec3 visibleNormal(const Facets& f, const Vec3& w_o, const Vec2& u) {
  const double angle = 2 * kPi * u.x;
  const Vec3 seen = glm::normalize(stretched(f, w_o));
  const double z = (1 - u.y) * (1 + seen.z) - seen.z, across = std::sqrt(std::max(0.0, 1 - z * z));
  const Vec3 cap = Vec3(across * std::cos(angle), across * std::sin(angle), z) + seen;
  return glm::normalize(f.along * cap.x * f.tangent + f.across * cap.y * f.bitangent + cap.z * f.n);
}

/// Smith's Λ (Heitz 2014).
double hidden(const Facets& f, const Vec3& w) {
  return (glm::length(stretched(f, w)) / std::abs(glm::dot(f.n, w)) - 1) / 2;
}

/// Towards w_i from the sampled normal: G2/G1, height-correlated; 0 below the surface.
double reflectedShare(const Facets& f, const Vec3& facing, const Vec3& w_o, const Vec3& w_i) {
  if (!(glm::dot(f.n, w_i) > 0 && glm::dot(facing, w_i) > 0)) return 0;
  return (1 + hidden(f, w_o)) / (1 + hidden(f, w_o) + hidden(f, w_i));
}

/// Where a glossy surfel sends what goes through one of its facets, and G1 of the way there.
std::optional<Vec3> transmittedByFacet(const Surfel& s, const Vec3& w_o, const Vec3& facet, double eta,
                                       double& share) {
  if (!s.volume || eta == 1) return -w_o;
  const auto w_i = refracted(w_o, facet, eta);
  if (!w_i || !(glm::dot(s.facing, *w_i) < 0 && glm::dot(s.n, *w_i) < 0)) return std::nullopt;
  share = 1 / (1 + hidden(facetsOf(s), *w_i));
  return w_i;
}

Vec3 dielectricAt(const ThinFilm& film, const TintedFresnel& fresnel, double eta, double cosine) {
  const bool total = fresnel.r0 < 1 && eta != 1 && totallyReflected(cosine, eta);
  const Vec3 clear = fresnel.reflectance(cosine, eta);
  return total ? clear : film.over(clear, fresnel.f0, cosine);
}

Vec3 dielectricAt(const Surfel& s, double cosine) {
  if (!s.split) return dielectricAt(s.film, s.fresnel, s.eta, cosine);
  Vec3 reflectance;
  for (int c = 0; c < 3; ++c)
    reflectance[c] = dielectricAt(s.film, s.split->fresnel[c], s.split->eta[c], cosine)[c];
  return reflectance;
}

/// Of facets, as glTF's highlights have it.
Vec3 roughDielectricAt(const Surfel& s, double cosine) {
  return s.film.over(schlick(s.fresnel.f0, s.fresnel.f90, cosine), s.fresnel.f0, cosine);
}

Vec3 metalAt(const Surfel& s, double cosine) {
  return s.film.over(schlick(s.baseColor, Vec3(1), cosine), s.baseColor, cosine);
}

double sheenAlbedo(const Surfel& s, double cosO, double cosI) {
  if (!s.sheen.isThere()) return 0;
  return std::max(fibreAlbedo(s.sheen.roughness, cosO), fibreAlbedo(s.sheen.roughness, cosI));
}

double belowSheen(const Surfel& s, double albedo) {
  return std::max(0.0, 1 - maxComponent(s.sheen.color) * albedo);
}

/// The share that layers leave of what goes between w_o and w_i below them.
double belowLayers(const Surfel& s, double cosO, double cosI) {
  return belowSheen(s, sheenAlbedo(s, cosO, cosI)) * (1 - s.coat.reflectance);
}

/// Of the surface without its layers.
Vec3 baseBsdf(const Surfel& s, const Vec3& w_i, const Vec3& w_o, bool withoutGloss) {
  const double no = glm::dot(s.n, w_o);
  const Vec3 diffuse = (1 - s.transmission) * (1 - s.diffuseTransmission) * s.baseColor / kPi;
  if (s.smooth) return (1 - s.metallic) * (1.0 - dielectricAt(s, no)) * diffuse;

  const Vec3 h = glm::normalize(w_i + w_o);
  const double oh = glm::dot(w_o, h);
  const double lobe = withoutGloss && s.glossy ? 0.0 : microfacets(facetsOf(s), w_o, w_i, h);
  const Vec3 dielectric = roughDielectricAt(s, oh);
  return (1 - s.metallic) * ((1 - maxComponent(dielectric)) * diffuse + dielectric * lobe) +
         s.metallic * metalAt(s, oh) * lobe;
}

/// Lambert's part for light from the other side, w_i, without the layers. `mirrored`: where that would come
/// from on the viewer's side, as whose the surface reflects it on its way.
Vec3 throughBsdf(const Surfel& s, const Vec3& mirrored, const Vec3& w_o) {
  const double oh = glm::dot(w_o, glm::normalize(mirrored + w_o));
  const Vec3 kept =
      s.smooth ? 1.0 - dielectricAt(s, glm::dot(s.n, w_o)) : Vec3(1 - maxComponent(roughDielectricAt(s, oh)));
  return (1 - s.metallic) * (1 - s.transmission) * s.diffuseTransmission * kept * s.diffuseTransmissionColor /
         kPi;
}

/// Of the coat; irradiance counts by the cosine to its own normal.
double coatBsdf(const Surfel& s, const Vec3& w_i, const Vec3& w_o, bool withoutGloss) {
  const double cosine = glm::dot(s.coat.n, w_i);
  if (s.coat.smooth || s.coat.reflectance == 0 || cosine <= 0 || (withoutGloss && s.coat.glossy)) return 0;
  const Vec3 h = glm::normalize(w_i + w_o);
  return s.coat.reflectance * microfacets(facetsOf(s.coat), w_o, w_i, h) * cosine / glm::dot(s.n, w_i);
}

/// The mirror reflection of the coat, or that of one of its facets.
Impulse coatImpulse(const Surfel& s, const Vec3& w_o, const Vec2& facets) {
  Impulse impulse{w_o, Vec3(0), false};
  if (!s.coat.smooth && !s.coat.glossy) return impulse;
  double share = 1;
  if (s.coat.glossy) {
    const Facets own = facetsOf(s.coat);
    impulse.w_i = mirrored(w_o, visibleNormal(own, w_o, facets));
    share = reflectedShare(own, s.facing, w_o, impulse.w_i);
  } else {
    impulse.w_i = reflectedDirection(s.coat.n, s.facing, w_o);
  }
  impulse.magnitude = Vec3(s.alpha * s.coat.reflectance * share);
  return impulse;
}

}  // namespace

Vec3 spreadingBsdf(const Surfel& s, const Vec3& w_i, const Vec3& w_o, bool withoutGloss) {
  const double no = glm::dot(s.n, w_o), ni = glm::dot(s.n, w_i);
  if (ni < 0) return belowLayers(s, no, -ni) * throughBsdf(s, w_i - 2 * ni * s.n, w_o);
  const double albedo = sheenAlbedo(s, no, ni);
  Vec3 f = belowSheen(s, albedo) * baseBsdf(s, w_i, w_o, withoutGloss);
  if (s.sheen.isThere()) {
    const double nh = glm::dot(s.n, glm::normalize(w_i + w_o));
    f += s.sheen.color * fibreLobe(s.sheen.roughness, no, ni, nh) / std::max(1.0, albedo);
  }
  return (1 - s.coat.reflectance) * f + coatBsdf(s, w_i, w_o, withoutGloss);
}

Vec3 ambientReflectance(const Surfel& s, const Vec3& w_o) {
  const double no = std::min(1.0, glm::dot(s.n, w_o)), albedo = sheenAlbedo(s, no, no);
  const Vec3 color =
      (1 - s.diffuseTransmission) * s.baseColor + s.diffuseTransmission * s.diffuseTransmissionColor;
  const Vec3 matte = (1 - s.metallic) * (1 - s.transmission) * color;
  Vec3 share = matte + s.metallic * s.baseColor;
  if (s.smooth || s.glossy) share = matte * (1.0 - dielectricAt(s, no));
  share = belowSheen(s, albedo) * share + s.sheen.color * std::min(albedo, 1.0);
  const bool isCoatInImpulses = s.coat.smooth || s.coat.glossy;
  return (1 - s.coat.reflectance) * share + (isCoatInImpulses ? 0.0 : s.coat.reflectance);
}

namespace {

/// What goes through, of all colours alike or of one.
Impulse refraction(const Surfel& s, const Vec3& w_o, const Vec3& n, double eta, const Vec3& carried) {
  Impulse impulse{-w_o, Vec3(0), true, !s.volume || s.eta == 1, s.split.has_value(), eta};
  double share = 1;
  const auto beyond =
      s.glossy ? transmittedByFacet(s, w_o, n, eta, share) : transmittedDirection(s, w_o, eta);
  if (!beyond || !(s.transmission > 0) || s.unlit) return impulse;
  impulse.w_i = *beyond;
  impulse.magnitude = share * s.alpha * (1 - s.metallic) * s.transmission * carried;
  return impulse;
}

/// The same of each colour.
std::array<Impulse, 3> refractions(const Surfel& s, const Vec3& w_o, const Vec3& n, const Vec3& carried) {
  if (!s.split) return {refraction(s, w_o, n, s.eta, carried)};
  std::array<Impulse, 3> all;
  for (int c = 0; c < 3; ++c) {
    Vec3 own(0);
    own[c] = carried[c];
    all[c] = refraction(s, w_o, n, s.split->eta[c], own);
  }
  return all;
}

/// 1 for each channel that is totally reflected inside a solid.
Vec3 reflectedInside(const Surfel& s, double cosine) {
  Vec3 inside(0);
  if (!(s.volume && s.transmission > 0)) return inside;
  for (int c = 0; c < 3; ++c) {
    const double eta = s.split ? s.split->eta[c] : s.eta;
    inside[c] = eta != 1 && eta > 0 && totallyReflected(cosine, eta) ? 1 : 0;
  }
  return inside;
}

}  // namespace

Impulses impulsesOf(const Surfel& s, const Vec3& w_o, const Vec2& facets) {
  const Vec3 n = s.glossy ? visibleNormal(facetsOf(s), w_o, facets) : s.n;
  const double cosine = std::min(1.0, glm::dot(n, w_o));
  const bool isOpaqueGloss = s.glossy && !(s.transmission > 0);  // as its highlight has it
  const Vec3 dielectric = isOpaqueGloss ? roughDielectricAt(s, cosine) : dielectricAt(s, cosine);
  const double cosO = glm::dot(s.n, w_o);
  Impulse straight{-w_o, Vec3(1 - s.alpha), true, true};
  Impulse reflection{w_o, Vec3(0), false};

  std::array<Impulse, 3> through =
      refractions(s, w_o, n, belowLayers(s, cosO, cosO) * s.baseColor * (1.0 - dielectric));
  const Vec3 transmitted = through[0].magnitude + through[1].magnitude + through[2].magnitude;
  const Vec3 reflects = s.smooth || s.glossy ? Vec3(1) : reflectedInside(s, cosine);
  if (anyPositive(reflects) && !s.unlit) {
    reflection.w_i = s.glossy ? mirrored(w_o, n) : reflectedDirection(s.n, s.facing, w_o);
    reflection.magnitude = reflects * belowLayers(s, cosO, glm::dot(s.n, reflection.w_i)) *
                           (s.glossy ? reflectedShare(facetsOf(s), s.facing, w_o, reflection.w_i) : 1) *
                           s.alpha * ((1 - s.metallic) * dielectric + s.metallic * metalAt(s, cosine));
  }
  Impulse coat = coatImpulse(s, w_o, facets);
  const bool alike = s.smooth && s.coat.smooth && s.n == s.coat.n;
  if (!anyPositive(reflection.magnitude)) {
    // Added, not put in its place: what is no number stays none.
    if (anyPositive(coat.magnitude)) reflection.w_i = coat.w_i;
    reflection.magnitude += std::exchange(coat.magnitude, Vec3(0));
  } else if (alike || s.alpha < 1 || anyPositive(transmitted)) {  // no room for a third
    reflection.magnitude += std::exchange(coat.magnitude, Vec3(0));
  }
  if (!s.volume && s.alpha < 1) {  // what comes through a sheet goes on the same way: one ray does for both
    straight.magnitude += std::exchange(through[0].magnitude, Vec3(0));
  }
  Impulses impulses;
  impulses.add(straight);
  impulses.add(coat);
  const bool isFull = anyPositive(straight.magnitude) && anyPositive(transmitted) && s.volume;
  if (!isFull) impulses.add(reflection);
  for (const Impulse& impulse : through) impulses.add(impulse);
  return impulses;
}

Impulses carriedBy(const Impulses& impulses, const Vec3& throughput) {
  Impulses carried;
  for (const Impulse& impulse : impulses.all())
    if (!impulse.splits || anyPositive(throughput * impulse.magnitude)) carried.add(impulse);
  return carried;
}

Impulses chooseOne(const Impulses& impulses, double u) {
  if (impulses.count < 2) return impulses;
  double sum = 0, until = 0;
  for (const Impulse& impulse : impulses.all()) sum += luminance(impulse.magnitude);
  Impulses one;
  for (const Impulse& impulse : impulses.all()) {
    const double p = luminance(impulse.magnitude) / sum;
    until += p;
    if (!(u < until) && &impulse != &impulses.all().back()) continue;
    one.add(impulse);
    one.items[0].magnitude /= p;
    break;
  }
  return one;
}

}  // namespace whittle::reference
