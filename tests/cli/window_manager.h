// The least of window managers, for displays that have none: it shows windows, minimises and restores them.
#pragma once

#include <memory>
#include <string>

namespace whittle::test {

class WindowManager {
 public:
  /// Works in a thread of its own until it is destroyed. `display`: ":1".
  explicit WindowManager(const std::string& display);
  ~WindowManager();
  WindowManager(const WindowManager&) = delete;
  WindowManager& operator=(const WindowManager&) = delete;

  /// Built with Xlib, and the display lets it.
  bool works() const { return state_ != nullptr; }

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace whittle::test
