// whittle bench: rays per second by kind of ray and kernel, beside Embree's.
#include "bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/embree_baseline.h"
#include "cl/device.h"
#include "cl/kernel_cache.h"
#include "cli/build_failure.h"
#include "cli/commands.h"
#include "cli/option_kinds.h"
#include "cli/options.h"
#include "cli/progress_bar.h"
#include "cli/speech.h"
#include "report/text.h"

namespace whittle::cli {
namespace {

struct BenchCommand {
  SceneOptions scene;
  BenchOptions bench;
  std::filesystem::path kernelFolder;
  bool json = false;
};

void printJson(const BenchCommand& o, const BenchResult& r) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const BenchRow& row : r.rows) {
    nlohmann::ordered_json j{{"rays", row.rays},
                             {"query", row.query},
                             {"count", row.count},
                             {"kernel", row.kernel},
                             {"mraysPerSecond", row.mraysPerSecond}};
    if (haveEmbree()) {
      j["embreeMode"] = row.embreeMode;
      j["embreeMraysPerSecond"] = row.embreeMraysPerSecond;
      j["ratio"] = row.ratio;
      j["disagree"] = row.disagree;
    }
    rows.push_back(std::move(j));
  }
  nlohmann::ordered_json build{{"seconds", r.buildSeconds}, {"bytesPerTriangle", r.bytesPerTriangle}};
  if (haveEmbree()) build["embreeSeconds"] = r.embreeSeconds;
  nlohmann::ordered_json kernels = nlohmann::ordered_json::array();
  for (const KernelMemory& k : r.kernels)
    kernels.push_back({{"kernel", k.kernel},
                       {"bytesPerTriangle", k.nodes + k.triangles},
                       {"nodeBytesPerTriangle", k.nodes},
                       {"triangleBytesPerTriangle", k.triangles}});
  const nlohmann::ordered_json json{{"scene", o.scene.file.string()},
                                    {"triangles", r.triangles},
                                    {"threads", r.threads},
                                    {"device", r.device},
                                    {"launchSeconds", r.launchSeconds},
                                    {"build", build},
                                    {"kernels", kernels},
                                    {"rows", rows}};
  tellJson(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void printTable(const BenchResult& r) {
  tell(fmt::format("{}, {}, {}\n", formatSome(r.triangles, "triangle", "triangles"),
                   formatSome(static_cast<std::uint64_t>(r.threads), "thread", "threads"), r.device));
  tell(fmt::format("tree: {:.3f} s, {:.0f} bytes for each triangle", r.buildSeconds, r.bytesPerTriangle));
  if (haveEmbree()) tell(fmt::format("; Embree: {:.3f} s", r.embreeSeconds));
  tell("\nread by");
  for (const KernelMemory& k : r.kernels)
    tell(fmt::format("{} {}: {:.0f} + {:.0f}", &k == &r.kernels.front() ? "" : ",", k.kernel, k.nodes,
                     k.triangles));
  tell(fmt::format(" bytes of nodes + triangles for each triangle\n\n{:<11} {:<8} {:<9} {:>10} {:>9}", "rays",
                   "query", "kernel", "count", "Mrays/s"));
  if (haveEmbree())
    tell(fmt::format(" {:>9} {:<19} {:>6} {:>9}", "Embree's", "best mode", "ratio", "disagree"));
  tell("\n");
  for (const BenchRow& row : r.rows) {
    tell(fmt::format("{:<11} {:<8} {:<9} {:>10} {:>9.2f}", row.rays, row.query, row.kernel,
                     formatInteger(row.count), row.mraysPerSecond));
    if (haveEmbree())
      tell(fmt::format(" {:>9.2f} {:<19} {:>6.2f} {:>9}", row.embreeMraysPerSecond, row.embreeMode, row.ratio,
                       formatInteger(row.disagree)));
    tell("\n");
  }
  if (!haveEmbree()) tell("\nThis build has no Embree to compare with.\n");
}

/// Says where rates are of launches rather than of rays.
void noteShortRows(const BenchResult& r) {
  constexpr double kNoticeable = 0.2;  // of a row's time
  const auto isShort = [&](const BenchRow& row) {
    return r.launchSeconds > kNoticeable * static_cast<double>(row.count) / (row.mraysPerSecond * 1e6);
  };
  const auto count = static_cast<std::size_t>(std::count_if(r.rows.begin(), r.rows.end(), isShort));
  if (count > 0)
    note(
        fmt::format("{} of {} rows have so few rays that launching a kernel ({:.0f} µs) takes a fifth "
                    "of their time or more; --rays asks for more",
                    count, r.rows.size(), r.launchSeconds * 1e6));
}

void runBenchCommand(BenchCommand& o) {
  Notices notices;
  warnIfAny(settleKernelCache());
  if (!o.kernelFolder.empty()) o.bench.kernelFolder = o.kernelFolder;
  Settings settings;
  MemoryBudget budget = budgetOf(o.scene);
  const Scene scene = loadScene(o.scene, {}, settings, budget, notices);
  BenchResult result;
  {
    ProgressBar bar(o.scene.quiet);
    o.bench.phase = [&](const std::string& text) { bar.phase(text); };
    try {
      result = runBench(scene, o.bench);
    } catch (const BuildError& e) {
      explainBuildFailure(e, o.kernelFolder);
    }
  }
  if (o.json)
    printJson(o, result);
  else
    printTable(result);
  if (!o.scene.quiet) noteShortRows(result);
}

}  // namespace

void addBench(CLI::App& app, int& status) {
  auto o = std::make_shared<BenchCommand>();
  CLI::App* c = app.add_subcommand("bench", "rays per second of the searches, beside Embree's");
  addSceneOptions(*c, o->scene);
  c->option_defaults()->group("Output");
  c->add_flag("--json", o->json, "as JSON");
  c->add_flag("--quiet", o->scene.quiet, "no progress and no notes");
  c->option_defaults()->group("Measurement");
  addWhole(*c, "--rays", o->bench.rays, 1, 1 << 26, "N", "of each kind, about");
  addWhole(*c, "--runs", o->bench.runs, 1, 1000, "N", "of each contender, in turn; the median counts");
  c->add_flag("--all-kernels", o->bench.allKernels, "every kernel, not only the one the renderer would use");
  c->add_flag("--robust-only", o->bench.robustOnly, "only Embree's robust modes compete");
  c->option_defaults()->group("Device");
  addText(*c, "--device", [o](const std::string& v) { o->bench.device = v; },
          {"SELECTOR", "index from `whittle devices`, part of a name, or cpu|gpu",
           "the first CPU, else the first"});
  addWhole(*c, "--threads", o->bench.threads, 0, 4096, "N",
           "threads of a CPU device, of the tree builder and of Embree", "0: all");
  addFile(*c, "--kernels", o->kernelFolder, "FOLDER",
          "read kernels from here, not from the program (for developers)");
  c->footer("Example: whittle bench scene.glb --all-kernels");
  c->callback([o, &status] {
    runBenchCommand(*o);
    status = 0;
  });
}

}  // namespace whittle::cli
