// See window_library.h.
#include "view/window/window_library.h"

#include <GLFW/glfw3.h>

#include <atomic>

#include "view/window/window.h"

namespace whittle::view {
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
