// OpenCL failures as exceptions that say what was being done.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "cl/opencl.h"

namespace whittle {

/// A failed OpenCL call: what was being done, the call, the error's name and number.
class ClError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Kernels that do not compile: one line with the compiler's first error, and all that it said.
class BuildError : public ClError {
 public:
  BuildError(const std::string& doing, std::string log);
  const std::string& log() const { return log_; }

 private:
  std::string log_;
};

/// The first line of a compiler's log that is an error, else the first that says anything.
std::string firstError(const std::string& log);

/// CL_OUT_OF_RESOURCES and so on; "error -9999" for unknown numbers.
std::string clErrorName(cl_int error);

/// Runs `action`; an OpenCL error in it becomes a ClError that starts with `doing`.
template <typename Action>
decltype(auto) clTry(const std::string& doing, Action&& action) {
  try {
    return std::forward<Action>(action)();
  } catch (const cl::Error& e) {
    throw ClError(doing + ": " + e.what() + " failed with " + clErrorName(e.err()));
  }
}

}  // namespace whittle
