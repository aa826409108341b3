// --stats, --trace, --reference, --time-limit, --target-error: the names are a contract with scripts.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <set>

#include "image/image_io.h"
#include "report/json_float.h"
#include "report/text.h"
#include "run_whittle.h"
#include "scene/settings.h"

namespace whittle::test {
namespace {

using Json = nlohmann::json;

void expectKeys(const Json& object, const std::vector<const char*>& keys, const std::string& where) {
  for (const char* key : keys) EXPECT_TRUE(object.contains(key)) << where << " has no " << key;
}

/// Statistics of a small render; cases that ask for the same share one.
const Json& statsOf(const std::vector<std::string>& more) {
  static std::map<std::vector<std::string>, Json> known;
  if (const auto found = known.find(more); found != known.end()) return found->second;
  const Folder folder;
  auto args = smallRender(more);
  args.insert(args.end(), {"--stats", "s.json", "--quiet"});
  const Outcome run = runWhittle(args, {folder.path(), {}});
  EXPECT_EQ(run.status, 0) << run.err;
  return known[more] = readJson(folder / "s.json");
}

/// What a small render prints.
std::string summaryOf(const std::vector<std::string>& more, const Folder& folder = {}) {
  const Outcome run = runWhittle(smallRender(more), {folder.path(), {}});
  EXPECT_EQ(run.status, 0) << run.err;
  return run.out;
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Summary, SaysThatATargetWasMissed) {
  const auto missed = [](const std::vector<std::string>& more) {
    return has(summaryOf(more), "not the target of 0.0001 W/(m² sr)");
  };
  EXPECT_TRUE(missed({"--target-error", "1e-4", "--rays-per-pixel", "2"}));
  EXPECT_TRUE(missed({"--target-error", "1e-4", "--rays-per-pixel", "1"})) << "nothing is estimated";
  EXPECT_FALSE(missed({"--target-error", "100"}));
  EXPECT_FALSE(missed({"--rays-per-pixel", "2"}));
}

TEST(Summary, SpeaksOfTheMeanWhereTheTargetDoes) {
  const std::string missed = summaryOf({"--target-error", "0.01%", "--rays-per-pixel", "2"});
  EXPECT_TRUE(has(missed, "not the target of 0.01 % of the mean")) << missed;
  const std::string met = summaryOf({"--target-error", "0.01", "--target-error", "200 %"});
  EXPECT_FALSE(has(met, "not the target")) << met;
  EXPECT_TRUE(has(met, "2 rays per pixel")) << met << "the last target counts, and two rays meet it";
}

/// Theory gives the error of independent samples; the others do better.
TEST(Summary, SaysWhichWayTheEstimateErrs) {
  EXPECT_TRUE(has(summaryOf({"--rays-per-pixel", "4"}), "estimated error: about "));
  for (const char* sampler : {"stratified", "sobol"})
    EXPECT_TRUE(
        has(summaryOf({"--rays-per-pixel", "4", "--sampler", sampler}), "estimated error: at most about "));
}

TEST(Summary, HasTheTrueErrorBesideTheEstimate) {
  const Folder folder;
  const std::string without = summaryOf({"--rays-per-pixel", "4", "--seed", "9", "-o", "ref.exr"}, folder);
  EXPECT_FALSE(has(without, "true error")) << without;
  for (const char* rays : {"1", "2"}) {
    const std::string text =
        summaryOf({"--rays-per-pixel", rays, "--reference", "ref.exr", "-o", "a.exr"}, folder);
    const Outcome compared = runWhittle({"compare", "a.exr", "ref.exr", "--json"}, {folder.path(), {}});
    const double rmse = Json::parse(compared.out)["rmse"];
    const FloatImage picture = readFloatImage(folder / "a.exr");
    const double mean = std::accumulate(picture.pixels.begin(), picture.pixels.end(), 0.0) / (32 * 24 * 3);
    const std::string line =
        "true error: " + formatReal(rmse) + " W/(m² sr), " + formatReal(100 * rmse / mean) + " % of the mean";
    EXPECT_TRUE(has(text, line)) << line << " in:\n" << text;
    EXPECT_EQ(has(text, "estimated error"), std::string(rays) == "2") << text;
  }
}

TEST(Summary, NotesThatAdaptiveHasNothingToGiveOut) {
  const Folder folder;
  for (const char* rays : {"16", "17"}) {
    const Outcome run =
        runWhittle(smallRender({"--adaptive", "--rays-per-pixel", rays}), {folder.path(), {}});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(has(run.err, "note: --adaptive: changes nothing up to 16 rays"), std::string(rays) == "16")
        << run.err;
  }
}

TEST(Summary, CountsTheRaysThatWereReached) {
  const Folder folder;
  const Outcome met = runWhittle(
      smallRender({"--rays-per-pixel", "64", "--target-error", "100", "-o", "a.png"}), {folder.path(), {}});
  EXPECT_NE(met.out.find(" triangles, 2 rays per pixel\n"), std::string::npos) << met.out << met.err;
  const Outcome adaptive =
      runWhittle(smallRender({"--rays-per-pixel", "40", "--adaptive", "-o", "a.png"}), {folder.path(), {}});
  EXPECT_NE(adaptive.out.find(" rays per pixel (16 to "), std::string::npos) << adaptive.out << adaptive.err;
}

TEST(Stats, HoldsEveryKeyOfTheContract) {
  const Json& s = statsOf({"--rays-per-pixel", "4"});
  expectKeys(s,
             {"scene", "settings", "device", "features", "rays", "time", "phases", "stages", "bounces",
              "memory", "error", "cutOffThroughput", "bouncesThroughput", "transparentBouncesThroughput",
              "biasBound", "meanRadiance", "nonFinite", "dropped"},
             "top");
  expectKeys(s["scene"], {"file", "triangles", "materials", "lights", "textures"}, "scene");
  expectKeys(s["settings"], {"output", "stats", "profile", "trace", "reference", "aov", "quiet"}, "settings");
  eachSetting(Settings{},
              [&](const char* name, const auto&) { expectKeys(s["settings"], {name}, "settings"); });
  expectKeys(s["device"], {"platform", "name", "version", "driver", "computeUnits", "threads"}, "device");
  expectKeys(s["features"], {"used", "kept", "leftOut"}, "features");
  expectKeys(s["rays"], {"primary", "impulse", "shadow", "total"}, "rays");
  expectKeys(s["time"], {"load", "build", "compile", "upload", "render", "write", "total"}, "time");
  expectKeys(s["memory"], {"tree", "triangles", "queues", "textures", "film", "total"}, "memory");
  ASSERT_FALSE(s["stages"].empty());
  for (const auto& stage : s["stages"]) expectKeys(stage, {"name", "launches", "seconds", "items"}, "stage");
  ASSERT_FALSE(s["error"].empty());
  for (const auto& point : s["error"])
    expectKeys(point, {"seconds", "raysPerPixel", "estimate", "rmse", "mean"}, "error");
}

TEST(Stats, CountsAddUp) {
  const Json& s = statsOf({"--rays-per-pixel", "4"});
  EXPECT_EQ(s["rays"]["primary"], 32 * 24 * 4);
  EXPECT_EQ(s["rays"]["total"], s["rays"]["primary"].get<int>() + s["rays"]["impulse"].get<int>() +
                                    s["rays"]["shadow"].get<int>());
  EXPECT_EQ(s["dropped"], 0);
  EXPECT_EQ(s["nonFinite"], 0);
  std::map<std::string, std::uint64_t> items;
  for (const auto& stage : s["stages"]) items[stage["name"]] = stage["items"];
  EXPECT_EQ(items["raygen"], s["rays"]["primary"]);
  EXPECT_EQ(items["intersect"],
            s["rays"]["primary"].get<std::uint64_t>() + s["rays"]["impulse"].get<std::uint64_t>());
  EXPECT_EQ(items["occlude"], s["rays"]["shadow"]);
  const auto& m = s["memory"];
  std::uint64_t sum = 0;
  for (const char* group : {"tree", "triangles", "queues", "textures", "film"})
    sum += m[group].get<std::uint64_t>();
  EXPECT_EQ(m["total"], sum);
  double phases = 0.0;
  for (const char* phase : {"load", "render", "write"}) phases += s["time"][phase].get<double>();
  EXPECT_GE(s["time"]["total"].get<double>(), phases);
}

TEST(Stats, StagesAreTheSumsOfTheirBounces) {
  const Json& s = statsOf({"--rays-per-pixel", "4"});
  ASSERT_GT(s["bounces"].size(), 2U);
  for (const auto& stage : s["stages"]) {
    std::uint64_t launches = 0, items = 0, bytes = 0;
    double seconds = 0.0;
    for (const auto& bounce : s["bounces"])
      for (const auto& part : bounce["stages"])
        if (part["name"] == stage["name"]) {
          launches += part["launches"].get<std::uint64_t>();
          items += part["items"].get<std::uint64_t>();
          bytes += part["bytes"].get<std::uint64_t>();
          seconds += part["seconds"].get<double>();
        }
    EXPECT_EQ(launches, stage["launches"]) << stage["name"];
    EXPECT_EQ(items, stage["items"]) << stage["name"];
    EXPECT_EQ(bytes, stage["bytes"]) << stage["name"];
    EXPECT_GT(bytes, 0U) << stage["name"];
    EXPECT_NEAR(seconds, stage["seconds"].get<double>(), 1e-9) << stage["name"];
  }
}

TEST(Stats, PhasesCoverTheRun) {
  const Json& s = statsOf({});
  double end = 0.0;
  std::set<std::string> names;
  for (const auto& p : s["phases"]) {
    EXPECT_GE(p["start"].get<double>(), 0.0) << p;
    end = std::max(end, p["start"].get<double>() + p["seconds"].get<double>());
    names.insert(p["name"]);
  }
  for (const char* name :
       {"load", "open the device", "compile kernels", "build tree", "upload", "render", "write"})
    EXPECT_TRUE(names.contains(name)) << name;
  EXPECT_LE(end, s["time"]["total"].get<double>() + 1e-3);
}

TEST(Stats, SettingsAreThoseAskedFor) {
  const auto s = statsOf({"--no-shadows", "--bump", "0.25", "--impulses", "one", "--sampler", "sobol",
                          "--seed", "7", "--rays-per-pixel", "2", "--search", "array"})["settings"];
  EXPECT_EQ(s["shadows"], false);
  EXPECT_EQ(s["rayOffset"], 0.25);
  EXPECT_EQ(s["bump"], 0.25);
  EXPECT_EQ(s["impulses"], "one");
  EXPECT_EQ(s["sampler"], "sobol");
  EXPECT_EQ(s["seed"], 7);
  EXPECT_EQ(s["raysPerPixel"], 2);
  EXPECT_EQ(s["search"], "array");
  EXPECT_EQ(s["quiet"], true);
}

TEST(Stats, ACutoffTracesLessAndSaysWhatItCanCost) {
  const Json &whole = statsOf({}), &cut = statsOf({"--cutoff", "0.25"});
  EXPECT_EQ(whole["settings"]["cutoff"], 0);
  EXPECT_EQ(cut["settings"]["cutoff"], 0.25);
  EXPECT_EQ(whole["cutOffThroughput"], 0);
  EXPECT_GT(cut["biasBound"].get<double>(), whole["biasBound"].get<double>());
  EXPECT_GT(cut["cutOffThroughput"].get<double>(), 0);
  EXPECT_LT(cut["rays"]["impulse"].get<int>(), whole["rays"]["impulse"].get<int>());
}

/// The bound stands beside what it bounds: the mean of the brightest channel of the picture that was written.
TEST(Stats, TheMeanIsThatOfThePicture) {
  const Folder folder;
  const Outcome run =
      runWhittle(smallRender({"--cutoff", "0.25", "--stats", "s.json", "-o", "a.exr"}), {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  const FloatImage image = readFloatImage(folder / "a.exr");
  double sums[3] = {};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) sums[i % 3] += static_cast<double>(image.pixels[i]);
  const double mean = *std::max_element(sums, sums + 3) / (32 * 24);
  const Json s = readJson(folder / "s.json");
  // Sums of 768 numbers, in the same order or another: far fewer than 1e4 roundings of 1e-16 each.
  EXPECT_NEAR(s["meanRadiance"].get<double>(), mean, 1e-12 * mean);
  const std::string line = "W/(m² sr) off the mean, which is " + formatReal(mean) + ": " +
                           formatReal(100 * s["biasBound"].get<double>() / mean) + " %\n";
  EXPECT_NE(run.out.find(line), std::string::npos) << line << " in:\n" << run.out;
}

TEST(Stats, FloatsAreTheDecimalsThatWereTyped) {
  const Folder folder;
  ASSERT_EQ(runWhittle(smallRender({"--cutoff", "0.001", "--ray-offset", "0.1", "--mirror-roughness", "0.15",
                                    "--exposure", "-0.7", "--stats", "s.json", "--quiet"}),
                       {folder.path(), {}})
                .status,
            0);
  const std::string text = readText(folder / "s.json");
  for (const char* part :
       {"\"cutoff\": 0.001,", "\"rayOffset\": 0.1,", "\"mirrorRoughness\": 0.15,", "\"exposure\": -0.7,"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

/// Bits of floats of every size come back from what a JSON writer prints.
TEST(Stats, FloatsReadBackAsTheSameFloats) {
  std::uint32_t bits = 1;
  for (int i = 0; i < 20000; ++i) {
    bits = bits * 1664525U + 1013904223U;
    const auto value = std::bit_cast<float>(bits);
    if (!std::isfinite(value)) continue;
    const std::string text = Json(jsonFloat(value)).dump();
    EXPECT_EQ(std::bit_cast<std::uint32_t>(std::strtof(text.c_str(), nullptr)), bits) << text;
  }
}

TEST(Stats, TimeLimitStopsEarlyAndSaysHowFarItCame) {
  // A limit that the first pass of one ray has passed already: the second pass must not start… but two rays
  // give an estimate.
  const auto s = statsOf({"--rays-per-pixel", "1048576", "--time-limit", "0.000001"});
  EXPECT_EQ(s["settings"]["raysPerPixel"], 1048576) << "what was asked for";
  EXPECT_LE(s["samples"]["most"], 2);
  EXPECT_EQ(s["rays"]["primary"], 32 * 24 * s["samples"]["mean"].get<int>());
}

TEST(Stats, ATargetWithoutACountTakesAsManyRaysAsItNeeds) {
  const auto json = statsOf({"--target-error", "0.05"});
  const auto& last = json["error"].back();
  EXPECT_EQ(json["settings"]["raysPerPixel"], 65536) << "what stood for the count that was not given";
  EXPECT_GE(json["samples"]["least"], 2);
  EXPECT_EQ(last["raysPerPixel"], json["samples"]["mean"]);
  EXPECT_EQ(json["samples"]["least"], json["samples"]["most"]);
  EXPECT_LE(last["estimate"], 0.05);
}

TEST(Stats, ATargetIsAbsoluteOrAShareOfTheMean) {
  const auto share = statsOf({"--target-error", "0.01", "--target-error", "50%"});
  EXPECT_EQ(share["settings"]["targetError"], 0);
  EXPECT_EQ(share["settings"]["targetErrorRelative"], 0.5);
  const auto& last = share["error"].back();
  EXPECT_LE(last["estimate"].get<double>(), 0.5 * last["mean"].get<double>());
  const auto absolute = statsOf({"--target-error", "50%", "--target-error", "0.25"});
  EXPECT_EQ(absolute["settings"]["targetError"], 0.25);
  EXPECT_EQ(absolute["settings"]["targetErrorRelative"], 0);
}

TEST(Stats, TargetErrorStopsOnceTheEstimateIsBelow) {
  const auto loose = statsOf({"--rays-per-pixel", "4096", "--target-error", "0.02"});
  EXPECT_EQ(loose["settings"]["raysPerPixel"], 4096);
  EXPECT_LT(loose["samples"]["most"], 4096);
  EXPECT_LE(loose["error"].back()["estimate"], 0.02);
  for (std::size_t i = 0; i + 1 < loose["error"].size(); ++i)
    EXPECT_GT(loose["error"][i]["estimate"], 0.02) << "it should have stopped at point " << i;
}

TEST(Reference, TrueErrorFallsAndIsZeroAgainstThePictureItself) {
  const Folder folder;
  ASSERT_EQ(runWhittle(smallRender({"--rays-per-pixel", "8", "-o", "ref.exr"}), {folder.path(), {}}).status,
            0);
  const Outcome run = runWhittle(
      smallRender({"--rays-per-pixel", "8", "--reference", "ref.exr", "--stats", "s.json", "-o", "a.exr"}),
      {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json error = readJson(folder / "s.json")["error"];
  ASSERT_EQ(error.size(), 4U);  // after 1, 2, 4 and 8 rays
  EXPECT_TRUE(error[0]["estimate"].is_null()) << "one ray per pixel has no variance";
  EXPECT_GT(error[0]["rmse"], error[2]["rmse"]);
  // The same samples in the same order: passes do not change the picture's bits.
  EXPECT_EQ(error[3]["rmse"], 0.0);
  EXPECT_EQ(readText(folder / "a.exr").size(), readText(folder / "ref.exr").size());
}

TEST(Reference, AgreesWithCompare) {
  const Folder folder;
  ASSERT_EQ(
      runWhittle(smallRender({"--rays-per-pixel", "4", "--seed", "9", "-o", "ref.exr"}), {folder.path(), {}})
          .status,
      0);
  ASSERT_EQ(runWhittle(smallRender({"--rays-per-pixel", "2", "--reference", "ref.exr", "--stats", "s.json",
                                    "-o", "a.exr"}),
                       {folder.path(), {}})
                .status,
            0);
  const Outcome compared = runWhittle({"compare", "a.exr", "ref.exr", "--json"}, {folder.path(), {}});
  ASSERT_EQ(compared.status, 0) << compared.err;
  const double rmse = readJson(folder / "s.json")["error"].back()["rmse"];
  // Sums of 2304 squares in another order: far fewer than 1e4 roundings of 1e-16 each.
  EXPECT_NEAR(rmse, Json::parse(compared.out)["rmse"].get<double>(), 1e-12);
}

TEST(Reference, OfAnotherSizeIsRefused) {
  const Folder folder;
  ASSERT_EQ(runWhittle(smallRender({"-o", "ref.exr"}), {folder.path(), {}}).status, 0);
  const Outcome run = runWhittle(smallRender({"--width", "16", "--reference", "ref.exr", "-o", "a.exr"}),
                                 {folder.path(), {}});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--reference: ref.exr is 32×24 but the picture is 16×24"), std::string::npos)
      << run.err;
}

TEST(Trace, HasOneEventForEachLaunchWithBounceAndItems) {
  const Folder folder;
  ASSERT_EQ(runWhittle(smallRender({"--trace", "t.json", "--stats", "s.json"}), {folder.path(), {}}).status,
            0);
  const Json trace = readJson(folder / "t.json"), stats = readJson(folder / "s.json");
  std::map<std::string, std::uint64_t> launches, items;
  std::map<std::pair<std::string, int>, std::uint64_t> itemsOfBounce;
  std::set<std::string> phases;
  double end = 0.0, hostEnd = 0.0;
  for (const auto& e : trace["traceEvents"]) {
    if (e["ph"] != "X") continue;
    EXPECT_GE(e["ts"].get<double>(), 0.0) << e;
    EXPECT_GE(e["dur"].get<double>(), 0.0) << e;
    if (e["cat"] == "phase") {
      phases.insert(e["name"]);
      if (e["name"] == "render") hostEnd = e["ts"].get<double>() + e["dur"].get<double>();
      continue;
    }
    end = std::max(end, e["ts"].get<double>() + e["dur"].get<double>());
    ++launches[e["name"]];
    items[e["name"]] += e["args"]["items"].get<std::uint64_t>();
    const int bounce = e["args"]["bounce"];
    EXPECT_EQ(bounce == 0, e["name"] == "raygen" || e["name"] == "film") << e;
    EXPECT_LE(bounce, 8) << e;
    itemsOfBounce[{e["name"], bounce}] += e["args"]["items"].get<std::uint64_t>();
    EXPECT_EQ(e["args"]["batch"], 0) << e;
    EXPECT_FALSE(e["args"]["queue"].get<std::string>().empty()) << e;
    EXPECT_GE(e["args"]["waited us"].get<double>(), 0.0) << e;
  }
  for (const auto& b : stats["bounces"])
    for (const auto& stage : b["stages"])
      EXPECT_EQ((itemsOfBounce[{stage["name"], b["bounce"]}]), stage["items"]) << stage["name"];
  for (const auto& stage : stats["stages"]) {
    EXPECT_EQ(launches[stage["name"]], stage["launches"]) << stage["name"];
    EXPECT_EQ(items[stage["name"]], stage["items"]) << stage["name"];
  }
  for (const char* phase : {"load", "build tree", "compile kernels", "upload", "render"})
    EXPECT_TRUE(phases.contains(phase)) << phase;
  // One clock for both: the last kernel ends before the host has waited for it (0.2 ms for the clocks' tie,
  // which is late by as long as the shortest enqueueing takes).
  EXPECT_LE(end, hostEnd + 200.0);
}

}  // namespace
}  // namespace whittle::test
