// whittle bench: the names of its report are a contract with scripts; rates are not tested.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "run_whittle.h"

namespace whittle::test {
namespace {

using Json = nlohmann::json;

/// A short bench; cases that ask for the same share one.
const Json& benchOf(const std::vector<std::string>& more) {
  static std::map<std::vector<std::string>, Json> known;
  if (const auto found = known.find(more); found != known.end()) return found->second;
  std::vector<std::string> args{
      "bench", std::string(WHITTLE_SCENES) + "/shadow.glb", "--json", "--rays", "2000", "--runs", "1"};
  args.insert(args.end(), more.begin(), more.end());
  const Outcome run = runWhittle(args);
  EXPECT_EQ(run.status, 0) << run.err;
  return known[more] = Json::parse(run.out);
}

TEST(Bench, HasARowForEachKindOfRayAndQuery) {
  const Json& r = benchOf({});
  for (const char* key : {"scene", "triangles", "threads", "device", "build", "kernels", "rows"})
    EXPECT_TRUE(r.contains(key)) << key;
  for (const char* key : {"seconds", "bytesPerTriangle"}) EXPECT_GT(r["build"][key], 0) << key;
  std::set<std::string> found;
  for (const auto& row : r["rows"]) {
    found.insert(row["rays"].get<std::string>() + " " + row["query"].get<std::string>());
    EXPECT_GT(row["count"], 0);
    EXPECT_GT(row["mraysPerSecond"], 0);
  }
  for (const char* kind : {"eye", "shadow", "mirror1", "mirror2", "refraction", "cosine", "uniform"})
    for (const char* query : {" nearest", " any"})
      EXPECT_TRUE(found.contains(std::string(kind) + query)) << kind << query;
  EXPECT_EQ(r["rows"].size(), 14U);
}

/// What each kernel reads of the scene, whether it takes part or not: its nodes, and the corners of its
/// triangles, 36 bytes each and one more than there are.
TEST(Bench, SaysWhatEachKernelReadsForEachTriangle) {
  const Json& r = benchOf({});
  std::set<std::string> names;
  for (const auto& k : r["kernels"]) {
    names.insert(k["kernel"].get<std::string>());
    const double nodes = k["nodeBytesPerTriangle"], triangles = k["triangleBytesPerTriangle"];
    EXPECT_GT(nodes, 1) << k;
    const double count = r["triangles"];
    EXPECT_NEAR(triangles, 36 * (count + 1) / count, 1e-6) << k;
    EXPECT_LT(nodes + triangles, 1000) << k;
    EXPECT_DOUBLE_EQ(k["bytesPerTriangle"], nodes + triangles) << k;
    if (k["kernel"] == "single2") {
      EXPECT_LE(nodes, 64) << "at most a node for each triangle";
    }
  }
  EXPECT_TRUE(names.contains("single2") && names.contains(r["rows"][0]["kernel"].get<std::string>()));
}

/// Embree in its robust mode judges every kernel; a build without it has nothing to say.
TEST(Bench, EveryKernelAgreesWithEmbree) {
  const Json& r = benchOf({"--all-kernels", "--robust-only"});
  std::set<std::string> kernels;
  for (const auto& row : r["rows"]) {
    kernels.insert(row["kernel"].get<std::string>());
    if (!row.contains("embreeMode")) GTEST_SKIP() << "this build has no Embree";
    EXPECT_EQ(row["embreeMode"].get<std::string>().rfind("robust", 0), 0U);
    // A ray within rounding of an edge may go either way: one of two thousand.
    EXPECT_LE(row["disagree"], 1) << row;
  }
  EXPECT_EQ(kernels, (std::set<std::string>{"packet16", "single2"}));
}

/// Everything lies in one plane: no ray may start in it. And it is one triangle.
TEST(Bench, ATriangleAloneIsNoPuzzle) {
  const Folder folder;
  std::ofstream(folder / "one.gltf")
      << R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  const Outcome run = runWhittle(
      {"bench", "one.gltf", "--rays", "2000", "--runs", "1", "--all-kernels", "--json"}, {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json report = Json::parse(run.out);
  EXPECT_FALSE(report["rows"].empty());
  for (const auto& row : report["rows"]) EXPECT_LE(row.value("disagree", 0), 1) << row;
  const Outcome few = runWhittle({"bench", "one.gltf", "--rays", "1", "--runs", "1"}, {folder.path(), {}});
  EXPECT_EQ(few.out.rfind("1 triangle, ", 0), 0U) << few.out;
  EXPECT_NE(few.err.find("so few rays that launching a kernel"), std::string::npos) << few.err;
}

TEST(Bench, TextSaysTheSame) {
  const Outcome run = runWhittle(
      {"bench", std::string(WHITTLE_SCENES) + "/shadow.glb", "--rays", "500", "--runs", "1", "--quiet"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  for (const char* part :
       {"triangles", "bytes for each triangle", "nodes + triangles", "mirror2", "packet16", "Mrays/s"})
    EXPECT_NE(run.out.find(part), std::string::npos) << part << " in:\n" << run.out;
}

}  // namespace
}  // namespace whittle::test
