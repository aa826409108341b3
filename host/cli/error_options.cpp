// Targets, limits, and how many rays they mean.
#include "cli/error_options.h"

#include <fmt/format.h>

#include <string_view>

#include "cli/option_kinds.h"
#include "report/text.h"
#include "wavefront/sample_counts.h"

namespace whittle::cli {
namespace {

/// Rays for each pixel where a target or a limit decides: more than anyone waits for,
/// few enough for every sampler.
constexpr int kUntilStopped = 1 << 16;

/// "0.002", or "1%" and "1 %": of the mean. One takes the place of the other.
void parseTarget(const std::string& text, Settings& s) {
  constexpr double kMost = 1e30;
  std::string_view number = text;
  const bool relative = number.ends_with('%');
  if (relative) number.remove_suffix(number.ends_with(" %") ? 2 : 1);
  double value = 0.0;
  try {
    value = parseReal("--target-error", std::string(number), 0.0, kMost);
  } catch (const InputError&) {
    throw InputError(fmt::format(
        "--target-error: '{}' is not a number from 0 to {:g}: E in W/(m² sr), or P% of the mean radiance",
        text, kMost));
  }
  s.targetError = relative ? 0.0 : value;
  s.targetErrorRelative = relative ? value / 100.0 : 0.0;
}

}  // namespace

void addErrorOptions(CLI::App& c, Settings& s) {
  c.option_defaults()->group("Error against time");
  addText(
      c, "--target-error", [&s](const std::string& text) { parseTarget(text, s); },
      {"E|P%",
       "stop once the estimated RMSE is at most E W/(m² sr), or P % of the picture's mean radiance; without "
       "--rays-per-pixel as many rays as that takes",
       "0: never"});
  addReal(c, "--time-limit", s.timeLimit, 0, 1e9, "SECONDS",
          "stop rendering after this; every pixel gets one ray, however long that takes; without "
          "--rays-per-pixel as many as fit",
          "0: none");
  c.add_flag("--adaptive,!--no-adaptive", s.adaptive,
             fmt::format("more rays where the estimated error is largest, beyond {} for each pixel [off]",
                         kPilotSamples));
}

void settleRaysPerPixel(const CLI::App& command, Settings& s) {
  if (command.count("--rays-per-pixel") > 0) return;
  if (!hasErrorTarget(s) && s.timeLimit <= 0.0) {
    if (s.adaptive)
      throw InputError("--adaptive: give --rays-per-pixel (on average), --target-error or --time-limit");
    return;
  }
  if (s.sampler == Sampler::Stratified)
    throw InputError("--sampler: stratified divides each pixel by --rays-per-pixel, which is not given");
  s.raysPerPixel = kUntilStopped;
}

void followTarget(Settings& s, int usual) {
  const bool isEnded = hasErrorTarget(s) || s.timeLimit > 0.0;
  if (isEnded && s.raysPerPixel == usual && s.sampler != Sampler::Stratified) s.raysPerPixel = kUntilStopped;
  if (!isEnded && s.raysPerPixel == kUntilStopped) s.raysPerPixel = usual;
}

std::vector<std::string> uselessAdaptive(const Settings& s) {
  if (!s.adaptive || s.raysPerPixel > static_cast<int>(kPilotSamples)) return {};
  return {
      fmt::format("--adaptive: changes nothing up to {} rays for each pixel, which all get alike; "
                  "a larger --rays-per-pixel lets it choose",
                  kPilotSamples)};
}

}  // namespace whittle::cli
