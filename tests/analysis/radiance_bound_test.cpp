// The bound on radiance against rays of the double-precision recursion, and where it must be exact.
#include "analysis/radiance_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/largest_biradiance.h"
#include "scene/material_factors.h"
#include "support/random_scenes.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

double largest(const glm::dvec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

TEST(RadianceBound, AHallOfMirrorsReturnsNoMoreThanItsLamp) {
  Scene scene;
  addFloor(scene, mirror(glm::vec3(0.9F)), 0, true);
  addFloor(scene, mirror(glm::vec3(0.8F)), 2, false);
  addFloor(scene, glass(1.5F, true), 1, true);
  addFloor(scene, emitter({1, 2, 3}), -1, true);
  scene.background.radiance = {0.5F, 4, 0.5F};
  EXPECT_NEAR(glm::length(radianceBound(scene, {}) - glm::dvec3(1, 4, 3)), 0, 1e-4);
}

TEST(RadianceBound, MirrorsThatGlowAddUpForEver) {
  Material material = mirror(glm::vec3(1));
  material.emission = glm::vec3(2);
  Scene scene;
  addFloor(scene, material, 0, true);
  addFloor(scene, material, 1, false);
  EXPECT_EQ(radianceBound(scene, {}).x, std::numeric_limits<double>::infinity());
  EXPECT_EQ(biasBound(scene, {}, 0), 0) << "nothing ended";
}

/// A rough pane that glows and lets 3/4 of the light through: a hall of them brings at most e + e 3/4 + e
/// 9/16 …
TEST(RadianceBound, PanesThatGlowAddUpToAGeometricSeries) {
  Material material = glass(1.5F, false);
  material.roughness = 1;
  material.baseColor = {0.75F, 0.5F, 0, 1};
  material.specular = 0;
  material.emission = glm::vec3(2);
  Scene scene;
  addFloor(scene, material, 0, true);
  EXPECT_NEAR(glm::length(radianceBound(scene, {}) - glm::dvec3(8, 4, 2)), 0, 1e-3);
  EXPECT_NEAR(biasBound(scene, {}, 0.25), 2, 1e-3);
}

/// With one bounce no impulse is compiled, and nothing counted: all that an impulse can bring may be missing.
TEST(RadianceBound, OfOneBounceIsAllThatImpulsesBring) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, 4);
  scene.background.radiance = {3, 1, 2};
  Settings settings;
  settings.bounces = 1;
  EXPECT_EQ(biasBound(scene, settings, 0), 0) << "no impulses";
  addFloor(scene, mirror(glm::vec3(0.5F)), 1, true, 4);
  EXPECT_NEAR(biasBound(scene, settings, 0), 3, 1e-4);
}

TEST(RadianceBound, AMatteFloorIsBrightestBelowItsLight) {
  Scene scene;
  addFloor(scene, lambert({0.5F, 0.25F, 1}), 0, true, 4);
  scene.lights = {pointLight({1, 0.5F, 2}, 3)};  // above a face
  EXPECT_NEAR(radianceBound(scene, {}).z, 3 / 0.25 / M_PI, 1e-3);
  scene.lights = {pointLight({7, 4, 0.5F}, 3)};  // beside an edge
  EXPECT_NEAR(radianceBound(scene, {}).x, 0.5 * 3 / 25 / M_PI, 1e-5);
  scene.lights = {pointLight({6, 1, 6}, 3)};  // beyond a corner
  EXPECT_NEAR(radianceBound(scene, {}).y, 0.25 * 3 / 9 / M_PI, 1e-5);
  scene.lights[0].range = 2.9F;
  EXPECT_EQ(radianceBound(scene, {}), glm::dvec3(0));
  scene.lights[0].kind = LightKind::Directional;
  EXPECT_NEAR(radianceBound(scene, {}).z, 3 / M_PI, 1e-4);
}

TEST(RadianceBound, ThereIsNoneForALightOnASurfaceUnlessItScattersNothing) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, 4);
  scene.lights = {pointLight({1, 0, 1}, 3)};
  EXPECT_EQ(radianceBound(scene, {}).x, std::numeric_limits<double>::infinity());
  scene.materials[0] = emitter(glm::vec3(7));
  EXPECT_NEAR(radianceBound(scene, {}).x, 7, 1e-3);
  scene.materials[0] = mirror(glm::vec3(1));
  EXPECT_EQ(radianceBound(scene, {}).x, 0);
  scene.materials[0].specular = 2;
  EXPECT_EQ(radianceBound(scene, {}).x, std::numeric_limits<double>::infinity()) << "no reflectance";
}

/// Anything that the loader accepts without a word.
Material anyMaterialOf(Rng& rng) {
  const auto often0 = [&](float high) { return rng.unit() < 0.5F ? 0.0F : rng.between(0, high); };
  Material m;
  eachFactor(m, [&](const MaterialFactor& factor, std::span<float> numbers) {
    if (rng.unit() < 0.3F) return;  // as where a file says nothing
    for (float& v : numbers) v = rng.between(std::max(factor.least, -2.0F), std::min(factor.most, 2.0F));
  });
  // Not so much that one kind hides the others.
  m.metallic = rng.unit() < 0.3F ? 1.0F : often0(1);
  m.roughness *= 0.6F;
  m.transmission = often0(1);
  m.ior = std::max(m.ior, 1.0F);
  m.volume = rng.unit() < 0.4F;
  m.emission = glm::vec3(often0(0.5F));
  m.alphaMode = rng.unit() < 0.3F ? AlphaMode::Blend : AlphaMode::Opaque;
  m.unlit = rng.unit() < 0.1F;
  return m;
}

/// Quads of random materials in a cube of 2 m, two lights, a background.
Scene anyScene(Rng& rng) {
  Scene scene;
  for (int i = 0; i < 10; ++i)
    addQuad(scene, addMaterial(scene, anyMaterialOf(rng)), rng.inBox(1), 2.0F * rng.direction(),
            2.0F * rng.direction());
  scene.lights = {pointLight(rng.inBox(1), rng.between(0.1F, 1)), pointLight(rng.inBox(1), 1)};
  scene.lights[1].kind = LightKind::Directional;
  scene.lights[1].direction = rng.direction();
  scene.background.radiance = {0.1F, rng.unit(), 0.3F};
  return scene;
}

TEST(RadianceBound, NoRayBringsMore) {
  Rng rng(7);
  double nearest = 0;
  for (int s = 0; s < 60; ++s) {
    Settings settings;
    settings.mirrorRoughness = s % 3 == 0 ? 0.05F : 0.2F;
    settings.transparentBounces = 2;  // hits besides the bounces
    Scene scene = anyScene(rng);
    if (s % 4 == 0) scene.lights.clear();
    const glm::dvec3 bound = radianceBound(scene, settings);
    for (const int bounces : {1, 2, 5}) {
      settings.bounces = bounces;
      Probe probe(scene, settings);
      for (int i = 0; i < 300; ++i) {
        const Vec3 seen = probe.Li(rng.inBox(1.5F), rng.direction());
        for (int c = 0; c < 3; ++c) {
          ASSERT_LE(seen[c], bound[c]) << "scene " << s << ", " << bounces << " bounces";
          nearest = std::max(nearest, seen[c] / bound[c]);
        }
      }
    }
  }
  EXPECT_GT(nearest, 0.5) << "or the bound says nothing";
}

TEST(RadianceBound, NoHighlightIsBrighterHoweverItIsSeen) {
  Rng rng(11);
  for (const float roughness : {0.2F, 0.3F, 0.5F, 1.0F}) {
    Scene scene;
    Material metal = mirror(glm::vec3(1));
    metal.roughness = roughness;
    addFloor(scene, metal, 0, true);
    scene.lights = {pointLight({0, 1, 0}, 1)};
    scene.lights[0].kind = LightKind::Directional;
    Settings settings = exactSettings();
    settings.bounces = 1;
    double most = 0;
    for (int i = 0; i < 2000; ++i) {
      const double down = i % 2 == 0 ? std::pow(10.0, -3 * rng.unit()) : rng.unit();
      const Vec3 w = glm::normalize(Vec3(1, -down, 0));
      scene.lights[0].direction = glm::vec3(w.x, w.y, 0.1F * rng.unit());  // seen near its mirror image
      Probe probe(scene, settings);
      most = std::max(most, largest(probe.Li({-w.x, -w.y, 0}, w)));
      most = std::max(most, largest(probe.Li({w.x, -w.y, 0}, {-w.x, w.y, 0})));
    }
    const double bound = largest(radianceBound(scene, settings));
    EXPECT_LE(most, bound) << roughness;
    EXPECT_GT(most, 0.3 * bound) << roughness;
  }
}

TEST(LightReach, NoPointOfAMaterialIsNearer) {
  Rng rng(3);
  for (int s = 0; s < 200; ++s) {
    Scene scene;
    const auto material = addMaterial(scene, lambert(glm::vec3(1)));
    addMaterial(scene, lambert(glm::vec3(1)));  // of nothing
    for (int i = 0; i < 3; ++i)
      addQuad(scene, material, rng.inBox(1), rng.inBox(1), s % 2 ? rng.inBox(1e-6F) : rng.inBox(1));
    scene.lights = {pointLight(rng.inBox(2), 1)};
    const auto most = largestBiradiance(scene, {});
    EXPECT_EQ(most[1], glm::dvec3(0));
    double sampled = 0;
    for (int i = 0; i < 2000; ++i) {
      const Triangle& t = scene.triangles[static_cast<std::size_t>(rng.unit() * 6)];
      double u = rng.unit(), v = rng.unit();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      if (i % 3 == 0) v = 0;
      const glm::dvec3 a = scene.positions[t.v0], b = scene.positions[t.v1], c = scene.positions[t.v2];
      const glm::dvec3 away = a + u * (b - a) + v * (c - a) - glm::dvec3(scene.lights[0].position);
      sampled = std::max(sampled, 1 / glm::dot(away, away));
    }
    EXPECT_LE(sampled, most[0].x);
    EXPECT_GT(sampled, 0.7 * most[0].x);
  }
}

/// Many triangles are passed at a time; one by one, each alone in its scene, they say the same to the bit.
TEST(LargestBiradiance, IsThatOfTheNearestTriangleAlone) {
  Rng random(7);
  Scene scene;
  scene.materials.resize(3);
  const TriangleMesh soup = randomSoup(1000, 0.05F, 8);
  scene.positions = soup.positions;
  for (const glm::uvec3& t : soup.triangles) {
    // Runs of every length, materials that come back.
    const auto material = static_cast<std::uint32_t>(
        random.unit() < 0.05F ? random.bits() % 3 : scene.triangles.size() / 300 % 3);
    scene.triangles.push_back({t.x, t.y, t.z, material});
  }
  for (int i = 0; i < 20; ++i) {
    Light light;
    light.kind = LightKind::Point;
    light.intensity = glm::vec3(1, 2, 3);
    light.position = random.inBox(1.5F);
    light.range = std::numeric_limits<float>::infinity();
    scene.lights = {light};
    const auto all = largestBiradiance(scene, {});
    std::vector<glm::dvec3> alone(3, glm::dvec3(0));
    for (const Triangle& t : scene.triangles) {
      Scene one = scene;
      one.triangles = {t};
      alone[t.material] = glm::max(alone[t.material], largestBiradiance(one, {})[t.material]);
    }
    for (std::size_t m = 0; m < 3; ++m) EXPECT_EQ(all[m], alone[m]) << "light " << i << ", material " << m;
  }
}

}  // namespace
}  // namespace whittle::test
