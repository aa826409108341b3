// Cases 23, 25 and lights of our own: almost on a plane, faint and fierce ones.
#include <cmath>
#include <numbers>

#include "forms.h"

namespace whittle::test {
namespace {

/// ρ I h / (π (h² + x²)^(3/2)), Lambert's plane under a point light.
double lambertPlane(double rho, double intensity, double h, double x) {
  const double d2 = h * h + x * x;
  return rho * intensity * h / (std::numbers::pi * d2 * std::sqrt(d2));
}

/// A floor of half side 32 m under a light at height h; pixel i at x = i step.
Scene underLight(float h, float intensity, double step, int count) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, 32);
  scene.lights = {pointLight({0, h, 0}, intensity)};
  scene.cameras = {rowCamera(0, step, count, 2)};
  return scene;
}

TEST(CaseLights, AsHighAsAMillionMetresAndAsLowAsAMicrometre) {
  for (const float h : {1e-6F, 1e-3F, 1.0F, 1e3F, 1e6F}) {
    const float intensity = 5 * h * h;
    const Views views = everyForm(underLight(h, intensity, 0.5, 33), caseSettings(33, 1));
    Worst worst;
    for (std::size_t i = 0; i < 33; ++i)
      worst.relative(red(views.kernel.radiance, i),
                     lambertPlane(0.5, static_cast<double>(intensity), static_cast<double>(h),
                                  0.5 * static_cast<double>(i)));
    record({h < 1e-5F ? "O4" : "23", fmt::format("a light {:g} m above a plane, 0 to 16 m away", h),
            "ρ I h / (π (h² + x²)^(3/2))", worst.result(), worst.error(), "relative", 1e-5});
  }
}

TEST(CaseLights, FaintAndFierce) {
  for (const float intensity : {1e-30F, 1e-20F, 1.0F, 1e20F, 1e30F}) {
    const Views views = everyForm(underLight(2, intensity, 0.5, 17), caseSettings(17, 1));
    Worst worst;
    for (std::size_t i = 0; i < 17; ++i)
      worst.relative(red(views.kernel.radiance, i),
                     lambertPlane(0.5, static_cast<double>(intensity), 2, 0.5 * static_cast<double>(i)));
    EXPECT_EQ(views.kernel.stats.nonFinite, 0U);
    record({"O5", fmt::format("a light of {:g} W/sr 2 m above a plane", intensity),
            "ρ I h / (π (h² + x²)^(3/2))", worst.result(), worst.error(), "relative", 1e-5});
  }
}

TEST(CaseLights, OnASurface) {
  const Views views = everyForm(underLight(0, 5, 1, 9), caseSettings(9, 1));
  Worst worst;
  for (std::size_t i = 0; i < 9; ++i) worst.absolute(red(views.kernel.radiance, i), 0);
  record({"25", "a light in the plane, pixel 0 on it", "0 (no cosine), finite", worst.result(),
          worst.error() + static_cast<double>(views.kernel.stats.nonFinite), "absolute", 0});
}

/// A picture in a corner of which the coordinate counts a million repeats: the texel of the exact coordinate.
TEST(CaseTextures, ACoordinateOfAMillion) {
  Image stripes;
  stripes.width = 8, stripes.height = 1;
  for (int i = 0; i < 8; ++i)
    stripes.texels.insert(stripes.texels.end(), {static_cast<std::uint8_t>(30 * i + 10), 0, 0, 255});
  const auto picture = [&](float from) {
    Material m;
    m.unlit = true;
    m.baseColorTexture.image = 0;
    m.baseColorTexture.filter = Filter::Nearest;
    Scene scene;
    addQuad(scene, addMaterial(scene, m), {0, 0, -1}, {0, 0, 2}, {2, 0, 0});
    scene.images = {stripes};
    scene.uv0 = {{from, 0}, {from, 1}, {from + 2, 1}, {from + 2, 0}};
    scene.cameras = {rowCamera(1.0 / 32, 1.0 / 16, 32, 1)};  // half a texel each, never on a texel's edge
    Settings settings;
    settings.width = 32, settings.height = 1, settings.bounces = 1;
    return everyForm(scene, settings);
  };
  const Views near = picture(0);
  for (const float from : {-1e6F, 1e4F, 1e6F}) {
    const Views far = picture(from);
    recordCount("O12", fmt::format("texture coordinates from {:.0f}, eight texels a repeat", from),
                "the texels of coordinates from 0",
                differingPixels(near.kernel.radiance, far.kernel.radiance), 32, "pixels");
    EXPECT_EQ(differingPixels(near.reference.radiance, far.reference.radiance), 0U);
  }
}

}  // namespace
}  // namespace whittle::test
