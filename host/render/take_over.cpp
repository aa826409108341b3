// When compiling pays. General programs take 1.1 to 1.3 times as long as a scene's own (host/README.md), and
// compiling those takes some 3 to 6 s of a processor.
#include "render/take_over.h"

#include <limits>
#include <utility>

namespace whittle {
namespace {

/// Less is over before anybody minds, and is not worth a compiler even for next time.
constexpr double kSeconds = 0.5;
/// With so much to come it pays to take a processor from the render; with less the compiler takes what the
/// render leaves, and the next run finds its work.
constexpr double kEagerSeconds = 25.0;
/// Loading what is compiled takes some 0.2 s.
constexpr double kLeastLeft = 0.5;

}  // namespace

void TakeOver::begin(const ProgramChoice& choice, bool isGeneral) {
  std::string key;
  for (const KernelProgram& program : choice.own) key += programKey(program, choice.target);
  if (key != key_) {
    leave();
    before_ = notBefore_ = 0.0;
    key_ = std::move(key);
  }
  runs_ = {{isGeneral, 0, 0.0, 0.0}};
  began_ = std::chrono::steady_clock::now();
}

void TakeOver::beforeBatch(std::uint32_t batch, OpenDevice& device, const ProgramChoice& choice,
                           const RenderHooks& hooks, const SamplingLoop& loop, StageRunner& stages) {
  if (!isGeneral()) return;
  bool isReady = hooks.takeOverBefore == batch;
  if (!isReady && hooks.tier == Tier::Auto && !hooks.takeOverBefore) {
    const double left = loop.secondsLeft(), seconds = loop.seconds();
    const bool isEager = left + hooks.picturesToCome * (seconds + left) > kEagerSeconds;
    const bool mayStart = generalSeconds(seconds) > kSeconds && generalSeconds(seconds) >= notBefore_;
    if (mayStart && (!compiler_ || (isBeside_ && isEager))) start(choice, hooks, !isEager);
    const auto status = compiler_ ? compiler_->ended() : std::nullopt;
    isReady = status == 0 && left > kLeastLeft;
    if (status && *status != 0) {
      compiler_.reset();
      notBefore_ = 2.0 * generalSeconds(seconds);  // another compiles beside, or it failed
    }
  }
  if (!isReady) return;
  stages.use(compileOnce(device, choice.own, choice.target));
  runs_.back().seconds = loop.seconds();
  if (hooks.trace) hooks.trace->phase("on general kernels", began_, Trace::Track::Compiler);
  runs_.push_back({false, batch, loop.seconds(), 0.0});
}

void TakeOver::end(const ProgramChoice& choice, const RenderHooks& hooks, double seconds) {
  if (isGeneral() && hooks.trace) hooks.trace->phase("on general kernels", began_, Trace::Track::Compiler);
  if (runs_.front().isGeneral) before_ += runs(seconds).front().seconds;
  if (isGeneral() && hooks.tier == Tier::Auto && !compiler_ && before_ > kSeconds && before_ >= notBefore_)
    start(choice, hooks, true);
}

std::vector<ProgramRun> TakeOver::runs(double seconds) const {
  std::vector<ProgramRun> all = runs_;
  if (!all.empty()) all.back().seconds = seconds - all.back().from;
  return all;
}

void TakeOver::start(const ProgramChoice& choice, const RenderHooks& hooks, bool isBeside) {
  CompilerJob job = choice.job;
  job.isBeside = isBeside_ = isBeside;
  compiler_.reset();  // one that came too slowly ends
  auto run = choice.mayCompileBeside ? CompilerRun::start(hooks.compiler, job) : std::nullopt;
  if (run) compiler_.emplace(std::move(*run));
  if (!compiler_) notBefore_ = std::numeric_limits<double>::infinity();
}

void TakeOver::leave() {
  if (compiler_) compiler_->letGo();
  compiler_.reset();
}

}  // namespace whittle
