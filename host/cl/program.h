// A compute context on one device: queue, compiled program, kernels, buffers that know their names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cl/device.h"
#include "cl/error.h"

namespace whittle {

/// Device memory with a name, for messages and statistics. An empty one is passed
/// to kernels as a null pointer.
struct Buffer {
  std::string name;
  std::size_t bytes = 0;
  cl::Buffer handle;

  explicit operator bool() const { return bytes > 0; }
};

/// Owns the context and an in-order command queue of one device.
class Compute {
 public:
  /// Real: buffers are allocated. SizesOnly: they only know their names and sizes, and limits are checked.
  enum class Memory : std::uint8_t { Real, SizesOnly };
  /// Whether the command queue keeps the time of each launch (CL_QUEUE_PROFILING_ENABLE).
  enum class Launches : std::uint8_t { Timed, Untimed };

  explicit Compute(DeviceInfo device, Memory memory = Memory::Real, Launches launches = Launches::Timed);

  const DeviceInfo& device() const { return device_; }
  cl::CommandQueue& queue() { return queue_; }
  bool timesLaunches() const { return launches_ == Launches::Timed; }

  /// Allocates; throws ClError that names the buffer, its size and the device's limit.
  Buffer allocate(const std::string& name, std::size_t bytes);
  /// Allocates and fills from host memory; empty data gives an empty Buffer.
  Buffer upload(const std::string& name, const void* data, std::size_t bytes);
  template <typename T, typename Allocator>
  Buffer upload(const std::string& name, const std::vector<T, Allocator>& data) {
    return upload(name, data.data(), data.size() * sizeof(T));
  }
  /// Blocking copy of a whole buffer from the host.
  void write(const Buffer& buffer, const void* data);
  /// Its first `bytes` only.
  void write(const Buffer& buffer, const void* data, std::size_t bytes);
  /// From `offset` on.
  void write(const Buffer& buffer, std::size_t offset, std::span<const std::byte> bytes);
  /// Blocking copy to the host.
  void read(const Buffer& buffer, std::size_t offset, std::size_t bytes, void* out);
  void fillZero(const Buffer& buffer);

  /// Builds `source`, which messages call `name`; a failure throws BuildError. Warnings of the compiler are
  /// kept in buildLog().
  cl::Program build(const std::string& source, const std::string& options,
                    const std::string& name = "the kernels");
  const std::string& buildLog() const { return buildLog_; }
  /// A program from what binaryOf returned; nothing where the driver refuses it.
  std::optional<cl::Program> fromBinary(const std::vector<unsigned char>& binary);
  /// The device's code of a built program; on PoCL for work-groups of those sizes that were launched before.
  /// Throws ClError.
  std::vector<unsigned char> binaryOf(const cl::Program& program);

 private:
  DeviceInfo device_;
  Memory memory_;
  Launches launches_;
  cl::Context context_;
  cl::CommandQueue queue_;
  std::string buildLog_;
};

}  // namespace whittle
