// A folder of kernel files for one test, removed with it.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace whittle::test {

class TemporarySources {
 public:
  TemporarySources() {
    std::string pattern = (std::filesystem::temp_directory_path() / "whittle-kernels-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~TemporarySources() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  TemporarySources(const TemporarySources&) = delete;
  TemporarySources& operator=(const TemporarySources&) = delete;

  void write(const std::string& path, const std::string& text) const {
    std::filesystem::create_directories((folder_ / path).parent_path());
    std::ofstream(folder_ / path) << text;
  }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

}  // namespace whittle::test
