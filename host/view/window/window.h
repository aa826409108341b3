// The window: GLFW, OpenGL and Dear ImGui, from the first frame to the last.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <set>
#include <string>

#include "view/window/panels.h"
#include "view/window/window_library.h"

struct GLFWwindow;

namespace whittle::view {

/// After the last event: what fades or follows takes a frame or two more.
inline constexpr int kFramesAfterEvent = 3;
/// Without a move for so long the hand is off the camera.
inline constexpr double kRestSeconds = 0.15;

/// What the colours of the difference mean.
ColorScale differenceScale(const CompareView& compared);

class Window : public Stage {
 public:
  /// Throws std::runtime_error where there is no display, or none with OpenGL 3.
  Window(ViewModel& model, const WindowOptions& options);
  ~Window() override;
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Until it is closed.
  void run();

  void redraw() override { framesToDraw_ = std::max(framesToDraw_, 1); }
  void key(const std::string& name) override;
  void pointer(const Place& place) override;
  void button(const std::string& name, bool isDown) override;
  void wheel(double steps) override { pendingWheel_ += steps; }
  void resize(int width, int height) override;
  void minimise() override;
  void restore() override;
  void drop(const std::string& file) override;
  void screenshot(const std::filesystem::path& file) override { pendingShot_ = file; }
  std::string set(const std::string& id, const std::string& text) override;
  void saveScene(const std::filesystem::path& file) override { model_.edits().save(file); }
  bool hasPicture() const override { return model_.hasPicture(); }
  bool isFinished() const override { return model_.isFinished(); }
  std::string impasse() const override { return model_.impasse(); }
  bool isSaving() const override { return model_.isSaving(); }
  bool showsNewest() const override { return model_.hasNewestCodes(); }
  std::string stateJson() const override;
  void print(const std::string& text) override { options_.print(text); }
  double now() const override;
  void quit() override;

 private:
  void frame();
  // What stands where: window_panels.cpp.
  void drawPanels(float width, float height);
  void leftPanel();
  void rightPanel();
  void bottomLine(float height);
  void clear(int width, int height) const;
  void drawPicture();
  void drawScales();
  void drawScale(const ColorScale& scale, int steps);
  void drawRays(int emphasised);
  void drawHandles();
  /// A handle that the mouse has; false: it has none.
  bool dragHandle(double right, double down);
  /// A picture on the GPU.
  struct Texture {
    unsigned name = 0;
    int width = 0, height = 0;
    std::uint64_t serial = 0;  ///< of the picture in it; 0: none yet
    bool isCoarse = false;
  };
  static void upload(const Picture& picture, Texture& to);
  /// From one share of its width to another, at its place in the window.
  void draw(const Texture& texture, float from, float to);
  void writeShot();
  void moveCamera();
  // A region of the picture: window_region.cpp.
  int widthOfModel() const;
  int heightOfModel() const;
  void switchRegion();
  bool leaveRegion();  ///< false: there is none
  bool marksRegion();  ///< the mouse is taken
  void drawRegion();
  // A reference: window_compare.cpp.
  void switchCompare(CompareMode mode);  ///< on, or off where it is on
  bool compareShortcut(int key);         ///< false: it is none
  /// What is drawn in the place of the picture or of a part of it; null: nothing.
  const Picture* pictureBeside() const;
  bool isSplit() const;
  float splitPlace() const;
  bool slidesSplit();  ///< the mouse is taken
  void drawSplit();
  void drawNames();
  void shortcuts(int key, bool ctrl);
  void pressed(int key, int mods);
  // Size and colours: window_scale.cpp.
  void restyle();
  std::string setScale(const std::string& text);  ///< as ViewModel::set
  bool scaleShortcut(int key);                    ///< false: it is none
  void scaleButtons();
  /// The picture's rectangle in the window.
  struct Rect {
    float x = 0, y = 0, width = 0, height = 0;
  };
  Rect pictureRect(float left, float top, float width, float height) const;
  ImVec2 inPicture(const ImVec2& pointer) const;  ///< [0, 1]²
  ImVec2 mouse() const;
  ImVec2 inWindow(double x, double y) const;  ///< from there
  bool isBusy() const;
  bool isMinimised() const;

  ViewModel& model_;
  const WindowOptions& options_;
  GLFWwindow* window_ = nullptr;
  PanelState panels_;
  Texture texture_;
  Texture beside_;  ///< the reference or the difference
  /// A region that is being marked; places in [0, 1]² of the picture.
  struct Marker {
    bool isOn = false, isDragged = false;
    ImVec2 from{}, to{};
  };
  Marker marker_;
  bool isSliding_ = false;  ///< the line between picture and reference
  Rect picture_;
  Rect ground_;                          ///< the part without panels, from the window's top
  float scale_ = 1, standardScale_ = 1;  ///< of letters and panels; and what the window began with
  float fontScale_ = 0;                  ///< that the letters were drawn for; 0: there are none
  float statisticsCut_ = 0;              ///< pixels of the right panel that one must scroll to see
  int panelsShown_ = 0;                  ///< beside the picture: none for want of room, one or both
  int framesToDraw_ = 3;
  int frames_ = 0;
  double drawnAt_ = 0, frameSeconds_ = 0;  ///< when and how long the last frame was drawn
  bool wasMoving_ = false;
  ImVec2 pressedAt_{-1, -1};              ///< where the left button went down on the picture
  int hoveredRay_ = -1;                   ///< in the list of rays
  std::optional<std::size_t> heldLight_;  ///< whose handle the mouse has
  std::chrono::steady_clock::time_point movedAt_{};
  // What a script does with the mouse.
  bool isScripted_ = false;
  ImVec2 pointer_{-1, -1};
  std::array<bool, 3> buttons_{};
  double pendingWheel_ = 0;
  std::set<int> heldKeys_;
  std::filesystem::path pendingShot_;  ///< the next frame is written there
};

}  // namespace whittle::view
