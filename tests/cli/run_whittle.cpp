// fork, exec, poll; see the header.
#include "run_whittle.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace whittle::test {
namespace {

[[noreturn]] void becomeProgram(const std::vector<std::string>& args, const RunOptions& options, int out,
                                int err) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a case that hangs takes along what it runs
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  if (!options.folder.empty() && ::chdir(options.folder.c_str()) != 0) ::_exit(126);
  for (const auto& [name, value] : options.env) ::setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> words;
  for (const auto& a : args) words.push_back(const_cast<char*>(a.c_str()));
  words.push_back(nullptr);
  ::execvp(words[0], words.data());
  ::_exit(127);
}

/// Empties both pipes together, so that neither fills up and stops the program.
void drain(int out, int err, Outcome& run) {
  std::array<pollfd, 2> fds{{{out, POLLIN, 0}, {err, POLLIN, 0}}};
  std::array<std::string*, 2> texts{&run.out, &run.err};
  for (int open = 2; open > 0;) {
    if (::poll(fds.data(), fds.size(), -1) < 0) continue;
    for (std::size_t i = 0; i < fds.size(); ++i) {
      if (fds[i].fd < 0 || fds[i].revents == 0) continue;
      std::array<char, 4096> buffer;
      const ssize_t got = ::read(fds[i].fd, buffer.data(), buffer.size());
      if (got > 0) {
        texts[i]->append(buffer.data(), static_cast<std::size_t>(got));
        continue;
      }
      fds[i].fd = -1;
      --open;
    }
  }
}

pid_t start(const std::vector<std::string>& args, const RunOptions& options, int& outEnd, int& errEnd) {
  int out[2], err[2];
  if (::pipe2(out, O_CLOEXEC) != 0 || ::pipe2(err, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  const pid_t pid = ::fork();
  if (pid < 0) throw std::runtime_error("no process");
  if (pid == 0) becomeProgram(args, options, out[1], err[1]);
  ::close(out[1]);
  ::close(err[1]);
  outEnd = out[0];
  errEnd = err[0];
  return pid;
}

Outcome wait(pid_t pid, int out, int err) {
  Outcome run;
  drain(out, err, run);
  ::close(out);
  ::close(err);
  int status = 0;
  ::waitpid(pid, &status, 0);
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return run;
}

}  // namespace

Process::Process(const std::vector<std::string>& args, const RunOptions& options) {
  std::vector<std::string> words{WHITTLE_BINARY};
  words.insert(words.end(), args.begin(), args.end());
  pid_ = start(words, options, out_, err_);
}

void Process::signal(int number) const { ::kill(pid_, number); }

Outcome Process::finish() { return wait(pid_, out_, err_); }

Outcome runShell(const std::string& script, const RunOptions& options) {
  RunOptions withProgram = options;
  withProgram.env.emplace_back("WHITTLE", WHITTLE_BINARY);
  int out = -1, err = -1;
  const pid_t pid = start({"sh", "-c", script}, withProgram, out, err);
  return wait(pid, out, err);
}

Folder::Folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "whittle-cli-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace whittle::test
