// KHR_materials_pbrSpecularGlossiness, from a file to radiance, against the extension's own formulas.
#include <cmath>
#include <numbers>

#include "gltf/builder.h"
#include "support/probe.h"

namespace whittle::test {
namespace {

/// A lamp 2 m above a triangle that is seen from there: half vector and all directions are the normal, where
/// the extension's c_diff = diffuse (1 - max(specular)) and F0 = specular hold as they stand. D = 1/(π α²),
/// and V = 1/4 (glTF 2.0, appendix B.3), with α = (1 - glossiness)².
TEST(SpecularGlossiness, FromTheFrontAsTheExtensionSays) {
  const glm::dvec3 diffuse(0.8, 0.5, 0.25), specular(0.5, 0.25, 0.125);
  constexpr double kGlossiness = 0.5, kIntensity = 10, kAbove = 2;
  GltfBuilder b;
  const Json gloss{{"diffuseFactor", {diffuse.x, diffuse.y, diffuse.z, 1}},
                   {"specularFactor", {specular.x, specular.y, specular.z}},
                   {"glossinessFactor", kGlossiness}};
  b.material({{"extensions", {{"KHR_materials_pbrSpecularGlossiness", gloss}}}});
  b.node({{"mesh", b.triangleMesh({{"material", 0}})}});
  b.json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::array({{{"type", "point"}, {"intensity", kIntensity}}});
  b.node({{"translation", {0.25, 0.25, kAbove}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  b.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
  Probe probe(b.load());
  const Vec3 seen = probe.Li({0.25, 0.25, 1}, {0, 0, -1});
  const double alpha = (1 - kGlossiness) * (1 - kGlossiness), strongest = 0.5;
  const double D = 1 / (std::numbers::pi * alpha * alpha), V = 0.25;
  for (int i = 0; i < 3; ++i) {
    const double c_diff = diffuse[i] * (1 - strongest);
    const double f = c_diff / std::numbers::pi + specular[i] * D * V;
    // Factors are floats.
    EXPECT_NEAR(seen[i], f * kIntensity / (kAbove * kAbove), 1e-6) << i;
  }
}

}  // namespace
}  // namespace whittle::test
