// What a render takes of the machine's memory at its most, on a CPU device, whose buffers are this process's
// own. Sums of what lives at the same time, phase by phase; what belongs to no scene is measured.
#pragma once

#include <cstdint>

#include "render/plan.h"
#include "scene/memory_budget.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// The device's runtime with its compiler, its threads and kernels that are compiled already, beside
/// kProgramBytes.
inline constexpr std::uint64_t kRuntimeBytes = 20'000'000;
/// What the image codec and its libraries take, which EXR, JPEG to write and unusual images to read ask for.
inline constexpr std::uint64_t kCodecBytes = 118'000'000;
/// What compiling them takes besides, where they are not: the first render of a kind of scene.
inline constexpr std::uint64_t kCompilerBytes = 150'000'000;
/// For each triangle beside the scene's arrays, while the tree is built and uploaded.
inline constexpr std::uint64_t kTriangleBytes = 150;

/// Film and picture: all that grows with the number of pixels.
std::uint64_t pictureBytes(const Settings& settings);

/// The process's peak in a render of the plan with its kernels compiled already. `loadBytes`: the most that
/// was held while the scene was read (MemoryBudget::peak).
std::uint64_t peakBytes(const Scene& scene, const RenderPlan& plan, std::uint64_t loadBytes);

}  // namespace whittle
