// See viewer.h.
#include "view/viewer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "render/explanation.h"
#include "report/stats.h"
#include "scene/input_error.h"
#include "view/false_colors.h"
#include "view/region_picture.h"

namespace whittle::view {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr std::size_t kMessages = 200;
constexpr std::chrono::milliseconds kLookEvery{400};  ///< at the scene's file
/// Settings that only change how radiance becomes codes.
bool isOfCodes(const std::string& id) { return id == "exposure" || id == "tone-map"; }

}  // namespace

Viewer::Viewer(Services services, const Settings& settings, const std::filesystem::path& file)
    : services_(std::move(services)),
      settings_(settings),
      layer_(kLayers.front()),
      comparison_(services_.readReference, services_.wake),
      live_(services_.wake, services_.compiler, services_.kernelFolder) {
  Control layer;
  layer.id = kLayerControl;
  layer.group = "Picture";
  layer.label = layer.id;
  layer.kind = Control::Kind::Choice;
  layer.words = kLayers;
  layer.standard = layer_;
  layer.tip =
      "radiance, or what each pixel's first sample meets: distance, normal, base colour, triangle; or how "
      "many samples it has";
  services_.controls.insert(services_.controls.begin(), layer);
  const auto comparing = Comparison::controls();
  const auto afterPicture = std::find_if(services_.controls.begin(), services_.controls.end(),
                                         [](const Control& c) { return c.group != "Picture"; });
  services_.controls.insert(afterPicture, comparing.begin(), comparing.end());
  if (!file.empty()) load(file, false);
}

void Viewer::say(bool isError, std::string text) {
  if (messages_.size() == kMessages) messages_.erase(messages_.begin());
  messages_.push_back({isError, std::move(text)});
}

double Viewer::aspect() const { return static_cast<double>(settings_.width) / settings_.height; }

double Viewer::size() const { return std::max(1e-9, glm::length(bounds_.hi - bounds_.lo)); }

glm::dvec3 Viewer::middle() const { return (bounds_.lo + bounds_.hi) / 2.0; }

/// Its pivot is what it looks at, else the scene's middle.
HandCamera Viewer::held(const Camera& camera) const {
  HandCamera hand(camera, middle());
  if (scene_) hand.setPivot(pointUnder(*scene_, camera, aspect(), 0.5, 0.5, middle()));
  return hand;
}

void Viewer::load(const std::filesystem::path& file, bool keepsCamera) {
  live_.run("reading the scene", [this, file, keepsCamera, settings = settings_]() mutable {
    Loaded loaded;
    loaded.before = loaded.settings = settings;
    loaded.keepsCamera = keepsCamera;
    try {
      loaded.scene = std::make_shared<const Scene>(services_.load(file, loaded.settings, loaded.notes));
    } catch (const std::exception& e) {
      loaded.problem = e.what();
    }
    const std::lock_guard lock(mutex_);
    loaded_ = std::move(loaded);
  });
}

/// Takes what loading settles, unless it was changed by hand meanwhile.
void Viewer::settle(const Loaded& loaded) {
  const auto take = [&](auto Settings::*member) {
    if (settings_.*member == loaded.before.*member) settings_.*member = loaded.settings.*member;
  };
  take(&Settings::width);
  take(&Settings::height);
  take(&Settings::camera);
  take(&Settings::ambient);
  take(&Settings::crop);
  if (settings_.crop && !liesWithin(*settings_.crop, settings_.width, settings_.height))
    settings_.crop.reset();
}

void Viewer::takeOver(Loaded loaded) {
  if (!loaded.scene) {
    say(true, loaded.problem);
    if (!isFinished()) ask();  // what was under way goes on
    return;
  }
  const bool isFirst = !scene_;
  scene_ = loaded.scene;
  bounds_ = boundsOf(*scene_);
  settle(loaded);
  for (auto& text : loaded.notes) say(false, std::move(text));
  file_ = scene_->file;
  if (!loaded.keepsCamera) written_ = {}, whole_.reset();
  if (isFirst || !loaded.keepsCamera) camera_ = held(scene_->cameras[findCamera(*scene_, settings_.camera)]);
  ask();
}

Request Viewer::request() const {
  Settings settings = settings_;
  settings.aovs = layer_ != kLayers.front();
  return {scene_, camera_.camera(), settings, isMoving_};
}

void Viewer::ask() {
  explained_.reset();  // of another picture
  if (scene_) request_ = live_.ask(request());
}

void Viewer::explain(double x, double y) {
  if (!scene_ || !(x >= 0 && x < 1 && y >= 0 && y < 1)) return;
  Followed followed{scene_,
                    camera_.camera(),
                    aspect(),
                    static_cast<int>(x * settings_.width),
                    static_cast<int>(y * settings_.height),
                    settings_.raysPerPixel,
                    {}};
  const bool isDone = isFinished();
  live_.explain(request(), followed.x, followed.y, [this, followed](std::vector<RayTree> trees) mutable {
    followed.tree = std::move(trees.at(0));
    const std::lock_guard lock(mutex_);
    followed_ = std::move(followed);
  });
  if (!isDone) ask();  // it was cut off
}

ViewModel::Explained Viewer::explainedOf(Followed f) {
  Explained e{f.x, f.y, std::move(f.tree), {}, {}, {}, {}};
  for (std::size_t i = 0; i < e.tree.rays.size(); ++i) {
    e.titles.push_back(rayTitle(e.tree, i, *f.scene));
    e.lines.push_back(rayLines(e.tree, i, *f.scene));
  }
  e.drawn = drawnRays(e.tree, *f.scene, f.camera, f.aspect);
  const glm::dvec3 sum = sumOf(e.tree);
  e.sum = fmt::format("sum of {} rays: {:.6g} {:.6g} {:.6g}; the {} has {:.6g} {:.6g} {:.6g}",
                      e.tree.rays.size(), sum.x, sum.y, sum.z,
                      f.samples > 1 ? fmt::format("first of {} samples", f.samples) : "pixel",
                      e.tree.radiance.x, e.tree.radiance.y, e.tree.radiance.z);
  return e;
}

/// Reads the scene again once its file was written and has been left alone since the last look.
void Viewer::lookAtFile() {
  const auto now = std::chrono::steady_clock::now();
  if (!scene_ || file_.empty() || now - lookedAt_ < kLookEvery) return;
  lookedAt_ = now;
  std::error_code error;
  const auto time = std::filesystem::last_write_time(file_, error);
  if (error) return;  // between two versions, maybe
  if (written_ == std::filesystem::file_time_type{}) written_ = writing_ = time;
  if (time != written_ && time == writing_) {
    written_ = time;
    reload();
  }
  writing_ = time;
}

bool Viewer::update() {
  bool isNew = false;
  lookAtFile();
  std::optional<Loaded> loaded;
  std::optional<Followed> followed;
  {
    const std::lock_guard lock(mutex_);
    loaded.swap(loaded_);
    followed.swap(followed_);
  }
  if (loaded) takeOver(std::move(*loaded)), isNew = true;
  if (followed && followed->scene == scene_) explained_ = explainedOf(std::move(*followed)), isNew = true;
  Shown shown = live_.shown();
  if (shown.result != shown_.result || shown.finished != shown_.finished) {
    takePicture(std::move(shown));
    isNew = true;
  }
  isNew |= comparison_.update(messages_);
  const std::string error = live_.progress().error;
  if (error != lastError_) {
    if (!error.empty()) say(true, error);
    lastError_ = error;
    isNew = true;
  }
  return isNew;
}

void Viewer::takePicture(Shown shown) {
  const bool isOther = shown.result != shown_.result;
  shown_ = std::move(shown);
  if (shown_.result && isOther)
    whole_ =
        shown_.asked.crop
            ? std::make_shared<const RenderResult>(withRegion(whole_.get(), *shown_.result, shown_.asked))
            : shown_.result;
  if (isOther) makeCodes();
}

void Viewer::makeCodes() {
  if (!whole_ || !scene_) return;
  const FloatImage& radiance = whole_->radiance;
  Settings exposed = settings_;
  exposed.exposure = services_.stops(radiance, *scene_, settings_);
  picture_.width = radiance.width;
  picture_.height = radiance.height;
  // The layers come with the first picture that is rendered for them.
  const bool isLayer = layer_ != kLayers.front() && whole_->aovs.contains(layer_);
  picture_.codes = isLayer ? falseColors(*whole_, layer_) : services_.codes(radiance, *scene_, exposed);
  picture_.coarse = shown_.coarse && !shown_.asked.crop;
  ++picture_.serial;
  if (!shown_.coarse)
    comparison_.show(whole_, [codes = services_.codes, scene = scene_, exposed](const FloatImage& light) {
      return codes(light, *scene, exposed);
    });
}

void Viewer::keepReference() {
  if (!whole_ || picture_.coarse) return say(true, "there is no picture yet");
  comparison_.keep(whole_->radiance);
}

bool Viewer::isFinished() const { return shown_.finished && shown_.request == request_; }

std::string Viewer::set(const std::string& id, const std::string& text) {
  if (id == kLayerControl) return showLayer(text);
  if (Comparison::has(id)) return comparison_.set(id, text);
  Settings changed = settings_;
  try {
    services_.set(changed, id, text);
  } catch (const InputError& e) {
    return e.what();
  }
  if (changed.width != settings_.width || changed.height != settings_.height) changed.crop.reset();
  settings_ = changed;
  const auto control = std::find_if(services_.controls.begin(), services_.controls.end(),
                                    [&](const Control& c) { return c.id == id; });
  if (isOfCodes(id))
    makeCodes();
  else if (control != services_.controls.end() && control->reloads)
    load({}, true);
  else
    ask();
  return {};
}

std::string Viewer::showLayer(const std::string& layer) {
  if (std::find(kLayers.begin(), kLayers.end(), layer) == kLayers.end())
    return fmt::format("show: '{}' is not one of {}", layer, fmt::join(kLayers, "|"));
  const bool isTraced = layer == kLayers.front() || (whole_ && whole_->aovs.contains(layer));
  layer_ = layer;
  if (isTraced)
    makeCodes();
  else
    ask();
  return {};
}

void Viewer::cameraMoved() {
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
  ask();
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

void Viewer::setMoving(bool isMoving) { isMoving_ = isMoving; }

void Viewer::open(const std::filesystem::path& file) { load(file, false); }
void Viewer::reload() { load({}, true); }

void Viewer::save(const std::filesystem::path& withoutExtension) {
  if (!whole_ || !scene_) return say(true, "there is no picture yet");
  try {
    say(false, services_.save(withoutExtension, *whole_, *scene_, settings_));
  } catch (const std::exception& e) {
    say(true, e.what());
  }
}

std::string Viewer::stateJson() const {
  nlohmann::ordered_json state;
  if (shown_.result) state["stats"] = statsToJson(shown_.result->stats);
  const Progress p = live_.progress();
  state["view"] = {{"finished", isFinished()},
                   {"coarse", shown_.coarse},
                   {"doing", p.doing},
                   {"error", p.error},
                   {"firstSeconds", p.firstSeconds},
                   {"width", picture_.width},
                   {"height", picture_.height},
                   {"programs", p.work.programs},
                   {"scene", p.work.scene ? 1 : 0},
                   {"messages", messages_.size()},
                   {"explainedRays", explained_ ? explained_->tree.rays.size() : 0}};
  state["compare"] = comparison_.state();
  return state.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace whittle::view
