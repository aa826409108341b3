// A compute context on one device: queue, compiled program, kernels, buffers that know their names.
#pragma once

#include <algorithm>
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
  /// Its memory, where host and device share it: may be written until the first launch that is given the
  /// buffer. Else null.
  std::byte* shared = nullptr;

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
  /// Of its device, found out by trying (cl/device_facts.h).
  void know(const DeviceFacts& facts) { device_.facts = facts; }
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
  /// Makes `count` items of type T: `make(first, items)` writes items [first, first + items.size()), in place
  /// where the memory is shared, else some at a time, which are then copied. Items hold anything before.
  /// Blocking.
  template <typename T, typename Make>
  void writeItems(const Buffer& buffer, std::size_t count, const Make& make) {
    if (!buffer.handle()) return;
    if (buffer.shared) return make(std::size_t{0}, std::span(reinterpret_cast<T*>(buffer.shared), count));
    constexpr std::size_t kAtOnce = 1 << 16;
    std::vector<T> part(std::min(kAtOnce, count));
    for (std::size_t first = 0; first < count; first += kAtOnce) {
      const std::span<T> items(part.data(), std::min(kAtOnce, count - first));
      make(first, items);
      write(buffer, first * sizeof(T), std::as_bytes(items));
    }
  }

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
  Buffer allocateShared(const std::string& name, std::size_t bytes);

  DeviceInfo device_;
  Memory memory_;
  Launches launches_;
  cl::Context context_;
  cl::CommandQueue queue_;
  std::string buildLog_;
};

}  // namespace whittle
