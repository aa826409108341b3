// Footprints in the reference: cones of eye rays and what surfaces make of them, against rays beside them;
// levels of known pictures; lookups over a footprint against means.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/camera.h"
#include "reference/cone.h"
#include "support/probe.h"

namespace whittle::test {
namespace {

using reference::Cone;
using reference::Encoding;
using reference::Footprint;
using reference::Mean;

/// A floor at y = 0 whose texture coordinates are its x and z.
Scene measuredFloor() {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(1)), 0);
  for (const glm::vec3& p : scene.positions) scene.uv0.emplace_back(p.x, p.z);
  return scene;
}

double areaOf(const Footprint& f) { return std::abs(f.one.x * f.other.y - f.one.y * f.other.x); }

/// Where on the floor the ray through a place of the picture ends.
Vec2 placeOnFloor(const Camera& camera, const Vec2& at, int width, int height) {
  const Ray ray = reference::eyeRay(camera, at, width, height);
  const Vec3 p = ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
  return {p.x, p.z};
}

/// The footprint of a pixel's eye ray is as large as the pixel on the floor; far from the middle of a wide
/// picture, at several distances and angles, and for parallel rays.
TEST(Footprint, OfAnEyeRayIsAsLargeAsThePixelOnTheFloor) {
  const Scene scene = measuredFloor();
  Settings settings;
  settings.width = 64, settings.height = 36;
  for (const bool orthographic : {false, true})
    for (const Vec2 at : {Vec2(32.5, 30.5), Vec2(3.5, 34.5), Vec2(60.5, 25.5), Vec2(32.5, 20.5)}) {
      Camera camera;
      camera.orthographic = orthographic;
      camera.position = {0.4F, 1.7F, 0.3F};
      camera.yfov = 1.2F;
      camera.forward = glm::normalize(glm::vec3(0, -0.5F, -1));
      camera.up = glm::normalize(glm::vec3(0, 1, -0.5F));
      const Ray ray = reference::eyeRay(camera, at, settings.width, settings.height);
      const double t = -ray.origin.y / ray.direction.y;
      const double width = reference::widthAt(reference::eyeCone(camera, settings, ray, 0), t);
      const Footprint footprint = reference::footprintOf(scene, ray, 0, 0, width);
      constexpr double kStep = 1e-4;  // pixels; what a derivative by it is off by is far below the tolerance
      const auto moved = [&](const Vec2& by) {
        const Vec2 ahead = placeOnFloor(camera, at + kStep * by, settings.width, settings.height);
        return (ahead - placeOnFloor(camera, at - kStep * by, settings.width, settings.height)) / (2 * kStep);
      };
      const double pixel = areaOf({moved({1, 0}), moved({0, 1})});
      EXPECT_NEAR(areaOf(footprint) / pixel, 1, 1e-6) << at.x << ' ' << at.y << ' ' << orthographic;
    }
}

/// On a plane the footprint is an ellipse, as wide as the cone and longer by the cosine.
TEST(Footprint, IsLongerByTheCosine) {
  const Scene scene = measuredFloor();
  for (const double degrees : {0.0, 30.0, 80.0}) {
    const double angle = degrees * reference::kPi / 180;
    const Ray ray{{0, std::cos(angle), 0}, {std::sin(angle), -std::cos(angle), 0}};
    const auto [one, other] = reference::footprintOf(scene, ray, 0, 0, 0.01);
    const double squares = glm::dot(one, one) + glm::dot(other, other);  // of both axes
    EXPECT_NEAR(squares, 1e-4 * (1 + 1 / reference::square(std::cos(angle))), 1e-12 * squares);
    EXPECT_NEAR(areaOf({one, other}), 1e-4 / std::cos(angle), 1e-12);
  }
}

/// Sample n stands for 1/(n + 1) of its pixel.
TEST(Footprint, OfLaterSamplesIsSmaller) {
  const Camera camera;
  const Ray ray{Vec3(camera.position), Vec3(camera.forward)};
  const double first = reference::eyeCone(camera, {}, ray, 0).spread;
  EXPECT_NEAR(first, 2 * std::tan(0.45) / 360, 1e-9) << "yfov 0.9, 360 pixels";
  EXPECT_NEAR(reference::eyeCone(camera, {}, ray, 3).spread, first / 2, 1e-15);
}

reference::Surfel onSphere(const Vec3& n, double bend) {
  reference::Surfel surfel = whiteMetalAt(n, 0);
  surfel.bend = bend;
  return surfel;
}

Vec3 refracted(const Vec3& d, const Vec3& n, double eta) {
  const double cosine = -glm::dot(d, n), sine2 = eta * eta * (1 - cosine * cosine);
  return eta * d + (eta * cosine - std::sqrt(1 - sine2)) * n;
}

/// Rays of a cone that meets a sphere of radius 1 about 0, reflected or refracted: how the directions move
/// apart with the places, in the plane of incidence and across it; the mean of both is the cone's.
TEST(Cone, IsSpreadBySpheresAsRaysAre) {
  constexpr double kAside = 1e-5;
  for (const double spread : {0.0, 0.3})
    for (const double angle : {0.0, 0.5, 1.1})
      for (const bool reflects : {true, false}) {
        const double eta = 1 / 1.5, width = 0.01;
        const Vec3 n(0, 1, 0), d(std::sin(angle), -std::cos(angle), 0),
            u(std::cos(angle), std::sin(angle), 0), v(0, 0, 1);
        const auto leaves = [&](const Vec3& d1, const Vec3& n1) {
          return reflects ? d1 - 2 * glm::dot(d1, n1) * n1 : refracted(d1, n1, eta);
        };
        const auto turned = [&](const Vec3& axis) {
          // Of a cone as wide as `width`: a ray from so far aside turns by this much of its spread.
          const Vec3 from = n + kAside * axis, towards = glm::normalize(d + kAside / width * spread * axis);
          const double b = glm::dot(from, towards), c = glm::dot(from, from) - 1;
          const Vec3 met = from + (-b - std::sqrt(std::max(0.0, b * b - c))) * towards;
          return (leaves(towards, glm::normalize(met)) - leaves(d, n)) / kAside * width;
        };
        const Vec3 w_i = leaves(d, n), u1 = glm::cross(v, w_i) * (reflects ? -1.0 : 1.0);
        const double across = glm::dot(turned(v), v);
        const double inPlane = glm::dot(turned(u), u1) * (glm::dot(glm::cross(v, d), u) > 0 ? 1 : -1);
        reference::Surfel surfel = onSphere(n, 1);
        surfel.eta = 1 / eta;
        const Cone cone =
            reference::afterImpulse({width, spread}, width, surfel, d, {w_i, Vec3(1), !reflects});
        // Second order in kAside, over the width: 1e-3 of what turns.
        EXPECT_NEAR(cone.spread, (inPlane + across) / 2, 2e-4 + 2e-3 * spread)
            << spread << ' ' << angle << ' ' << reflects;
      }
}

TEST(Cone, KeepsItsSpreadAtFlatMirrors) {
  const Vec3 n(0, 1, 0), d = glm::normalize(Vec3(1, -1, 0)), w_i = glm::normalize(Vec3(1, 1, 0));
  const Cone cone = reference::afterImpulse({0, 0.01}, 0.03, onSphere(n, 0), d, {w_i, Vec3(1), false});
  EXPECT_EQ(cone.spread, 0.01);
  EXPECT_NEAR(reference::widthAt(cone, 2), 0.05, 1e-15) << "as after 5 m without the mirror";
}

TEST(Cone, BendIsTheCurvatureOfASphere) {
  Scene scene;
  const double radius = 2.5;
  for (const Vec3 direction : {Vec3(0, 1, 0), Vec3(0.01, 1, 0), Vec3(0, 1, -0.01)}) {
    scene.normals.emplace_back(glm::normalize(direction));
    scene.positions.emplace_back(radius * glm::normalize(direction));
  }
  scene.triangles.push_back({0, 1, 2, 0});
  // Floats of 2.5 and 0.01 between them: 2e-7 over 0.02.
  EXPECT_NEAR(reference::bendOf(scene, 0), 1 / radius, 2e-5);
  scene.normals[1] = glm::vec3(0);
  EXPECT_EQ(reference::bendOf(scene, 0), 0) << "a corner without a normal";
}

Scene checkered(int size, Encoding encoding) {
  Scene scene;
  Material material;
  (encoding == Encoding::Srgb ? material.baseColorTexture : material.normalTexture).image = 0;
  Image image{"", size, size, {}};
  for (int i = 0; i < size * size; ++i) {
    const std::uint8_t code = (i + i / size) % 2 ? 255 : 0;
    image.texels.insert(image.texels.end(), {code, code, code, 255});
  }
  scene.images = {image};
  scene.materials = {material};
  return scene;
}

/// So many texels along u, and along v.
Footprint inTexels(const Scene& scene, double u, double v) {
  const double size = scene.images[0].width;
  return {{u / size, 0}, {0, v / size}};
}

TEST(Footprint, OfManyTexelsSeesTheirMean) {
  const Scene scene = checkered(16, Encoding::Srgb);
  const reference::TextureLevels levels(scene, {});
  const TextureSlot& slot = scene.materials[0].baseColorTexture;
  const auto seen = [&](double u, double v, const Vec2& at) {
    return reference::filteredTexture(scene, levels, slot, at, inTexels(scene, u, v), {Encoding::Srgb, false})
        .r;
  };
  // Half the light, rounded to a code: 188, a step of which is 0.0085.
  for (const Vec2 at : {Vec2(0.03125), Vec2(0.3, 0.7)}) EXPECT_NEAR(seen(4, 4, at), 0.5, 0.005);
  // Narrow and long: the lookups lie along the length. Neighbours that differ are the worst for some and a
  // half apart.
  EXPECT_NEAR(seen(8, 1, {0.03125, 0.03125}), 0.5, 0.2) << "eight texels in a row, four of them white";
  EXPECT_NEAR(seen(1, 8, {0.03125, 0.03125}), 0.5, 0.2);
  EXPECT_EQ(seen(1, 1, {0.03125, 0.03125}), 0) << "the texel itself";
  EXPECT_EQ(seen(0.1, 0.9, {0.09375, 0.03125}), 1);
}

}  // namespace
}  // namespace whittle::test
