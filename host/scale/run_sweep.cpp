// See run_sweep.h.
#include "scale/run_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <list>
#include <memory>
#include <set>
#include <span>
#include <thread>

#include "cl/error.h"
#include "render/render_session.h"
#include "scene/hash.h"
#include "scene/input_error.h"

namespace whittle {
namespace {

using Clock = std::chrono::steady_clock;

/// Of the machine.
int processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

double now() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

std::uint64_t bytesOf(const Stats& stats) {
  std::uint64_t sum = 0;
  for (const BufferStats& b : stats.buffers) sum += b.bytes;
  return sum;
}

/// A session for each point, so that nothing is allocated or compiled in a frame that counts; as many as the
/// memory allows.
class Sessions {
 public:
  explicit Sessions(std::uint64_t memory) : memory_(memory) {}

  /// Renders the point; where its session is new, once more before, uncounted.
  RenderResult render(std::size_t point, const Scene& scene, const Settings& settings,
                      const RenderHooks& hooks) {
    auto kept = std::find_if(open_.begin(), open_.end(), [&](const Open& o) { return o.point == point; });
    if (kept != open_.end()) {
      open_.splice(open_.begin(), open_, kept);
    } else {
      makeRoom();
      open_.push_front({point, std::make_unique<RenderSession>(), 0});
      try {
        open_.front().bytes = bytesOf(open_.front().session->render(scene, settings, hooks).stats);
      } catch (...) {
        open_.pop_front();
        throw;
      }
      largest_ = std::max(largest_, open_.front().bytes);
    }
    return open_.front().session->render(scene, settings, hooks);
  }

 private:
  struct Open {
    std::size_t point;
    std::unique_ptr<RenderSession> session;
    std::uint64_t bytes;
  };

  /// For another as large as the largest so far.
  void makeRoom() {
    const auto held = [&] {
      std::uint64_t sum = largest_;
      for (const Open& o : open_) sum += o.bytes;
      return sum;
    };
    while (!open_.empty() && held() > memory_) open_.pop_back();
  }

  std::uint64_t memory_, largest_ = 0;
  std::list<Open> open_;  ///< the last used first
};

/// Of one run of runSweep.
class SweepRun {
 public:
  SweepRun(const Scene& scene, std::vector<SweepPoint> points, const SweepPlan& plan)
      : scene_(scene), plan_(plan), sessions_(plan.memory) {
    for (SweepPoint& p : points) sweep_.points.push_back({std::move(p), "", {}, {}, {}, 0, 0});
  }

  Sweep run() {
    const double start = now();
    sweep_.processors = static_cast<unsigned>(processors());
    if (plan_.measuresCeilings) measureCeilingsOfAll();
    // One after the other before they take turns: compiling is no part of a round.
    for (std::size_t p = 0; p < sweep_.points.size() && keepsGoing(); ++p) {
      say(fmt::format("warming up point {} of {}", p + 1, sweep_.points.size()));
      frame(p);
    }
    watch_.look();
    const double begin = now();
    const auto samples = measureRounds(
        sweep_.points.size(), plan_.rounds,
        {[&](std::size_t p) {
           const double left = std::max(0.0, plan_.rounds.seconds - (now() - begin));
           say(fmt::format("measuring, {:.0f} s left at most", left));
           return sweep_.points[p].refused.empty() ? frame(p) : std::numeric_limits<double>::quiet_NaN();
         },
         now, [&] { return wasQuiet(); }, [&] { return keepsGoing(); }});
    for (std::size_t p = 0; p < samples.size(); ++p) keep(sweep_.points[p], samples[p], stageTimes_[p]);
    sweep_.isWhole = keepsGoing();
    sweep_.seconds = now() - start;
    findDifferences();
    return std::move(sweep_);
  }

 private:
  bool keepsGoing() const { return !plan_.keepGoing || plan_.keepGoing(); }
  void say(const std::string& text) const {
    if (plan_.hooks.phase) plan_.hooks.phase(text);
  }

  bool wasQuiet() {
    const Load load = watch_.look();
    if (load.others + load.stolen > sweep_.load.others + sweep_.load.stolen || !sweep_.load.isKnown)
      sweep_.load = load;
    return load.isQuiet();
  }

  /// Three short looks at each number of threads, in turns; the median of each rate.
  void measureCeilingsOfAll() {
    constexpr int kLooks = 3;
    constexpr double kSeconds = 0.08, kBytes = 128e6;
    std::set<int> counts{1, processors()};
    for (const SweptPoint& p : sweep_.points)
      if (p.point.settings.threads > 0) counts.insert(p.point.settings.threads);
    std::map<int, std::vector<Ceilings>> looks;
    say("what the machine gives");
    for (int i = 0; i < kLooks; ++i)
      for (const int n : counts)
        if (keepsGoing()) looks[n].push_back(measureCeilings(n, kSeconds, kBytes));
    for (const auto& [n, all] : looks) {
      const auto middle = [&all = all](double Ceilings::*rate) {
        std::vector<double> rates;
        rates.reserve(all.size());
        for (const Ceilings& c : all) rates.push_back(c.*rate);
        return medianInterval(rates).middle;
      };
      sweep_.ceilings.push_back(
          {n, middle(&Ceilings::integer), middle(&Ceilings::multiplyAdd), middle(&Ceilings::triad)});
    }
  }

  /// Seconds of a frame of the point, or NaN where it cannot be had.
  double frame(std::size_t p) {
    SweptPoint& point = sweep_.points[p];
    RenderHooks hooks;
    hooks.kernelFolder = plan_.hooks.kernelFolder;
    hooks.compiler = plan_.hooks.compiler;
    hooks.keepGoing = plan_.keepGoing;
    hooks.tier = Tier::Specialised;
    RenderResult result;
    try {
      result = sessions_.render(p, scene_, point.point.settings, hooks);
    } catch (const InputError& e) {
      return refuse(point, e.what(), p);
    } catch (const ClError& e) {
      return refuse(point, e.what(), p);
    }
    if (!keepsGoing()) return result.stats.time.render;  // cut short: nobody reads it
    note(point, result);
    std::map<std::string, double> stages;
    // Where a driver gives no times those of stages are the host's, which are no numbers of the device.
    if (!result.stats.device.givesTimes) result.stats.stages.clear();
    for (const StageStats& s : result.stats.stages) {
      stages[s.facts.name] += s.seconds;
      if (std::find(sweep_.stages.begin(), sweep_.stages.end(), s.facts.name) == sweep_.stages.end())
        sweep_.stages.emplace_back(s.facts.name);
    }
    stageTimes_[p].push_back(std::move(stages));
    return result.stats.time.render;
  }

  double refuse(SweptPoint& point, const std::string& why, std::size_t p) {
    if (p == 0) throw;
    point.refused = why;
    return std::numeric_limits<double>::quiet_NaN();
  }

  void note(SweptPoint& point, const RenderResult& result) {
    const auto& pixels = result.radiance.pixels;
    const std::uint64_t picture = hashOf(std::as_bytes(std::span(pixels)));
    // The same point drawn twice must not differ either.
    if (point.picture != 0 && point.picture != picture) isUnsteady_.insert(&point);
    point.picture = picture;
    point.rays = result.stats.rays.total();
    point.used = result.stats.settings;
    if (sweep_.device.empty()) sweep_.device = result.stats.device.name;
  }

  /// The stages of the frames that were counted: the first of all was a warm-up.
  void keep(SweptPoint& point, const std::vector<Sample>& frames,
            const std::vector<std::map<std::string, double>>& times) {
    point.frames = frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      sweep_.frameSeconds += frames[i].value;
      for (const auto& [stage, seconds] : times[i + 1])
        point.stages[stage].push_back({frames[i].round, seconds, frames[i].isQuiet});
    }
  }

  void findDifferences() {
    for (std::size_t p = 0; p < sweep_.points.size(); ++p) {
      const SweptPoint& point = sweep_.points[p];
      if (isUnsteady_.count(&point) > 0) sweep_.differing.emplace_back(p, p);
      if (!point.refused.empty() || point.frames.empty()) continue;
      for (std::size_t q = 0; q < p; ++q) {
        const SweptPoint& other = sweep_.points[q];
        if (other.frames.empty() || !haveSamePicture(point.point.settings, other.point.settings)) continue;
        if (other.picture != point.picture) sweep_.differing.emplace_back(q, p);
        break;
      }
    }
  }

  const Scene& scene_;
  const SweepPlan& plan_;
  Sessions sessions_;
  Sweep sweep_;
  LoadWatch watch_;
  std::map<std::size_t, std::vector<std::map<std::string, double>>> stageTimes_;
  std::set<const SweptPoint*> isUnsteady_;
};

}  // namespace

Sweep runSweep(const Scene& scene, std::vector<SweepPoint> points, const SweepPlan& plan) {
  return SweepRun(scene, std::move(points), plan).run();
}

Comparison compare(const std::vector<Sample>& first, const std::vector<Sample>& samples) {
  return {intervalOf(samples), ratioOf(first, samples)};
}

Best bestOf(const Sweep& sweep) {
  const auto competes = [&](const SweptPoint& p) {
    return !p.frames.empty() && haveSamePicture(p.point.settings, sweep.points.front().point.settings);
  };
  Best best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < sweep.points.size(); ++p) {
    if (!competes(sweep.points[p])) continue;
    const double seconds = intervalOf(sweep.points[p].frames).middle;
    if (seconds < least) least = seconds, best.point = p;
  }
  for (std::size_t p = 0; p < sweep.points.size(); ++p) {
    if (p == best.point || !competes(sweep.points[p])) continue;
    const Interval ratio = ratioOf(sweep.points[best.point].frames, sweep.points[p].frames);
    // Too few rounds in common: then the two intervals must lie apart.
    const Interval fast = intervalOf(sweep.points[best.point].frames),
                   other = intervalOf(sweep.points[p].frames);
    const bool overlap = !fast.isKnown || !other.isKnown || other.low <= fast.high;
    if (ratio.isKnown ? ratio.contains(1.0) : overlap) best.asGood.push_back(p);
  }
  return best;
}

std::vector<ScalingPoint> scalingPoints(const Sweep& sweep) {
  std::vector<ScalingPoint> points;
  if (sweep.ceilings.empty()) return points;
  const Settings& first = sweep.points.front().point.settings;
  for (const SweptPoint& p : sweep.points) {
    Settings alike = p.point.settings;
    alike.threads = first.threads;
    if (settingsToJson(alike) != settingsToJson(first)) continue;
    const int threads = p.point.settings.threads;
    if (threads < 1) continue;  // all, which another point names
    // More threads than processors take turns: they are worth no more.
    const auto ceiling = std::find_if(sweep.ceilings.begin(), sweep.ceilings.end(), [&](const Ceilings& c) {
      return c.threads == std::min(threads, processors());
    });
    if (ceiling == sweep.ceilings.end()) continue;
    const double worth = ceiling->multiplyAdd / sweep.ceilings.front().multiplyAdd;
    for (const Sample& s : counted(p.frames))
      points.push_back({static_cast<double>(threads), worth, 1.0 / s.value});
  }
  return points;
}

}  // namespace whittle
