// Cameras: what a picture of one shows, which is meant, and one made out of a place to look from.
#pragma once

#include <optional>

#include "scene/scene.h"

namespace whittle {

/// Width over height of a picture where nothing else says.
inline constexpr double kUsualAspect = 16.0 / 9.0;

/// Half the height that a picture of this aspect shows, metres at a distance of 1 m (perspective) or anywhere
/// (orthographic). A picture narrower than the camera's own frame shows more above and below, so that nothing
/// of the frame is cut off (glTF 2.0, 3.10.3).
double halfHeight(const Camera& camera, double aspect);

/// Whether something lies before the camera's near plane, so that eye rays may meet it there.
bool nearPlaneCuts(const Scene& scene, const Camera& camera, double aspect);
/// Whether something lies beyond its far plane.
bool liesBeyondFarPlane(const Scene& scene, const Camera& camera);

/// Index of the camera with this name, on a node of this name, or with this number, in that order. Throws
/// InputError for a selector that fits none.
std::size_t findCamera(const Scene& scene, const std::string& selector);

/// Box of the triangles; 2 m around the origin where there are none.
struct Bounds {
  glm::dvec3 lo{-1.0}, hi{1.0};
};
Bounds boundsOf(const Scene& scene);

/// A camera by hand. Either an eye and what it looks at, in the file's coordinates, or an orbit around the
/// scene's middle.
struct Viewpoint {
  std::optional<glm::dvec3> eye, lookAt;  ///< metres; without lookAt: the scene's middle
  glm::dvec3 up{0, 1, 0};
  std::optional<double> yfov;  ///< radians; without: that of the added camera
  /// Orthographic, and so many metres of the scene from the picture's lower edge to its upper one.
  std::optional<double> orthoHeight;
  /// Degrees: azimuth from +Z towards +X, elevation. Distance in metres from the middle; without: so that the
  /// scene fills the picture.
  std::optional<glm::dvec2> orbit;
  std::optional<double> distance;
};

/// What looks from there at a picture of this aspect. Throws InputError where eye and lookAt are one, or up
/// runs along the view.
Camera cameraAt(const Scene& scene, const Viewpoint& from, double aspect);

/// The camera of a file that has none: from the front right and a little above, or of a scene half as long
/// again to the side, from there; so far away that all of the scene is in the picture.
Camera framingCamera(const Scene& scene, double aspect);

}  // namespace whittle
