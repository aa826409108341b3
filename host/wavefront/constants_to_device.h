// What kernels get of a render by value.
#pragma once

#include "kernels/shared/layout.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// `camera`: the one that the picture is seen by.
device::RenderConstants constantsToDevice(const Scene& scene, const Camera& camera, const Settings& settings);

}  // namespace whittle
