// The auxiliary outputs of a render, by name.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/preparation.h"
#include "render/sampling_loop.h"
#include "scene/settings.h"
#include "wavefront/pixel_recorder.h"

namespace whittle {

/// As RenderResult::aovs has them.
inline const std::vector<std::string> kAovNames{"depth",   "normal", "albedo", "primitive",
                                                "samples", "error",  "bounce", "cost"};

/// Has the render keep this one; more may come with it. Throws std::invalid_argument for another name.
void askForAov(Settings& settings, const std::string& name);
/// All that the settings allow: the error takes two rays for each pixel.
void askForAllAovs(Settings& settings);

/// What was asked for, as RenderResult::aovs has it; `recorder`: there for bounces and costs.
std::map<std::string, FloatImage> readAovs(Compute& compute, const Settings& settings,
                                           const PictureBuffers& picture, SamplingLoop& loop,
                                           const std::optional<PixelRecorder>& recorder);

}  // namespace whittle
