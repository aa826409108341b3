// Buffers: what is written is read, in either kind of memory and at both ends of the largest one; two queues
// see each other's work once it is finished.
#include <fmt/format.h>

#include <array>

#include "check/device_check.h"
#include "scene/byte_counts.h"

namespace whittle {
namespace {

constexpr std::uint64_t kMost = std::uint64_t{256}
                                << 20;  ///< bytes that a check takes, however much there is

std::vector<std::uint32_t> numbers(std::size_t count, std::uint32_t seed) {
  std::vector<std::uint32_t> values(count);
  for (std::uint32_t& value : values) value = seed = seed * 747796405U + 2891336453U;
  return values;
}

std::size_t differences(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return count;
}

Finding checkMap(Compute& compute) {
  const auto written = numbers(1 << 16, 1);
  const Buffer buffer = compute.upload("mapped", written);
  std::vector<std::uint32_t> seen(written.size());
  clTry("mapping a buffer", [&] {
    void* const at = compute.queue().enqueueMapBuffer(buffer.handle, CL_TRUE, CL_MAP_READ, 0, buffer.bytes);
    std::copy_n(static_cast<const std::uint32_t*>(at), seen.size(), seen.begin());
    compute.queue().enqueueUnmapMemObject(buffer.handle, at);
    compute.queue().finish();
  });
  return comparedFinding("mapping a buffer", differences(seen, written), written.size(), "written",
                         "pictures are read wrongly");
}

Finding checkLargest(Compute& compute) {
  const std::uint64_t bytes = std::min(compute.device().largestBuffer, kMost) / 4096 * 4096;
  const Buffer buffer = compute.allocate("largest", bytes);
  const auto written = numbers(1024, 2);
  const std::size_t part = written.size() * sizeof(std::uint32_t);
  std::vector<std::uint32_t> seen(written.size());
  std::size_t different = 0;
  for (const std::size_t offset : {std::size_t{0}, static_cast<std::size_t>(bytes) - part}) {
    compute.write(buffer, offset, std::as_bytes(std::span(written)));
    compute.read(buffer, offset, part, seen.data());
    different += differences(seen, written);
  }
  Finding finding = comparedFinding("large buffers", different, 2 * written.size(), "written",
                                    "large scenes are drawn wrongly");
  finding.seen += fmt::format(", at both ends of {} (the driver says {})", formatBytes(bytes),
                              formatBytes(compute.device().largestBuffer));
  return finding;
}

}  // namespace

std::vector<Finding> checkMemory(Compute& compute) { return {checkMap(compute), checkLargest(compute)}; }

std::vector<Finding> checkTwoQueues(Compute& compute) {
  return clTry("two queues on " + compute.device().name, [&]() -> std::vector<Finding> {
    cl::CommandQueue other(compute.queue().getInfo<CL_QUEUE_CONTEXT>(), compute.device().device);
    const auto written = numbers(1 << 14, 3);
    const Buffer from = compute.upload("from", written), to = compute.allocate("to", from.bytes);
    other.enqueueCopyBuffer(from.handle, to.handle, 0, 0, from.bytes);
    other.finish();
    std::vector<std::uint32_t> seen(written.size());
    compute.read(to, 0, to.bytes, seen.data());
    return {comparedFinding("two queues", differences(seen, written), written.size(), "written",
                            "the window shows what was there before")};
  });
}

}  // namespace whittle
