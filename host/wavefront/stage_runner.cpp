// Kernel launches with fixed work-group sizes and event timing.
#include "wavefront/stage_runner.h"

#include <algorithm>
#include <map>

#include "cl/device_facts.h"

namespace whittle {

namespace {

/// Iterations at most of what lies within the loop over samples (film.cl) and over lights (shade.cl), if no
/// compiler unrolls any of it: five sums thrice; eight candidates of a surface light, each found in a table
/// of at most 2^32 rows, and some more.
constexpr std::uint32_t kLoopsOfASample = 16, kLoopsOfALight = 512;

}  // namespace

int defaultWorkGroup(const SceneFeatures& features) { return features.has(Feature::PACKETS) ? 8 : 64; }

std::uint32_t defaultCompactChunk(const DeviceInfo& device) {
  if (device.kind != "cpu") return 32;
  return device.facts.loopLimit > 0 ? LoopLimits::kCompactChunk : 1024;
}

LoopLimits loopLimits(const DeviceInfo& device) {
  const std::uint32_t budget = loopBudget(device);
  if (budget == 0) return {};
  return {.triangles = budget - 1,
          .entries = device.facts.loopLimit / (SUM_ENDED + ENDED_KINDS) * LoopLimits::kCompactChunk,
          .samples = std::max(1U, budget / kLoopsOfASample),
          .lights = std::max(1U, budget / kLoopsOfALight)};
}

StageRunner::StageRunner(Compute& compute, const std::vector<cl::Program>& programs, int workGroup,
                         const LaunchWidths& widths, const EntryBytes& entryBytes)
    : compute_(compute),
      workGroup_(static_cast<std::size_t>(workGroup)),
      widths_(widths),
      entryBytes_(entryBytes) {
  use(programs);
}

void StageRunner::use(const std::vector<cl::Program>& programs) {
  kernels_.clear();
  for (cl::Program program : programs)  // opencl.hpp asks a program that may change
    clTry("finding the kernels of a program", [&] {
      std::vector<cl::Kernel> kernels;
      program.createKernels(&kernels);
      for (const auto& kernel : kernels) kernels_.emplace(kernel.getInfo<CL_KERNEL_FUNCTION_NAME>(), kernel);
    });
}

cl::Kernel& StageRunner::find(const char* name) {
  const auto found = kernels_.find(name);
  if (found == kernels_.end()) throw ClError("no program has a kernel '" + std::string(name) + "'");
  return found->second;
}

std::size_t StageRunner::stageIndex(const Stage& stage) {
  const auto at = std::find_if(stages_.begin(), stages_.end(), [&](const StageOfBounce& s) {
    return s.bounce == bounce_ && s.stats.facts.name == stage.facts.name;
  });
  if (at != stages_.end()) return static_cast<std::size_t>(at - stages_.begin());
  stages_.push_back({bounce_, {stage.facts, widths_.of(stage.width)}});
  return stages_.size() - 1;
}

void StageRunner::launch(const Stage& stage, cl::Kernel& kernel, std::uint64_t workItems, Work work) {
  const std::size_t global = (workItems + workGroup_ - 1) / workGroup_ * workGroup_;
  Launch launch{stageIndex(stage), {}, work, batch_};
  const bool timed = compute_.timesLaunches(), byHost = timed && !compute_.device().facts.givesTimes;
  if (byHost) finish();
  launch.start = steadySeconds(Trace::Clock::now());
  clTry(std::string("launching kernel '") + stage.facts.name + "' on " + compute_.device().name, [&] {
    compute_.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(global), cl::NDRange(workGroup_),
                                          nullptr, timed && !byHost ? &launch.event : nullptr);
  });
  if (trace_) launch.enqueued = steadySeconds(Trace::Clock::now());
  StageStats& stats = stages_[launch.stage].stats;
  stats.launches += 1;
  stats.items += work.items;
  stats.bytes += work.bytes;
  if (byHost)
    timeByHost(launch);
  else if (timed)
    launches_.push_back(std::move(launch));
}

void StageRunner::finish() {
  clTry("waiting for kernels", [&] { compute_.queue().finish(); });
}

/// A launch that nothing is under way beside.
void StageRunner::timeByHost(Launch& launch) {
  finish();
  const double end = steadySeconds(Trace::Clock::now());
  stages_[launch.stage].stats.seconds += end - launch.start;
  if (!trace_) return;
  trace_->launchesAreHosts();
  launch.enqueued = launch.start;  // one clock is behind both
  record(launch, launch.start, launch.start, end);
}

void StageRunner::collect() {
  if (!compute_.timesLaunches()) return finish();
  clTry("reading kernel times", [&] {
    for (auto& launch : launches_) {
      launch.event.wait();
      const auto start = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
      const auto end = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
      if (end > start) stages_[launch.stage].stats.seconds += static_cast<double>(end - start) * 1e-9;
      if (trace_ && end > start) recordLaunch(launch, start, end);
    }
  });
  launches_.clear();
}

void StageRunner::recordLaunch(const Launch& launch, std::uint64_t start, std::uint64_t end) {
  const auto queued = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_QUEUED>();
  const auto seconds = [](std::uint64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1e-9; };
  record(launch, seconds(queued), seconds(start), seconds(end));
}

void StageRunner::record(const Launch& launch, double queued, double start, double end) {
  const StageOfBounce& of = stages_[launch.stage];
  trace_->launch({of.stats.facts.name, of.stats.facts.queue, launch.batch, of.bounce, launch.work.items,
                  launch.work.bytes, launch.enqueued, start, end},
                 queued);
}

std::vector<StageStats> StageRunner::stats() {
  collect();
  std::vector<StageStats> all;
  for (const auto& [bounce, stats] : stages_) {
    const auto same = [&, name = stats.facts.name](const StageStats& s) { return s.facts.name == name; };
    const auto found = std::find_if(all.begin(), all.end(), same);
    if (found == all.end())
      all.push_back(stats);
    else
      found->add(stats);
  }
  return all;
}

std::vector<BounceStats> StageRunner::statsByBounce() {
  collect();
  std::map<std::uint32_t, BounceStats> bounces;
  for (const auto& [bounce, stats] : stages_) {
    bounces[bounce].bounce = bounce;
    bounces[bounce].stages.push_back(stats);
  }
  std::vector<BounceStats> list;
  list.reserve(bounces.size());
  for (auto& [number, bounce] : bounces) list.push_back(std::move(bounce));
  return list;
}

}  // namespace whittle
