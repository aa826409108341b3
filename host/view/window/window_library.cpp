// See window_library.h.
#include "view/window/window_library.h"

#include <GLFW/glfw3.h>

#include <mutex>

#include "view/window/window.h"

namespace whittle::view {
namespace {

class Library : public WindowLibrary {
 public:
  void run(ViewModel& model, const WindowOptions& options) const override {
    Window window(model, options);
    setOpen(true);
    struct Closing {
      const Library& library;
      ~Closing() { library.setOpen(false); }
    } closing{*this};
    window.run();
  }
  void wake() const override {
    const std::lock_guard lock(mutex_);
    if (isOpen_) glfwPostEmptyEvent();
  }

 private:
  void setOpen(bool isOpen) const {
    const std::lock_guard lock(mutex_);
    isOpen_ = isOpen;
  }

  mutable std::mutex mutex_;  ///< held while GLFW is called, so that it does not end meanwhile
  mutable bool isOpen_ = false;
};

}  // namespace
}  // namespace whittle::view

const whittle::view::WindowLibrary* whittleWindowLibrary() {
  static const whittle::view::Library library;
  return &library;
}
