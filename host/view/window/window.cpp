// See window.h.
#include "view/window/window.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <GLFW/glfw3.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "view/window/style.h"

namespace whittle::view {
namespace {

/// Of the panels, in the font's units.
constexpr float kSettingsWidth = 288, kStatisticsWidth = 300, kLineHeight = 28;
/// After the last event: what fades or follows takes a frame or two more.
constexpr int kFramesAfterEvent = 3;
constexpr double kTurn = 3.5;  ///< radians that a drag over the picture's height turns
constexpr double kWheel = 1.12;
/// Without a move for so long the hand is off the camera.
constexpr double kRestSeconds = 0.15;
/// How often a clock and a bar are drawn that go on by themselves. Where OpenGL is software too, each frame
/// is taken from the render: ten a second cost it a third of its time.
constexpr double kClockSeconds = 0.5;
/// How often the model is asked where nothing happens: a scene's file may have been written.
constexpr double kIdleSeconds = 0.5;

Window& windowOf(GLFWwindow* w) { return *static_cast<Window*>(glfwGetWindowUserPointer(w)); }

int buttonOf(const std::string& name) { return name == "right" ? 1 : name == "middle" ? 2 : 0; }

/// "Ctrl+S", "F12", "r", "?": GLFW's key and modifiers; throws std::invalid_argument.
std::pair<int, int> keyOf(std::string name) {
  int mods = 0;
  for (const auto& [prefix, mod] :
       {std::pair("Ctrl+", GLFW_MOD_CONTROL), std::pair("Shift+", GLFW_MOD_SHIFT)})
    if (name.rfind(prefix, 0) == 0) name.erase(0, std::string(prefix).size()), mods |= mod;
  if (name.size() == 1 && std::isalnum(static_cast<unsigned char>(name[0])))
    return {std::toupper(static_cast<unsigned char>(name[0])), mods};
  if (name == "?") return {GLFW_KEY_H, 0};
  if (name == "Escape" || name == "Esc") return {GLFW_KEY_ESCAPE, mods};
  if (name == "Home") return {GLFW_KEY_HOME, mods};
  if (name == "Tab") return {GLFW_KEY_TAB, mods};
  if (name == "F12") return {GLFW_KEY_F12, mods};
  throw std::invalid_argument(fmt::format("'{}' is no key that does anything", name));
}

}  // namespace

Window::Window(ViewModel& model, const WindowOptions& options) : model_(model), options_(options) {
  panels_.isLight = options.isLight;
  glfwSetErrorCallback(nullptr);
  if (!glfwInit())
    throw std::runtime_error("there is no display to open a window on (DISPLAY, WAYLAND_DISPLAY)");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  window_ = glfwCreateWindow(1280, 720, options.title.c_str(), nullptr, nullptr);
  if (!window_) {
    const char* said = nullptr;
    glfwGetError(&said);
    const std::string reason = said ? said : "no reason given";
    glfwTerminate();
    throw std::runtime_error(fmt::format("no window with OpenGL 3: {}", reason));
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  float scale = 1;
  glfwGetWindowContentScale(window_, &scale, nullptr);
  scale_ = std::clamp(scale, 1.0F, 4.0F);
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  loadFont(options.fonts, scale_);
  restyle();
  glfwSetWindowUserPointer(window_, this);
  // ImGui's own callbacks call these.
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int mods) {
    Window& self = windowOf(w);
    self.framesToDraw_ = kFramesAfterEvent;
    if (action == GLFW_RELEASE) self.heldKeys_.erase(key);
    if (action == GLFW_PRESS) self.pressed(key, mods);
  });
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** files) {
    if (count > 0) windowOf(w).drop(files[0]);
  });
  const auto again = [](GLFWwindow* w) { windowOf(w).framesToDraw_ = kFramesAfterEvent; };
  glfwSetWindowRefreshCallback(window_, again);
  glfwSetCursorPosCallback(
      window_, [](GLFWwindow* w, double, double) { windowOf(w).framesToDraw_ = kFramesAfterEvent; });
  glfwSetFramebufferSizeCallback(
      window_, [](GLFWwindow* w, int, int) { windowOf(w).framesToDraw_ = kFramesAfterEvent; });
  glfwSetMouseButtonCallback(
      window_, [](GLFWwindow* w, int, int, int) { windowOf(w).framesToDraw_ = kFramesAfterEvent; });
  glfwSetScrollCallback(window_,
                        [](GLFWwindow* w, double, double) { windowOf(w).framesToDraw_ = kFramesAfterEvent; });
  ImGui_ImplGlfw_InitForOpenGL(window_, true);
  ImGui_ImplOpenGL3_Init("#version 130");
  glGenTextures(1, &texture_);
}

Window::~Window() {
  if (!window_) return;
  glDeleteTextures(1, &texture_);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::restyle() {
  applyStyle(panels_.isLight, scale_);
  panels_.restyles = false;
  framesToDraw_ = kFramesAfterEvent;
}

double Window::now() const { return glfwGetTime(); }
void Window::quit() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void Window::resize(int width, int height) {
  glfwSetWindowSize(window_, std::clamp(width, 1, 16384), std::clamp(height, 1, 16384));
}
void Window::drop(const std::string& file) {
  model_.open(file);
  framesToDraw_ = kFramesAfterEvent;
}

bool Window::isBusy() const { return !model_.progress().doing.empty(); }

void Window::run() {
  while (!glfwWindowShouldClose(window_)) {
    // Nothing is drawn where nothing changes: a new picture, a key or the mouse wakes it.
    const bool isWaiting = framesToDraw_ <= 0 && heldKeys_.empty();
    if (!isWaiting)
      glfwPollEvents();
    else if (options_.script)
      glfwWaitEventsTimeout(0.01);
    else if (isBusy() || wasMoving_)
      glfwWaitEventsTimeout(wasMoving_ ? kRestSeconds : kClockSeconds);
    else
      glfwWaitEventsTimeout(kIdleSeconds);
    if (model_.update()) redraw();
    if (options_.script && !options_.script(*this)) quit();
    const bool isDue = now() - drawnAt_ >= kClockSeconds;
    if (isDue && (isBusy() || wasMoving_)) redraw();
    if (framesToDraw_ <= 0 && heldKeys_.empty()) continue;
    frame();
    --framesToDraw_;
  }
}

void Window::key(const std::string& name) {
  const auto [key, mods] = keyOf(name);
  pressed(key, mods);
  heldKeys_.erase(key);
}

void Window::pointer(const Place& place) {
  isScripted_ = true;
  const float scale =
      picture_.width / static_cast<float>(std::max(1, std::atoi(model_.value("width").c_str())));
  pointer_ = place.ofWindow ? ImVec2(static_cast<float>(place.x), static_cast<float>(place.y))
                            : ImVec2(picture_.x + static_cast<float>(place.x) * scale,
                                     picture_.y + static_cast<float>(place.y) * scale);
}

void Window::button(const std::string& name, bool isDown) {
  isScripted_ = true;
  buttons_[static_cast<std::size_t>(buttonOf(name))] = isDown;
}

/// Before the swap: after it the frame is gone.
void Window::writeShot() {
  const auto file = std::exchange(pendingShot_, {});
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  std::vector<std::uint8_t> rows(static_cast<std::size_t>(width) * height * 4), codes(rows.size());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadBuffer(GL_BACK);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
  const std::size_t row = static_cast<std::size_t>(width) * 4;
  for (int y = 0; y < height; ++y)
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(height - 1 - y)),
                row, codes.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(y)));
  for (std::size_t i = 3; i < codes.size(); i += 4) codes[i] = 255;
  options_.writeCodes(file, width, height, codes);
}

std::string Window::stateJson() const {
  // The window's own part is put into the model's.
  std::string state = model_.stateJson();
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  const std::string own = fmt::format(
      R"(,"window":{{"width":{},"height":{},"frames":{},"pictureX":{},"pictureY":{},"pictureWidth":{},"pictureHeight":{}}}}})",
      width, height, frames_, picture_.x, picture_.y, picture_.width, picture_.height);
  state.pop_back();
  return state + own;
}

void Window::upload() {
  const Picture& p = model_.picture();
  if (p.serial == uploaded_ || p.serial == 0) return;
  glBindTexture(GL_TEXTURE_2D, texture_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  if (p.width != textureWidth_ || p.height != textureHeight_)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, p.width, p.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, p.codes.data());
  else
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, p.width, p.height, GL_RGBA, GL_UNSIGNED_BYTE, p.codes.data());
  textureWidth_ = p.width;
  textureHeight_ = p.height;
  uploaded_ = p.serial;
  isLinear_ = p.coarse;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/// 1:1 in the middle where there is room, else as large as fits.
Window::Rect Window::pictureRect(float left, float top, float width, float height) const {
  const auto w = static_cast<float>(std::max(1, std::atoi(model_.value("width").c_str())));
  const auto h = static_cast<float>(std::max(1, std::atoi(model_.value("height").c_str())));
  float scale = std::min(width / w, height / h);
  scale = scale >= 1 ? std::floor(scale) : std::max(scale, 1e-3F);
  return {std::floor(left + (width - w * scale) / 2), std::floor(top + (height - h * scale) / 2), w * scale,
          h * scale};
}

ImVec2 Window::inPicture(const ImVec2& at) const {
  return {(at.x - picture_.x) / picture_.width, (at.y - picture_.y) / picture_.height};
}

void Window::drawPicture() {
  upload();
  ImDrawList* const draw = ImGui::GetBackgroundDrawList();
  const ImU32 ground = panels_.isLight ? IM_COL32(214, 214, 218, 255) : IM_COL32(16, 17, 19, 255);
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  draw->AddRectFilled({0, 0}, size, ground);
  if (uploaded_ == 0) return;
  glBindTexture(GL_TEXTURE_2D, texture_);
  const float scale = picture_.width / static_cast<float>(textureWidth_);
  const int filter = isLinear_ || scale != std::floor(scale) ? GL_LINEAR : GL_NEAREST;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  draw->AddImage(std::bit_cast<ImTextureID>(static_cast<std::uintptr_t>(texture_)), {picture_.x, picture_.y},
                 {picture_.x + picture_.width, picture_.y + picture_.height});
}

namespace {

struct Stroke {
  ImU32 color;
  float width, dash, gap;  ///< pixels; no gap: solid
};

/// Told apart by pattern as well as by colour.
Stroke strokeOf(Line line) {
  switch (line) {
    case Line::Eye:
      return {IM_COL32_WHITE, 2, 0, 0};
    case Line::Reflected:
      return {kSeries[0], 2, 0, 0};
    case Line::Refracted:
      return {kSeries[1], 2, 10, 5};
    case Line::Straight:
      return {kSeries[2], 2, 2, 5};
    case Line::Shadow:
      return {kSeries[3], 1, 0, 0};
    case Line::Blocked:
      break;
  }
  return {IM_COL32_BLACK, 1.5F, 6, 6};
}

void drawStroke(ImDrawList& draw, ImVec2 a, ImVec2 b, const Stroke& s, float thicker) {
  const float dx = b.x - a.x, dy = b.y - a.y, length = std::sqrt(dx * dx + dy * dy);
  const float period = s.gap > 0 ? s.dash + s.gap : length;
  if (!(length > 0) || !(length < 1e5F)) return;
  for (float at = 0; at < length; at += period) {
    const float end = std::min(length, at + (s.gap > 0 ? s.dash : length));
    const ImVec2 from{a.x + dx * at / length, a.y + dy * at / length},
        to{a.x + dx * end / length, a.y + dy * end / length};
    draw.AddLine(from, to, IM_COL32(0, 0, 0, 110), s.width + thicker + 2);  // seen before anything
    draw.AddLine(from, to, s.color, s.width + thicker);
  }
}

}  // namespace

void Window::drawRays(int emphasised) {
  const ViewModel::Explained* const e = model_.explained();
  if (!e) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.PushClipRect({picture_.x, picture_.y}, {picture_.x + picture_.width, picture_.y + picture_.height});
  const auto at = [&](double x, double y) {
    return ImVec2(picture_.x + static_cast<float>(x) * picture_.width,
                  picture_.y + static_cast<float>(y) * picture_.height);
  };
  for (const DrawnRay& d : e->drawn) {
    const bool isOn = static_cast<int>(d.ray) == emphasised;
    drawStroke(draw, at(d.x0, d.y0), at(d.x1, d.y1), strokeOf(d.line), isOn ? 2.0F : 0.0F);
    if (d.line == Line::Eye) {
      draw.AddCircle(at(d.x0, d.y0), 7, IM_COL32_BLACK, 0, 4);
      draw.AddCircle(at(d.x0, d.y0), 7, IM_COL32_WHITE, 0, 2);
    }
  }
  draw.PopClipRect();
}

void Window::drawPanels(float width, float height) {
  const float unit = ImGui::GetFontSize() / 15, line = kLineHeight * unit;
  const bool hasRoom = width > (kSettingsWidth + kStatisticsWidth + 120) * unit;
  const bool shown = panels_.showsPanels && hasRoom && height > 4 * line;
  const float left = shown ? kSettingsWidth * unit : 0, right = shown ? kStatisticsWidth * unit : 0;
  picture_ = pictureRect(left, 0, std::max(1.0F, width - left - right), std::max(1.0F, height - line));
  drawPicture();
  drawRays(hoveredRay_);
  constexpr auto kFixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                          ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoBringToFrontOnFocus;
  const auto panel = [&](const char* name, float x, float y, float w, float h, const auto& content) {
    ImGui::SetNextWindowPos({x, y});
    ImGui::SetNextWindowSize({w, h});
    if (ImGui::Begin(name, nullptr, kFixed)) content();
    ImGui::End();
  };
  if (shown) {
    panel("settings", 0, 0, left, height - line, [&] {
      cameraPanel(model_);
      settingsPanel(model_, panels_);
    });
    hoveredRay_ = -1;
    panel("statistics", width - right, 0, right, height - line, [&] {
      if (model_.explained())
        hoveredRay_ = explanationPanel(model_);
      else
        statisticsPanel(model_);
    });
  }
  if (height > line)
    panel("messages", 0, height - line, width, line, [&] {
      ImGui::SetCursorPosY((line - ImGui::GetTextLineHeight()) / 2);
      if (ImGui::SmallButton("H: help")) panels_.showsHelp = !panels_.showsHelp;
      ImGui::SameLine();
      messageLine(model_);
    });
  helpWindow(panels_);
}

void Window::frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGuiIO& io = ImGui::GetIO();
  if (isScripted_) {
    io.MousePos = pointer_;
    for (std::size_t i = 0; i < buttons_.size(); ++i) io.MouseDown[i] = buttons_[i];
    io.MouseWheel += static_cast<float>(pendingWheel_);
    pendingWheel_ = 0;
  }
  ImGui::NewFrame();
  moveCamera();
  drawPanels(io.DisplaySize.x, io.DisplaySize.y);
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  glViewport(0, 0, width, height);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (!pendingShot_.empty()) writeShot();
  if (panels_.restyles) restyle();
  ++frames_;
  glfwSwapBuffers(window_);
  drawnAt_ = now();
}

void Window::moveCamera() {
  const ImGuiIO& io = ImGui::GetIO();
  bool moves = false;
  if (!io.WantCaptureMouse && picture_.height > 0) {
    const double dx = static_cast<double>(io.MouseDelta.x / picture_.height),
                 dy = static_cast<double>(io.MouseDelta.y / picture_.height);
    const ImVec2 at = inPicture(io.MousePos);
    for (int b = 0; b < 3; ++b)
      if (ImGui::IsMouseClicked(b)) model_.holdPoint(static_cast<double>(at.x), static_cast<double>(at.y));
    if (ImGui::IsMouseClicked(0)) pressedAt_ = io.MousePos;
    if (ImGui::IsMouseReleased(0) && pressedAt_.x == io.MousePos.x && pressedAt_.y == io.MousePos.y)
      model_.explain(static_cast<double>(at.x), static_cast<double>(at.y));
    const bool isMoved = dx != 0 || dy != 0;
    const bool left = ImGui::IsMouseDown(0), pans = ImGui::IsMouseDown(2) || (left && io.KeyShift);
    if (left || pans || ImGui::IsMouseDown(1)) moves = true, model_.setMoving(true);
    if (isMoved && pans)
      model_.pan(dx, -dy);
    else if (isMoved && left)
      model_.orbit(dx * kTurn, -dy * kTurn);
    else if (isMoved && ImGui::IsMouseDown(1))
      model_.look(dx, -dy);
    if (io.MouseWheel != 0) {
      model_.setMoving(true);
      model_.holdPoint(static_cast<double>(at.x), static_cast<double>(at.y));
      model_.zoom(std::pow(kWheel, static_cast<double>(io.MouseWheel)));
      moves = true;
    }
  }
  if (!heldKeys_.empty() && !io.WantTextInput) {
    const auto held = [&](int key) { return heldKeys_.contains(key) ? 1.0 : 0.0; };
    const double step = std::min(0.1, static_cast<double>(io.DeltaTime)) * 40;
    const double right = held('D') - held('A'), up = held('E') - held('Q'), ahead = held('W') - held('S');
    if (right != 0 || up != 0 || ahead != 0) {
      model_.setMoving(true);
      model_.fly(right * step, up * step, ahead * step);
      moves = true;
    }
  }
  const auto time = std::chrono::steady_clock::now();
  if (moves) movedAt_ = time, wasMoving_ = true;
  if (wasMoving_ && std::chrono::duration<double>(time - movedAt_).count() > kRestSeconds)
    wasMoving_ = false, model_.setMoving(false);
}

void Window::pressed(int key, int mods) {
  framesToDraw_ = kFramesAfterEvent;
  if (ImGui::GetIO().WantTextInput) return;
  const bool ctrl = (mods & GLFW_MOD_CONTROL) != 0;
  if (!ctrl && std::string("WASDQE").find(static_cast<char>(key < 128 ? key : 0)) != std::string::npos &&
      key < 128)
    heldKeys_.insert(key);
  shortcuts(key, ctrl);
}

void Window::shortcuts(int key, bool ctrl) {
  if (ctrl) {
    if (key == 'Q') quit();
    if (key == 'R') model_.reload();
    if (key == 'S') model_.save("whittle");
    if (key == 'C') glfwSetClipboardString(window_, model_.cameraText().c_str());
    if (key == 'V') {
      const char* const text = glfwGetClipboardString(window_);
      if (text) model_.pasteCamera(text);
    }
    return;
  }
  switch (key) {
    case 'R':
    case GLFW_KEY_HOME:
      model_.resetCamera();
      break;
    case 'F':
      model_.frameAll();
      break;
    case '1':
      model_.seeFrom(Side::Front);
      break;
    case '3':
      model_.seeFrom(Side::Right);
      break;
    case '7':
      model_.seeFrom(Side::Top);
      break;
    case '5':
      model_.switchOrthographic();
      break;
    case 'L':
      panels_.isLight = !panels_.isLight, panels_.restyles = true;
      break;
    case 'H':
    case GLFW_KEY_SLASH:
      panels_.showsHelp = !panels_.showsHelp;
      break;
    case GLFW_KEY_TAB:
      panels_.showsPanels = !panels_.showsPanels;
      break;
    case GLFW_KEY_F12:
      model_.save("whittle");
      break;
    case GLFW_KEY_ESCAPE:
      if (panels_.showsHelp)
        panels_.showsHelp = false;
      else if (model_.explained())
        model_.closeExplanation();
      else
        model_.stop();
      break;
    default:
      break;
  }
}

namespace {

class Library : public WindowLibrary {
 public:
  void run(ViewModel& model, const WindowOptions& options) const override {
    Window window(model, options);
    isOpen_ = true;
    struct Closing {
      std::atomic<bool>& isOpen;
      ~Closing() { isOpen = false; }
    } closing{isOpen_};
    window.run();
  }
  void wake() const override {
    if (isOpen_) glfwPostEmptyEvent();
  }

 private:
  mutable std::atomic<bool> isOpen_ = false;
};

}  // namespace
}  // namespace whittle::view

const whittle::view::WindowLibrary* whittleWindowLibrary() {
  static const whittle::view::Library library;
  return &library;
}
