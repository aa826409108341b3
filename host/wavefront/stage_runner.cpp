// Kernel launches with fixed work-group sizes and event timing.
#include "wavefront/stage_runner.h"

#include <algorithm>
#include <map>

namespace whittle {

int defaultWorkGroup(const SceneFeatures& features) { return features.has(Feature::PACKETS) ? 8 : 64; }

StageRunner::StageRunner(Compute& compute, const std::vector<cl::Program>& programs, int workGroup)
    : compute_(compute), workGroup_(static_cast<std::size_t>(workGroup)) {
  for (cl::Program program : programs)  // opencl.hpp asks a program that may change
    clTry("finding the kernels of a program", [&] {
      std::vector<cl::Kernel> kernels;
      program.createKernels(&kernels);
      for (const auto& kernel : kernels) kernels_.emplace(kernel.getInfo<CL_KERNEL_FUNCTION_NAME>(), kernel);
    });
}

cl::Kernel& StageRunner::find(const std::string& name) {
  const auto found = kernels_.find(name);
  if (found == kernels_.end()) throw ClError("no program has a kernel '" + name + "'");
  return found->second;
}

std::size_t StageRunner::stageIndex(const std::string& name) {
  const auto at = std::find_if(stages_.begin(), stages_.end(), [&](const StageOfBounce& s) {
    return s.bounce == bounce_ && s.stage.name == name;
  });
  if (at != stages_.end()) return static_cast<std::size_t>(at - stages_.begin());
  stages_.push_back({bounce_, {name, 0, 0.0, 0, 0}});
  return stages_.size() - 1;
}

void StageRunner::setBytes(cl::Kernel& kernel, const std::string& name, cl_uint index, std::size_t bytes,
                           const void* value) {
  const cl_int error = clSetKernelArg(kernel(), index, bytes, value);
  if (error != CL_SUCCESS)
    throw ClError("setting argument " + std::to_string(index) + " of kernel '" + name +
                  "': " + clErrorName(error));
}

void StageRunner::setBuffer(cl::Kernel& kernel, const std::string& name, cl_uint index,
                            const Buffer& buffer) {
  const cl_mem handle = buffer ? buffer.handle() : nullptr;
  setBytes(kernel, name, index, sizeof(handle), buffer ? &handle : nullptr);
}

void StageRunner::launch(const std::string& name, cl::Kernel& kernel, std::uint64_t workItems,
                         StageWork work) {
  const std::size_t global = (workItems + workGroup_ - 1) / workGroup_ * workGroup_;
  Launch launch{stageIndex(name), {}, work, batch_};
  const bool timed = compute_.timesLaunches();
  clTry("launching kernel '" + name + "' on " + compute_.device().name, [&] {
    compute_.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(global), cl::NDRange(workGroup_),
                                          nullptr, timed ? &launch.event : nullptr);
  });
  if (trace_) launch.enqueued = steadySeconds(Trace::Clock::now());
  StageStats& stage = stages_[launch.stage].stage;
  stage.launches += 1;
  stage.items += work.items;
  stage.bytes += work.bytes;
  if (timed) launches_.push_back(std::move(launch));
}

void StageRunner::collect() {
  if (!compute_.timesLaunches()) {
    clTry("waiting for kernels", [&] { compute_.queue().finish(); });
    return;
  }
  clTry("reading kernel times", [&] {
    for (auto& launch : launches_) {
      launch.event.wait();
      const auto start = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
      const auto end = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
      if (end > start) stages_[launch.stage].stage.seconds += static_cast<double>(end - start) * 1e-9;
      if (trace_ && end > start) recordLaunch(launch, start, end);
    }
  });
  launches_.clear();
}

void StageRunner::recordLaunch(const Launch& launch, std::uint64_t start, std::uint64_t end) {
  const auto queued = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_QUEUED>();
  const auto seconds = [](std::uint64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1e-9; };
  const StageOfBounce& of = stages_[launch.stage];
  trace_->launch({of.stage.name, launch.batch, of.bounce, launch.work.items, launch.work.bytes,
                  launch.enqueued, seconds(start), seconds(end)},
                 seconds(queued));
}

namespace {

/// The entry of a name, made if it is not there.
StageStats& entryOf(std::vector<StageStats>& stages, const std::string& name) {
  for (auto& s : stages)
    if (s.name == name) return s;
  stages.push_back({name, 0, 0.0, 0, 0});
  return stages.back();
}

}  // namespace

std::vector<StageStats> StageRunner::stats() {
  collect();
  std::vector<StageStats> all;
  for (const auto& [bounce, stage] : stages_) {
    entryOf(all, stage.name).add(stage);
  }
  return all;
}

std::vector<BounceStats> StageRunner::statsByBounce() {
  collect();
  std::map<std::uint32_t, BounceStats> bounces;
  for (const auto& [bounce, stage] : stages_) {
    bounces[bounce].bounce = bounce;
    bounces[bounce].stages.push_back(stage);
  }
  std::vector<BounceStats> list;
  for (auto& [number, bounce] : bounces) list.push_back(std::move(bounce));
  return list;
}

}  // namespace whittle
