// A camera as the raygen kernel reads it.
#pragma once

#include "kernels/shared/layout.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// Camera and picture size for kernels. Steps between pixels are split into two floats each, so that a kernel
/// can compute an eye ray to twice a float's precision.
device::DeviceCamera cameraToDevice(const Camera& camera, const Settings& settings);

}  // namespace whittle
