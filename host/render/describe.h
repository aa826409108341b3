// What each part of a render contributes to its statistics.
#pragma once

#include "analysis/radiance_bound.h"
#include "cl/device.h"
#include "render/preparation.h"
#include "render/sampling_loop.h"
#include "report/stats.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "wavefront/wavefront.h"

namespace whittle {

void describeScene(Stats& stats, const Scene& scene);
/// `threads`: as set; 0: all that the device has.
void describeDevice(Stats& stats, const DeviceInfo& device, int threads);
/// Search, features and what was pruned.
void describeDecisions(Stats& stats, const Decisions& decisions);
/// Counts, samples, error, and what ended. Reads a counter of the device.
void describeRays(Stats& stats, BiasBound& bias, Wavefront& wavefront, const SamplingLoop& loop);

}  // namespace whittle
