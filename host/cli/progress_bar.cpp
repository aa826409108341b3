// Terminal progress. A line never wraps, because a wrapped line cannot be taken back.
#include "cli/progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "cli/guard.h"
#include "cli/speech.h"
#include "report/text.h"

namespace whittle::cli {
namespace {

std::size_t terminalColumns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

ProgressBar::ProgressBar(bool quiet, std::string what)
    : on_(!quiet && isatty(STDERR_FILENO)), what_(what.empty() ? "" : std::move(what) + ": ") {}

ProgressBar::~ProgressBar() {
  clear();
  nowDoing("");
}

void ProgressBar::clear() {
  if (!shown_) return;
  drawError("\r\033[K");
  shown_ = false;
}

void ProgressBar::show(const std::string& line) {
  drawError("\r\033[K" + line);
  shown_ = true;
}

void ProgressBar::phase(const std::string& phase) {
  const std::string text = what_ + phase;
  nowDoing(text);
  if (on_) show(columnsOf(text) + 2 < terminalColumns() ? text + " …" : "…");
}

void ProgressBar::update(double fraction, double seconds, const std::string& rate) {
  const auto now = std::chrono::steady_clock::now();
  if (!on_ || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  fraction = std::clamp(fraction, 0.0, 1.0);
  std::string text = fmt::format("{}{:3.0f} %", what_, 100.0 * fraction);
  if (!rate.empty()) text += "  " + rate;
  if (fraction > 0.0 && fraction < 1.0)
    text += "  " + formatSeconds(std::max(1.0, seconds / fraction - seconds)) + " left";
  // The last two columns stay free for the "^C" that a terminal echoes.
  const std::size_t columns = std::max<std::size_t>(terminalColumns(), 2) - 2;
  const std::size_t used = columnsOf(text) + 2;
  const int cells = used < columns ? static_cast<int>(std::min<std::size_t>(30, columns - used)) : 0;
  std::string bar;
  for (int i = 0; i < cells; ++i) bar += i < static_cast<int>(fraction * cells) ? "█" : "░";
  show(cells > 0 ? bar + " " + text : fmt::format("{:3.0f} %", 100.0 * fraction));
}

}  // namespace whittle::cli
