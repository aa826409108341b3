// What of a scene can be edited while it is rendered: numbers of its lights, materials and background. They
// are few beside its triangles and texels, so they travel where those stay.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

struct Appearance {
  std::vector<Light> lights;        ///< as many as the scene has, in its order
  std::vector<Material> materials;  ///< the same
  glm::vec3 backgroundRadiance{0.0F};
  double backgroundRotation = 0.0;
};

Appearance appearanceOf(const Scene& scene);

/// Writes intensity, position, direction and cone of lights, factors of materials, radiance and rotation of
/// the background. Everything else stays as it is, so that another thread may read that meanwhile.
void setAppearance(const Appearance& appearance, Scene& scene);

/// Whether the two differ in what setAppearance writes.
bool differs(const Light& a, const Light& b);
bool differs(const Material& a, const Material& b);

/// As --background-rotation and --background-strength say; a background with a sun of its own is not turned.
void turnAndScale(Background& background, const Settings& settings);

}  // namespace whittle
