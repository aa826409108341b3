// See viewer.h.
#include "view/viewer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "analysis/focus.h"
#include "render/aovs.h"
#include "report/stats.h"
#include "scene/input_error.h"
#include "view/false_colors.h"

namespace whittle::view {
namespace {

constexpr std::size_t kMessages = 200;
constexpr std::chrono::milliseconds kLookEvery{400};  ///< at the scene's file
/// Settings that only change how radiance becomes codes.
bool isOfCodes(const std::string& id) {
  return id == "exposure" || id == "tone-map" || id == "bloom" || id == "dither";
}
/// Those that are edits of the scene.
bool isOfBackground(const std::string& id) {
  return id == "background-rotation" || id == "background-strength";
}

/// Settings that put something into the scene.
bool isOfLoading(const std::string& id) {
  return id == "area-lights" || id == "sky" || id == "sky-light" || id == "time" || id == "animation" ||
         id == "scene" || id == "background";
}

}  // namespace

Viewer::Viewer(Services services, const Settings& settings, const std::filesystem::path& file)
    : services_(std::move(services)),
      settings_(settings),
      layer_(kBeauty),
      editor_(owner()),
      comparison_(services_.readReference, services_.wake),
      live_(services_.wake, services_.compiler, services_.kernelFolder) {
  Control layer;
  layer.id = kLayerControl;
  layer.group = "Picture";
  layer.label = layer.id;
  layer.kind = Control::Kind::Choice;
  layer.words = kAovNames;
  layer.words.insert(layer.words.begin(), kBeauty);
  layer.standard = layer_;
  layer.tip =
      "radiance; or what each pixel's first sample meets: distance, normal, base colour, triangle; how many "
      "samples the pixel has and their standard error; at which bounce the first sample's light came, and "
      "how many nodes and triangles the searches for its hits visited";
  services_.controls.insert(services_.controls.begin(), layer);
  const auto comparing = Comparison::controls();
  const auto afterPicture = std::find_if(services_.controls.begin(), services_.controls.end(),
                                         [](const Control& c) { return c.group != "Picture"; });
  services_.controls.insert(afterPicture, comparing.begin(), comparing.end());
  renewStandards();
  if (!file.empty()) load(file, false);
}

void Viewer::renewStandards() {
  for (Control& c : services_.controls)
    if (c.id != kLayerControl && !Comparison::has(c.id)) c.standard = services_.standard(settings_, c.id);
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
  ++loadsUnderWay_;
  live_.run("reading the scene", [this, file, keepsCamera, settings = settings_]() mutable {
    Loaded loaded;
    loaded.before = loaded.settings = settings;
    loaded.keepsCamera = keepsCamera;
    try {
      loaded.scene = std::make_shared<Scene>(services_.load(file, loaded.settings, loaded.notes));
    } catch (const std::exception& e) {
      loaded.problem = e.what();
    }
    const std::lock_guard lock(mutex_);
    loaded.loads = loaded_ ? loaded_->loads + 1 : 1;
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
  if (!isAmbientByHand_) take(&Settings::ambient);
  take(&Settings::crop);
  if (settings_.crop && !liesWithin(*settings_.crop, settings_.width, settings_.height))
    settings_.crop.reset();
}

void Viewer::takeOver(Loaded loaded) {
  loadProblem_ = loaded.problem;
  if (!loaded.scene) {
    say(true, loaded.problem);
    if (!isTraced()) ask();  // what was under way goes on
    return;
  }
  const bool isFirst = !scene_, isSameFile = scene_ && scene_->file == loaded.scene->file;
  scene_ = loaded.scene;
  bounds_ = boundsOf(*scene_);
  background_.unscaled = scene_->background.unscaled;
  background_.hasSun = scene_->background.hasSun;
  settle(loaded);
  editor_.take(*scene_, isSameFile);
  renewAppearance();
  for (auto& text : loaded.notes) say(false, std::move(text));
  file_ = scene_->file;
  if (!loaded.keepsCamera) services_.recent.add(file_);
  if (!loaded.keepsCamera) written_ = {}, ++album_;
  if (isFirst || !loaded.keepsCamera) camera_ = held(scene_->cameras[findCamera(*scene_, settings_.camera)]);
  ask();
}

Request Viewer::request() const {
  Settings settings = settings_;
  if (layer_ != kBeauty) askForAov(settings, layer_);
  if (settings.aperture > 0 && !settings.focusDistance)
    settings.focusDistance = focusOn(*scene_, camera_.camera(), aspect());
  return {scene_, appearance_, camera_.camera(), settings, isMoving_, album_};
}

void Viewer::ask(bool coarseFirst) {
  if (!scene_ || !hasMemory()) return;
  closeExplanation();  // of another picture
  Request wanted = request();
  wanted.coarseFirst |= coarseFirst;
  request_ = live_.ask(std::move(wanted));
  times_ = {std::chrono::steady_clock::now(), 0, 0, 0};
}

SceneEditor::Owner Viewer::owner() {
  SceneEditor::Owner owner;
  owner.edited = [this] { edited(); };
  owner.say = [this](bool isError, std::string text) { say(isError, std::move(text)); };
  owner.save = [this](const std::filesystem::path& copy, const Appearance& file, const Appearance& edited) {
    if (!scene_) return say(true, "there is no scene yet");
    saveAside("writing a copy of the scene", [this, scene = scene_, copy, file, edited] {
      return services_.saveScene(copy, *scene, file, edited);
    });
  };
  owner.camera = [this]() -> const Camera& { return camera_.camera(); };
  owner.aspect = [this] { return aspect(); };
  return owner;
}

void Viewer::renewAppearance() {
  Appearance now = editor_.appearance();
  turnAndScale(background_, settings_);
  now.backgroundRadiance = background_.radiance;
  now.backgroundRotation = background_.rotation;
  appearance_ = std::make_shared<const Appearance>(std::move(now));
}

void Viewer::edited() {
  if (!neededBefore_ && shown_.result) neededBefore_ = shown_.result->stats.featuresUsed;
  renewAppearance();
  ask(true);
}

/// What an edit made needless, and what it needs, once its first picture is there.
void Viewer::sayNeeds() {
  if (!neededBefore_ || !hasPicture()) return;
  const auto before = *std::exchange(neededBefore_, std::nullopt);
  const auto& now = shown_.result->stats.featuresUsed;
  const auto sayMissing = [&](const std::vector<std::string>& from, const std::vector<std::string>& in,
                              const char* what) {
    std::vector<std::string> missing;
    for (const auto& feature : from)
      if (std::find(in.begin(), in.end(), feature) == in.end()) missing.push_back(feature);
    if (!missing.empty())
      say(false,
          fmt::format("{} {} now {}", fmt::join(missing, ", "), missing.size() > 1 ? "are" : "is", what));
  };
  sayMissing(before, now, "left out");
  sayMissing(now, before, "needed");
}

/// Where a picture would take too much, the one before stays.
bool Viewer::hasMemory() {
  try {
    services_.checkPicture(settings_);
  } catch (const InputError& e) {
    if (messages_.empty() || messages_.back().text != e.what()) say(true, e.what());
    return false;
  }
  return true;
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
    followed.swap(delivered_);
  }
  if (loaded) {
    loadsUnderWay_ -= loaded->loads;
    takeOver(std::move(*loaded));
    isNew = true;
  }
  if (followed && followed->number == followed_) {
    explained_ = explainedOf(std::move(*followed)), isNew = true;
    const auto& rays = explained_->tree.rays;
    if (!rays.empty() && rays[0].hit) editor_.choose(Part::Material, rays[0].hit->material);
  }
  isNew |= takeSaved();
  isNew |= updatePicture();
  isNew |= comparison_.update(messages_);
  const std::string error = live_.progress().error;
  if (error != lastError_) {
    if (!error.empty()) say(true, error);
    lastError_ = error;
    isNew = true;
  }
  return isNew;
}

std::string Viewer::impasse() const {
  if (isFinished() || loadsUnderWay_ > 0) return {};
  if (!scene_) return loadProblem_.empty() ? "no scene is open" : loadProblem_;
  const Progress p = live_.progress();
  return p.doing.empty() ? p.error : std::string();
}

std::string Viewer::value(const std::string& id) const {
  if (id == kLayerControl) return layer_;
  if (id == kReferenceSwitch) return comparesWithReference_ ? "on" : "off";
  if (SceneEditor::isId(id)) return editor_.value(id);
  if (Comparison::has(id)) return comparison_.value(id);
  return services_.value(settings_, id);
}

std::string Viewer::set(const std::string& id, const std::string& text) {
  if (id == kLayerControl) return showLayer(text);
  if (id == kReferenceSwitch) return switchReference(text);
  if (id == kHeightSetting) return setHeight(text);
  if (id == kCameraSetting) return setCamera(text);
  if (id == kFovSetting) return setFov(text);
  if (SceneEditor::isId(id)) return editor_.set(id, text);
  if (Comparison::has(id)) return comparison_.set(id, text);
  Settings changed = settings_;
  try {
    services_.set(changed, id, text);
  } catch (const InputError& e) {
    return e.what();
  }
  if (changed.width != settings_.width || changed.height != settings_.height) changed.crop.reset();
  settings_ = changed;
  renewStandards();
  if (id == "ambient") isAmbientByHand_ = settings_.ambient.has_value();
  if (id == "sky" && !isAmbientByHand_)
    settings_.ambient = Settings{}.ambient;  // loading chooses it again: a sky's is a hundredfold
  if (isOfCodes(id))
    makeCodes();
  else if (isOfBackground(id))
    edited();
  else if (isOfLoading(id) || (id == "ambient" && !settings_.ambient))
    load({}, true), request_ = 0;  // what is shown is of the settings before
  else
    ask();
  return {};
}

std::string Viewer::showLayer(const std::string& layer) {
  const auto& layers = services_.controls.front().words;
  if (std::find(layers.begin(), layers.end(), layer) == layers.end())
    return fmt::format("show: '{}' is not one of {}", layer, fmt::join(layers, "|"));
  const bool isTraced = layer == kBeauty || (newest_.result && newest_.result->aovs.contains(layer));
  layer_ = layer;
  if (isTraced)
    makeCodes();
  else
    ask();
  return {};
}

void Viewer::setMoving(bool isMoving) { isMoving_ = isMoving; }

void Viewer::open(const std::filesystem::path& file) { load(file, false); }
void Viewer::reload() { load({}, true); }

std::string Viewer::stateJson() const {
  nlohmann::ordered_json state;
  if (shown_.result) state["stats"] = statsToJson(shown_.result->stats);
  const Progress p = live_.progress();
  state["view"] = {{"finished", isFinished()},
                   {"coarse", shown_.coarse},
                   {"doing", p.doing},
                   {"error", p.error},
                   {"firstSeconds", times_.first},
                   {"fullSeconds", times_.full},
                   {"refinedSeconds", times_.refined},
                   {"width", picture_.width},
                   {"height", picture_.height},
                   {"programs", p.work.programs},
                   {"scene", p.work.scene ? 1 : 0},
                   {"messages", messages_.size()},
                   {"message", messages_.empty() ? "" : messages_.back().text},
                   {"texelReads", p.work.texelReads},
                   {"lights", p.work.tables.lights ? 1 : 0},
                   {"materials", p.work.tables.materials ? 1 : 0},
                   {"triangles", p.work.tables.triangles ? 1 : 0},
                   {"options", optionsText()},
                   {"camera", cameraText()},
                   {"explainedRays", explained_ ? explained_->tree.rays.size() : 0},
                   {"explainedX", explained_ ? explained_->x : -1},
                   {"explainedY", explained_ ? explained_->y : -1},
                   {"isCompared", explained_ && !explained_->verdict.empty()},
                   {"parts", explained_ && explained_->parts}};
  state["edit"] = editor_.state();
  state["compare"] = comparison_.state();
  return state.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace whittle::view
