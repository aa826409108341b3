// See sweep_output.h.
#include "scale/sweep_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/text.h"

namespace whittle {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kWidth = 80;
constexpr std::size_t kIndent = 2;  // of lines after the first

/// "±0.4 %", or how many values are too few to say.
std::string spreadText(const Interval& interval, std::size_t count) {
  if (!interval.isKnown) return fmt::format("of {}", count);
  return fmt::format("±{:.1f} %", 100.0 * interval.relativeHalfWidth());
}

std::string rangeText(const Interval& interval) {
  if (!interval.isKnown || interval.low == interval.high) return fmt::format("{:.2f}", interval.middle);
  return fmt::format("{:.2f} ({:.2f}–{:.2f})", interval.middle, interval.low, interval.high);
}

/// Threads of a point in processors of the machine's own ceiling; 0: not measured.
double worthOf(const Sweep& sweep, const SweptPoint& point) {
  for (const Ceilings& c : sweep.ceilings)
    if (c.threads == point.point.settings.threads) return c.multiplyAdd / sweep.ceilings.front().multiplyAdd;
  return 0.0;
}

/// How well a point uses its threads.
struct Use {
  double efficiency = 0.0;  ///< speed-up for each thread more; 0: threads do not vary
  double ofMachine = 0.0;   ///< speed-up as a share of what the machine's arithmetic gains; 0: not known
};

/// Against the first point that differs in its threads alone.
Use useOf(const Sweep& sweep, const SweptPoint& point) {
  const int threads = point.point.settings.threads;
  if (sweep.ceilings.empty() || threads < 1) return {};
  const auto alike = [&](const SweptPoint& other) {
    Settings settings = other.point.settings;
    settings.threads = threads;
    return !other.frames.empty() && settingsToJson(settings) == settingsToJson(point.point.settings);
  };
  const SweptPoint& first = *std::find_if(sweep.points.begin(), sweep.points.end(), alike);
  if (first.point.settings.threads < 1) return {};
  const double speedUp = ratioOf(first.frames, point.frames).middle;
  Use use{speedUp * first.point.settings.threads / threads, 0.0};
  const double before = worthOf(sweep, first), worth = worthOf(sweep, point);
  if (before > 0.0 && worth > 0.0) use.ofMachine = speedUp * before / worth;
  return use;
}

std::vector<std::size_t> columnWidths(const Sweep& sweep, const std::vector<Axis>& axes) {
  std::vector<std::size_t> widths;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    widths.push_back(columnsOf(axes[a].name));
    for (const SweptPoint& p : sweep.points) widths[a] = std::max(widths[a], columnsOf(p.point.words[a]));
  }
  return widths;
}

std::string percentOrNothing(double share) {
  return share > 0.0 ? fmt::format("{:.0f} %", 100.0 * share) : "";
}

std::string frameTable(const Sweep& sweep, const std::vector<Axis>& axes) {
  const bool hasThreads = !sweep.ceilings.empty();
  const auto widths = columnWidths(sweep, axes);
  std::string out;
  for (std::size_t a = 0; a < axes.size(); ++a) out += padded(axes[a].name, widths[a] + 2);
  out += fmt::format("{:>10} {:>8}  {:<17}", "frame, ms", "", "speed-up");
  if (hasThreads) out += fmt::format(" {:>10} {:>10}", "efficiency", "of machine");
  out += "\n";
  const auto& first = sweep.points.front();
  for (const SweptPoint& p : sweep.points) {
    for (std::size_t a = 0; a < axes.size(); ++a) out += padded(p.point.words[a], widths[a] + 2);
    if (p.frames.empty()) {
      out += p.refused.empty() ? "not measured\n" : fmt::format("{}\n", p.refused);
      continue;
    }
    const Comparison c = compare(first.frames, p.frames);
    const auto samples = counted(p.frames);
    const bool isBusy =
        std::any_of(samples.begin(), samples.end(), [](const Sample& s) { return !s.isQuiet; });
    out += fmt::format(
        "{:>10.2f} {}{}  {}", c.seconds.middle * 1e3,
        std::string(8 - std::min<std::size_t>(8, columnsOf(spreadText(c.seconds, samples.size()))), ' '),
        spreadText(c.seconds, samples.size()), padded(rangeText(c.speedUp), 17));
    if (hasThreads) {
      const Use use = useOf(sweep, p);
      out += fmt::format(" {:>10} {:>10}", percentOrNothing(use.efficiency), percentOrNothing(use.ofMachine));
    }
    while (!out.empty() && out.back() == ' ') out.pop_back();
    out += isBusy ? " *\n" : "\n";
  }
  return out;
}

/// Milliseconds of each stage: of all points where the columns fit, else of the first and the best.
std::string stageTable(const Sweep& sweep, const std::vector<Axis>& axes, const Best& best) {
  constexpr std::size_t kName = 18, kColumn = 11;
  if (sweep.stages.empty()) return "This driver gives no times of stages.\n";
  std::vector<std::size_t> shown;
  for (std::size_t p = 0; p < sweep.points.size(); ++p)
    if (!sweep.points[p].frames.empty()) shown.push_back(p);
  const bool isShort = axes.size() == 1 && kName + kColumn * shown.size() <= kWidth;
  if (!isShort)
    shown = best.point == 0 ? std::vector<std::size_t>{0} : std::vector<std::size_t>{0, best.point};
  std::string out = padded(isShort ? axes.front().name : "stage, ms", kName);
  for (const std::size_t p : shown) {
    const std::string title = isShort ? sweep.points[p].point.words.front() : p == 0 ? "first" : "fastest";
    out += std::string(kColumn - std::min(kColumn, columnsOf(title)), ' ') + title;
  }
  out += "\n";
  for (const std::string& stage : sweep.stages) {
    out += padded(stage, kName);
    for (const std::size_t p : shown) {
      const auto at = sweep.points[p].stages.find(stage);
      out += at == sweep.points[p].stages.end()
                 ? fmt::format("{:>{}}", "", kColumn)
                 : fmt::format("{:>{}.2f}", intervalOf(at->second).middle * 1e3, kColumn);
    }
    while (out.back() == ' ') out.pop_back();
    out += "\n";
  }
  return out;
}

std::string estimateText(const Estimate& e, const char* name) {
  if (e.mayBeZero()) return fmt::format("{} below {:.2g}, not told from 0", name, e.value + e.half);
  return fmt::format("{} {:.3g} ± {:.2g}", name, e.value, e.half);
}

struct Laws {
  ScalingFit amdahl, universal;
};

Laws lawsOf(const Sweep& sweep) {
  const auto points = scalingPoints(sweep);
  // Amdahl's law says nothing of threads that take turns on a processor.
  std::vector<ScalingPoint> few = points;
  std::erase_if(few, [&](const ScalingPoint& p) { return p.threads > sweep.processors; });
  if (points.empty()) {
    const ScalingFit none{{}, "no point was measured"};
    return {none, none};
  }
  return {few.empty() ? ScalingFit{{}, "no point has as few threads as processors"} : fitAmdahl(few),
          fitUniversal(points)};
}

std::string lawLines(const Sweep& sweep) {
  if (sweep.ceilings.empty()) return "";
  const auto [amdahl, universal] = lawsOf(sweep);
  std::string out = "\nAmdahl's law: ";
  out += amdahl.law ? estimateText(amdahl.law->serial, "serial share") +
                          fmt::format("; off by {:.1f} %\n", 100.0 * amdahl.law->residual)
                    : fmt::format("cannot tell: {}\n", amdahl.whyNot);
  out += "universal law: ";
  out +=
      universal.law
          ? fmt::format("{}, {}; off by {:.1f} %\n", estimateText(universal.law->serial, "waiting"),
                        estimateText(universal.law->crosstalk, "crosstalk"), 100.0 * universal.law->residual)
          : fmt::format("cannot tell: {}\n", universal.whyNot);
  return out;
}

std::string bestLines(const Sweep& sweep, const std::vector<Axis>& axes, const Best& best) {
  const SweptPoint& point = sweep.points[best.point];
  const Interval seconds = intervalOf(point.frames);
  std::string out = fmt::format("fastest: {}: {:.2f} ms", pointText(point, axes), seconds.middle * 1e3);
  if (seconds.isKnown) out += fmt::format(" ({:.2f}–{:.2f})", seconds.low * 1e3, seconds.high * 1e3);
  out += "\n";
  if (best.asGood.empty()) return out;
  std::string others;
  constexpr std::size_t kNamed = 3;
  for (std::size_t i = 0; i < std::min(kNamed, best.asGood.size()); ++i)
    others += (i > 0 ? "; " : "") + pointText(sweep.points[best.asGood[i]], axes);
  if (best.asGood.size() > kNamed) others += fmt::format("; and {} more", best.asGood.size() - kNamed);
  return out + wrapped("not told apart from it: " + others, kWidth - kIndent, kIndent) + "\n";
}

std::string fileName(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

std::size_t countFrames(const Sweep& sweep, bool quietAlone) {
  std::size_t count = 0;
  for (const SweptPoint& p : sweep.points)
    count += static_cast<std::size_t>(std::count_if(
        p.frames.begin(), p.frames.end(), [&](const Sample& s) { return s.isQuiet || !quietAlone; }));
  return count;
}

Json toJson(const Interval& i) {
  return {{"median", i.middle},
          {"low", i.isKnown ? Json(i.low) : Json(nullptr)},
          {"high", i.isKnown ? Json(i.high) : Json(nullptr)}};
}

Json toJson(const Estimate& e) {
  return {{"value", e.value}, {"half", e.half}, {"mayBeZero", e.mayBeZero()}};
}

Json toJson(const ScalingFit& fit, bool hasCrosstalk) {
  if (!fit.law) return {{"cannotTell", fit.whyNot}};
  Json json{{"framesPerSecond", toJson(fit.law->rate)}, {"serial", toJson(fit.law->serial)}};
  if (hasCrosstalk) json["crosstalk"] = toJson(fit.law->crosstalk);
  json["residual"] = fit.law->residual;
  return json;
}

Json orNull(double value) { return value > 0.0 ? Json(value) : Json(nullptr); }

Json pointToJson(const Sweep& sweep, const SweptPoint& p, const std::vector<Axis>& axes) {
  Json values = Json::object();
  for (std::size_t a = 0; a < axes.size(); ++a) values[axes[a].name] = p.point.words[a];
  Json json{{"values", values}};
  if (p.frames.empty()) {
    json["refused"] = p.refused.empty() ? Json(nullptr) : Json(p.refused);
    return json;
  }
  const Comparison c = compare(sweep.points.front().frames, p.frames);
  json["frames"] = p.frames.size();
  json["quietFrames"] =
      std::count_if(p.frames.begin(), p.frames.end(), [](const Sample& s) { return s.isQuiet; });
  json["seconds"] = toJson(c.seconds);
  json["speedUp"] = toJson(c.speedUp);
  const Use use = useOf(sweep, p);
  json["efficiency"] = orNull(use.efficiency);
  json["ofMachine"] = orNull(use.ofMachine);
  json["raysPerSecond"] = static_cast<double>(p.rays) / c.seconds.middle;
  json["picture"] = fmt::format("{:016x}", p.picture);
  json["stages"] = Json::array();
  for (const std::string& stage : sweep.stages) {
    const auto at = p.stages.find(stage);
    if (at == p.stages.end()) continue;
    const auto first = sweep.points.front().stages.find(stage);
    Json row{{"name", stage}, {"seconds", toJson(intervalOf(at->second))}};
    if (first != sweep.points.front().stages.end() && intervalOf(at->second).middle > 0.0)
      row["speedUp"] = toJson(ratioOf(first->second, at->second));
    json["stages"].push_back(row);
  }
  json["settings"] = settingsToJson(p.used);
  return json;
}

}  // namespace

std::string pointText(const SweptPoint& point, const std::vector<Axis>& axes) {
  std::string text;
  for (std::size_t a = 0; a < axes.size(); ++a)
    text += fmt::format("{}{} {}", a > 0 ? ", " : "", axes[a].name, point.point.words[a]);
  return text.empty() ? "the settings as given" : text;
}

std::string sweepText(const Sweep& sweep, const std::vector<Axis>& axes, const Scene& scene) {
  const std::size_t frames = countFrames(sweep, false), quiet = countFrames(sweep, true);
  if (frames == 0) return "no frame was measured\n";
  const Best best = bestOf(sweep);
  const Settings& first = sweep.points.front().point.settings;
  std::string out = wrapped(
      fmt::format("{}, {}, {}, {} for each pixel; {} with {}: {} of {} in {}{}", fileName(scene.file),
                  formatSome(scene.triangles.size(), "triangle", "triangles"), sizeText(first),
                  formatSome(static_cast<std::uint64_t>(first.raysPerPixel), "ray", "rays"), sweep.device,
                  formatSome(sweep.processors, "processor", "processors"),
                  formatSome(frames, "frame", "frames"), formatSome(sweep.points.size(), "point", "points"),
                  formatSeconds(sweep.seconds), sweep.isWhole ? "" : ", ended by hand"),
      kWidth - kIndent, kIndent);
  out += "\n\n";
  out += frameTable(sweep, axes) + "\n" + stageTable(sweep, axes, best) + lawLines(sweep) + "\n";
  out += bestLines(sweep, axes, best);
  if (quiet < frames)
    out += wrapped(fmt::format(
                       "{} of {} frames ran beside other work ({}); they were measured again as far as the "
                       "time allowed, and count only in rows with a *",
                       frames - quiet, frames, loadText(sweep.load)),
                   kWidth - kIndent, kIndent) +
           "\n";
  return out;
}

Json sweepToJson(const Sweep& sweep, const std::vector<Axis>& axes, const Scene& scene,
                 const RoundsPlan& plan) {
  Json json{{"scene", scene.file},      {"triangles", scene.triangles.size()},
            {"device", sweep.device},   {"processors", sweep.processors},
            {"within", plan.within},    {"timeLimit", plan.seconds},
            {"seconds", sweep.seconds}, {"frameSeconds", sweep.frameSeconds},
            {"isWhole", sweep.isWhole}};
  json["axes"] = Json::array();
  for (const Axis& axis : axes) {
    Json words = Json::array();
    for (const AxisValue& v : axis.values) words.push_back(v.word);
    json["axes"].push_back({{"name", axis.name}, {"values", words}});
  }
  json["machine"] = Json::array();
  for (const Ceilings& c : sweep.ceilings)
    json["machine"].push_back({{"threads", c.threads},
                               {"integerOperationsPerSecond", c.integer},
                               {"flopsPerSecond", c.multiplyAdd},
                               {"triadBytesPerSecond", c.triad}});
  json["load"] = {{"isKnown", sweep.load.isKnown},
                  {"others", sweep.load.others},
                  {"stolen", sweep.load.stolen},
                  {"clock", orNull(sweep.load.clock)}};
  json["points"] = Json::array();
  for (const SweptPoint& p : sweep.points) json["points"].push_back(pointToJson(sweep, p, axes));
  if (!sweep.ceilings.empty()) {
    const auto [amdahl, universal] = lawsOf(sweep);
    json["laws"] = {{"amdahl", toJson(amdahl, false)}, {"universal", toJson(universal, true)}};
  }
  if (countFrames(sweep, false) > 0) {
    const Best best = bestOf(sweep);
    json["fastest"] = {{"point", best.point}, {"notToldApart", best.asGood}};
  }
  json["differing"] = sweep.differing;
  return json;
}

std::string sweepToCsv(const Sweep& sweep, const std::vector<Axis>& axes) {
  std::string out;
  for (const Axis& axis : axes) out += axis.name + ",";
  out += "round,quiet,stage,seconds\n";
  // A device may be called anything, with commas and quotation marks (RFC 4180).
  const auto quoted = [](const std::string& word) {
    if (word.find_first_of(",\"\n") == std::string::npos) return word;
    std::string text = "\"";
    for (const char c : word) text += c == '"' ? "\"\"" : std::string(1, c);
    return text + "\"";
  };
  for (const SweptPoint& p : sweep.points) {
    std::string values;
    for (const std::string& word : p.point.words) values += quoted(word) + ",";
    const auto lines = [&](const std::string& stage, const std::vector<Sample>& samples) {
      for (const Sample& s : samples)
        out += fmt::format("{}{},{},{},{:.9g}\n", values, s.round, s.isQuiet ? 1 : 0, stage, s.value);
    };
    lines("frame", p.frames);
    for (const std::string& stage : sweep.stages)
      if (const auto at = p.stages.find(stage); at != p.stages.end()) lines(stage, at->second);
  }
  return out;
}

}  // namespace whittle
