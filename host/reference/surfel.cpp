// A surfel out of a hit: position, normals, vertex attributes, material and textures.
#include "reference/surfel.h"

#include <algorithm>
#include <array>
#include <utility>

#include "kernels/shared/layout.h"
#include "reference/cone.h"
#include "reference/texture.h"

namespace whittle::reference {
namespace {

/// Vertex attributes at a hit; an array that the scene does not have gives `missing`.
template <class Out, class In>
Out interpolate(const Scene& scene, const std::vector<In>& values, const Hit& hit, const Out& missing) {
  if (values.empty()) return missing;
  const Triangle& t = scene.triangles[hit.triangle];
  return hit.barycentric[0] * Out(values[t.v0]) + hit.barycentric[1] * Out(values[t.v1]) +
         hit.barycentric[2] * Out(values[t.v2]);
}

/// The textures at a hit. Searches have no ray that stands for anything: they read texels as they are.
struct Lookups {
  const Scene& scene;
  const Hit& hit;
  const Ray* ray = nullptr;
  Filtering filtering = {};

  Vec4 of(const TextureSlot& slot, const Mean& mean = {}) const {
    if (!slot.used()) return Vec4(1);
    const Vec2 uv = interpolate(scene, slot.uvSet == 1 ? scene.uv1 : scene.uv0, hit, Vec2(0));
    if (!filtering.levels) return sampleTexture(scene, slot, uv, mean.encoding);
    const Footprint footprint = footprintOf(scene, *ray, hit.triangle, slot.uvSet, filtering.width);
    return filteredTexture(scene, *filtering.levels, slot, uv, footprint, mean);
  }
};

constexpr Mean kColors{Encoding::Srgb, false};

const Material& materialOf(const Scene& scene, const Hit& hit) {
  return scene.materials[scene.triangles[hit.triangle].material];
}

Vec3 geometricNormal(const TriangleIndex& triangles, const Hit& hit) {
  const auto [p0, p1, p2] = triangles.corners(hit.triangle);
  return glm::normalize(glm::cross(p1 - p0, p2 - p0));
}

Vec3 interpolatedNormal(const Scene& scene, const Hit& hit, const Vec3& n_g) {
  if (scene.normals.empty()) return n_g;
  const Triangle& t = scene.triangles[hit.triangle];
  for (const std::uint32_t v : {t.v0, t.v1, t.v2}) {
    if (scene.normals[v] == glm::vec3(0)) return n_g;
  }
  const Vec3 n = glm::normalize(interpolate(scene, scene.normals, hit, n_g));
  return isFinite(n) ? n : n_g;
}

/// From a point of a triangle to the surface that bulges over it: the mean of the point's projections on the
/// planes across the corners' normals, where those pass above it (Hanika 2021). Nothing for a triangle that
/// is as good as flat, or whose normals round an edge.
std::optional<Vec3> liftAt(const Scene& scene, const TriangleIndex& triangles, const Hit& hit,
                           const Vec3& position, const Vec3& n_g, bool front) {
  if (scene.normals.empty()) return std::nullopt;
  const Triangle& t = scene.triangles[hit.triangle];
  const std::array vertices{t.v0, t.v1, t.v2};
  const auto corners = triangles.corners(hit.triangle);
  double least = 1;
  Vec3 lift(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 normal(scene.normals[vertices[i]]);
    if (normal == Vec3(0)) return std::nullopt;
    least = std::min(least, glm::dot(normal, n_g));
    const Vec3 outwards = front ? normal : -normal;
    lift += hit.barycentric[static_cast<int>(i)] * std::max(0.0, glm::dot(corners[i] - position, outwards)) *
            outwards;
  }
  if (!(least < COARSE_COSINE && least > EDGE_COSINE)) return std::nullopt;
  return lift;
}

/// Tangent, bitangent and n as columns; not finite where there is no tangent.
glm::dmat3 tangentSpace(const Lookups& look, const Vec3& n) {
  const Scene& scene = look.scene;
  const Vec3 tangent(interpolate(scene, scene.tangents, look.hit, Vec4(0)));
  const Vec3 T = glm::normalize(tangent - n * glm::dot(n, tangent));
  const double hand = scene.tangents.empty() ? 1 : scene.tangents[scene.triangles[look.hit.triangle].v0].w;
  return {T, hand * glm::cross(n, T), n};
}

/// `n` tilted by a normal map; `n` itself where there is none or no tangent to lay it along.
Vec3 mappedNormal(const Lookups& look, const TextureSlot& map, double scale, const Vec3& n) {
  if (!map.used()) return n;
  const Vec3 t = Vec3(look.of(map)) * 2.0 - 1.0;
  const Vec3 mapped = glm::normalize(tangentSpace(look, n) * (t * Vec3(scale, scale, 1)));
  return isFinite(mapped) ? mapped : n;
}

double rayOffsetAt(const Settings& settings, const TriangleIndex& triangles, const Hit& hit) {
  if (settings.rayOffset) return *settings.rayOffset;
  const auto corners = triangles.corners(hit.triangle);
  Vec3 size(0);
  for (int i = 0; i < 3; ++i) size += hit.barycentric[i] * glm::abs(corners[i]);
  return std::max(0x1p-20 * maxComponent(size), 1e-30);
}

double metallicAt(const Lookups& look, const Material& material) {
  return std::clamp(material.metallic * look.of(material.metallicRoughnessTexture).b, 0.0, 1.0);
}

double transmissionAt(const Lookups& look, const Material& material) {
  if (material.unlit) return 0;
  return std::clamp(material.transmission * look.of(material.transmissionTexture).r, 0.0, 1.0);
}

TintedFresnel fresnelAt(const Lookups& look, const Material& material, double index) {
  return TintedFresnel(index, material.specular * look.of(material.specularTexture).a,
                       Vec3(material.specularColor) * Vec3(look.of(material.specularColorTexture, kColors)));
}

/// Index beyond over index here. A sheet looks the same from both sides; 0 (all is reflected) stays 0.
double relativeIndex(const Material& material, bool front) {
  const double ior = material.ior;
  return front || !material.volume || ior == 0 ? ior : 1 / ior;
}

/// Red bends least. Whatever has no greater index inside than outside splits nothing.
std::optional<Dispersion> splitAt(const Lookups& look, const Material& material, const Surfel& surfel) {
  const double ior = material.ior, half = (ior - 1) * 0.025 * static_cast<double>(material.dispersion);
  if (!(surfel.volume && surfel.transmission > 0 && ior > 1 && material.dispersion > 0)) return std::nullopt;
  const std::array<double, 3> index{std::max(1.0, ior - half), ior, ior + half};
  Dispersion split{{fresnelAt(look, material, index[0]), fresnelAt(look, material, index[1]),
                    fresnelAt(look, material, index[2])},
                   index};
  for (double& eta : split.eta) eta = surfel.front ? eta : 1 / eta;
  return split;
}

Coat coatAt(const Lookups& look, const Material& m, const Settings& settings, const Vec3& n,
            const Vec3& w_o) {
  Coat coat;
  coat.n = n;
  const double covered = std::clamp(m.clearcoat * look.of(m.clearcoatTexture).r, 0.0, 1.0);
  coat.reflectance = covered * schlick(Vec3(0.04), Vec3(1), std::min(1.0, glm::dot(n, w_o))).x;
  coat.roughness = std::clamp(m.clearcoatRoughness * look.of(m.clearcoatRoughnessTexture).g, 0.0, 1.0);
  coat.smooth = coat.roughness < static_cast<double>(settings.mirrorRoughness);
  coat.glossy = settings.glossy && !coat.smooth;
  return coat;
}

Sheen sheenAt(const Lookups& look, const Material& m) {
  return {Vec3(m.sheenColor) * Vec3(look.of(m.sheenColorTexture, kColors)),
          std::clamp(m.sheenRoughness * look.of(m.sheenRoughnessTexture).a, 0.0, 1.0)};
}

ThinFilm filmAt(const Lookups& look, const Material& m) {
  const double blended = look.of(m.iridescenceThicknessTexture).g;
  return {std::clamp(m.iridescence * look.of(m.iridescenceTexture).r, 0.0, 1.0), m.iridescenceIor,
          std::lerp(static_cast<double>(m.leastThickness), static_cast<double>(m.mostThickness), blended)};
}

/// The direction along which facets are rougher, about `unmapped`, the normal before its map; and by how
/// much.
void layFacets(const Lookups& look, const Material& m, const Vec3& unmapped, Surfel& surfel) {
  const bool textured = m.anisotropyTexture.used();
  const Vec4 texel = look.of(m.anisotropyTexture);
  const Vec2 given = textured ? Vec2(texel.r, texel.g) * 2.0 - 1.0 : Vec2(1, 0);
  const double cosine = std::cos(m.anisotropyRotation), sine = std::sin(m.anisotropyRotation);
  const Vec3 turned = tangentSpace(look, unmapped) *
                      Vec3(cosine * given.x - sine * given.y, sine * given.x + cosine * given.y, 0);
  const Vec3 across = glm::normalize(turned - surfel.n * glm::dot(surfel.n, turned));
  if (!isFinite(across)) return;
  surfel.grain = across;
  surfel.stretch = square(std::clamp(m.anisotropy * (textured ? texel.b : 1), 0.0, 1.0));
}

/// Base colour and coverage at a hit; coverage as the alpha mode has it (1 for opaque, unchanged for MASK).
Vec4 baseColorAt(const Lookups& look) {
  const auto& [scene, hit, ray, filtering] = look;
  const Material& material = materialOf(scene, hit);
  Vec4 color = Vec4(material.baseColor) * look.of(material.baseColorTexture, meanOfBaseColor(material)) *
               interpolate(scene, scene.colors, hit, Vec4(1));
  color.a = material.alphaMode == AlphaMode::Opaque ? 1.0 : std::clamp(color.a, 0.0, 1.0);
  return color;
}

}  // namespace

bool passesMask(const Scene& scene, const Hit& hit) {
  const Material& material = materialOf(scene, hit);
  return material.alphaMode != AlphaMode::Mask || !(baseColorAt({scene, hit}).a < material.alphaCutoff);
}

Surfel makeSurfel(const Scene& scene, const Settings& settings, const TriangleIndex& triangles,
                  const Ray& ray, const Hit& hit, const Filtering& filtering) {
  const Lookups look{scene, hit, &ray, filtering};
  const Material& material = materialOf(scene, hit);
  const Vec3 w_o = -ray.direction;
  const Vec3 n_g = geometricNormal(triangles, hit);
  const auto corners = triangles.corners(hit.triangle);
  const Vec4 color = baseColorAt(look);
  const Vec3 unmapped = interpolatedNormal(scene, hit, n_g);

  Surfel surfel{
      .position =
          hit.barycentric[0] * corners[0] + hit.barycentric[1] * corners[1] + hit.barycentric[2] * corners[2],
      .facing = n_g,
      .n = mappedNormal(look, material.normalTexture, material.normalScale, unmapped),
      .front = glm::dot(n_g, w_o) > 0,
      .rayOffset = rayOffsetAt(settings, triangles, hit),
      .baseColor = Vec3(color),
      .alpha = material.alphaMode == AlphaMode::Blend ? color.a : 1.0,
      .metallic = metallicAt(look, material),
      .roughness = std::clamp(material.roughness * look.of(material.metallicRoughnessTexture).g, 0.0, 1.0),
      .transmission = transmissionAt(look, material),
      .smooth = false,
      .glossy = false,
      .volume = material.volume,
      .unlit = material.unlit,
      .fresnel = fresnelAt(look, material, material.ior),
      .eta = 1,
      .emission = Vec3(0),
      .sigma_a = Vec3(material.sigma_a),
      .bend = bendOf(scene, hit.triangle)};
  surfel.smooth = surfel.roughness < static_cast<double>(settings.mirrorRoughness);
  surfel.glossy = settings.glossy && !surfel.smooth && !surfel.unlit;
  surfel.eta = relativeIndex(material, surfel.front);
  if (settings.smoothTerminator) {
    surfel.lift = liftAt(scene, triangles, hit, surfel.position, n_g, surfel.front);
    surfel.liftBehind = liftAt(scene, triangles, hit, surfel.position, n_g, !surfel.front);
  }
  if (!surfel.front) {
    surfel.facing = -surfel.facing;
    surfel.bend = -surfel.bend;
  }
  const auto turned = [&](const Vec3& n) {  // a normal of the front side, to the viewer
    const Vec3 own = surfel.front ? n : -n;
    return glm::dot(own, w_o) <= 0 ? surfel.facing : own;
  };
  surfel.n = turned(surfel.n);
  if (surfel.front || material.doubleSided) {
    surfel.emission = Vec3(material.emission) * Vec3(look.of(material.emissionTexture, kColors));
  }
  if (material.unlit) return surfel;
  surfel.split = splitAt(look, material, surfel);
  for (int c = 0; c < 3 && surfel.split; ++c) surfel.fresnel.f0[c] = surfel.split->fresnel[c].f0[c];
  surfel.diffuseTransmission =
      std::clamp(material.diffuseTransmission * look.of(material.diffuseTransmissionTexture).a, 0.0, 1.0);
  surfel.diffuseTransmissionColor = Vec3(material.diffuseTransmissionColor) *
                                    Vec3(look.of(material.diffuseTransmissionColorTexture, kColors));
  if (surfel.front || !material.volume) {
    const Vec3 n =
        mappedNormal(look, material.clearcoatNormalTexture, material.clearcoatNormalScale, unmapped);
    surfel.coat = coatAt(look, material, settings, turned(n), w_o);
    surfel.emission *= 1 - surfel.coat.reflectance;
  }
  surfel.sheen = sheenAt(look, material);
  surfel.film = filmAt(look, material);
  if (material.anisotropy > 0) layFacets(look, material, unmapped, surfel);
  return surfel;
}

Surfel turnedOver(Surfel surfel) {
  surfel.n = -surfel.n;
  surfel.facing = -surfel.facing;
  std::swap(surfel.lift, surfel.liftBehind);
  return surfel;
}

Vec3 shadowTransmittance(const Scene& scene, const TriangleIndex& triangles, const Ray& ray, const Hit& hit) {
  const Material& material = materialOf(scene, hit);
  if (!passesMask(scene, hit)) return Vec3(1);
  const Lookups look{scene, hit};
  const Vec4 color = baseColorAt(look);
  const double a = material.alphaMode == AlphaMode::Blend ? color.a : 1.0;
  const double transmitted = a * transmissionAt(look, material) * (1 - metallicAt(look, material));
  if (transmitted == 0) return Vec3(1 - a);
  const double cosine = std::min(1.0, std::abs(glm::dot(geometricNormal(triangles, hit), ray.direction)));
  return glm::clamp(1 - a + transmitted * Vec3(color) * (1 - dielectricReflectance(cosine, material.ior)),
                    0.0, 1.0);
}

}  // namespace whittle::reference
