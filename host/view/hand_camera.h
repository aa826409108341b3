// A camera in a hand: what moving a mouse or pressing a key does to it. The world's up is +Y, as glTF has it.
#pragma once

#include "scene/camera.h"
#include "scene/scene.h"

namespace whittle::view {

class HandCamera {
 public:
  HandCamera() = default;
  /// `pivot`: what orbits, pans and zooms are about, in the scene's coordinates; lengths in metres.
  HandCamera(const Camera& camera, const glm::dvec3& pivot);

  const Camera& camera() const { return camera_; }
  const glm::dvec3& pivot() const { return pivot_; }
  /// The point keeps its distance along the view.
  void setPivot(const glm::dvec3& pivot) { pivot_ = pivot; }
  void setFieldOfView(double radians);
  /// Metres that an orthographic picture shows from edge to edge.
  void setOrthographicHeight(double metres);

  /// Radians about the world's up and the camera's right, as if a hand turned the scene; never over the
  /// poles. The pivot keeps its place in the picture.
  void orbit(double right, double up);
  /// By shares of the picture's height, at the pivot's distance: what lies there goes along with the hand.
  void pan(double right, double up);
  /// The distance from the pivot is divided by the factor; an orthographic camera shows as much less.
  void zoom(double factor);
  /// Radians, on the spot.
  void look(double right, double up);
  /// Metres.
  void fly(double right, double up, double ahead);
  /// What is near and far is all seen: a view by hand has the near and far plane of nobody's camera, and no
  /// option of the command line either.
  void openPlanes();
  /// Perspective and orthographic with the same height of picture at the pivot.
  void switchOrthographic();

 private:
  double distance() const;
  void turn(const glm::dvec3& axis, double radians, bool aboutPivot);
  void turnUpward(double radians, bool aboutPivot);

  Camera camera_;
  glm::dvec3 position_{0};  ///< Camera has single precision: many small moves would be lost
  glm::dvec3 pivot_{0};
};

}  // namespace whittle::view
