// Trace Event Format: "X" is a complete event, "M" names a row; times are microseconds.
#include "render/trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whittle {
namespace {

constexpr int kProcess = 1;

nlohmann::ordered_json trackName(Trace::Track track, const char* name) {
  return {{"ph", "M"},
          {"name", "thread_name"},
          {"pid", kProcess},
          {"tid", static_cast<int>(track)},
          {"args", {{"name", name}}}};
}

/// The queue that a stage serves: whose entries are its items.
const char* queueOf(const std::string& stage) {
  if (stage == "raygen" || stage == "intersect" || stage == "find_long_runs") return "rays";
  if (stage == "compact_shadow" || stage == "occlude" || stage == "shade_light") return "shadow rays";
  if (stage == "compact_impulse") return "impulses";
  if (stage == "film") return "samples";
  return "hits";
}

/// To the nanosecond: device clocks tell no more.
double microseconds(double seconds) { return std::round(seconds * 1e9) * 1e-3; }

nlohmann::ordered_json completeEvent(const std::string& name, const char* category, Trace::Track track,
                                     double start, double end) {
  return {{"ph", "X"},
          {"name", name},
          {"cat", category},
          {"pid", kProcess},
          {"tid", static_cast<int>(track)},
          {"ts", microseconds(start)},
          {"dur", microseconds(end - start)}};
}

}  // namespace

double steadySeconds(Trace::Clock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

void Trace::phase(const std::string& name, Clock::time_point start, Track track) {
  const auto now = Clock::now();
  const std::lock_guard lock(phasesMutex_);
  phases_.push_back({name, track, steadySeconds(start), steadySeconds(now)});
}

nlohmann::ordered_json Trace::toJson() const {
  double origin = std::numeric_limits<double>::infinity();
  for (const auto& p : phases_) origin = std::min(origin, p.start);
  for (const auto& l : launches_) origin = std::min(origin, l.start);
  nlohmann::ordered_json events = nlohmann::ordered_json::array();
  events.push_back(
      {{"ph", "M"}, {"name", "process_name"}, {"pid", kProcess}, {"args", {{"name", "whittle"}}}});
  events.push_back(trackName(Track::Host, "host"));
  events.push_back(trackName(Track::Compiler, "kernel compiler"));
  events.push_back(trackName(Track::Device, "device"));
  for (const auto& p : phases_)
    events.push_back(completeEvent(p.name, "phase", p.track, p.start - origin, p.end - origin));
  for (const auto& l : launches_) {
    events.push_back(completeEvent(l.stage, "kernel", Track::Device, l.start - origin, l.end - origin));
    events.back()["args"] = {
        {"batch", l.batch},          {"bounce", l.bounce},
        {"queue", queueOf(l.stage)}, {"items", l.items},
        {"bytes", l.bytes},          {"waited us", microseconds(std::max(0.0, l.start - l.enqueued))}};
  }
  return {{"displayTimeUnit", "ms"}, {"traceEvents", std::move(events)}};
}

}  // namespace whittle
