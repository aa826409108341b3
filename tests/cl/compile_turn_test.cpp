// One compiles, the others wait, and nobody waits for the dead.
#include "cl/compile_turn.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>
#include <vector>

namespace whittle {
namespace {

using namespace std::chrono_literals;

class CompileTurnTest : public testing::Test {
 protected:
  CompileTurnTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "whittle-turn-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    if (const char* const before = std::getenv("POCL_CACHE_DIR")) before_ = before;
    ::setenv("POCL_CACHE_DIR", folder_.c_str(), 1);
  }
  ~CompileTurnTest() override {
    before_.empty() ? ::unsetenv("POCL_CACHE_DIR") : ::setenv("POCL_CACHE_DIR", before_.c_str(), 1);
    std::filesystem::remove_all(folder_);
  }

  /// Twenty threads that come while the first has its turn; how many had one.
  static int turnsOfTwenty(bool finish) {
    std::atomic<int> turns = 0;
    std::vector<std::thread> threads;
    {
      CompileTurn first("key");
      EXPECT_TRUE(first.isMine());
      for (int i = 0; i < 20; ++i)
        threads.emplace_back([&] {
          CompileTurn turn("key");
          turns += turn.isMine() ? 1 : 0;
          if (turn.isMine()) turn.done();
        });
      std::this_thread::sleep_for(200ms);
      EXPECT_EQ(turns, 0) << "they wait";
      if (finish) first.done();
    }
    for (std::thread& t : threads) t.join();
    return turns;
  }

 private:
  std::filesystem::path folder_;
  std::string before_;
};

TEST_F(CompileTurnTest, WhoWaitedForWorkThatIsDoneHasNoTurn) {
  EXPECT_EQ(turnsOfTwenty(true), 0);
  EXPECT_EQ(turnsOfTwenty(true), 0) << "a later count is as good as the first";
}

TEST_F(CompileTurnTest, OneTakesTheTurnOfTheDead) {
  const int turns = turnsOfTwenty(false);
  EXPECT_GE(turns, 1);
  EXPECT_LT(turns, 20);
}

TEST_F(CompileTurnTest, OtherKeysDoNotWait) {
  const CompileTurn one("one"), two("two");
  EXPECT_TRUE(one.isMine());
  EXPECT_TRUE(two.isMine());
}

TEST_F(CompileTurnTest, WithoutAFolderNobodyWaits) {
  ::setenv("POCL_CACHE_DIR", "/proc/none", 1);
  const CompileTurn one("key"), two("key");
  EXPECT_FALSE(two.isMine());
}

}  // namespace
}  // namespace whittle
