// The same room in micrometres and in light-years, moved far from the origin, and through transforms that
// stretch, mirror or flatten.
#include "forms.h"
#include "scene/gltf_builder.h"

namespace whittle::test {
namespace {

/// A room of about 4 m: matte floor, mirror, slab of tinted glass, a blocker under a lamp; times `scale`. The
/// lamp grows with the square and absorption shrinks, so that the radiance is the same at any scale.
Scene room(double scale) {
  const auto s = static_cast<float>(scale);
  Scene scene;
  addFloor(scene, lambert({0.6F, 0.5F, 0.4F}), 0, true, 2 * s);
  addQuad(scene, addMaterial(scene, mirror(glm::vec3(0.8F))), {-2 * s, 0, -2 * s}, {4 * s, 0, 0},
          {0, 3 * s, 0});
  Material tinted = glass(1.5F, true);
  tinted.sigma_a = glm::vec3(glm::dvec3(0.2, 0.5, 1) / scale);
  const std::uint32_t slab = addMaterial(scene, tinted);
  addQuad(scene, slab, {-1.5F * s, 0.5F * s, 0}, {s, 0, 0}, {0, s, 0});
  addQuad(scene, slab, {-1.5F * s, 0.5F * s, -0.25F * s}, {0, s, 0}, {s, 0, 0});
  addQuad(scene, addMaterial(scene, lambert(glm::vec3(0.7F))), {0.25F * s, s, -0.5F * s}, {0, 0, s},
          {s, 0, 0});
  scene.lights = {pointLight(glm::vec3(glm::dvec3(0.5, 2.5, 0.5) * scale), 1)};
  scene.lights[0].intensity = glm::vec3(glm::dvec3(8, 7, 6) * scale * scale);
  scene.background.radiance = {0.1F, 0.2F, 0.4F};
  scene.cameras = {rayCamera(glm::dvec3(0.3, 1.7, 3.1) * scale, {-0.1, -0.35, -1})};
  return scene;
}

struct Scale {
  const char* id;
  const char* name;
  double metres;
};

TEST(Scale, ARoomInMicrometresAndInLightYears) {
  const Settings settings = caseSettings(16, 9, 5);
  const ReferenceResult exact = renderReference(room(1), settings);
  for (const Scale& scale : {Scale{"O10", "1 m", 1},
                             {"O10", "1 um", 1e-6},
                             {"O10", "1e-9 m", 1e-9},
                             {"O11", "1e4 km", 1e7},
                             {"O11", "1 astronomical unit", 1.495978707e11},
                             {"O11", "1e12", 1e12},
                             {"O11", "1e13", 1e13},
                             {"O11", "1 light-year", 9.4607304725808e15}}) {
    SCOPED_TRACE(scale.name);
    const Views views = everyForm(room(scale.metres), settings);
    Worst worst;
    for (std::size_t i = 0; i < exact.radiance.pixels.size(); ++i)
      worst.relative(views.kernel.radiance.pixels[i], exact.radiance.pixels[i]);
    record({scale.id, fmt::format("a room with mirror, glass and shadow whose metre is {}", scale.name),
            "the radiance of the room in metres (double)", worst.result(), worst.error(), "relative", 2e-5});
  }
}

}  // namespace
}  // namespace whittle::test
