// What does looking cost? Renders the same frame again and again in one process: with nothing timed, with
// stages timed as --profile and --stats do, and with launches recorded as --trace does; in each round all of
// them, in random order. Tab-separated lines to standard output: variant, round, seconds of rendering,
// seconds that its table or timeline takes afterwards (as text, without the disk), launches. usage:
// frame_cost SCENE.glb WIDTH HEIGHT RAYS_PER_PIXEL WAVEFRONT ROUNDS        (experiments/overhead.py runs it)
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <random>
#include <span>
#include <string>

#include "gltf/loader.h"
#include "render/renderer.h"
#include "report/profile_table.h"

namespace whittle {
namespace {

using Clock = std::chrono::steady_clock;

struct Variant {
  const char* name;
  bool timed, traced;
};

/// The first twice: how far it is from itself is what the measurement cannot tell.
constexpr std::array kVariants = {Variant{"off", false, false}, Variant{"off again", false, false},
                                  Variant{"--profile", true, false}, Variant{"--trace", true, true}};

struct Frame {
  double render = 0.0, after = 0.0;  ///< seconds
  std::uint64_t launches = 0;
};

Frame renderFrame(const Scene& scene, const Settings& settings, const Variant& variant) {
  RenderHooks hooks;
  hooks.timeStages = variant.timed;
  const auto trace = variant.traced ? std::make_unique<Trace>() : nullptr;
  hooks.trace = trace.get();
  const Stats stats = render(scene, settings, hooks).stats;
  const auto rendered = Clock::now();
  std::size_t characters = 0;
  if (trace)
    characters = trace->toText().size();
  else if (variant.timed)
    characters = profileTable(stats).size();
  Frame frame{stats.time.render, 0.0, 0};
  // A text that nobody looks at might never be made.
  if (characters > 0) frame.after = std::chrono::duration<double>(Clock::now() - rendered).count();
  for (const auto& stage : stats.stages) frame.launches += stage.launches;
  return frame;
}

void measure(const Scene& scene, const Settings& settings, int rounds) {
  std::mt19937 dice(1);
  auto order = kVariants;
  for (const Variant& variant : kVariants) renderFrame(scene, settings, variant);  // compiled, memory touched
  for (int round = 0; round < rounds; ++round) {
    std::shuffle(order.begin(), order.end(), dice);
    for (const Variant& variant : order) {
      const Frame f = renderFrame(scene, settings, variant);
      fmt::print("{}\t{}\t{:.9f}\t{:.9f}\t{}\n", variant.name, round, f.render, f.after, f.launches);
    }
    std::fflush(stdout);
  }
}

int run(std::span<const char* const> arguments) {
  if (arguments.size() != 6) {
    fmt::print(stderr, "usage: frame_cost SCENE.glb WIDTH HEIGHT RAYS_PER_PIXEL WAVEFRONT ROUNDS\n");
    return 2;
  }
  Notices notices;
  const Scene scene = loadGltf(arguments[0], {}, notices);
  Settings settings;
  settings.width = std::stoi(arguments[1]);
  settings.height = std::stoi(arguments[2]);
  settings.raysPerPixel = std::stoi(arguments[3]);
  settings.wavefront = std::stoi(arguments[4]);
  measure(scene, settings, std::stoi(arguments[5]));
  return 0;
}

}  // namespace
}  // namespace whittle

int main(int count, char** values) {
  try {
    return whittle::run({values + 1, static_cast<std::size_t>(std::max(count, 1) - 1)});
  } catch (const std::exception& e) {
    fmt::print(stderr, "frame_cost: {}\n", e.what());
    return 1;
  }
}
