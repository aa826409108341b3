// The list of recent files: order, length, and folders that cannot be written.
#include "view/recent_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace whittle::test {
namespace {

namespace fs = std::filesystem;
using view::RecentFiles;

class RecentFilesTest : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }
  const fs::path folder_ = fs::temp_directory_path() / fmt::format("whittle-recent-{}", ::getpid());
  const fs::path store_ = folder_ / "deep" / "recent";
};

TEST_F(RecentFilesTest, TheNewestComesFirstAndOnce) {
  RecentFiles recent(store_);
  EXPECT_TRUE(recent.files().empty());
  for (const char* file : {"/a.glb", "/b.glb", "/x/../a.glb"}) recent.add(file);
  const std::vector<fs::path> expected{"/a.glb", "/b.glb"};
  EXPECT_EQ(recent.files(), expected);
  EXPECT_EQ(RecentFiles(store_).files(), expected) << "read again";
}

TEST_F(RecentFilesTest, IsNoLongerThanItIs) {
  RecentFiles recent(store_);
  for (int i = 0; i < 40; ++i) recent.add(fmt::format("/{}.glb", i));
  ASSERT_EQ(recent.files().size(), view::kRecentFiles);
  EXPECT_EQ(recent.files()[0], "/39.glb");
  EXPECT_EQ(RecentFiles(store_).files(), recent.files());
}

TEST_F(RecentFilesTest, WhatIsNoListIsNone) {
  fs::create_directories(store_);  // a folder
  EXPECT_TRUE(RecentFiles(store_).files().empty());
  fs::remove(store_);
  std::ofstream(store_) << "relative.glb\n\n/good.glb\n";
  EXPECT_EQ(RecentFiles(store_).files(), std::vector<fs::path>{"/good.glb"});
  RecentFiles unwritable("/proc/nowhere/recent");
  unwritable.add("/a.glb");
  EXPECT_EQ(unwritable.files().size(), 1U);
  RecentFiles nowhere("");
  nowhere.add("/a\nb.glb");
  EXPECT_TRUE(nowhere.files().empty()) << "two lines";
}

}  // namespace
}  // namespace whittle::test
