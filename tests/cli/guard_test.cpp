// The guard: whatever ends the worker is said in one line, signals are answered at once, and nobody is left
// behind.
#include "cli/guard.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "cli/run_whittle.h"
#include "cli/starvation.h"

namespace whittle::test {
namespace {

using Names = std::vector<std::string>;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// Minutes of work, so that what a test does comes while it renders.
std::vector<std::string> longRender() { return smallRender({"-o", "a.exr", "--rays-per-pixel", "1000000"}); }

/// Waits until `process` runs with two threads or more: its driver is open.
bool waitForThreads(pid_t process) {
  for (int i = 0; i < 1000; ++i, std::this_thread::sleep_for(20ms)) {
    std::error_code gone;
    std::size_t threads = 0;
    std::filesystem::directory_iterator thread("/proc/" + std::to_string(process) + "/task", gone);
    for (; !gone && thread != std::filesystem::directory_iterator(); thread.increment(gone)) ++threads;
    if (threads > 1) return true;
  }
  return false;
}

/// The process that the guard has started, once its driver is open; 0 if that does not happen.
pid_t workerOf(pid_t guard) {
  const std::string children =
      "/proc/" + std::to_string(guard) + "/task/" + std::to_string(guard) + "/children";
  for (int i = 0; i < 1000; ++i, std::this_thread::sleep_for(20ms)) {
    pid_t worker = 0;
    if (std::ifstream(children) >> worker) return waitForThreads(worker) ? worker : 0;
  }
  return 0;
}

/// Gone, or ended and not yet waited for.
bool hasEnded(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  if (!std::getline(stat, line)) return true;
  const char state = line.at(line.rfind(')') + 2);
  return state == 'Z' || state == 'X';
}

TEST(Guard, ACrashOfTheWorkerIsOneLine) {
  const Folder folder;
  Process process(longRender(), {folder.path(), {}});
  const pid_t worker = workerOf(process.id());
  ASSERT_GT(worker, 0);
  // Not SIGSEGV: the kernel compiler takes that one for its own, and goes on.
  ::kill(worker, SIGBUS);
  const Outcome run = process.finish();
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err.rfind("whittle: a crash in a library or the OpenCL driver ended the program (SIGBUS", 0),
            0U)
      << run.err;
  EXPECT_NE(run.err.find("nothing written"), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_EQ(folder.names(), Names{});
}

TEST(Guard, ItsEndIsTheWorkersEnd) {
  const Folder folder;
  Process process(longRender(), {folder.path(), {}});
  const pid_t worker = workerOf(process.id());
  ASSERT_GT(worker, 0);
  process.signal(SIGKILL);
  process.finish();
  for (int i = 0; i < 100 && !hasEnded(worker); ++i) std::this_thread::sleep_for(20ms);
  EXPECT_TRUE(hasEnded(worker));
  EXPECT_EQ(folder.names(), Names{});
}

/// The children of all threads of `process`.
std::vector<pid_t> childrenOf(pid_t process) {
  std::vector<pid_t> children;
  std::error_code gone;
  std::filesystem::directory_iterator thread("/proc/" + std::to_string(process) + "/task", gone);
  for (; !gone && thread != std::filesystem::directory_iterator(); thread.increment(gone)) {
    std::ifstream in(thread->path() / "children");
    for (pid_t child = 0; in >> child;) children.push_back(child);
  }
  return children;
}

TEST(Guard, TheCompilersProcessGoesWithIt) {
  const Folder folder, cache;  // empty: a compilation takes seconds, and a process beside
  Process process(longRender(), {folder.path(), {{"POCL_CACHE_DIR", cache.path()}}});
  const pid_t worker = workerOf(process.id());
  ASSERT_GT(worker, 0);
  std::vector<pid_t> compilers;
  for (int i = 0; i < 500 && compilers.empty(); ++i, std::this_thread::sleep_for(10ms))
    compilers = childrenOf(worker);
  ASSERT_FALSE(compilers.empty());
  for (const pid_t compiler : compilers) ASSERT_TRUE(waitForThreads(compiler)) << "it never came to work";
  process.signal(SIGKILL);
  process.finish();
  for (const pid_t compiler : compilers) {
    for (int i = 0; i < 100 && !hasEnded(compiler); ++i) std::this_thread::sleep_for(20ms);
    EXPECT_TRUE(hasEnded(compiler));
  }
}

TEST(Guard, AnInterruptionWhilePicturesAreWrittenSaysWhichAre) {
  const Folder folder;
  // The first is small on disk and there at once; to encode the second takes seconds.
  Process process({"render", scene("white_furnace.glb"), "--width", "6000", "--height", "5000", "--bounces",
                   "1", "-o", "a.jpg", "-o", "b.png"},
                  {folder.path(), {}});
  for (int i = 0; i < 6000 && !std::filesystem::exists(folder / "a.jpg"); ++i)
    std::this_thread::sleep_for(10ms);
  std::this_thread::sleep_for(50ms);
  const auto begin = Clock::now();
  process.signal(SIGTERM);
  const Outcome run = process.finish();
  // A tenth of a second here; to encode the rest takes several.
  EXPECT_LT(Clock::now() - begin, 2s);
  EXPECT_EQ(run.status, -SIGTERM);
  EXPECT_NE(run.err.find("whittle: interrupted; written: a.jpg\n"), std::string::npos) << run.err;
  EXPECT_EQ(folder.names(), Names{"a.jpg"});
}

TEST(Guard, ABackgroundJobThatIgnoresASignalGoesOnIgnoringIt) {
  const Folder folder;
  const Outcome run = runShell(
      "trap '' HUP; \"$WHITTLE\" render " + scene() +
          " --width 64 --height 48 --rays-per-pixel 200 -o a.exr --quiet & sleep 0.2; kill -HUP $!; wait $!",
      {folder.path(), {}});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.names(), Names{"a.exr"});
}

/// A process that runs `work` until it is killed.
template <typename Work>
class Other {
 public:
  explicit Other(const Work& work) : id_(::fork()) {
    if (id_ == 0)
      for (;;) work();
  }
  ~Other() {
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
  }
  Other(const Other&) = delete;
  Other& operator=(const Other&) = delete;
  pid_t id() const { return id_; }

 private:
  pid_t id_;
};

/// Whether `process`, which has some megabytes of addresses, is starved within two seconds under `limit`.
bool starvesUnder(pid_t process, std::uint64_t limit) {
  cli::Starvation starvation;
  for (int i = 0; i < 20; ++i, std::this_thread::sleep_for(100ms))
    if (starvation.isStarved(process, limit)) return true;
  return false;
}

TEST(Guard, OnlyWhoSleepsAtTheEndOfItsMemoryStarves) {
  constexpr std::uint64_t kLittle = 1 << 20, kMuch = std::uint64_t{1} << 46;
  const Other sleeps([] { ::pause(); });
  EXPECT_TRUE(starvesUnder(sleeps.id(), kLittle));
  EXPECT_FALSE(starvesUnder(sleeps.id(), kMuch)) << "it has enough, and waits for something else";
  volatile int count = 0;
  const Other works([&] { count = count + 1; });
  EXPECT_FALSE(starvesUnder(works.id(), kLittle));
  ::kill(sleeps.id(), SIGSTOP);
  EXPECT_FALSE(starvesUnder(sleeps.id(), kLittle)) << "the user has stopped it";
}

}  // namespace
}  // namespace whittle::test
