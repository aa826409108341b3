// Trace Event Format: "X" is a complete event, "M" names a row; times are microseconds. Written as text at
// once: a frame may have thousands of launches, and a tree of JSON values takes ten times as long as the
// text. Names are kernels' and our own phases', which JSON needs not escape.
#include "report/trace.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

namespace whittle {
namespace {

constexpr int kProcess = 1;

using Text = fmt::memory_buffer;

void nameRow(Text& out, int row, const char* event, const char* name) {
  fmt::format_to(std::back_inserter(out),
                 R"({{"ph":"M","name":"{}","pid":{},"tid":{},"args":{{"name":"{}"}}}},)"
                 "\n",
                 event, kProcess, row, name);
}

/// Microseconds to three digits, as device clocks tell no more than nanoseconds. (As integers, which are
/// written faster than doubles.)
struct Microseconds {
  std::uint64_t whole, thousandths;

  explicit Microseconds(double seconds) {
    const auto nanoseconds = static_cast<std::uint64_t>(std::llround(std::max(0.0, seconds) * 1e9));
    whole = nanoseconds / 1000, thousandths = nanoseconds % 1000;
  }
};

/// All but the closing brace.
void openEvent(Text& out, std::string_view name, const char* category, int row, double start, double end) {
  const Microseconds from(start), length(end - start);
  fmt::format_to(std::back_inserter(out),
                 FMT_COMPILE(R"({{"ph":"X","name":"{}","cat":"{}","pid":{},"tid":{},)"
                             R"("ts":{}.{:03},"dur":{}.{:03})"),
                 name, category, kProcess, row, from.whole, from.thousandths, length.whole,
                 length.thousandths);
}

void launchArguments(Text& out, const Trace::Launch& l, double seconds) {
  const Microseconds waited(seconds);
  fmt::format_to(std::back_inserter(out),
                 FMT_COMPILE(R"(,"args":{{"batch":{},"bounce":{},"queue":"{}",)"
                             R"("items":{},"bytes":{},"waited us":{}.{:03}}})"),
                 l.batch, l.bounce, l.queue, l.items, l.bytes, waited.whole, waited.thousandths);
}

}  // namespace

double steadySeconds(Trace::Clock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

void Trace::phase(const std::string& name, Clock::time_point start, Track track) {
  const auto now = Clock::now();
  const std::lock_guard lock(phasesMutex_);
  phases_.push_back({name, static_cast<int>(track), steadySeconds(start), steadySeconds(now)});
}

void Trace::work(const std::string& name, Clock::time_point start) {
  const auto now = Clock::now();
  const std::thread::id self = std::this_thread::get_id();
  const std::lock_guard lock(phasesMutex_);
  int row = static_cast<int>(Track::Host);
  if (self != maker_) {
    const auto known = std::find(helpers_.begin(), helpers_.end(), self);
    row = static_cast<int>(Track::Helpers) + static_cast<int>(known - helpers_.begin());
    if (known == helpers_.end()) helpers_.push_back(self);
  }
  phases_.push_back({name, row, steadySeconds(start), steadySeconds(now)});
}

double Trace::firstSecond() const {
  double first = std::numeric_limits<double>::infinity();
  for (const auto& p : phases_) first = std::min(first, p.start);
  for (const auto& l : launches_) first = std::min(first, l.start + hostMinusDevice_);
  return first;
}

std::string Trace::toText() const {
  const double origin = firstSecond();
  Text out;
  const auto append = [&](std::string_view text) { out.append(text.data(), text.data() + text.size()); };
  append("{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n");
  nameRow(out, 0, "process_name", "whittle");
  nameRow(out, static_cast<int>(Track::Host), "thread_name", "host");
  nameRow(out, static_cast<int>(Track::Compiler), "thread_name", "kernel compiler");
  nameRow(out, static_cast<int>(Track::Device), "thread_name",
          areLaunchesHosts_ ? "device, by the host's clock" : "device");
  for (std::size_t i = 0; i < helpers_.size(); ++i)
    nameRow(out, static_cast<int>(Track::Helpers) + static_cast<int>(i), "thread_name",
            fmt::format("host, thread {}", i + 2).c_str());
  for (const auto& p : phases_) {
    openEvent(out, p.name, "phase", p.row, p.start - origin, p.end - origin);
    append("},\n");
  }
  for (const auto& l : launches_) {
    const double start = l.start + hostMinusDevice_, end = l.end + hostMinusDevice_;
    openEvent(out, l.stage, "kernel", static_cast<int>(Track::Device), start - origin, end - origin);
    launchArguments(out, l, start - l.enqueued);
    append("},\n");
  }
  out.resize(out.size() - 2);  // JSON wants no comma after the last
  append("\n]}\n");
  return fmt::to_string(out);
}

}  // namespace whittle
