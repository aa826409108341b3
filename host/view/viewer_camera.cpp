// The camera as hands, keys and the clipboard move it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "analysis/focus.h"
#include "scene/camera.h"
#include "scene/input_error.h"
#include "view/viewer.h"

namespace whittle::view {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Not a number where the text is none.
double parsedNumber(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void Viewer::cameraMoved() {
  camera_.openPlanes();
  if (scene_) ask();
}

void Viewer::orbit(double right, double up) { camera_.orbit(right, up), cameraMoved(); }
void Viewer::pan(double right, double up) { camera_.pan(right, up), cameraMoved(); }
void Viewer::zoom(double factor) { camera_.zoom(factor), cameraMoved(); }
void Viewer::look(double right, double up) { camera_.look(right, up), cameraMoved(); }
void Viewer::fly(double right, double up, double ahead) {
  const double step = size() / 100;
  camera_.fly(right * step, up * step, ahead * step);
  cameraMoved();
}

void Viewer::holdPoint(double x, double y) {
  if (scene_) camera_.setPivot(pointUnder(*scene_, camera_.camera(), aspect(), x, y, camera_.pivot()));
}

void Viewer::resetCamera() {
  if (!scene_) return;
  camera_ = held(scene_->cameras[findCamera(*scene_, settings_.camera)]);
  ask();
}

/// As far back along the view as shows the whole box's ball.
void Viewer::frameAll() {
  if (!scene_) return;
  Camera camera = camera_.camera();
  const double radius = size() / 2, half = halfHeight(camera, aspect());
  const double least = std::min(1.0, aspect());
  if (camera.orthographic) {
    camera.ymag = static_cast<float>(radius / least);
    camera.aspect = 0;
    camera.position = glm::vec3(middle() - glm::dvec3(camera.forward) * 2.0 * radius);
  } else {
    const double away = radius / std::sin(std::atan(half * least));
    camera.position = glm::vec3(middle() - glm::dvec3(camera.forward) * away);
  }
  camera_ = HandCamera(camera, middle());
  cameraMoved();
}

void Viewer::seeFrom(Side side) {
  Camera camera = camera_.camera();
  const auto look = [&](const glm::vec3& forward, const glm::vec3& up) {
    camera.forward = forward, camera.up = up, camera.right = glm::cross(forward, up);
  };
  if (side == Side::Front) look({0, 0, -1}, {0, 1, 0});
  if (side == Side::Right) look({-1, 0, 0}, {0, 1, 0});
  if (side == Side::Top) look({0, -1, 0}, {0, 0, -1});
  camera_ = HandCamera(camera, middle());
  frameAll();
}

void Viewer::switchOrthographic() { camera_.switchOrthographic(), cameraMoved(); }

std::vector<std::string> Viewer::cameras() const {
  std::vector<std::string> names;
  if (!scene_) return names;
  for (std::size_t i = 0; i < scene_->cameras.size(); ++i) {
    const Camera& c = scene_->cameras[i];
    names.push_back(fmt::format("{} {}", i, c.name.empty() ? c.node : c.name));
  }
  return names;
}

void Viewer::chooseCamera(std::size_t index) {
  if (!scene_ || index >= scene_->cameras.size()) return;
  settings_.camera = std::to_string(index);
  resetCamera();
}

double Viewer::fieldOfView() const { return static_cast<double>(camera_.camera().yfov) * kDegrees; }
void Viewer::setFieldOfView(double degrees) {
  camera_.setFieldOfView(degrees / kDegrees);
  cameraMoved();
}

std::optional<double> Viewer::orthographicHeight() const {
  const Camera& camera = camera_.camera();
  return camera.orthographic ? std::optional(2.0 * static_cast<double>(camera.ymag)) : std::nullopt;
}

void Viewer::setOrthographicHeight(double metres) {
  camera_.setOrthographicHeight(metres);
  cameraMoved();
}

std::string Viewer::setHeight(const std::string& text) {
  const double metres = parsedNumber(text);
  if (!(metres > 0.0) || !std::isfinite(metres))
    return fmt::format("{}: '{}' is no height in metres", kHeightSetting, text);
  if (!orthographicHeight()) switchOrthographic();
  setOrthographicHeight(metres);
  return {};
}

std::string Viewer::setFov(const std::string& text) {
  const double degrees = parsedNumber(text);
  if (!(degrees >= 0.001 && degrees <= 179))
    return fmt::format("{}: '{}' is not from 0.001 to 179 degrees", kFovSetting, text);
  if (orthographicHeight()) switchOrthographic();
  setFieldOfView(degrees);
  return {};
}

std::string Viewer::setCamera(const std::string& text) {
  if (!scene_) return fmt::format("{}: there is no scene yet", kCameraSetting);
  try {
    chooseCamera(findCamera(*scene_, text));
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

std::string Viewer::cameraText() const {
  return scene_ ? services_.cameraText(camera_.camera(), scene_->origin) : std::string();
}

void Viewer::pasteCamera(const std::string& text) {
  if (!scene_) return;
  try {
    camera_ = held(services_.camera(*scene_, aspect(), text));
  } catch (const InputError& e) {
    return say(true, e.what());
  }
  ask();
}

}  // namespace whittle::view
