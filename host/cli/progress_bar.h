// One line on standard error with share, rate and remaining time; silent where that is not a terminal.
#pragma once

#include <chrono>
#include <string>

namespace whittle::cli {

class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void phase(const std::string& text);
  /// `rate`: for instance "12.3 Mrays/s"; empty to leave it out.
  void update(double fraction, double seconds, const std::string& rate);
  void clear();

 private:
  void show(const std::string& line);

  bool on_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace whittle::cli
