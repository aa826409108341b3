// A scene as every form of the renderer sees it: one ray or sixteen, array or tree, and the double-precision
// recursion. All cases keep one set of features, so that they share compiled kernels.
#pragma once

#include <initializer_list>

#include "analysis/scene_features.h"
#include "reference/reference.h"
#include "support/record.h"
#include "support/search_bench.h"
#include "support/single_rays.h"

namespace whittle::test {

inline std::uint64_t bitsOf(std::initializer_list<Feature> features) {
  std::uint64_t bits = 0;
  for (const Feature f : features) bits |= std::uint64_t{1} << static_cast<int>(f);
  return bits;
}

/// What the scenes of these cases need between them.
inline std::uint64_t commonFeatures() {
  using F = Feature;
  return bitsOf({F::SHADOWS, F::FILTERED_SHADOWS, F::POINT_LIGHTS, F::DIRECTIONAL_LIGHTS, F::LIGHTS, F::METAL,
                 F::MIRROR, F::TRANSMISSION, F::REFRACTION, F::ABSORPTION, F::EMISSION, F::UNLIT,
                 F::SPECULAR_EXTENSION, F::VERTEX_COLORS, F::BACKGROUND, F::BOTH_BRANCHES, F::ORTHOGRAPHIC,
                 F::IMPULSES});
}

/// At least two bounces: one alone would leave the impulses out.
inline Settings caseSettings(int width, int height, int bounces = 2) {
  Settings settings;
  settings.width = width;
  settings.height = height;
  settings.bounces = bounces;
  settings.keepFeatures = commonFeatures();
  return settings;
}

/// Only the renderer's own choice of form.
inline RenderResult seen(const Scene& scene, const Settings& settings) {
  return renderOnDevice(scene, settings);
}

struct Views {
  RenderResult kernel;        ///< of the first form; the others have its bits
  ReferenceResult reference;  ///< in double
};

/// Renders in every form; fails where one has other bits, loses rays or counts other samples as not finite.
inline Views everyForm(const Scene& scene, const Settings& settings) {
  Views views;
  for (const SearchForm& form : searchForms()) {
    Settings own = settings;
    own.search = form.search;
    own.lanes = form.lanes;
    RenderResult result = renderOnDevice(scene, own);
    EXPECT_EQ(result.stats.dropped, 0U) << form.name;
    if (&form == searchForms().data()) {
      views.kernel = std::move(result);
      continue;
    }
    EXPECT_EQ(differingPixels(views.kernel.radiance, result.radiance), 0U) << form.name;
    EXPECT_EQ(views.kernel.stats.rays.total(), result.stats.rays.total()) << form.name;
    EXPECT_EQ(views.kernel.stats.nonFinite, result.stats.nonFinite) << form.name;
  }
  views.reference = renderReference(scene, settings);
  return views;
}

/// Parallel rays straight down, pixel i of a row of `count` at x = first + i step, from `height`.
inline Camera rowCamera(double first, double step, int count, double height) {
  Camera camera;
  camera.orthographic = true;
  camera.forward = {0, -1, 0};
  camera.right = {1, 0, 0};
  camera.up = {0, 0, -1};
  camera.ymag = static_cast<float>(step / 2);
  camera.position = glm::vec3(glm::dvec3(first + step * (count - 1) / 2, height, 0));
  return camera;
}

/// One ray from `origin` along `direction`: the camera of a picture of one pixel.
inline Camera rayCamera(const glm::dvec3& origin, const glm::dvec3& direction) {
  Camera camera;
  camera.position = glm::vec3(origin);
  aim(camera, direction);
  return camera;
}

inline double red(const FloatImage& image, std::size_t pixel = 0) {
  return static_cast<double>(image.pixels[3 * pixel]);
}
inline double green(const FloatImage& image, std::size_t pixel = 0) {
  return static_cast<double>(image.pixels[3 * pixel + 1]);
}

inline bool allFinite(const FloatImage& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(), [](float v) { return std::isfinite(v); });
}

}  // namespace whittle::test
