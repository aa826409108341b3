// One line on standard error with share, rate and remaining time; silent where that is not a terminal.
#pragma once

#include <chrono>
#include <string>

namespace whittle::cli {

class ProgressBar {
 public:
  /// `what`: stands before every phase, "frame 3 of 48".
  explicit ProgressBar(bool quiet, std::string what = {});
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void phase(const std::string& phase);
  /// `rate`: for instance "12.3 Mrays/s"; empty to leave it out.
  void update(double fraction, double seconds, const std::string& rate);
  void clear();

 private:
  void show(const std::string& line);

  bool on_;
  std::string what_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace whittle::cli
