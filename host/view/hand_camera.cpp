// See hand_camera.h.
#include "view/hand_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace whittle::view {
namespace {

constexpr glm::dvec3 kUp{0, 1, 0};
/// Radians from the poles, where "up" has no meaning.
constexpr double kPole = 1e-3;
constexpr double kLeastView = 0.02, kLargestView = 3.0;       // radians
constexpr double kLeastHeight = 1e-9, kLargestHeight = 1e18;  // metres

glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1 - c));
}

}  // namespace

HandCamera::HandCamera(const Camera& camera, const glm::dvec3& pivot)
    : camera_(camera), position_(camera.position), pivot_(pivot) {}

double HandCamera::distance() const {
  return std::max(1e-9, glm::dot(pivot_ - position_, glm::dvec3(camera_.forward)));
}

void HandCamera::turn(const glm::dvec3& axis, double radians, bool aboutPivot) {
  glm::dvec3 forward = glm::normalize(turned(glm::dvec3(camera_.forward), axis, radians));
  glm::dvec3 up = turned(glm::dvec3(camera_.up), axis, radians);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
  up = glm::cross(right, forward);
  camera_.forward = glm::vec3(forward), camera_.right = glm::vec3(right), camera_.up = glm::vec3(up);
  if (aboutPivot) position_ = pivot_ + turned(position_ - pivot_, axis, radians);
  camera_.position = glm::vec3(position_);
}

void HandCamera::turnUpward(double radians, bool aboutPivot) {
  const double height = std::asin(std::clamp(static_cast<double>(camera_.forward.y), -1.0, 1.0));
  const double limit = std::numbers::pi / 2 - kPole;
  const double allowed =
      std::clamp(height + radians, std::min(-limit, height), std::max(limit, height)) - height;
  turn(glm::dvec3(camera_.right), allowed, aboutPivot);
}

void HandCamera::orbit(double right, double up) {
  turn(kUp, -right, true);
  turnUpward(up, true);
}

void HandCamera::look(double right, double up) {
  turn(kUp, -right, false);
  turnUpward(up, false);
}

void HandCamera::pan(double right, double up) {
  const double height = camera_.orthographic
                            ? 2.0 * static_cast<double>(camera_.ymag)
                            : 2.0 * std::tan(static_cast<double>(camera_.yfov) / 2) * distance();
  const glm::dvec3 by = height * (right * glm::dvec3(camera_.right) + up * glm::dvec3(camera_.up));
  position_ -= by;
  camera_.position = glm::vec3(position_);
}

void HandCamera::zoom(double factor) {
  if (!(factor > 0.0)) return;
  if (camera_.orthographic) {
    camera_.ymag = static_cast<float>(static_cast<double>(camera_.ymag) / factor);
    return;
  }
  position_ = pivot_ + (position_ - pivot_) / factor;
  camera_.position = glm::vec3(position_);
}

void HandCamera::fly(double right, double up, double ahead) {
  const glm::dvec3 by = right * glm::dvec3(camera_.right) + up * kUp + ahead * glm::dvec3(camera_.forward);
  position_ += by;
  pivot_ += by;
  camera_.position = glm::vec3(position_);
}

void HandCamera::setFieldOfView(double radians) {
  camera_.yfov = static_cast<float>(std::clamp(radians, kLeastView, kLargestView));
}

void HandCamera::setOrthographicHeight(double metres) {
  camera_.ymag = static_cast<float>(std::clamp(metres, kLeastHeight, kLargestHeight) / 2);
}

void HandCamera::openPlanes() {
  camera_.znear = 0.0F;
  camera_.zfar = std::numeric_limits<float>::infinity();
}

void HandCamera::switchOrthographic() {
  const double half = std::tan(static_cast<double>(camera_.yfov) / 2);
  if (camera_.orthographic) {
    // As far from the pivot as shows the same there.
    const double wanted = static_cast<double>(camera_.ymag) / half;
    position_ = pivot_ - glm::dvec3(camera_.forward) * wanted;
    camera_.position = glm::vec3(position_);
  } else {
    camera_.ymag = static_cast<float>(half * distance());
  }
  camera_.orthographic = !camera_.orthographic;
}

}  // namespace whittle::view
