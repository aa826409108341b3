// Context, buffers and program of one device.
#include "cl/program.h"

#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "scene/byte_counts.h"

namespace whittle {

Compute::Compute(DeviceInfo device, Memory memory, Launches launches)
    : device_(std::move(device)), memory_(memory), launches_(launches) {
  clTry("opening " + device_.name, [&] {
    context_ = cl::Context(device_.device);
    queue_ = cl::CommandQueue(context_, device_.device, timesLaunches() ? CL_QUEUE_PROFILING_ENABLE : 0);
  });
}

Buffer Compute::allocate(const std::string& name, std::size_t bytes) {
  if (bytes == 0) return {};
  if (bytes > device_.largestBuffer)
    // Bytes as well: just above the limit both are the same number of gigabytes.
    throw ClError(fmt::format("buffer '{}' needs {} ({} bytes) but {} allows {} ({} bytes) in one allocation",
                              name, formatBytes(bytes), bytes, device_.name,
                              formatBytes(device_.largestBuffer), device_.largestBuffer));
  if (memory_ == Memory::SizesOnly) return {name, bytes, {}};
  return clTry(fmt::format("allocating buffer '{}' of {}", name, formatBytes(bytes)), [&] {
    if (device_.sharesMemory)
      if (Buffer shared = allocateShared(name, bytes)) return shared;
    return Buffer{name, bytes, cl::Buffer(context_, CL_MEM_READ_WRITE, bytes)};
  });
}

/// Empty where there is no memory left: what the driver then says of its own is told.
Buffer Compute::allocateShared(const std::string& name, std::size_t bytes) {
  constexpr std::size_t kPage = 4096;  // what drivers take as it is, whatever else they copy
  if (bytes > ~std::size_t{0} - kPage) return {};
  std::unique_ptr<void, decltype(&std::free)> memory(
      std::aligned_alloc(kPage, (bytes + kPage - 1) / kPage * kPage), &std::free);
  if (!memory) return {};
  Buffer buffer{name, bytes,
                cl::Buffer(context_, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, memory.get()),
                static_cast<std::byte*>(memory.get())};
  // Launches may still be under way when the last handle goes: the driver says when it needs the memory no
  // more.
  buffer.handle.setDestructorCallback([](cl_mem, void* own) { std::free(own); }, memory.get());
  static_cast<void>(memory.release());  // the driver has it
  return buffer;
}

Buffer Compute::upload(const std::string& name, const void* data, std::size_t bytes) {
  Buffer buffer = allocate(name, bytes);
  write(buffer, data);
  return buffer;
}

void Compute::write(const Buffer& buffer, const void* data) { write(buffer, data, buffer.bytes); }

void Compute::write(const Buffer& buffer, const void* data, std::size_t bytes) {
  write(buffer, 0, {static_cast<const std::byte*>(data), bytes});
}

void Compute::write(const Buffer& buffer, std::size_t offset, std::span<const std::byte> bytes) {
  if (!buffer.handle() || bytes.empty()) return;
  clTry(fmt::format("uploading '{}'", buffer.name),
        [&] { queue_.enqueueWriteBuffer(buffer.handle, CL_TRUE, offset, bytes.size(), bytes.data()); });
}

void Compute::read(const Buffer& buffer, std::size_t offset, std::size_t bytes, void* out) {
  if (bytes == 0) return;
  clTry(fmt::format("reading '{}' back", buffer.name),
        [&] { queue_.enqueueReadBuffer(buffer.handle, CL_TRUE, offset, bytes, out); });
}

void Compute::fillZero(const Buffer& buffer) {
  if (!buffer.handle()) return;
  clTry(fmt::format("clearing '{}'", buffer.name), [&] {
    queue_.enqueueFillBuffer(buffer.handle, cl_uint{0}, 0, buffer.bytes / sizeof(cl_uint) * sizeof(cl_uint));
  });
}

cl::Program Compute::build(const std::string& source, const std::string& options, const std::string& name) {
  const std::string doing = "compiling " + name;
  return clTry(doing, [&] {
    cl::Program program(context_, source);
    try {
      program.build({device_.device}, options.c_str());
    } catch (const cl::Error& e) {
      std::string log;
      if (e.err() == CL_BUILD_PROGRAM_FAILURE)
        log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device_.device);
      const std::string failed =
          fmt::format("{} on {} failed with {}", doing, device_.name, clErrorName(e.err()));
      throw BuildError(failed, fmt::format("{}\noptions: {}\n", log, options));
    }
    buildLog_ = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device_.device);
    return program;
  });
}

std::optional<cl::Program> Compute::fromBinary(const std::vector<unsigned char>& binary) {
  try {
    cl::Program program(context_, {device_.device}, {binary});
    program.build({device_.device});
    return program;
  } catch (const cl::Error&) {
    return std::nullopt;
  }
}

std::vector<unsigned char> Compute::binaryOf(const cl::Program& program) {
  return clTry("reading a program's binary", [&] {
    auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
    return binaries.empty() ? std::vector<unsigned char>() : std::move(binaries.front());
  });
}

}  // namespace whittle
