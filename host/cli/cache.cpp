// whittle cache: the general programs that are kept as device binaries: what is there, clearing, compiling
// them.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "cl/device.h"
#include "cl/device_facts.h"
#include "cl/kernel_cache.h"
#include "cl/program_cache.h"
#include "cli/commands.h"
#include "cli/option_kinds.h"
#include "cli/progress_bar.h"
#include "cli/speech.h"
#include "programs/general_programs.h"
#include "report/text.h"
#include "scene/byte_counts.h"
#include "scene/whole_file.h"

namespace whittle::cli {
namespace {

struct CacheOptions {
  bool clear = false, warm = false, backwards = false, quiet = false;
  std::string device;
};

std::string ageText(std::chrono::seconds age) {
  const auto seconds = age.count();
  if (seconds < 60) return "now";
  if (seconds < 3600) return fmt::format("{} min", seconds / 60);
  if (seconds < std::int64_t{2} * 86400) return fmt::format("{} h", seconds / 3600);
  return fmt::format("{} days", seconds / 86400);
}

void show(const ProgramCache& cache) {
  const auto entries = cache.entries();
  std::uint64_t bytes = 0;
  for (const auto& entry : entries) bytes += entry.bytes;
  tell(fmt::format("{}: {}, {} of {} at most\n", cache.folder().string(),
                   formatSome(entries.size(), "program", "programs"), formatBytes(bytes),
                   formatBytes(cache.most())));
  if (entries.empty()) tell("`whittle cache --warm` compiles the general programs\n");
  if (!entries.empty()) tell(fmt::format("{:>8}  {:>8}  {:>8}  program\n", "size", "made", "used"));
  for (const auto& entry : entries)
    tell(fmt::format("{:>8}  {:>8}  {:>8}  {}\n", formatBytes(entry.bytes), ageText(entry.age),
                     ageText(entry.unused), entry.what));
}

/// Before anything is compiled that could not be kept.
void checkFolder(const ProgramCache& cache) {
  std::error_code error;
  std::filesystem::create_directories(cache.folder(), error);
  try {
    tryFolder(cache.folder() / "program");
  } catch (const std::exception& e) {
    throw std::runtime_error(fmt::format(
        "programs cannot be kept: {}; set WHITTLE_CACHE_DIR to a folder that can be written to", e.what()));
  }
}

/// PoCL compiles one kernel at a time in a process: a second one begins at the other end. What goes wrong
/// there goes wrong here too, and is said here.
pid_t startSecond(const CacheOptions& o) {
  std::array<std::string, 7> words{"whittle", "cache",    "--warm", "--backwards",
                                   "--quiet", "--device", o.device};
  std::array<char*, 8> pointers{};
  for (std::size_t i = 0; i < words.size(); ++i) pointers[i] = words[i].data();
  if (o.device.empty()) pointers[5] = nullptr;
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int error = ::posix_spawn(&process, "/proc/self/exe", &quiet, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  return error == 0 ? process : 0;
}

int warm(const CacheOptions& o, const ProgramCache& cache) {
  checkFolder(cache);
  warnIfAny(settleKernelCache());
  prepareCpuThreads(0, 0);
  Compute compute(selectDevice(listDevices(), o.device));
  ProgressBar bar(o.quiet);
  int compiled = 0;
  pid_t second = 0;
  const auto start = std::chrono::steady_clock::now();
  warmCache(cache, compute, o.backwards, [&](const WarmingStep& step) {
    if (step.isThere) return;
    if (!o.backwards && compiled == 0) second = startSecond(o);
    ++compiled;
    bar.phase("compiling " + step.what);
  });
  while (second > 0 && ::waitpid(second, nullptr, 0) < 0 && errno == EINTR) continue;
  bar.clear();
  if (o.quiet) return 0;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  tell(compiled == 0 ? fmt::format("the general programs are in {} already\n", cache.folder().string())
                     : fmt::format("compiled the general programs into {} in {}\n", cache.folder().string(),
                                   formatSeconds(seconds)));
  return 0;
}

int runCache(const CacheOptions& o) {
  if (o.clear && o.warm) throw InputError("--clear and --warm: give one of the two");
  if (!o.device.empty() && !o.warm) throw InputError("--device: only --warm asks for one");
  const ProgramCache cache(programCacheFolder());
  if (o.clear) {
    forgetFacts();
    tell(fmt::format("removed {} from {}\n", formatSome(cache.clear(), "program", "programs"),
                     cache.folder().string()));
    return 0;
  }
  if (o.warm) return warm(o, cache);
  show(cache);
  return 0;
}

}  // namespace

void addCache(CLI::App& app, int& status) {
  auto o = std::make_shared<CacheOptions>();
  CLI::App* c =
      app.add_subcommand("cache", "programs kept compiled, so that scenes start without a compiler");
  c->option_defaults()->group("Options");
  c->add_flag("--warm", o->warm, "compile the general programs that are missing, once for a device");
  c->add_flag("--clear", o->clear, "remove all of them, and what was found out about devices");
  addText(*c, "--device", [o](const std::string& word) { o->device = word; },
          {"SELECTOR", "of --warm: index from `whittle devices`, part of a name, or cpu|gpu",
           "the first CPU, else the first"});
  c->add_flag("--quiet", o->quiet, "no progress and no last line");
  c->add_flag("--backwards", o->backwards, "of --warm: begin with the last program, for the second of two")
      ->group("");
  c->footer("Example: whittle cache --warm; whittle cache");
  c->callback([o, &status] { status = runCache(*o); });
}

}  // namespace whittle::cli
