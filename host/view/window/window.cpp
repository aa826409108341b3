// See window.h.
#include "view/window/window.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "view/window/scale.h"

namespace whittle::view {
namespace {

/// How often a clock and a bar are drawn that go on by themselves. Where OpenGL is software too, each frame
/// is taken from the render: ten a second cost it a third of its time.
constexpr double kClockSeconds = 0.5;
/// How often the model is asked where nothing happens: a scene's file may have been written.
constexpr double kIdleSeconds = 0.5;

Window& windowOf(GLFWwindow* w) { return *static_cast<Window*>(glfwGetWindowUserPointer(w)); }

}  // namespace

Window::Window(ViewModel& model, const WindowOptions& options) : model_(model), options_(options) {
  panels_.isLight = options.isLight;
  glfwSetErrorCallback(nullptr);
  if (!glfwInit())
    throw std::runtime_error("there is no display to open a window on (DISPLAY, WAYLAND_DISPLAY)");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
  const MonitorFacts monitor = monitorFacts();
  standardScale_ = options.uiScale.value_or(suitingScale(monitor.scale, monitor.height));
  scale_ = standardScale_;
  const auto size = [&](int side, int most) {
    return std::min(static_cast<int>(std::lround(static_cast<float>(side) * scale_)), most);
  };
  window_ = glfwCreateWindow(size(1280, monitor.width), size(720, monitor.height), options.title.c_str(),
                             nullptr, nullptr);
  if (!window_) {
    const char* said = nullptr;
    glfwGetError(&said);
    const std::string reason = said ? said : "no reason given";
    glfwTerminate();
    throw std::runtime_error(fmt::format("no window with OpenGL 3: {}", reason));
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
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
  glfwSetWindowIconifyCallback(window_,
                               [](GLFWwindow* w, int) { windowOf(w).framesToDraw_ = kFramesAfterEvent; });
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
  for (Texture* t : {&texture_, &beside_}) glGenTextures(1, &t->name);
}

Window::~Window() {
  if (!window_) return;
  for (const Texture& t : {texture_, beside_}) glDeleteTextures(1, &t.name);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

double Window::now() const { return glfwGetTime(); }
void Window::quit() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
std::string Window::set(const std::string& id, const std::string& text) {
  if (PanelState::has(id)) return panels_.set(id, text);
  return id == kScaleSetting ? setScale(text) : model_.set(id, text);
}
void Window::resize(int width, int height) {
  glfwSetWindowSize(window_, std::clamp(width, 1, 16384), std::clamp(height, 1, 16384));
}
void Window::minimise() { glfwIconifyWindow(window_); }
void Window::restore() { glfwRestoreWindow(window_); }
void Window::drop(const std::string& file) {
  const bool isShift = glfwGetKey(window_, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ||
                       glfwGetKey(window_, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
  if (isShift)
    model_.set("reference", file);
  else
    model_.open(file);
  framesToDraw_ = kFramesAfterEvent;
}

bool Window::isBusy() const { return !model_.progress().doing.empty() || model_.isSaving(); }
bool Window::isMinimised() const { return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE; }

void Window::run() {
  while (!glfwWindowShouldClose(window_)) {
    // Nothing is drawn where nothing changes, or nobody sees it: a new picture, a key or the mouse wakes it.
    const bool isWaiting = isMinimised() || (framesToDraw_ <= 0 && heldKeys_.empty());
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
    if (isMinimised() || (framesToDraw_ <= 0 && heldKeys_.empty())) continue;
    frame();
    --framesToDraw_;
  }
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
      R"(,"window":{{"width":{},"height":{},"frames":{},"frameSeconds":{},"minimised":{},"pictureX":{},"pictureY":{},"pictureWidth":{},"pictureHeight":{},"uiScale":{},"panels":{},"firstRay":{},"listedRays":{},"statisticsCut":{}}}}})",
      width, height, frames_, frameSeconds_, isMinimised(), picture_.x, picture_.y, picture_.width,
      picture_.height, scale_, panelsShown_, panels_.firstRay, panels_.listedRays, statisticsCut_);
  state.pop_back();
  return state + own;
}

void Window::frame() {
  const double began = now();
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
  clear(width, height);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (!pendingShot_.empty()) writeShot();
  if (panels_.restyles) restyle();
  ++frames_;
  glfwSwapBuffers(window_);
  drawnAt_ = now();
  frameSeconds_ = drawnAt_ - began;
}

}  // namespace whittle::view
