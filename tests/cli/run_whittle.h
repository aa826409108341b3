// Runs the built program as a user would: a process of its own, its two streams, its exit status.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace whittle::test {

struct Outcome {
  int status = -1;  ///< exit status; -signal where one ended it
  std::string out, err;
};

struct RunOptions {
  std::filesystem::path folder;                          ///< working folder; empty: the caller's
  std::vector<std::pair<std::string, std::string>> env;  ///< added to the caller's
};

/// A started `whittle ARGS…` that can be signalled.
class Process {
 public:
  explicit Process(const std::vector<std::string>& args, const RunOptions& options = {});
  void signal(int number) const;
  pid_t id() const { return pid_; }
  /// Reads both streams to their ends and waits.
  Outcome finish();

 private:
  pid_t pid_ = -1;
  int out_ = -1, err_ = -1;
};

inline Outcome runWhittle(const std::vector<std::string>& args, const RunOptions& options = {}) {
  return Process(args, options).finish();
}
/// `sh -c SCRIPT` with $WHITTLE set.
Outcome runShell(const std::string& script, const RunOptions& options = {});

inline std::string scene(const std::string& name = "cornell_box.glb") {
  return std::string(WHITTLE_SCENES "/") + name;
}

inline std::string readText(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}
inline nlohmann::json readJson(const std::filesystem::path& file) {
  return nlohmann::json::parse(readText(file));
}

/// A folder for one test, removed with it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  /// Names of what is in it, sorted; partial files included.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

/// A render that takes well under a second once its kernels are compiled.
inline std::vector<std::string> smallRender(std::vector<std::string> more) {
  std::vector<std::string> args{"render", scene(), "--width", "32", "--height", "24"};
  args.insert(args.end(), more.begin(), more.end());
  return args;
}

}  // namespace whittle::test
