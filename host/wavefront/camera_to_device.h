// The camera that was asked for, and as the raygen kernel reads it.
#pragma once

#include <cstddef>
#include <string>

#include "kernels/shared/layout.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// Camera and picture size for kernels. Steps between pixels are split into two floats each, so that a kernel
/// can compute an eye ray to twice a float's precision.
device::DeviceCamera cameraToDevice(const Camera& camera, const Settings& settings);

/// Index of the camera with this name or, where none is called so, at this index; throws InputError that
/// lists what there is.
std::size_t findCamera(const Scene& scene, const std::string& selector);

}  // namespace whittle
