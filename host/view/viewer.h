// The model behind a window: settings, camera and scene, and a picture of them that is always under way.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "view/comparison.h"
#include "view/hand_camera.h"
#include "view/live_render.h"
#include "view/view_model.h"

namespace whittle::view {

/// The control that no option of a render has: which of false_colors.h's layers is shown.
inline constexpr const char* kLayerControl = "show";

/// What the command line knows and the model does not. All but `load` are called by the window's thread.
struct Services {
  std::vector<Control> controls;
  /// The value of a control as text.
  std::function<std::string(const Settings&, const std::string& id)> value;
  /// Throws InputError, with the settings as before.
  std::function<void(Settings&, const std::string& id, const std::string& text)> set;
  /// Reads a scene on the render's thread: settles what the settings leave to it, and adds notes. `file`: a
  /// scene or an environment, empty: the same as before. Throws InputError.
  std::function<Scene(const std::filesystem::path& file, Settings&, std::vector<std::string>& notes)> load;
  /// Codes of a picture, RGBA.
  std::function<std::vector<std::uint8_t>(const FloatImage&, const Scene&, const Settings&)> codes;
  /// The exposure of a picture in stops, chosen where the settings leave it open.
  std::function<float(const FloatImage&, const Scene&, const Settings&)> stops;
  /// On another thread. Throws InputError.
  std::function<Reference(const std::filesystem::path&)> readReference;
  std::function<std::string(const Camera&, const glm::dvec3& origin)> cameraText;
  /// Throws InputError.
  std::function<Camera(const Scene&, double aspect, const std::string& text)> camera;
  /// Writes NAME.png and NAME.exr and returns what was written. Throws.
  std::function<std::string(const std::filesystem::path&, const RenderResult&, const Scene&, const Settings&)>
      save;
  std::function<void()> wake;  ///< the window: there is something new; any thread
  std::filesystem::path compiler;
  std::optional<std::filesystem::path> kernelFolder;
};

class Viewer : public ViewModel {
 public:
  /// Starts to load the scene at once, if `file` is not empty.
  Viewer(Services services, const Settings& settings, const std::filesystem::path& file);

  bool update() override;
  const Picture& picture() const override { return picture_; }
  const RenderResult* result() const override { return shown_.result.get(); }
  Progress progress() const override { return live_.progress(); }
  bool isFinished() const override;
  bool hasPicture() const override { return shown_.result && shown_.request == request_; }
  const std::vector<Message>& messages() const override { return messages_; }
  const std::vector<Control>& controls() const override { return services_.controls; }
  std::string value(const std::string& id) const override {
    if (Comparison::has(id)) return comparison_.value(id);
    return id == kLayerControl ? layer_ : services_.value(settings_, id);
  }
  std::string set(const std::string& id, const std::string& text) override;

  void orbit(double right, double up) override;
  void pan(double right, double up) override;
  void zoom(double factor) override;
  void look(double right, double up) override;
  void fly(double right, double up, double ahead) override;
  void holdPoint(double x, double y) override;
  void resetCamera() override;
  void frameAll() override;
  void seeFrom(Side side) override;
  void switchOrthographic() override;
  std::vector<std::string> cameras() const override;
  void chooseCamera(std::size_t index) override;
  double fieldOfView() const override;
  void setFieldOfView(double degrees) override;
  std::string cameraText() const override;
  void pasteCamera(const std::string& text) override;
  void setMoving(bool isMoving) override;
  void explain(double x, double y) override;
  void closeExplanation() override { explained_.reset(); }
  const Explained* explained() const override { return explained_ ? &*explained_ : nullptr; }

  const CompareView& compared() const override { return comparison_.view(); }
  void keepReference() override;
  std::optional<Region> region() const override { return settings_.crop; }

  void open(const std::filesystem::path& file) override;
  void reload() override;
  void save(const std::filesystem::path& withoutExtension) override;
  void stop() override { live_.stop(); }
  std::string stateJson() const override;

 private:
  /// What the render's thread has read.
  struct Loaded {
    std::shared_ptr<const Scene> scene;
    Settings before, settings;  ///< what loading was given, and what it made of that
    std::vector<std::string> notes;
    bool keepsCamera = false;
    std::string problem;  ///< why there is no scene
  };
  void load(const std::filesystem::path& file, bool keepsCamera);
  void takeOver(Loaded loaded);
  void settle(const Loaded& loaded);
  Request request() const;
  /// A pixel's rays, fresh from the render's thread.
  struct Followed {
    std::shared_ptr<const Scene> scene;
    Camera camera;
    double aspect = 1;
    int x = 0, y = 0, samples = 1;
    RayTree tree;
  };
  static Explained explainedOf(Followed followed);
  void ask();
  void cameraMoved();
  void say(bool isError, std::string text);
  double aspect() const;
  double size() const;  ///< of the scene, metres
  glm::dvec3 middle() const;
  HandCamera held(const Camera& camera) const;
  void takePicture(Shown shown);
  void makeCodes();
  void lookAtFile();
  std::string showLayer(const std::string& layer);

  Services services_;
  Settings settings_;
  std::string layer_;                   ///< that is shown, of kLayers
  std::shared_ptr<const Scene> scene_;  ///< null: none yet
  Bounds bounds_;                       ///< of its triangles
  HandCamera camera_;
  bool isMoving_ = false;
  Shown shown_;
  /// What of it is seen: with a region the rest is of what was rendered before.
  std::shared_ptr<const RenderResult> whole_;
  std::uint64_t request_ = 0;
  Picture picture_;
  std::string codesOf_;  ///< the exposure and tone map that the codes were made with
  std::vector<Message> messages_;
  std::string lastError_;
  /// The scene's file, and when it was written as far as is known; an exporter that is still at it is waited
  /// for.
  std::filesystem::path file_;
  std::filesystem::file_time_type written_{}, writing_{};
  std::chrono::steady_clock::time_point lookedAt_{};
  std::optional<Explained> explained_;
  std::mutex mutex_;  ///< of loaded_ and followed_
  std::optional<Loaded> loaded_;
  std::optional<Followed> followed_;
  Comparison comparison_;
  LiveRender live_;  ///< last: its thread uses services_ and loaded_
};

}  // namespace whittle::view
