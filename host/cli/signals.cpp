// A handler can reach nothing but variables of this file: they are the one exception to "no globals".
#include "cli/signals.h"

#include <unistd.h>

#include <csignal>
#include <initializer_list>

namespace whittle::cli {
namespace {

volatile std::sig_atomic_t held = 0;
volatile std::sig_atomic_t waiting = 0;  // the signal that came while held, or 0
volatile std::sig_atomic_t wipes = 0;
volatile std::sig_atomic_t wrote = 0;  // a hold has ended: files may be there

void die(int signal) {
  if (wipes) {
    static constexpr char kWipe[] = "\r\033[K";
    [[maybe_unused]] const auto ignored = ::write(STDERR_FILENO, kWipe, sizeof(kWipe) - 1);
  }
  static constexpr char kNothing[] = "whittle: interrupted, nothing written\n";
  static constexpr char kDone[] = "whittle: interrupted\n";
  [[maybe_unused]] const auto ignored = wrote ? ::write(STDERR_FILENO, kDone, sizeof(kDone) - 1)
                                              : ::write(STDERR_FILENO, kNothing, sizeof(kNothing) - 1);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

extern "C" {
static void whittleOnSignal(int signal) {
  if (held)
    waiting = signal;
  else
    die(signal);
}
}

void installSignals(bool clearLine) {
  wipes = clearLine ? 1 : 0;
  for (const int s : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    action.sa_handler = whittleOnSignal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    struct sigaction before {};
    // nohup and background jobs ignore some of them: that stays so.
    if (::sigaction(s, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      ::sigaction(s, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

HoldSignals::HoldSignals() { held = 1; }

HoldSignals::~HoldSignals() {
  wrote = 1;
  held = 0;
  if (waiting != 0) die(waiting);
}

}  // namespace whittle::cli
