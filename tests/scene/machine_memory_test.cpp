// What is free, read from files as a kernel writes them.
#include "scene/machine_memory.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <fstream>

namespace whittle {
namespace {

namespace fs = std::filesystem;

/// A root folder of a machine that does not exist.
class Machine {
 public:
  Machine() {
    std::string pattern = (fs::temp_directory_path() / "whittle_machine_XXXXXX").string();
    root_ = mkdtemp(pattern.data());
  }
  ~Machine() {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  Machine& file(const std::string& name, const std::string& text) {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
    return *this;
  }
  std::optional<std::uint64_t> free() const { return freeMemory(root_); }

 private:
  fs::path root_;
};

constexpr const char* kMeminfo = "MemTotal:  2000 kB\nMemFree:  10 kB\nMemAvailable:   1000 kB\n";

TEST(MachineMemory, NothingIsKnownWhereNothingIsSaid) { EXPECT_EQ(Machine().free(), std::nullopt); }

TEST(MachineMemory, AvailableIsMoreThanFree) {
  EXPECT_EQ(Machine().file("proc/meminfo", kMeminfo).free(), 1'024'000U);
}

TEST(MachineMemory, AGroupLeavesItsLimitWithoutWhatItHolds) {
  Machine machine;
  machine.file("proc/meminfo", kMeminfo)
      .file("proc/self/cgroup", "0::/a/b\n")
      .file("sys/fs/cgroup/a/b/memory.max", "500000\n")
      .file("sys/fs/cgroup/a/b/memory.current", "300000\n")
      .file("sys/fs/cgroup/a/b/memory.stat", "anon 100000\ninactive_file 200000\n");
  EXPECT_EQ(machine.free(), 400'000U) << "cached files give way";
}

TEST(MachineMemory, GroupsAboveCountToo) {
  Machine machine;
  machine.file("proc/meminfo", kMeminfo)
      .file("proc/self/cgroup", "0::/a/b\n")
      .file("sys/fs/cgroup/a/b/memory.max", "max\n")
      .file("sys/fs/cgroup/a/memory.max", "7000\n");
  EXPECT_EQ(machine.free(), 7000U);
}

TEST(MachineMemory, ANameThatOnlyTheOutsideKnows) {
  Machine machine;
  machine.file("proc/meminfo", kMeminfo)
      .file("proc/self/cgroup", "0::/../outside\n")
      .file("sys/fs/cgroup/memory.max", "9000\n");
  EXPECT_EQ(machine.free(), 9000U);
}

TEST(MachineMemory, GroupsOfVersionOne) {
  Machine machine;
  machine.file("proc/meminfo", kMeminfo)
      .file("proc/self/cgroup", "3:cpu:/x\n7:memory:/x\n")
      .file("sys/fs/cgroup/memory/x/memory.limit_in_bytes", "8000\n")
      .file("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(machine.free(), 8000U);
}

TEST(MachineMemory, TheProcessHasLimitsOfItsOwn) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer takes more than such a limit leaves";
#endif
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_DATA, &before), 0);
  const rlimit less{100'000'000'000 / 1000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_DATA, &less), 0);
  const MemoryLimit limit = memoryLimitOfMachine();
  setrlimit(RLIMIT_DATA, &before);
  EXPECT_LE(limit.bytes, 80'000'000U);
  EXPECT_FALSE(limit.isChosen);
}

}  // namespace
}  // namespace whittle
