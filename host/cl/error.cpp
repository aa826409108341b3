// Names of OpenCL errors.
#include "cl/error.h"

#include <array>
#include <sstream>

namespace whittle {

BuildError::BuildError(const std::string& doing, std::string log)
    : ClError(doing + ": " + firstError(log)), log_(std::move(log)) {}

std::string firstError(const std::string& log) {
  std::istringstream lines(log);
  std::string first;
  for (std::string line; std::getline(lines, line);) {
    line.erase(0, line.find_first_not_of(" \t"));
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.find("error:") != std::string::npos) return line;
    if (first.empty()) first = line;
  }
  return first.empty() ? "the compiler does not say why" : first;
}

std::string clErrorName(cl_int error) {
  struct Named {
    cl_int code;
    const char* name;
  };
#define NAMED(code) \
  Named { code, #code }
  static const std::array kNames{NAMED(CL_SUCCESS),
                                 NAMED(CL_DEVICE_NOT_FOUND),
                                 NAMED(CL_DEVICE_NOT_AVAILABLE),
                                 NAMED(CL_COMPILER_NOT_AVAILABLE),
                                 NAMED(CL_MEM_OBJECT_ALLOCATION_FAILURE),
                                 NAMED(CL_OUT_OF_RESOURCES),
                                 NAMED(CL_OUT_OF_HOST_MEMORY),
                                 NAMED(CL_PROFILING_INFO_NOT_AVAILABLE),
                                 NAMED(CL_BUILD_PROGRAM_FAILURE),
                                 NAMED(CL_COMPILE_PROGRAM_FAILURE),
                                 NAMED(CL_INVALID_VALUE),
                                 NAMED(CL_INVALID_DEVICE),
                                 NAMED(CL_INVALID_CONTEXT),
                                 NAMED(CL_INVALID_COMMAND_QUEUE),
                                 NAMED(CL_INVALID_MEM_OBJECT),
                                 NAMED(CL_INVALID_BINARY),
                                 NAMED(CL_INVALID_BUILD_OPTIONS),
                                 NAMED(CL_INVALID_PROGRAM),
                                 NAMED(CL_INVALID_PROGRAM_EXECUTABLE),
                                 NAMED(CL_INVALID_KERNEL_NAME),
                                 NAMED(CL_INVALID_KERNEL_DEFINITION),
                                 NAMED(CL_INVALID_KERNEL),
                                 NAMED(CL_INVALID_ARG_INDEX),
                                 NAMED(CL_INVALID_ARG_VALUE),
                                 NAMED(CL_INVALID_ARG_SIZE),
                                 NAMED(CL_INVALID_KERNEL_ARGS),
                                 NAMED(CL_INVALID_WORK_DIMENSION),
                                 NAMED(CL_INVALID_WORK_GROUP_SIZE),
                                 NAMED(CL_INVALID_WORK_ITEM_SIZE),
                                 NAMED(CL_INVALID_GLOBAL_OFFSET),
                                 NAMED(CL_INVALID_EVENT),
                                 NAMED(CL_INVALID_OPERATION),
                                 NAMED(CL_INVALID_BUFFER_SIZE),
                                 NAMED(CL_INVALID_GLOBAL_WORK_SIZE),
                                 Named{-1001, "CL_PLATFORM_NOT_FOUND_KHR"}};
#undef NAMED
  for (const auto& n : kNames)
    if (n.code == error) return std::string(n.name) + " (" + std::to_string(error) + ")";
  return "error " + std::to_string(error);
}

}  // namespace whittle
