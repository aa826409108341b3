// See rounds.h.
#include "measure/rounds.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace whittle {
namespace {

/// Of one run of measureRounds.
class Rounds {
 public:
  Rounds(std::size_t points, const RoundsPlan& plan, const RoundsWork& work)
      : plan_(plan), work_(work), samples_(points), isOut_(points), dice_(plan.seed), start_(work.now()) {}

  std::vector<std::vector<Sample>> run() {
    lastLook_ = start_;
    for (int round = 0; round < plan_.most && !order(round).empty(); ++round)
      if (!runRound(round)) break;
    look();
    return std::move(samples_);
  }

 private:
  /// Whose turn it is, in random order. Empty: all are done.
  std::vector<std::size_t> order(int round) {
    std::vector<std::size_t> points(samples_.size());
    std::iota(points.begin(), points.end(), std::size_t{0});
    const auto isDone = [&](std::size_t p) { return isOut_[p] || (round > 0 && isNarrow(p)); };
    if (std::all_of(points.begin(), points.end(), isDone)) return {};
    std::erase_if(points, [&](std::size_t p) { return p == 0 ? bool(isOut_[p]) : isDone(p); });
    std::shuffle(points.begin(), points.end(), dice_);
    order_ = points;
    return points;
  }

  /// Returns whether another round may follow.
  bool runRound(int round) {
    for (const std::size_t p : order_) {
      if (!work_.keepGoing()) return false;
      if (round > 0 && work_.now() - start_ >= plan_.seconds) return false;
      const double value = work_.measure(p);
      if (!work_.keepGoing()) return false;  // it may have been cut short
      if (std::isnan(value))
        isOut_[p] = true;
      else {
        samples_[p].push_back({round, value, true});
        fresh_.push_back(p);
      }
      if (work_.now() - lastLook_ >= plan_.lookEvery) look();
    }
    return true;
  }

  /// Judges what was measured since the last look.
  void look() {
    const bool wasQuiet = work_.wasQuiet();
    lastLook_ = work_.now();
    // Each point was measured some times; its last samples are those.
    std::vector<std::size_t> times(samples_.size());
    for (const std::size_t p : fresh_) ++times[p];
    for (std::size_t p = 0; p < times.size(); ++p)
      for (auto s = samples_[p].end() - static_cast<std::ptrdiff_t>(times[p]); s != samples_[p].end(); ++s)
        s->isQuiet = wasQuiet;
    fresh_.clear();
  }

  bool isNarrow(std::size_t p) const {
    std::vector<double> quiet;
    for (const Sample& s : samples_[p])
      if (s.isQuiet) quiet.push_back(s.value);
    return static_cast<int>(quiet.size()) >= kLeastForInterval &&
           medianInterval(quiet).relativeHalfWidth() <= plan_.within;
  }

  const RoundsPlan& plan_;
  const RoundsWork& work_;
  std::vector<std::vector<Sample>> samples_;
  std::vector<bool> isOut_;
  std::vector<std::size_t> order_, fresh_;
  std::mt19937 dice_;
  double start_, lastLook_ = 0.0;
};

}  // namespace

std::vector<std::vector<Sample>> measureRounds(std::size_t points, const RoundsPlan& plan,
                                               const RoundsWork& work) {
  return Rounds(points, plan, work).run();
}

std::vector<Sample> counted(const std::vector<Sample>& samples) {
  std::vector<Sample> quiet;
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(quiet),
               [](const Sample& s) { return s.isQuiet; });
  return static_cast<int>(quiet.size()) >= kLeastForInterval ? quiet : samples;
}

Interval intervalOf(const std::vector<Sample>& samples) {
  std::vector<double> values;
  for (const Sample& s : counted(samples)) values.push_back(s.value);
  return medianInterval(values);
}

Interval ratioOf(const std::vector<Sample>& first, const std::vector<Sample>& second) {
  std::vector<double> ratios;
  const std::vector<Sample> a = counted(first), b = counted(second);
  for (const Sample& s : b) {
    const auto same = std::find_if(a.begin(), a.end(), [&](const Sample& f) { return f.round == s.round; });
    if (same != a.end()) ratios.push_back(same->value / s.value);
  }
  if (!ratios.empty()) return medianInterval(ratios);
  const double ratio = intervalOf(first).middle / intervalOf(second).middle;
  return {ratio, ratio, ratio, false};
}

}  // namespace whittle
