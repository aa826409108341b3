// Doubling passes, the last as long as a target is expected to need: each look at the error costs a read of
// the film, so that there are few.
#include "render/sampling_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cl/error.h"
#include "scene/input_error.h"

namespace whittle {
namespace {

/// Of the samples so far, what an adaptive round gives out: small enough that blocks can part ways, large
/// enough that looks are few (growth of a quarter: 12 looks for 16 times the samples).
constexpr double kAdaptiveGrowth = 0.25;
/// Where somebody looks on: what one pass after the first takes at least. Each picture that is shown takes
/// time from the next, and rays of many samples of few pixels keep caches warm that those of few samples of
/// many do not: of Sponza 16 samples at once take a tenth less than 1, 3 and 12.
constexpr double kShownSeconds = 0.7;
constexpr double kGradualGrowth = 3.0;
/// The least that a pass adds on the way to a target, so that looks are few where the estimate keeps rising.
constexpr double kLeastGrowth = 1.0 / 16.0;
/// More than a target is expected to need, so that it is seldom missed by a hair: estimates go on changing.
constexpr double kTargetMargin = 1.02;
/// How long a batch may go on after the limit; what it has done is lost if it takes longer.
constexpr double kLateShare = 0.1, kLateSeconds = 0.25;

/// At least one.
std::uint64_t shareOf(std::uint64_t samples, double share) {
  return std::max<std::uint64_t>(1,
                                 static_cast<std::uint64_t>(std::ceil(static_cast<double>(samples) * share)));
}

std::string nameOf(const DeviceInfo& device) {
  return fmt::format("{}, {} {}", device.name, device.platform, device.version);
}

double endedInAll(const RayTally& tally) {
  const EndedThroughput ended = endedThroughput(tally.ended);
  return ended.cutOff + ended.bounces + ended.straight;
}

}  // namespace

SamplingLoop::SamplingLoop(Compute& compute, Wavefront& wavefront, const Settings& settings,
                           const RenderHooks& hooks, const FilmBuffers& buffers)
    : compute_(compute),
      wavefront_(wavefront),
      settings_(settings),
      hooks_(hooks),
      buffers_(buffers),
      counts_(buffers.pixels) {}

bool SamplingLoop::looks() const {
  return settings_.timeLimit > 0.0 || hasErrorTarget(settings_) || settings_.adaptive || hooks_.reference ||
         hooks_.shown || hooks_.isPreview;
}

void SamplingLoop::run(const std::function<void()>& passDone) {
  start_ = saved_ = Clock::now();
  if (hooks_.resumed) goOnFrom(*hooks_.resumed);
  if (pending_.empty() && !hasMetTarget()) pending_ = nextPasses();
  while (!pending_.empty()) {
    const double began = elapsed();
    const SamplePass& first = pending_.front();
    const std::uint32_t samples = first.samples;
    const bool isUniform = pending_.size() == 1 && first.blocks.size() == counts_.blocks();
    const bool stopped = !tracePending();
    if (isUniform) passSamples_ = samples, passSeconds_ = elapsed() - began;
    if (looks()) look();
    if (stopped || hasMetTarget()) break;
    pending_ = nextPasses();
    if (!pending_.empty()) passDone();
  }
  clTry("waiting for the last kernels", [&] { compute_.queue().finish(); });
  seconds_ = elapsed();
  if (hooks_.checkpoint) save();
  if (error_.empty() && counts_.least() >= 2) look();
}

bool SamplingLoop::hasMetTarget() const { return !error_.empty() && meetsTarget(settings_, error_.back()); }

void SamplingLoop::goOnFrom(const RenderState& state) {
  if (state.counts.size() != counts_.blocks() || state.film.size() * sizeof(float) != buffers_.film.bytes ||
      state.aovs.size() * sizeof(float) != buffers_.aovs.bytes)
    throw InputError("the picture that is to be gone on with has another size or other layers");
  for (std::size_t b = 0; b < state.counts.size(); ++b) counts_.add(b, state.counts[b]);
  pending_ = state.pending;
  if (state.device != nameOf(compute_.device()) && hooks_.note)
    hooks_.note(fmt::format("the picture began on {}: it will have that one's bits in part", state.device));
  compute_.write(buffers_.film, state.film.data());
  if (buffers_.aovs) compute_.write(buffers_.aovs, state.aovs.data());
  wavefront_.countOn(state.tally, state.nonFinite);
  endedShare_ = state.endedShare;
  error_ = state.error;
  before_ = state.seconds;
  samplesBefore_ = static_cast<double>(counts_.total());
  // What the next passes are decided by.
  if (pending_.empty() && looks()) look();
}

RenderState SamplingLoop::state() {
  RenderState state;
  for (std::size_t b = 0; b < counts_.blocks(); ++b) state.counts.push_back(counts_.ofBlock(b));
  state.pending = pending_;
  state.film.resize(buffers_.film.bytes / sizeof(float));
  compute_.read(buffers_.film, 0, buffers_.film.bytes, state.film.data());
  state.aovs.resize(buffers_.aovs.bytes / sizeof(float));
  if (buffers_.aovs) compute_.read(buffers_.aovs, 0, buffers_.aovs.bytes, state.aovs.data());
  state.device = nameOf(compute_.device());
  state.tally = wavefront_.tally();
  state.nonFinite = wavefront_.nonFinite();
  state.endedShare = endedShare_;
  state.seconds = secondsInAll();
  state.error = error_;
  return state;
}

void SamplingLoop::save() {
  const HostWork work(hooks_.trace, "save the state");
  hooks_.checkpoint(state());
  saved_ = Clock::now();
}

std::vector<SamplePass> SamplingLoop::nextPasses() const {
  const auto wanted = static_cast<std::uint64_t>(settings_.raysPerPixel) * counts_.pixels();
  const std::uint64_t done = counts_.total();
  if (done >= wanted || (hooks_.isPreview && done > 0)) return {};
  if (settings_.adaptive && counts_.least() >= kPilotSamples)
    return adaptivePasses(counts_, variances_,
                          std::min(wanted - done, shareOf(done, growth(kAdaptiveGrowth))), wanted - done);
  const std::uint32_t samples = nextSamples();
  if (samples == 0) return {};
  return {uniformPass(counts_, samples)};
}

/// Of the samples so far, what a pass adds: what a target is expected to need, but at most `most`. The
/// estimate falls with the root of the samples at least.
double SamplingLoop::growth(double most) const {
  if (!hasErrorTarget(settings_) || counts_.least() < 2) return most;
  const double ratio = error_.back().estimate / errorTarget(settings_, error_.back());
  const double missing = kTargetMargin * ratio * ratio - 1.0;
  if (!(missing < most)) return most;  // NaN and infinity too: nothing is known of the error then
  return std::max(missing, kLeastGrowth);
}

/// Of the samples so far, what a pass adds that is to be looked at: as many again, or what fills
/// kShownSeconds, and all that is left where that takes less than twice as long. Not too much at once on the
/// way to a target, since the first estimates of the error are rough, and where all is soon there: then they
/// are worth seeing.
double SamplingLoop::shownGrowth() const {
  const double done = counts_.least();
  if (!hooks_.shown || !(done > 0.0) || !(passSeconds_ > 0.0)) return 1.0;
  const double fitting = kShownSeconds / passSeconds_ * passSamples_,
               left = static_cast<double>(settings_.raysPerPixel) - done;
  const double growth = (left <= 2.0 * fitting ? left : fitting) / done;
  const bool isGradual = hasErrorTarget(settings_) || 2.0 * left <= fitting;
  return std::max(1.0, isGradual ? std::min(growth, kGradualGrowth) : growth);
}

/// Samples of each pixel in the next pass, as long as they fit into the time that is left; 0: none fits any
/// more.
std::uint32_t SamplingLoop::nextSamples() const {
  const auto total = static_cast<std::uint32_t>(settings_.raysPerPixel);
  const std::uint32_t done = counts_.least();
  if (!looks() && !hooks_.checkpoint) return total - done;
  const auto wanted =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(shareOf(done, growth(shownGrowth())), total - done));
  if (settings_.timeLimit <= 0.0 || done == 0) return wanted;
  const double fitting =
      (settings_.timeLimit - elapsed()) / std::max(passSeconds_, 1e-9) * static_cast<double>(passSamples_);
  return fitting >= wanted ? wanted : static_cast<std::uint32_t>(std::max(0.0, fitting));
}

/// False: stopped, and what is left is still pending.
bool SamplingLoop::tracePending() {
  while (!pending_.empty()) {
    const bool isWhole = tracePass(pending_.front());
    if (pending_.front().blocks.empty()) pending_.erase(pending_.begin());
    if (std::exchange(isPausing_, false))
      save();
    else if (!isWhole)
      return false;
  }
  return true;
}

bool SamplingLoop::tracePass(SamplePass& pass) {
  if (pass.blocks.size() == counts_.blocks()) {
    const Buffer none;
    return traceWith(pass, {buffers_.order, none, static_cast<std::uint32_t>(counts_.pixels()),
                            pass.firstSample, pass.samples});
  }
  std::vector<std::uint32_t> all(counts_.pixels()), order;
  compute_.read(buffers_.order, 0, buffers_.order.bytes, all.data());
  for (const std::uint32_t block : pass.blocks) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(block) * FILM_BLOCK;
    order.insert(order.end(), first, first + counts_.pixelsOf(block));
  }
  compute_.write(buffers_.passOrder, order.data(), order.size() * sizeof(std::uint32_t));
  compute_.write(buffers_.passBlocks, pass.blocks.data(), pass.blocks.size() * sizeof(std::uint32_t));
  return traceWith(pass, {buffers_.passOrder, buffers_.passBlocks, static_cast<std::uint32_t>(order.size()),
                          pass.firstSample, pass.samples});
}

/// False: stopped. The blocks that were finished are no longer in the pass.
bool SamplingLoop::traceWith(SamplePass& pass, const TracePass& launches) {
  const double endedBefore = endedInAll(wavefront_.tally());
  const KeepGoing ask{[this](double samples, bool between) { return keepGoing(samples, between); }};
  const std::uint32_t pixels = wavefront_.trace(launches, ask);
  const std::size_t blocks = (pixels + FILM_BLOCK - 1) / FILM_BLOCK;
  for (std::size_t b = 0; b < blocks; ++b) counts_.add(pass.blocks[b], pass.samples);
  pass.blocks.erase(pass.blocks.begin(), pass.blocks.begin() + static_cast<std::ptrdiff_t>(blocks));
  // A pixel's mean holds a sample with the weight 1 / (samples in the end), which is at most 1 /
  // (samples so far).
  const double weight = 1.0 / (static_cast<double>(counts_.pixels()) * (pass.firstSample + pass.samples));
  endedShare_ += weight * (endedInAll(wavefront_.tally()) - endedBefore);
  return pixels == launches.pixels;
}

double SamplingLoop::endedPerSample() const {
  if (counts_.least() != counts_.most()) return endedShare_;
  return counts_.total() == 0 ? 0.0 : endedInAll(wavefront_.tally()) / static_cast<double>(counts_.total());
}

double SamplingLoop::secondsLeft() const {
  const double done = samplesDone_ - samplesBefore_;
  return done > 0.0 ? elapsed() * std::max(0.0, (expectedSamples() - samplesDone_) / done) : 0.0;
}

bool SamplingLoop::keepGoing(double samplesOfPass, bool betweenBatches) {
  samplesDone_ = static_cast<double>(counts_.total()) + samplesOfPass;
  reportProgress(samplesDone_);
  if (hooks_.keepGoing && !hooks_.keepGoing()) return false;
  if (hooks_.checkpoint && betweenBatches && samplesOfPass > 0.0 &&
      std::chrono::duration<double>(Clock::now() - saved_).count() >= hooks_.checkpointSeconds) {
    isPausing_ = true;
    return false;
  }
  const double limit = settings_.timeLimit, now = elapsed();
  if (limit <= 0.0 || now <= limit) return true;
  if (counts_.least() > 0)
    return !betweenBatches && now <= limit + std::max(kLateShare * limit, kLateSeconds);
  if (!saidLate_ && hooks_.note && samplesOfPass > 0.0 && now > 2.0 * limit + 1.0) {
    saidLate_ = true;
    const double share = samplesOfPass / static_cast<double>(counts_.pixels());
    hooks_.note(fmt::format(
        "the time limit has passed, but {:.0f} % of the pixels have no ray yet; about {:.0f} s more. "
        "--cutoff 0.001, --impulses one or fewer --bounces make rays cheaper",
        std::ceil(100.0 * (1.0 - share)), now / share - now));
  }
  return true;
}

void SamplingLoop::reportProgress(double samples) {
  if (!hooks_.progress) return;
  const RayTally& t = wavefront_.tally();
  hooks_.progress(
      {samples, std::max(expectedSamples(), samples), secondsInAll(), t.primary + t.impulse + t.shadow});
}

/// Of the picture, what the whole will take by the last estimate (the error falls with the root of the
/// samples) and the time limit.
double SamplingLoop::expectedSamples() const {
  const double done = static_cast<double>(counts_.total()), pixels = static_cast<double>(counts_.pixels());
  double samples = pixels * settings_.raysPerPixel;
  if (hasErrorTarget(settings_) && !error_.empty() && error_.back().estimate > 0.0)
    samples =
        std::min(samples, done * std::pow(error_.back().estimate / errorTarget(settings_, error_.back()), 2));
  if (settings_.timeLimit > 0.0 && done > 0.0)
    samples = std::min(samples, done * settings_.timeLimit / std::max(elapsed(), 1e-9));
  return std::max(samples, pixels + done);
}

/// Notes how far the picture is. One sample for each pixel says nothing of its error.
void SamplingLoop::look() {
  const HostWork work(hooks_.trace, "estimate error");
  const bool estimates = counts_.least() >= 2;
  if (!estimates && !hooks_.reference) return;
  const double now = seconds_ > 0.0 ? seconds_ : elapsed();
  ErrorPoint point{before_ + now, counts_.mean(), 0.0, {}, 0.0};
  double total = 0.0;
  if (estimates) variances_.assign(counts_.blocks(), 0.0);
  eachPart([&](const FilmPart& part) {
    addRadiance(part, counts_, total);
    if (estimates) addBlockVariances(part, counts_, variances_);
  });
  point.mean = total / (3.0 * static_cast<double>(counts_.pixels()));
  if (estimates) point.estimate = estimateError(variances_, counts_);
  if (hooks_.reference) point.rmse = rootMeanSquare(picture(), *hooks_.reference);
  error_.push_back(point);
}

template <class Visit>
void SamplingLoop::eachPart(const Visit& visit) {
  constexpr std::size_t kPixels = std::size_t{1024} * FILM_BLOCK;
  const std::size_t all = counts_.pixels(), planes = buffers_.film.bytes / sizeof(float) / all;
  FilmPart part;
  for (; part.first < all; part.first += kPixels) {
    const std::size_t pixels = std::min(kPixels, all - part.first), bytes = pixels * sizeof(float);
    part.pixelOrder.resize(pixels);
    part.planes.resize(planes * pixels);
    compute_.read(buffers_.order, part.first * sizeof(float), bytes, part.pixelOrder.data());
    for (std::size_t i = 0; i < planes; ++i)
      compute_.read(buffers_.film, (i * all + part.first) * sizeof(float), bytes, &part.planes[i * pixels]);
    visit(part);
  }
}

FloatImage SamplingLoop::picture() {
  FloatImage image = blackImage(settings_, 3);
  eachPart([&](const FilmPart& part) { resolveFilm(part, counts_, image); });
  return image;
}

FloatImage SamplingLoop::alpha() {
  FloatImage image = blackImage(settings_, 1);
  eachPart([&](const FilmPart& part) { resolveAlpha(part, counts_, image); });
  return image;
}

FloatImage SamplingLoop::errors() {
  FloatImage image = blackImage(settings_, 1);
  eachPart([&](const FilmPart& part) { showErrors(part, counts_, image); });
  return image;
}

FloatImage SamplingLoop::samples() {
  FloatImage image = blackImage(settings_, 1);
  eachPart([&](const FilmPart& part) { showSamples(part, counts_, image); });
  return image;
}

}  // namespace whittle
