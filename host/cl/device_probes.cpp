// Runs kernels/probes/device.cl and judges what comes out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "cl/device_facts.h"
#include "cl/kernel_source.h"

namespace whittle {
namespace {

constexpr std::uint32_t kLoops = 1 << 20;  ///< iterations that are tried
constexpr std::uint32_t kItems = 64;       ///< of the loops; several vectors of any driver
constexpr std::uint32_t kSamples = 4096;   ///< of the arithmetic
constexpr std::size_t kValues = 14;        ///< PROBE_VALUES

std::uint32_t step(std::uint32_t x) { return x * 1664525U + 1013904223U; }

/// Steps from `begin` to `end`; `most` where there are as many or more.
std::uint32_t stepsBetween(std::uint32_t begin, std::uint32_t end, std::uint32_t most) {
  std::uint32_t steps = 0;
  for (std::uint32_t x = begin; x != end && steps < most; x = step(x)) ++steps;
  return steps;
}

class Prober {
 public:
  explicit Prober(Compute& compute)
      : compute_(compute),
        queue_(clTry("opening a queue for probes",
                     [&] {
                       return cl::CommandQueue(compute.queue().getInfo<CL_QUEUE_CONTEXT>(),
                                               compute.device().device, CL_QUEUE_PROFILING_ENABLE);
                     })),
        program_(compute.build(assembleKernelSource({"probes/device.cl"}), "-cl-std=CL1.2", "the probes")) {}

  /// The iterations after which loops ended; 0: none did before its time.
  std::uint32_t loopLimit() {
    std::uint32_t limit = 0;
    constexpr std::uint32_t kInner = 1023;
    for (const auto& [outer, inner] : {std::pair(kLoops, 0U), std::pair(kLoops / (kInner + 1), kInner)}) {
      std::vector<std::uint32_t> begin(kItems);
      for (std::uint32_t i = 0; i < kItems; ++i) begin[i] = i * 2654435761U + 1;
      const std::vector<std::uint32_t> end = runLoops(begin, outer, inner);
      for (std::uint32_t i = 0; i < kItems; ++i) {
        const std::uint32_t steps = stepsBetween(begin[i], end[i], kLoops);
        if (steps < kLoops) limit = limit == 0 ? std::max(steps, 1U) : std::clamp(steps, 1U, limit);
      }
    }
    return limit;
  }

  const std::vector<LaunchTimes>& launches() const { return launches_; }

  /// kValues for each of the samples.
  std::vector<float> arithmetic(const std::array<std::vector<float>, 3>& inputs) {
    std::vector<float> out(std::size_t{kSamples} * kValues, std::numeric_limits<float>::quiet_NaN());
    clTry("trying the arithmetic of " + compute_.device().name, [&] {
      cl::Kernel kernel(program_, "probe_arithmetic");
      kernel.setArg(0, kSamples);
      std::vector<Buffer> buffers;
      for (cl_uint i = 0; i < inputs.size(); ++i) {
        buffers.push_back(compute_.upload("probe", inputs[i]));
        kernel.setArg(i + 1, buffers.back().handle);
      }
      const Buffer result = compute_.upload("probe results", out);
      kernel.setArg(4, result.handle);
      queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(kSamples), cl::NDRange(kGroup));
      queue_.finish();
      compute_.read(result, 0, result.bytes, out.data());
    });
    return out;
  }

 private:
  static constexpr std::size_t kGroup = 8;

  std::vector<std::uint32_t> runLoops(const std::vector<std::uint32_t>& begin, std::uint32_t outer,
                                      std::uint32_t inner) {
    const Buffer states = compute_.upload("probe", begin);
    std::vector<std::uint32_t> end(begin.size());
    clTry("trying loops on " + compute_.device().name, [&] {
      cl::Kernel kernel(program_, "probe_loops");
      kernel.setArg(0, outer);
      kernel.setArg(1, inner);
      kernel.setArg(2, states.handle);
      cl::Event event;
      queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(begin.size()), cl::NDRange(kGroup),
                                  nullptr, &event);
      queue_.finish();
      try {
        launches_.push_back({event.getProfilingInfo<CL_PROFILING_COMMAND_START>(),
                             event.getProfilingInfo<CL_PROFILING_COMMAND_END>()});
      } catch (const cl::Error&) {
        launches_.push_back({});  // a driver that has none
      }
      compute_.read(states, 0, states.bytes, end.data());
    });
    return end;
  }

  Compute& compute_;
  cl::CommandQueue queue_;
  cl::Program program_;
  std::vector<LaunchTimes> launches_;
};

/// Away from the smallest and the largest numbers, of both signs.
std::array<std::vector<float>, 3> arithmeticInputs() {
  std::array<std::vector<float>, 3> inputs;
  std::uint32_t x = 1;
  for (std::uint32_t i = 0; i < kSamples; ++i)
    for (auto& values : inputs) {
      x = step(x);
      const float unit = static_cast<float>(x >> 8) * 0x1p-23F - 1.0F;
      x = step(x);
      values.push_back(std::ldexp(unit == 0.0F ? 1.0F : unit, static_cast<int>(x >> 28) - 6));
    }
  return inputs;
}

float differenceOfProducts(float a, float b, float c, float d) {
  const float cd = c * d, difference = std::fma(a, b, -cd), error = std::fma(-c, d, cd);
  return difference + error;
}

/// What the host has for a sample; NaN where it is judged otherwise.
std::array<float, kValues> expected(float x, float y, float z) {
  const auto bits = [](float f) { return std::bit_cast<std::uint32_t>(f); };
  const float eight[8] = {x, y, z, x, y, z, x, y};
  const std::uint64_t wide = std::uint64_t{bits(x)} << 24 | bits(y);
  return {0.0F,
          std::fma(x, y, z),
          differenceOfProducts(x, y, z, x),
          x / y,
          std::sqrt(std::fabs(x)),
          x > y ? x : z,
          static_cast<float>(static_cast<std::int32_t>(x * 1000.0F)),
          static_cast<float>(static_cast<std::uint32_t>(std::fabs(z * 4096.0F))),
          static_cast<float>((bits(x) * 2654435761U) >> 8),
          static_cast<float>(static_cast<std::uint32_t>((wide + bits(z)) >> 32)),
          x > y ? x : z,
          eight[bits(y) & 7U],
          8.0F,
          std::numeric_limits<float>::quiet_NaN()};
}

/// What a row of values is, and by how many units in the last place OpenCL C 1.2 (7.4) lets it be off.
struct Row {
  const char* name;
  double ulps = 0.0;
  const char* consequence = "";
};
constexpr std::array<Row, kValues> kRows{
    Row{"contraction off", 0, "rays slip through the edge between two triangles"},
    Row{"fma rounds once", 0, "the triangle test's signs are wrong: rays leak"},
    Row{"difference of products", 0, "the triangle test's signs are wrong: rays leak"},
    Row{"division", 2.5, "distances and barycentrics are off"},
    Row{"square root", 3.0, "normals are off"},
    Row{"selection", 0, "every choice in the kernels"},
    Row{"conversion to int", 0, "texels and samples are taken from elsewhere"},
    Row{"conversion to uint", 0, "samples are taken from elsewhere"},
    Row{"integer product", 0, "random numbers are not those of other devices"},
    Row{"64-bit sum", 0, "what ended at cut-offs is counted wrongly"},
    Row{"selection in vectors", 0, "every choice in the kernels"},
    Row{"private arrays", 0, "the searches' stacks"},
    Row{"NaN in comparisons", 0, "values that are no numbers go unseen"},
    Row{"denormals", 0, ""}};

double ulpsBetween(float seen, float right) {
  if (std::bit_cast<std::uint32_t>(seen) == std::bit_cast<std::uint32_t>(right)) return 0.0;
  if (!std::isfinite(seen) || !std::isfinite(right)) return std::numeric_limits<double>::infinity();
  const double unit =
      static_cast<double>(std::nextafter(std::fabs(right), std::numeric_limits<float>::infinity())) -
      std::fabs(static_cast<double>(right));
  return std::fabs(static_cast<double>(seen) - static_cast<double>(right)) / unit;
}

Finding arithmeticFinding(const Row& row, std::size_t value, const std::vector<float>& out,
                          const std::array<std::vector<float>, 3>& inputs) {
  double worst = 0.0;
  std::size_t different = 0, flushed = 0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const float seen = out[i * kValues + value],
                right = expected(inputs[0][i], inputs[1][i], inputs[2][i])[value];
    flushed += seen == 0.0F;
    // 0 is 0, whatever its sign: no kernel asks for that.
    if (std::isnan(right) || seen == right) continue;
    worst = std::max(worst, ulpsBetween(seen, right));
    ++different;
  }
  if (std::string_view(row.name) == "denormals")
    return {row.name, Verdict::Right, flushed > 0 ? "become 0" : "are kept", ""};
  if (different == 0)
    return {row.name, Verdict::Right, row.ulps > 0.0 ? "rounds correctly" : "as the host", ""};
  if (worst <= row.ulps)
    return {row.name, Verdict::Right, fmt::format("within {:.1f} units in the last place", worst),
            "pictures differ from other devices' by rounding"};
  return {row.name, Verdict::Wrong, fmt::format("{} of {} differ from the host", different, kSamples),
          row.consequence};
}

Finding loopFinding(const DeviceFacts& facts) {
  if (facts.loopLimit == 0)
    return {"length of loops", Verdict::Right, fmt::format("{} iterations", kLoops), ""};
  const bool isEnough = facts.loopLimit >= kLeastLoopLimit;
  return {"length of loops", isEnough ? Verdict::WorkedRound : Verdict::Wrong,
          fmt::format("the driver ends loops after {} iterations and says nothing", facts.loopLimit),
          isEnough ? "launches are cut, searches count their steps, --search array has few triangles"
                   : "pictures lack what the loops had still to do"};
}

Finding timesFinding(const DeviceFacts& facts) {
  if (facts.givesTimes) return {"event times", Verdict::Right, "grow with the launches", ""};
  return {"event times", Verdict::WorkedRound, "this driver gives no times",
          "--profile and --trace have the host's clock around finished launches, statistics null"};
}

}  // namespace

bool areTimes(std::uint64_t resolution, const std::vector<LaunchTimes>& launches) {
  constexpr std::uint64_t kLeast = 100;  // ns: no launch takes less
  if (resolution == 0 || launches.empty()) return false;
  std::uint64_t last = 0;
  for (const auto& [start, end] : launches) {
    if (start < last || end < start + kLeast) return false;
    last = end;
  }
  return true;
}

DeviceProbe probeDevice(Compute& compute) {
  DeviceProbe probe;
  Prober prober(compute);
  probe.facts.loopLimit = prober.loopLimit();
  probe.findings.push_back(loopFinding(probe.facts));
  const auto resolution = clTry("asking " + compute.device().name, [&] {
    return compute.device().device.getInfo<CL_DEVICE_PROFILING_TIMER_RESOLUTION>();
  });
  probe.facts.givesTimes = areTimes(resolution, prober.launches());
  probe.findings.push_back(timesFinding(probe.facts));
  const auto inputs = arithmeticInputs();
  const std::vector<float> out = prober.arithmetic(inputs);
  for (std::size_t value = 0; value < kValues; ++value)
    probe.findings.push_back(arithmeticFinding(kRows[value], value, out, inputs));
  return probe;
}

}  // namespace whittle
