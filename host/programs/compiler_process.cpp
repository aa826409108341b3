// The compiler process: its command line, its start and its work.
#include "programs/compiler_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <stdexcept>

#include "cl/device.h"

namespace whittle {

std::vector<std::string> commandLine(const CompilerJob& job) {
  std::vector<std::string> words{std::to_string(job.device),
                                 std::to_string(job.features),
                                 std::to_string(job.target.compactChunk),
                                 std::to_string(job.target.workGroup),
                                 std::to_string(static_cast<int>(job.target.relaxedArithmetic)),
                                 job.folder ? job.folder->string() : ""};
  words.insert(words.end(), job.stages.begin(), job.stages.end());
  return words;
}

CompilerJob compilerJob(const std::vector<std::string>& words) {
  constexpr std::size_t kBeforeStages = 6;
  if (words.size() < kBeforeStages)
    throw std::invalid_argument(std::string(kCompilerCommand) + ": for internal use");
  CompilerJob job;
  job.device = std::stoi(words[0]);
  job.features = std::stoull(words[1]);
  job.target = {static_cast<std::uint32_t>(std::stoul(words[2])), std::stoi(words[3]), words[4] != "0"};
  if (!words[5].empty()) job.folder = words[5];
  job.stages.assign(words.begin() + kBeforeStages, words.end());
  return job;
}

std::function<void()> startCompilerProcess(const std::filesystem::path& binary, const CompilerJob& job) {
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
  pid_t process = 0;
  const int error = posix_spawn(&process, binary.c_str(), &quiet, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  if (error != 0) return {};
  return [process] {
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  };
}

void compilerProcessMain(const std::vector<std::string>& arguments) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody else would want what it makes
  const CompilerJob job = compilerJob(arguments);
  const auto programs = kernelPrograms(SceneFeatures::ofBits(job.features), job.stages, job.folder);
  prepareCpuThreads(0, job.target.workGroup);
  Compute compute(selectDevice(listDevices(), std::to_string(job.device)));
  for (std::size_t i = 1; i < programs.size(); ++i) compileProgram(compute, programs[i], job.target);
}

}  // namespace whittle
