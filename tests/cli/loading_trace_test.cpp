// --trace of the host: what it did before the first ray, and on which thread.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "cli/run_whittle.h"

namespace whittle::test {
namespace {

using Json = nlohmann::json;

TEST(LoadingTrace, ShowsWhatTheHostDidWhileItLoaded) {
  const Folder folder;
  const std::string scene = WHITTLE_SCENES "/textured.glb";
  ASSERT_EQ(runWhittle({"render", scene, "--width", "32", "--height", "24", "--trace", "t.json", "--quiet"},
                       {folder.path(), {}})
                .status,
            0);
  struct Span {
    double begin, end;
    int row;
  };
  std::map<std::string, Span> phases;
  std::set<int> named;
  const Json trace = readJson(folder / "t.json");
  for (const auto& e : trace["traceEvents"]) {
    if (e["ph"] == "M" && e["name"] == "thread_name") named.insert(e["tid"].get<int>());
    if (e["ph"] != "X" || e["cat"] != "phase") continue;
    const double begin = e["ts"];
    phases[e["name"]] = {begin, begin + e["dur"].get<double>(), e["tid"]};
  }
  ASSERT_TRUE(phases.contains("load"));
  const Span load = phases["load"];
  constexpr double kClock = 1.0;  // microseconds that roundings may add
  for (const char* part :
       {"read the file", "read the description", "decode images", "decode image 0", "read meshes"}) {
    ASSERT_TRUE(phases.contains(part)) << part;
    EXPECT_GE(phases[part].begin, load.begin - kClock) << part;
    EXPECT_LE(phases[part].end, load.end + kClock) << part;
    EXPECT_TRUE(named.contains(phases[part].row)) << part;
  }
  EXPECT_EQ(phases["read the file"].row, load.row);
  // On a row of its own, beside the reading.
  ASSERT_TRUE(phases.contains("open the device"));
  EXPECT_TRUE(named.contains(phases["open the device"].row));
}

}  // namespace
}  // namespace whittle::test
