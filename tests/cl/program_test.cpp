// Buffers that name themselves in messages, and builds whose failures carry the log with the
// file's own lines.
#include "cl/program.h"

#include <gtest/gtest.h>

#include <numeric>

#include "cl/kernel_source.h"
#include "scene/byte_counts.h"
#include "support/temporary_sources.h"
#include "support/test_device.h"
#include "support/text.h"

namespace whittle {
namespace {

using test::contains;

template <typename Action>
std::string clErrorOf(Action action) {
  try {
    action();
  } catch (const ClError& e) {
    return e.what();
  }
  return "no ClError";
}

TEST(Compute, AllocationOverTheLimitNamesBufferSizeAndLimit) {
  Compute compute = test::openTestDevice();
  const std::uint64_t limit = compute.device().largestBuffer;
  const std::uint64_t tooMuch = limit + 4096;
  const std::string message = clErrorOf([&] { compute.allocate("rays of the test", tooMuch); });
  EXPECT_TRUE(contains(message, "'rays of the test'")) << message;
  EXPECT_TRUE(contains(message, formatBytes(tooMuch))) << message;
  EXPECT_TRUE(contains(message, formatBytes(limit))) << message;
  EXPECT_TRUE(contains(message, std::to_string(tooMuch))) << message;
  EXPECT_TRUE(contains(message, std::to_string(limit))) << message;
  EXPECT_TRUE(contains(message, compute.device().name)) << message;
  EXPECT_FALSE(contains(message, "\n")) << message;
}

TEST(Compute, QueueKeepsTimesOnlyWhereAsked) {
  for (const auto launches : {Compute::Launches::Timed, Compute::Launches::Untimed}) {
    Compute compute(test::testDevice(), Compute::Memory::Real, launches);
    const auto properties = compute.queue().getInfo<CL_QUEUE_PROPERTIES>();
    EXPECT_EQ((properties & CL_QUEUE_PROFILING_ENABLE) != 0, compute.timesLaunches());
    EXPECT_EQ(compute.timesLaunches(), launches == Compute::Launches::Timed);
  }
}

TEST(Compute, BuffersKeepTheirContents) {
  Compute compute = test::openTestDevice();
  std::vector<std::uint32_t> values(1000);
  std::iota(values.begin(), values.end(), 5U);
  const Buffer buffer = compute.upload("numbers", values);
  EXPECT_TRUE(buffer);
  EXPECT_EQ(buffer.bytes, 4000U);
  std::vector<std::uint32_t> part(10);
  compute.read(buffer, 990 * sizeof(std::uint32_t), 10 * sizeof(std::uint32_t), part.data());
  EXPECT_EQ(part, std::vector<std::uint32_t>(values.end() - 10, values.end()));
  compute.fillZero(buffer);
  std::vector<std::uint32_t> all(1000, 1);
  compute.read(buffer, 0, buffer.bytes, all.data());
  EXPECT_EQ(all, std::vector<std::uint32_t>(1000, 0));
  const Buffer empty = compute.upload("nothing", std::vector<float>{});
  EXPECT_FALSE(empty);
  compute.fillZero(empty);
  compute.read(empty, 0, 0, nullptr);
  const std::string message = clErrorOf([&] { compute.read(buffer, 4000, 4, all.data()); });
  EXPECT_TRUE(contains(message, "'numbers'")) << message;
}

/// On devices of both kinds of memory the same items, whole or in parts, come to every place.
TEST(Compute, ItemsAreMadeInPlaceOrInParts) {
  constexpr std::size_t kCount = 3'000'001;  // more than one part, and no whole number of them
  for (const bool shares : {false, true}) {
    DeviceInfo device = test::testDevice();
    if (shares && !device.sharesMemory) GTEST_SKIP() << device.name << " has memory of its own";
    device.sharesMemory = shares;
    Compute compute(device);
    const Buffer buffer = compute.allocate("squares", kCount * sizeof(std::uint32_t));
    EXPECT_EQ(buffer.shared != nullptr, shares);
    std::size_t made = 0;
    compute.writeItems<std::uint32_t>(buffer, kCount, [&](std::size_t first, std::span<std::uint32_t> items) {
      EXPECT_EQ(first, made);
      made += items.size();
      for (std::size_t i = 0; i < items.size(); ++i)
        items[i] = static_cast<std::uint32_t>((first + i) * (first + i));
    });
    EXPECT_EQ(made, kCount);
    std::vector<std::uint32_t> read(kCount);
    compute.read(buffer, 0, buffer.bytes, read.data());
    for (std::size_t i = 0; i < kCount; ++i) ASSERT_EQ(read[i], static_cast<std::uint32_t>(i * i)) << i;
  }
}

TEST(Compute, SharedMemoryOutlivesItsBufferWhileALaunchUsesIt) {
  Compute compute = test::openTestDevice();
  const cl::Program program = compute.build(
      "kernel void fill(global uint* out) { uint i = get_global_id(0); uint v = i;"
      " for (uint k = 0; k < 2000; ++k) v = v * 3u + 1u; out[i] = v; }",
      "", "a slow kernel");
  const std::size_t count = 1 << 21;
  const Buffer kept = compute.allocate("kept", count * sizeof(std::uint32_t));
  {
    const Buffer lost = compute.allocate("lost", count * sizeof(std::uint32_t));
    for (const Buffer* buffer : {&lost, &kept}) {
      cl::Kernel kernel(program, "fill");
      kernel.setArg(0, buffer->handle);
      compute.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(count));
    }
    compute.queue().flush();
  }  // its memory goes when the driver is done with it, not now
  std::vector<std::uint32_t> read(count);
  compute.read(kept, 0, kept.bytes, read.data());
  for (const std::size_t i : {std::size_t{0}, std::size_t{12345}, count - 1}) {
    auto v = static_cast<std::uint32_t>(i);
    for (int k = 0; k < 2000; ++k) v = v * 3U + 1U;
    EXPECT_EQ(read[i], v);
  }
}

/// The message in the first, the log in the second.
std::pair<std::string, std::string> buildErrorOf(Compute& compute, const std::string& source,
                                                 const std::string& options) {
  try {
    compute.build(source, options, "stage");
  } catch (const BuildError& e) {
    return {e.what(), e.log()};
  }
  return {"no BuildError", ""};
}

TEST(Compute, TheFirstErrorOfALog) {
  EXPECT_EQ(firstError("a.cl:1: warning: w\n  a.cl:2: error: e \na.cl:3: error: f\n"), "a.cl:2: error: e");
  EXPECT_EQ(firstError("\n\nsomething\nelse\n"), "something");
  EXPECT_EQ(firstError("\n"), "the compiler does not say why");
}

TEST(Compute, BuildFailureCarriesTheLogWithTheFilesOwnLines) {
  Compute compute = test::openTestDevice();
  const test::TemporarySources sources;
  sources.write("stage.cl",
                "#include \"lib/first.cl\"\n\n__kernel void stage(__global int* out) { out[0] = one(); }\n");
  sources.write("lib/first.cl", "#include \"lib/second.cl\"\nint one(void) { return two(); }\n");
  sources.write("lib/second.cl", "// a comment\n\nint two(void) { return thisIsNotDeclared; }\n");
  const std::string source = assembleKernelSource({"stage.cl"}, sources.folder());
  const auto [message, log] = buildErrorOf(compute, source, "-D SOME_OPTION=1");
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_TRUE(contains(message, "compiling stage on " + compute.device().name)) << message;
  EXPECT_TRUE(contains(message, "thisIsNotDeclared")) << message;
  EXPECT_TRUE(contains(message, "lib/second.cl:3")) << message;
  EXPECT_TRUE(contains(message, "CL_BUILD_PROGRAM_FAILURE")) << message;
  EXPECT_TRUE(contains(log, "SOME_OPTION") && contains(log, "lib/second.cl:3")) << log;

  sources.write("lib/second.cl", "int two(void) { return 2; }\n");
  sources.write("stage.cl",
                "#include \"lib/first.cl\"\n\n__kernel void stage(__global int* out) { out[0] = three(); }\n"
                "#include \"lib/second.cl\"\nint broken(void) { return alsoNotDeclared; }\n");
  const std::string second =
      buildErrorOf(compute, assembleKernelSource({"stage.cl"}, sources.folder()), "").second;
  EXPECT_TRUE(contains(second, "stage.cl:5")) << "after two includes\n" << second;
}

TEST(Compute, UnknownBuildOptionsAreAnErrorThatNamesThem) {
  Compute compute = test::openTestDevice();
  const std::string message =
      clErrorOf([&] { compute.build("__kernel void nothing(void) {}\n", "-this-is-no-option"); });
  EXPECT_TRUE(contains(message, "-this-is-no-option")) << message;
}

}  // namespace
}  // namespace whittle
