// What `whittle info` says of features: needed, kept, left out and why.
#pragma once

#include <string>

#include "analysis/scene_features.h"

namespace whittle::cli {

/// Sections of at most 80 columns, each after an empty line.
std::string featuresText(const SceneFeatures& features);

}  // namespace whittle::cli
