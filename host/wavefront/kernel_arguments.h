// Sets the arguments of a kernel one after another.
#pragma once

#include <string>
#include <type_traits>

#include "cl/program.h"
#include "wavefront/stage_arguments.h"

namespace whittle {

class KernelArguments {
 public:
  /// `name`: for messages.
  KernelArguments(cl::Kernel& kernel, const char* name) : kernel_(kernel), name_(name) {}

  /// The next argument; throws ClError that says which. Empty buffers become null pointers, a scene
  /// all its parameters.
  void add(const Buffer& buffer);
  void add(const SceneArgument& argument);
  template <typename T>
  void add(const Global<T>& argument) {
    add(argument.buffer ? *argument.buffer : Buffer{});
  }
  template <typename T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    set(sizeof(T), &value);
  }

 private:
  void set(std::size_t bytes, const void* value);

  cl::Kernel& kernel_;
  const char* name_;
  cl_uint index_ = 0;
};

/// All arguments of a stage.
template <typename S>
void setArguments(cl::Kernel& kernel, const S& stage) {
  KernelArguments arguments(kernel, S::stage.facts.name);
  std::apply([&](const auto&... each) { (arguments.add(each), ...); }, stage.arguments());
}

}  // namespace whittle
