// See window_manager.h. What it says and hears is in the Inter-Client Communication Conventions
// Manual, 4.1.4. Compiled by itself: Xlib's macros are words of everybody.
#include "window_manager.h"

#ifdef WHITTLE_XLIB

#include <poll.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <atomic>
#include <thread>

namespace whittle::test {

struct WindowManager::State {
  Display* display = nullptr;
  Atom stateProperty = 0, stateRequest = 0;
  std::atomic<bool> ends{false};
  std::thread thread;

  void tellState(::Window window, long state) const {
    const long value[2] = {state, 0};  // the second: no icon
    XChangeProperty(display, window, stateProperty, stateProperty, 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(value), 2);
  }

  void answer(const XEvent& event) const {
    if (event.type == MapRequest) {
      XMapWindow(display, event.xmaprequest.window);
      tellState(event.xmaprequest.window, NormalState);
    } else if (event.type == ConfigureRequest) {
      const XConfigureRequestEvent& r = event.xconfigurerequest;
      XWindowChanges changes{r.x, r.y, r.width, r.height, r.border_width, r.above, r.detail};
      XConfigureWindow(display, r.window, static_cast<unsigned>(r.value_mask), &changes);
    } else if (event.type == ClientMessage && event.xclient.message_type == stateRequest &&
               event.xclient.data.l[0] == IconicState) {
      XUnmapWindow(display, event.xclient.window);
      tellState(event.xclient.window, IconicState);
    }
  }

  void work() const {
    pollfd socket{ConnectionNumber(display), POLLIN, 0};
    while (!ends) {
      while (XPending(display) > 0) {
        XEvent event;
        XNextEvent(display, &event);
        answer(event);
      }
      XFlush(display);
      poll(&socket, 1, 20);
    }
  }
};

WindowManager::WindowManager(const std::string& display) {
  Display* const opened = XOpenDisplay(display.c_str());
  if (!opened) return;
  XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });  // a window may be gone
  state_ = std::make_unique<State>();
  state_->display = opened;
  state_->stateProperty = XInternAtom(opened, "WM_STATE", 0);
  state_->stateRequest = XInternAtom(opened, "WM_CHANGE_STATE", 0);
  XSelectInput(opened, DefaultRootWindow(opened), SubstructureRedirectMask | SubstructureNotifyMask);
  XSync(opened, 0);
  state_->thread = std::thread([state = state_.get()] { state->work(); });
}

WindowManager::~WindowManager() {
  if (!state_) return;
  state_->ends = true;
  state_->thread.join();
  XCloseDisplay(state_->display);
}

}  // namespace whittle::test

#else

namespace whittle::test {

struct WindowManager::State {};
WindowManager::WindowManager(const std::string&) {}
WindowManager::~WindowManager() = default;

}  // namespace whittle::test

#endif
