// The model behind a window: settings, camera and scene, and a picture of them that is always under way.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "view/comparison.h"
#include "view/hand_camera.h"
#include "view/live_render.h"
#include "view/newest_worker.h"
#include "view/recent_files.h"
#include "view/scene_editor.h"
#include "view/view_model.h"

namespace whittle::view {

/// The control that no option of a render has: which layer is shown.
inline constexpr const char* kLayerControl = "show";

/// What the command line knows and the model does not. All but `load` are called by the window's thread.
struct Services {
  std::vector<Control> controls;
  /// The default of a control, which another setting may decide.
  std::function<std::string(const Settings&, const std::string& id)> standard;
  /// The value of a control as text.
  std::function<std::string(const Settings&, const std::string& id)> value;
  /// Throws InputError, with the settings as before.
  std::function<void(Settings&, const std::string& id, const std::string& text)> set;
  /// Reads a scene on the render's thread: settles what the settings leave to it, and adds notes. `file`: a
  /// scene or an environment, empty: the same as before. Throws InputError.
  std::function<Scene(const std::filesystem::path& file, Settings&, std::vector<std::string>& notes)> load;
  /// Throws InputError where a picture of these settings takes more memory than there is.
  std::function<void(const Settings&)> checkPicture;
  /// Codes of a picture, RGBA. It and `stops` are called by other threads.
  std::function<std::vector<std::uint8_t>(const FloatImage&, const Scene&, const Settings&)> codes;
  /// The exposure of a picture in stops, chosen where the settings leave it open.
  std::function<float(const FloatImage&, const Scene&, const Settings&)> stops;
  /// On another thread. Throws InputError.
  std::function<Reference(const std::filesystem::path&)> readReference;
  std::function<std::string(const Camera&, const glm::dvec3& origin)> cameraText;
  /// Throws InputError.
  std::function<Camera(const Scene&, double aspect, const std::string& text)> camera;
  /// Writes pictures called after `stem` and returns what was written. Throws.
  std::function<std::string(const std::filesystem::path&, const RenderResult&, const Scene&, const Settings&)>
      save;
  /// As options of the command line.
  std::function<std::string(const Settings&)> optionsText;
  /// Writes a copy of the scene's file with the differences of the two and returns what was written; an empty
  /// name: beside the file. Throws.
  std::function<std::string(const std::filesystem::path& copy, const Scene&, const Appearance& file,
                            const Appearance& edited)>
      saveScene;
  std::function<void()> wake;  ///< the window: there is something new; any thread
  RecentFiles recent{{}};
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
  std::string impasse() const override;
  bool isSaving() const override { return !saves_.empty(); }
  bool hasNewestCodes() const override { return codesMade_ == codesAsked_; }
  const std::vector<Message>& messages() const override { return messages_; }
  const std::vector<Control>& controls() const override { return services_.controls; }
  std::string value(const std::string& id) const override;
  std::string set(const std::string& id, const std::string& text) override;
  EditModel& edits() override { return editor_; }
  std::string optionsText() const override { return services_.optionsText(settings_); }

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
  std::optional<double> orthographicHeight() const override;
  void setOrthographicHeight(double metres) override;
  std::string cameraText() const override;
  void pasteCamera(const std::string& text) override;
  void setMoving(bool isMoving) override;
  void explain(double x, double y) override;
  void closeExplanation() override { explained_.reset(), followed_ = 0; }
  const Explained* explained() const override { return explained_ ? &*explained_ : nullptr; }

  const CompareView& compared() const override { return comparison_.view(); }
  void keepReference() override;
  std::optional<Region> region() const override { return settings_.crop; }

  void open(const std::filesystem::path& file) override;
  void reload() override;
  std::vector<std::filesystem::path> recentFiles() const override { return services_.recent.files(); }
  void save() override;
  void stop() override { live_.stop(); }
  std::string stateJson() const override;

 private:
  /// What the render's thread has read.
  struct Loaded {
    std::shared_ptr<Scene> scene;
    Settings before, settings;  ///< what loading was given, and what it made of that
    std::vector<std::string> notes;
    bool keepsCamera = false;
    std::string problem;  ///< why there is no scene
    int loads = 1;        ///< that ended since the last one was taken over
  };
  void load(const std::filesystem::path& file, bool keepsCamera);
  void takeOver(Loaded loaded);
  void settle(const Loaded& loaded);
  Request request() const;
  bool hasMemory();
  /// A pixel's rays, fresh from the render's thread.
  struct Followed {
    std::uint64_t number = 0;  ///< see followed_
    Request request;
    int x = 0, y = 0;
    RayTree tree;
    std::optional<RayTree> reference;
  };
  void follow(int x, int y);
  void deliver(const Followed& followed);
  static Explained explainedOf(Followed followed);
  void ask(bool coarseFirst = false);
  void renewStandards();  ///< of the controls
  SceneEditor::Owner owner();
  /// Lights, materials or the background were.
  void edited();
  void renewAppearance();
  void sayNeeds();
  void cameraMoved();
  void say(bool isError, std::string text);
  double aspect() const;
  double size() const;  ///< of the scene, metres
  glm::dvec3 middle() const;
  HandCamera held(const Camera& camera) const;
  /// Codes, fresh from their thread.
  struct Made {
    std::uint64_t number = 0;  ///< see codesAsked_
    Shown shown;
    std::shared_ptr<const Scene> scene;
    Settings exposed;  ///< with the exposure that was chosen
    Picture picture;
    std::string problem;  ///< why there are none
  };
  bool isTraced() const { return newest_.finished && newest_.request == request_; }
  bool updatePicture();
  void makeCodes();
  void codesInto(Made& made, const std::string& layer) const;
  void takePicture(Made made);
  void lookAtFile();
  void saveAside(const char* doing, std::function<std::string()> write);
  bool takeSaved();
  std::string showLayer(const std::string& layer);
  std::string switchReference(const std::string& text);
  std::string setHeight(const std::string& text);
  std::string setCamera(const std::string& text);
  std::string setFov(const std::string& text);

  Services services_;
  Settings settings_;
  std::string layer_;             ///< that is shown, kBeauty or one of kAovNames
  std::shared_ptr<Scene> scene_;  ///< null: none yet; its appearance is the render's (Request)
  SceneEditor editor_;
  Background background_;                         ///< of the scene, without its map
  std::shared_ptr<const Appearance> appearance_;  ///< as it is edited
  /// What the picture before an edit needed; unset: nothing was edited since.
  std::optional<std::vector<std::string>> neededBefore_;
  Bounds bounds_;  ///< of its triangles
  HandCamera camera_;
  bool isMoving_ = false;
  Shown newest_;             ///< that the render's thread has
  Shown shown_;              ///< whose codes are in picture_
  std::uint64_t album_ = 0;  ///< grows with each file that is opened: see Request
  std::uint64_t request_ = 0;
  /// Since the last request, seconds, until codes were there of its first picture, of the first that was not
  /// coarse, of the last; 0: not yet.
  struct Times {
    std::chrono::steady_clock::time_point asked{};
    double first = 0, full = 0, refined = 0;
  } times_;
  Picture picture_;
  std::uint64_t codesAsked_ = 0, codesMade_ = 0;  ///< how often codes were asked for; which are there
  std::vector<Message> messages_;
  std::string lastError_;
  int loadsUnderWay_ = 0;
  std::string loadProblem_;       ///< of the last scene that was read; empty: none
  bool isAmbientByHand_ = false;  ///< no load chooses it then
  /// The scene's file, and when it was written as far as is known; an exporter that is still at it is waited
  /// for.
  std::filesystem::path file_;
  std::filesystem::file_time_type written_{}, writing_{};
  std::chrono::steady_clock::time_point lookedAt_{};
  std::optional<Explained> explained_;
  bool comparesWithReference_ = false;
  std::uint64_t follows_ = 0;   ///< how often a pixel's rays were asked for
  std::uint64_t followed_ = 0;  ///< the time whose rays are still wanted; 0: none is
  std::mutex mutex_;            ///< of loaded_, delivered_ and made_
  std::optional<Loaded> loaded_;
  std::optional<Followed> delivered_;
  std::optional<Made> made_;
  // Last: their threads use services_ and what mutex_ guards.
  Comparison comparison_;
  NewestWorker coder_;
  LiveRender live_;
  std::mutex saving_;  ///< held while something is written
  std::vector<std::future<Message>> saves_;
};

}  // namespace whittle::view
