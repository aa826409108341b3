// Terminal progress.
#include "cli/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "cli/options.h"

namespace whittle::cli {

ProgressBar::ProgressBar(bool quiet) : on_(!quiet && isatty(STDERR_FILENO)) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::clear() {
  if (shown_) fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  shown_ = false;
}

void ProgressBar::phase(const std::string& text) {
  if (!on_) return;
  fmt::print(stderr, "\r\033[K{} …", text);
  std::fflush(stderr);
  shown_ = true;
}

void ProgressBar::update(double fraction, double seconds, const std::string& rate) {
  const auto now = std::chrono::steady_clock::now();
  if (!on_ || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kWidth);
  std::string bar;
  for (int i = 0; i < kWidth; ++i) bar += i < filled ? "█" : "░";
  const std::string left = fraction > 0.0 ? formatSeconds(seconds / fraction - seconds) + " left" : "";
  fmt::print(stderr, "\r\033[K{} {:3.0f} %  {}  {}", bar, 100.0 * fraction, rate, left);
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace whittle::cli
