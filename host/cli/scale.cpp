// whittle scale: how a scene's time changes with threads, work-group, wavefront and whatever else has several
// values.
#include "scale/run_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cl/device.h"
#include "cl/kernel_cache.h"
#include "cli/build_failure.h"
#include "cli/commands.h"
#include "cli/guard.h"
#include "cli/option_kinds.h"
#include "cli/options.h"
#include "cli/output_writer.h"
#include "cli/outputs.h"
#include "cli/progress_bar.h"
#include "cli/speech.h"
#include "render/peak_memory.h"
#include "report/page.h"
#include "scale/sweep_output.h"
#include "scene/machine_memory.h"

namespace whittle::cli {
namespace {

constexpr std::size_t kMostPoints = 4096;

struct ScaleCommand {
  SceneOptions scene;
  Settings settings;
  std::vector<Axis> axes;
  RoundsPlan rounds;
  std::filesystem::path kernelFolder, report;
  std::string command;  ///< as typed
  bool oneAtATime = false, json = false, csv = false;
};

/// The parts of a list with commas; none may be empty.
std::vector<std::string> partsOf(const std::string& option, const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t at = 0;;) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    parts.push_back(text.substr(at, end - at));
    if (parts.back().empty())
      throw InputError(fmt::format("{}: '{}': a value is missing beside a comma", option, text));
    if (end == text.size()) return parts;
    at = end + 1;
  }
}

/// "64", "256k", "1M": k is 1024, M 1024 k.
std::int64_t parseCount(const std::string& option, const std::string& text, std::int64_t low,
                        std::int64_t high) {
  std::int64_t unit = 1;
  std::string digits = text;
  if (!digits.empty() && (digits.back() == 'k' || digits.back() == 'K')) unit = 1 << 10;
  if (!digits.empty() && digits.back() == 'M') unit = 1 << 20;
  if (unit > 1) digits.pop_back();
  // Bounds of what stands before the unit: the product cannot overflow.
  const std::int64_t value = parseWhole(option, digits, std::min<std::int64_t>(low, 0), high / unit) * unit;
  if (value < low) parseWhole(option, text, low, high);
  return value;
}

/// Replaces an option of one value by one that takes several: an axis where there are more than one.
void addAxis(CLI::App& c, std::vector<Axis>& axes, const std::string& name,
             const std::function<std::vector<AxisValue>(const std::string&)>& parse, const OptionHelp& help) {
  if (CLI::Option* single = c.get_option_no_throw(name)) c.remove_option(single);
  addText(
      c, name,
      [&axes, name, parse](const std::string& text) {
        Axis axis{name.substr(2), parse(text)};
        std::erase_if(axes, [&](const Axis& a) { return a.name == axis.name; });  // the last counts
        axes.push_back(std::move(axis));
      },
      help);
}

/// Numbers with commas, "4-8" for all from 4 to 8.
void addNumberAxis(CLI::App& c, std::vector<Axis>& axes, const std::string& name, std::int64_t low,
                   std::int64_t high, int Settings::*member, const OptionHelp& help) {
  const auto parse = [=](const std::string& text) {
    std::vector<AxisValue> values;
    const auto add = [&](std::int64_t value) {
      if (values.size() >= kMostPoints)
        throw InputError(fmt::format("{}: '{}' has more than {} values", name, text, kMostPoints));
      values.push_back({std::to_string(value), [=](Settings& s) { s.*member = static_cast<int>(value); }});
    };
    for (const std::string& part : partsOf(name, text)) {
      const std::size_t dash = part.find('-', 1);
      if (dash == std::string::npos) {
        add(parseCount(name, part, low, high));
        continue;
      }
      const std::int64_t first = parseCount(name, part.substr(0, dash), low, high);
      const std::int64_t last = parseCount(name, part.substr(dash + 1), low, high);
      if (last < first)
        throw InputError(fmt::format("{}: '{}' goes down; write the smaller first", name, part));
      for (std::int64_t value = first; value <= last; ++value) add(value);
    }
    return values;
  };
  addAxis(c, axes, name, parse, help);
}

template <typename T>
void addWordAxis(CLI::App& c, std::vector<Axis>& axes, const std::string& name, T Settings::*member,
                 const std::string& text) {
  std::string words;
  for (const auto& w : wordsOf(T{})) words += (words.empty() ? "" : "|") + std::string(w.word);
  const auto parse = [=](const std::string& list) {
    std::vector<AxisValue> values;
    for (const std::string& part : partsOf(name, list)) {
      const auto& all = wordsOf(T{});
      const auto known =
          std::find_if(std::begin(all), std::end(all), [&](const auto& w) { return part == w.word; });
      if (known == std::end(all))
        throw InputError(fmt::format("{}: '{}' is not one of {}", name, part, words));
      values.push_back({part, [=, value = known->value](Settings& s) { s.*member = value; }});
    }
    return values;
  };
  addAxis(c, axes, name, parse, {words + ",…", text, wordsOf(T{})[0].word});
}

std::vector<AxisValue> parseSizes(const std::string& text) {
  std::vector<AxisValue> values;
  for (const std::string& part : partsOf("--size", text)) {
    const std::size_t cross = part.find('x');
    if (cross == std::string::npos)
      throw InputError(fmt::format("--size: '{}' is not WIDTHxHEIGHT, such as 640x360", part));
    const auto width = static_cast<int>(parseWhole("--size", part.substr(0, cross), 1, 65535));
    const auto height = static_cast<int>(parseWhole("--size", part.substr(cross + 1), 1, 65535));
    values.push_back({part, [=](Settings& s) { s.width = width, s.height = height; }});
  }
  return values;
}

std::vector<AxisValue> parseDevices(const std::string& text) {
  std::vector<AxisValue> values;
  for (const std::string& part : partsOf("--device", text))
    values.push_back({part, [=](Settings& s) { s.device = part; }});
  return values;
}

void addAxes(CLI::App& c, ScaleCommand& o) {
  c.option_defaults()->group("What changes (the values of each are measured in turn)");
  addNumberAxis(c, o.axes, "--threads", 0, 4096, &Settings::threads,
                {"N,N-N,…", "threads of a CPU device; 0: all", "0"});
  addNumberAxis(c, o.axes, "--work-group", 0, 65536, &Settings::workGroup,
                {"N,…", "work items of a group; 0: chosen for the device", "0"});
  addNumberAxis(c, o.axes, "--wavefront", 1, 1 << 28, &Settings::wavefront,
                {"N,…", "rays in flight: 4k is 4096, 1M 1024 k", std::to_string(o.settings.wavefront)});
  addWordAxis(c, o.axes, "--lanes", &Settings::lanes, "rays that one work item searches for");
  addWordAxis(c, o.axes, "--search", &Settings::search, "how the nearest triangle is found");
  addAxis(c, o.axes, "--device", parseDevices,
          {"SELECTOR,…", "as `whittle render` has it; several are different pictures",
           "the first CPU, else the first"});
  addNumberAxis(c, o.axes, "--rays-per-pixel", 1, 1 << 24, &Settings::raysPerPixel,
                {"N,…", "primary rays", std::to_string(o.settings.raysPerPixel)});
  addAxis(c, o.axes, "--size", parseSizes, {"WxH,…", "of the picture", "--width, --height"});
}

double parseWithin(const std::string& text) {
  if (!text.empty() && text.back() == '%')
    return parseReal("--within", text.substr(0, text.size() - 1), 0.1, 100.0) / 100.0;
  return parseReal("--within", text, 0.001, 1.0);
}

/// Axes of one value are settings.
std::vector<SweepPoint> pointsOf(ScaleCommand& o) {
  for (const Axis& axis : o.axes)
    if (axis.values.size() == 1) axis.values.front().set(o.settings);
  std::erase_if(o.axes, [](const Axis& axis) { return axis.values.size() == 1; });
  double count = 1.0;
  for (const Axis& axis : o.axes) count *= static_cast<double>(axis.values.size());
  if (!o.oneAtATime && count > kMostPoints)
    throw InputError(
        fmt::format("{:.0f} combinations; at most {} are measured: --one-at-a-time, or fewer values", count,
                    kMostPoints));
  return sweepPoints(o.settings, o.axes, o.oneAtATime);
}

/// For all points: PoCL is told before it starts.
void prepareThreads(const std::vector<SweepPoint>& points) {
  int threads = 0, workGroup = 0;
  for (const SweepPoint& p : points) {
    threads = std::max(threads, p.settings.threads);
    workGroup = std::max(workGroup, p.settings.workGroup);
  }
  prepareCpuThreads(threads, workGroup);
}

/// For a shell, which would take some characters for its own.
std::string commandText(const std::vector<std::string>& arguments) {
  std::string text = "whittle";
  for (const std::string& word : arguments) {
    const bool isPlain = !word.empty() && word.find_first_not_of(
                                              "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                              "0123456789-_=+,./:%@") == std::string::npos;
    if (isPlain) {
      text += " " + word;
      continue;
    }
    text += " '";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += "'";
  }
  return text;
}

void sayDifferences(const Sweep& sweep, const std::vector<Axis>& axes) {
  for (const auto& [a, b] : sweep.differing)
    complain(
        a == b ? fmt::format("{}: two frames of it are different pictures", pointText(sweep.points[a], axes))
               : fmt::format("{} and {} are different pictures, and should be the same",
                             pointText(sweep.points[a], axes), pointText(sweep.points[b], axes)));
}

/// The page, unless its file cannot be had by now. Returns whether it is there.
bool writeReport(const ScaleCommand& o, nlohmann::ordered_json json) {
  json["command"] = o.command;
  OutputWriter files;
  files.add(o.report, "", [&](const auto& to) {
    writeTextFile(to, pageText(o.scene.file.filename().string() + ": scale", "scale.js", json));
  });
  if (!o.scene.quiet && !o.json && !o.csv) tell("\n" + files.summary());
  return files.isComplete();
}

/// Returns the exit status.
int runScale(ScaleCommand& o) {
  OutputCheck check(o.settings.width, o.settings.height);
  check.reads(o.scene.file);
  check.text("--report", o.report);
  if (isStandardOutput(o.report)) throw InputError("--report: name a file");
  if (o.json && o.csv) throw InputError("--json and --csv: give one of the two");
  std::vector<SweepPoint> points = pointsOf(o);
  warnIfAny(settleKernelCache());
  prepareThreads(points);
  Notices notices;
  MemoryBudget budget = budgetOf(o.scene);
  Settings loaded = o.settings;
  const Scene scene = loadScene(o.scene, {kTriangleBytes, kRuntimeBytes + kCodecBytes, pictureBytes}, loaded,
                                budget, notices);
  // What loading settles for the scene holds for every point; its size only where no axis has sizes.
  o.settings = loaded;
  points = sweepPoints(o.settings, o.axes, o.oneAtATime);
  answerSignals();
  SweepPlan plan;
  plan.rounds = o.rounds;
  plan.measuresCeilings =
      std::any_of(o.axes.begin(), o.axes.end(), [](const Axis& axis) { return axis.name == "threads"; });
  plan.memory = memoryLimitOfMachine().bytes / 2;
  if (o.scene.memory) plan.memory = o.scene.memory->bytes / 2;
  if (!o.kernelFolder.empty()) plan.hooks.kernelFolder = o.kernelFolder;
  plan.hooks.compiler = "/proc/self/exe";
  plan.keepGoing = [] { return !endIsWanted(); };
  Sweep sweep;
  {
    ProgressBar bar(o.scene.quiet);
    plan.hooks.phase = [&](const std::string& text) { bar.phase(text); };
    try {
      sweep = runSweep(scene, std::move(points), plan);
    } catch (const BuildError& e) {
      explainBuildFailure(e, o.kernelFolder);
    }
  }
  const nlohmann::ordered_json json = sweepToJson(sweep, o.axes, scene, plan.rounds);
  if (o.json)
    tellJson(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  else
    tell(o.csv ? sweepToCsv(sweep, o.axes) : sweepText(sweep, o.axes, scene));
  const bool isWritten = o.report.empty() || writeReport(o, json);
  sayDifferences(sweep, o.axes);
  if (sweep.differing.empty() && isWritten) return 0;
  haveExplained();
  return 1;
}

}  // namespace

void addScale(CLI::App& app, int& status, const std::vector<std::string>& arguments) {
  auto o = std::make_shared<ScaleCommand>();
  o->command = commandText(arguments);
  CLI::App* c =
      app.add_subcommand("scale", "how a scene's time changes with threads, work-group, wavefront …");
  addSceneOptions(*c, o->scene);
  addPictureOptions(*c, o->settings, o->scene);
  addDeviceOptions(*c, o->settings);
  addAxes(*c, *o);
  c->option_defaults()->group("Measurement");
  c->add_flag("--one-at-a-time", o->oneAtATime,
              "of several axes vary one and leave the others at their first value [every combination]");
  addText(*c, "--within", [o](const std::string& word) { o->rounds.within = parseWithin(word); },
          {"SHARE|P%", "measure until half of each 95 % interval is at most this", "3%"});
  addReal(*c, "--time-limit", o->rounds.seconds, 0.1, 1e6, "SECONDS",
          "begin nothing after this, but one frame of each", "60");
  c->option_defaults()->group("Output");
  c->add_flag("--json", o->json, "as JSON, on standard output");
  c->add_flag("--csv", o->csv, "every single frame as CSV, on standard output");
  addFile(*c, "--report", o->report, "FILE.html", "curves and tables as a page of one file");
  c->add_flag("--quiet", o->scene.quiet, "no progress and no notes");
  addFile(*c, "--kernels", o->kernelFolder, "FOLDER",
          "read kernels from here, not from the program (for developers)");
  c->footer("Example: whittle scale scene.glb --threads 1,2,4-8 --work-group 8,64");
  c->callback([o, &status] { status = runScale(*o); });
}

}  // namespace whittle::cli
