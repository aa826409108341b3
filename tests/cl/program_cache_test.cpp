// Binaries on disk: what was stored comes back whole or not at all, the folder stays within its bound, and
// processes that store, load and are killed do not disturb each other.
#include "cl/program_cache.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <string>

#include "cl/kernel_cache.h"
#include "image/temporary_folder.h"
#include "scene/whole_file.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<unsigned char>;

Bytes noise(std::size_t bytes, unsigned seed = 1) {
  std::mt19937 random(seed);
  Bytes out(bytes);
  std::generate(out.begin(), out.end(), [&] { return static_cast<unsigned char>(random()); });
  return out;
}

std::vector<fs::path> filesOf(const ProgramCache& cache) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(cache.folder())) files.push_back(entry.path());
  return files;
}

class ProgramCacheTest : public testing::Test {
 protected:
  TemporaryFolder folder_;
  ProgramCache cache_{folder_ / "below" / "it"};
};

TEST_F(ProgramCacheTest, WhatIsStoredComesBackUnderItsKeyAlone) {
  EXPECT_FALSE(cache_.load("a"));
  EXPECT_TRUE(cache_.entries().empty());
  for (const std::size_t bytes : {0U, 1U, 70'000U}) {
    cache_.store("a", "searches, for a test", noise(bytes));
    EXPECT_TRUE(cache_.has("a"));
    EXPECT_EQ(cache_.load("a"), noise(bytes)) << bytes;
    EXPECT_FALSE(cache_.load("b"));
  }
  const auto entries = cache_.entries();
  ASSERT_EQ(entries.size(), 1U) << "the last replaced the others";
  EXPECT_EQ(entries[0].what, "searches, for a test");
  EXPECT_GT(entries[0].bytes, 70'000U);
  EXPECT_LT(entries[0].age.count(), 60);
  EXPECT_EQ(cache_.clear(), 1U);
  EXPECT_FALSE(cache_.load("a"));
  EXPECT_TRUE(filesOf(cache_).empty());
}

/// A byte that flips anywhere, an end that is missing, a tail that is not ours.
TEST_F(ProgramCacheTest, ADamagedEntryIsNotThereAndIsRemoved) {
  cache_.store("a", "what", noise(300));
  const fs::path file = filesOf(cache_).at(0);
  std::ifstream in(file, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  const auto expectMiss = [&](const std::string& text, std::size_t at) {
    std::ofstream(file, std::ios::binary) << text;
    EXPECT_FALSE(cache_.load("a")) << at;
    EXPECT_FALSE(fs::exists(file)) << at;
  };
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    expectMiss(changed, at);
    expectMiss(whole.substr(0, at), at);
  }
  expectMiss(whole + "x", whole.size());
  std::ofstream(file, std::ios::binary) << whole;
  EXPECT_EQ(cache_.load("a"), noise(300)) << "the file itself is good";
}

TEST_F(ProgramCacheTest, AnEntryOfAnotherKeyUnderTheSameNameIsNotTaken) {
  cache_.store("a", "what", noise(10));
  const fs::path a = filesOf(cache_).at(0);
  cache_.store("b", "what", noise(10, 2));
  for (const fs::path& b : filesOf(cache_))
    if (b != a) fs::copy_file(a, b, fs::copy_options::overwrite_existing);
  EXPECT_FALSE(cache_.load("b"));
  EXPECT_TRUE(cache_.load("a"));
}

TEST_F(ProgramCacheTest, ThoseUsedLongestAgoMakeRoom) {
  const ProgramCache cache(folder_ / "small", 3500);
  const auto ageBy = [&](const std::string& key, int hours) {
    const fs::path file = cache.folder() / (stableHash(key) + ".program");
    fs::last_write_time(file, fs::last_write_time(file) - std::chrono::hours(hours));
  };
  for (const char* key : {"a", "b", "c"}) cache.store(key, "what", noise(1000));
  ageBy("a", 5), ageBy("b", 4), ageBy("c", 3);
  EXPECT_TRUE(cache.load("a")) << "it is the one used last now";
  cache.store("d", "what", noise(1000));
  EXPECT_TRUE(cache.has("a") && cache.has("c") && cache.has("d"));
  EXPECT_FALSE(cache.has("b"));
  cache.store("large", "what", noise(10'000));
  EXPECT_EQ(cache.entries().size(), 1U) << "the newest stays, though it is larger than the bound";
  EXPECT_TRUE(cache.load("large"));
}

TEST_F(ProgramCacheTest, AFolderThatCannotBeWrittenToIsSaid) {
  const ProgramCache nowhere("/proc/none");
  EXPECT_THROW(nowhere.store("a", "what", noise(10)), UnwritableFile);
  EXPECT_FALSE(nowhere.load("a"));
  EXPECT_TRUE(nowhere.entries().empty());
  EXPECT_EQ(nowhere.clear(), 0U);
  nowhere.remove("a");
}

/// Eight processes store and load the same few entries; half of them are killed at some moment. Whatever is
/// found is whole.
TEST_F(ProgramCacheTest, ProcessesThatAreKilledLeaveNothingHalfDone) {
  constexpr int kProcesses = 8, kKeys = 3;
  const auto keyOf = [](int i) { return "key" + std::to_string(i % kKeys); };
  std::vector<pid_t> children;
  for (int p = 0; p < kProcesses; ++p) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      bool good = true;
      for (int i = 0; i < 60 || p % 2 == 1; ++i) {
        cache_.store(keyOf(i), "what", noise(200'000, static_cast<unsigned>(i % kKeys)));
        const auto found = cache_.load(keyOf(i));
        good = good && (!found || *found == noise(200'000, static_cast<unsigned>(i % kKeys)));
      }
      ::_exit(good ? 0 : 1);
    }
    children.push_back(child);
  }
  for (int p = 0; p < kProcesses; ++p) {
    if (p % 2 == 1) ::kill(children[static_cast<std::size_t>(p)], SIGKILL);
    int status = 0;
    ::waitpid(children[static_cast<std::size_t>(p)], &status, 0);
    if (p % 2 == 0) {
      EXPECT_EQ(status, 0) << p;
    }
  }
  for (int i = 0; i < kKeys; ++i)
    EXPECT_EQ(cache_.load(keyOf(i)), noise(200'000, static_cast<unsigned>(i))) << i;
  EXPECT_EQ(cache_.entries().size(), static_cast<std::size_t>(kKeys));
}

TEST(StableHash, IsThePublishedFnv1a) {
  EXPECT_EQ(stableHash(""), "cbf29ce484222325");
  EXPECT_EQ(stableHash("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(stableHash("foobar"), "85944171f73967e8");
}

TEST(ProgramCacheFolder, FollowsTheEnvironment) {
  const auto with = [](const char* own, const char* xdg, const char* home) {
    std::vector<std::pair<std::string, std::string>> before;
    for (const auto& [name, value] :
         {std::pair("WHITTLE_CACHE_DIR", own), std::pair("XDG_CACHE_HOME", xdg), std::pair("HOME", home)}) {
      const char* const old = std::getenv(name);
      before.emplace_back(name, old ? old : "");
      ::setenv(name, value, 1);
    }
    const fs::path folder = programCacheFolder();
    for (const auto& [name, value] : before) ::setenv(name.c_str(), value.c_str(), 1);
    return folder;
  };
  EXPECT_EQ(with("/own", "/xdg", "/home"), "/own");
  EXPECT_EQ(with("", "/xdg", "/home"), "/xdg/whittle");
  EXPECT_EQ(with("", "", "/home"), "/home/.cache/whittle");
  EXPECT_EQ(with("", "", "").filename(), "programs") << "among the temporary files";
}

}  // namespace
}  // namespace whittle
