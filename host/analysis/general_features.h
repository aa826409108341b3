// The general programs: compiled once for a machine, and good for nearly every scene. A scene starts on one
// of them while its own program, which leaves out what it does not need, is not there yet.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "analysis/scene_features.h"
#include "scene/settings.h"

namespace whittle {

struct GeneralProgram {
  const char* name = "";  ///< for people
  std::uint64_t features = 0;
};

/// From the fastest to the one that can most: what files ask for; what options ask for as well (lights of
/// some size, glowing surfaces and skies that light others, gloss, a lens, a cut-off, auxiliary outputs).
/// `packets`: for a device that they suit (DeviceTraits).
std::array<GeneralProgram, 2> generalPrograms(bool packets);

/// The first of them that draws a scene of `features` with the same bits: it has them all, and what it has
/// besides neither goes against a setting nor does anything where nothing asks for it. Nothing: there is
/// none.
std::optional<GeneralProgram> generalProgramFor(const SceneFeatures& features, const Settings& settings);

/// Features for whose buffers room is made where a general program runs, though the scene has no use for
/// them: it searches the tree, reads triangles' corners, and its queues have these planes.
std::uint64_t generalBufferFeatures(const GeneralProgram& program);

}  // namespace whittle
