// Results reach the disk one by one: what one of them meets keeps no other back.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace whittle::cli {

class OutputWriter {
 public:
  using Write = std::function<void(const std::filesystem::path&)>;

  /// Has `write` write to `file`. Where its folder no longer takes it (vanished, full, read-only by now), to
  /// the working folder or that for temporary files, under a name that is free there. What fails is said in
  /// one line on standard error; nothing is thrown. `remark`: behind the file's name in the summary.
  void add(const std::filesystem::path& file, const std::string& remark, const Write& write);

  /// Whether all of them are where they should be.
  bool isComplete() const { return complete_; }

  /// "wrote a.exr (depth)\n" for each of them, in their order.
  const std::string& summary() const { return summary_; }

 private:
  void wrote(const std::filesystem::path& file, const std::string& remark);
  void rescue(const std::filesystem::path& file, const std::string& remark, const Write& write,
              const std::string& problem);

  std::string summary_;
  bool complete_ = true;
};

}  // namespace whittle::cli
