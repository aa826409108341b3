// See kernel_arguments.h.
#include "wavefront/kernel_arguments.h"

namespace whittle {

void KernelArguments::set(std::size_t bytes, const void* value) {
  const cl_int error = clSetKernelArg(kernel_(), index_, bytes, value);
  if (error != CL_SUCCESS)
    throw ClError("setting argument " + std::to_string(index_) + " of kernel '" + name_ +
                  "': " + clErrorName(error));
  ++index_;
}

void KernelArguments::add(const Buffer& buffer) {
  const cl_mem handle = buffer ? buffer.handle() : nullptr;
  set(sizeof(cl_mem), buffer ? &handle : nullptr);
}

void KernelArguments::add(const SceneArgument& argument) {
  static const DeviceScene none;
  const DeviceScene& scene = argument.scene ? *argument.scene : none;
  std::apply([this](const auto&... each) { (add(each), ...); }, scene.arguments());
}

}  // namespace whittle
