// Case 33: nothing to see, nothing to see by, and cameras at the ends of what they can be.
#include <cmath>

#include "forms.h"

namespace whittle::test {
namespace {

const glm::vec3 kSky{0.25F, 0.5F, 1};

std::size_t otherThanSky(const FloatImage& image) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    count += image.pixels[i] != kSky[static_cast<int>(i % 3)];
  return count;
}

TEST(CaseEmpty, NoTrianglesNoLightsOnePixel) {
  for (const bool light : {false, true}) {
    for (const int size : {1}) {
      Scene scene;
      scene.background.radiance = kSky;
      scene.cameras.resize(1);
      if (light) scene.lights = {pointLight({0, 1, 0}, 3)};
      const Views views = everyForm(scene, caseSettings(size, size));
      recordCount("33",
                  fmt::format("no triangles, {}, {}×{} pixels", light ? "a light" : "no lights", size, size),
                  "the background", otherThanSky(views.kernel.radiance),
                  static_cast<std::size_t>(3 * size * size), "values");
    }
  }
}

/// A bright disc of known size in the middle of the view: the share of the picture that it fills.
TEST(CaseEmpty, FieldsOfViewFromNothingToAll) {
  const double degree = std::acos(-1.0) / 180;
  for (const double fov : {1e-3, 179.9}) {
    Scene scene;
    scene.background.radiance = kSky;
    const double half = std::tan(fov / 2 * degree);
    // A square that fills the middle half of the picture's height, 10 m away.
    const auto h = static_cast<float>(10 * half / 2);
    addQuad(scene, addMaterial(scene, emitter(glm::vec3(1))), {-h, -h, -10}, {2 * h, 0, 0}, {0, 2 * h, 0});
    scene.cameras.resize(1);
    scene.cameras[0].yfov = static_cast<float>(fov * degree);
    const Views views = everyForm(scene, caseSettings(16, 16));
    // tan of an angle close to 90° is as uncertain as the angle's last bit: edges may move by a pixel there.
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < 256; ++i) {
      const double x = std::abs(static_cast<double>(i % 16) - 7.5),
                   y = std::abs(static_cast<double>(i / 16) - 7.5);
      const bool inside = x < 4 && y < 4;
      wrong += (red(views.kernel.radiance, i) == 1.0) != inside;
    }
    recordCount("33", fmt::format("field of view of {:g}°, a square over half of it", fov),
                "8×8 of 16×16 pixels", wrong, 256, "pixels");
  }
}

TEST(CaseEmpty, ACameraOnATriangle) {
  Scene scene;
  scene.background.radiance = kSky;
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, 4);
  scene.lights = {pointLight({0, 2, 0}, 4)};
  for (const glm::dvec3& w : {glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0), glm::dvec3(1, -0.1, 0.3)}) {
    scene.cameras = {rayCamera({0.3, 0, 0.2}, w)};
    const Views views = everyForm(scene, caseSettings(1, 1));
    recordCount("33", fmt::format("a camera on a triangle, looking along ({:g}, {:g}, {:g})", w.x, w.y, w.z),
                "the background: nothing lies at t = 0", otherThanSky(views.kernel.radiance), 3, "values");
  }
}

}  // namespace
}  // namespace whittle::test
