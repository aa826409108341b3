// The window, as a library of its own that `whittle view` alone loads: Dear ImGui, GLFW and OpenGL cost no
// other start anything.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "view/script.h"
#include "view/view_model.h"

namespace whittle::view {

/// Of letters and panels; 1: as on a monitor of 1080 rows.
inline constexpr float kLeastUiScale = 0.5F, kLargestUiScale = 4.0F;

struct WindowOptions {
  std::string title;
  /// A frame of the script; false: it has ended. Empty: there is none.
  std::function<bool(Stage&)> script;
  /// Writes codes, RGBA, row 0 at the top. Throws.
  std::function<void(const std::filesystem::path&, int width, int height, const std::vector<std::uint8_t>&)>
      writeCodes;
  std::function<void(const std::string&)> print;  ///< a line on standard output
  std::vector<std::filesystem::path> fonts;       ///< the first that is there is taken
  bool isLight = false;
  std::optional<float> uiScale;  ///< unset: what suits the monitor
};

class WindowLibrary {
 public:
  virtual ~WindowLibrary() = default;
  /// Shows the model until the window is closed. Throws std::runtime_error where there is no display, or what
  /// the script throws.
  virtual void run(ViewModel& model, const WindowOptions& options) const = 0;
  /// There is something new to show; any thread, any time.
  virtual void wake() const = 0;
};

}  // namespace whittle::view

/// What the library exports.
extern "C" [[gnu::visibility("default")]] const whittle::view::WindowLibrary* whittleWindowLibrary();
