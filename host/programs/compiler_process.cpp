// The compiler process: its command line, its start and its work.
#include "programs/compiler_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <utility>

#include "cl/device.h"
#include "cl/kernel_cache.h"

namespace whittle {

std::vector<std::string> commandLine(const CompilerJob& job) {
  std::vector<std::string> words{std::to_string(job.device),
                                 std::to_string(job.features),
                                 std::to_string(job.target.compactChunk),
                                 std::to_string(job.target.workGroup),
                                 std::to_string(static_cast<int>(job.target.relaxedArithmetic)),
                                 job.folder ? job.folder->string() : "",
                                 std::to_string(job.first),
                                 std::to_string(static_cast<int>(job.isBeside))};
  words.insert(words.end(), job.stages.begin(), job.stages.end());
  return words;
}

CompilerJob compilerJob(const std::vector<std::string>& words) {
  constexpr std::size_t kBeforeStages = 8;
  if (words.size() < kBeforeStages)
    throw std::invalid_argument(std::string(kCompilerCommand) + ": for internal use");
  CompilerJob job;
  job.device = std::stoi(words[0]);
  job.features = std::stoull(words[1]);
  job.target = {static_cast<std::uint32_t>(std::stoul(words[2])), std::stoi(words[3]), words[4] != "0"};
  if (!words[5].empty()) job.folder = words[5];
  job.first = std::stoi(words[6]);
  job.isBeside = words[7] != "0";
  job.stages.assign(words.begin() + kBeforeStages, words.end());
  return job;
}

namespace {

/// 0: it cannot be started. `input`: becomes its standard input; below 0: it has ours.
pid_t spawnCompiler(const std::filesystem::path& binary, const CompilerJob& job, int input) {
  std::vector<std::string> words = commandLine(job);
  words.insert(words.begin(), {binary.string(), kCompilerCommand});
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", O_WRONLY, 0);
  if (input >= 0) posix_spawn_file_actions_adddup2(&quiet, input, STDIN_FILENO);
  pid_t process = 0;
  const int error = posix_spawn(&process, binary.c_str(), &quiet, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  return error == 0 ? process : 0;
}

/// What CompilerRun::letGo writes. Without it the end of the pipe is the end of the starter.
void endWithStarter() {
  char word = 0;
  ssize_t got = 0;
  do got = ::read(STDIN_FILENO, &word, 1);
  while (got < 0 && errno == EINTR);
  if (got == 0) ::_exit(1);
}

/// Whoever compiles beside: one at a time, so that many short renders do not leave many compilers.
bool takePlaceBeside() {
  constexpr unsigned kLongest = 300;
  ::alarm(kLongest);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);  // locks and pipes of whoever called the render
  ::setpriority(PRIO_PROCESS, 0, 19);
  const char* const folder = std::getenv("POCL_CACHE_DIR");
  if (!folder) return true;
  const auto place = std::filesystem::path(folder) / kBesideFile;
  const int file = ::open(place.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  return file < 0 || ::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;  // held until the end
}

}  // namespace

std::function<void()> startCompilerProcess(const std::filesystem::path& binary, const CompilerJob& job) {
  const pid_t process = spawnCompiler(binary, job, -1);
  if (process == 0) return {};
  return [process] {
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  };
}

std::optional<CompilerRun> CompilerRun::start(const std::filesystem::path& binary, CompilerJob job) {
  job.first = 0;
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  const pid_t process = spawnCompiler(binary, job, ends[0]);
  ::close(ends[0]);
  if (process != 0) return CompilerRun(process, ends[1]);
  ::close(ends[1]);
  return std::nullopt;
}

CompilerRun::CompilerRun(CompilerRun&& other) noexcept
    : process_(other.process_), life_(std::exchange(other.life_, -1)), status_(other.status_) {}

CompilerRun::~CompilerRun() {
  if (life_ >= 0) ::close(life_);
}

std::optional<int> CompilerRun::ended() {
  int status = 0;
  if (!status_ && ::waitpid(process_, &status, WNOHANG) != 0)
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  return status_;
}

void CompilerRun::letGo() const {
  // Into a pipe that nobody reads any more it would be a signal; then it has ended.
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  [[maybe_unused]] const ssize_t ignored = ::write(life_, "g", 1);
  std::signal(SIGPIPE, before);
}

void compilerProcessMain(const std::vector<std::string>& arguments) {
  const CompilerJob job = compilerJob(arguments);
  if (job.first == 0)
    std::thread(endWithStarter).detach();
  else
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody else would want what it makes
  if (job.isBeside && !takePlaceBeside()) ::_exit(1);
  const auto programs = kernelPrograms(SceneFeatures::ofBits(job.features), job.stages, job.folder);
  prepareCpuThreads(0, job.target.workGroup);
  Compute compute(selectDevice(listDevices(), std::to_string(job.device)));
  for (auto i = static_cast<std::size_t>(job.first); i < programs.size(); ++i)
    compileProgram(compute, programs[i], job.target);
}

}  // namespace whittle
