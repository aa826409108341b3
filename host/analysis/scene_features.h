// What a scene with these settings needs, decided in one place: drives the kernels compiled, the stages
// launched and the buffers allocated, and is what `whittle info` prints.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/feature.h"
#include "analysis/pruned_scene.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// What only the device decides.
struct DeviceTraits {
  bool packets = true;  ///< packets of sixteen suit its vector units
};

struct FeatureLine {
  Feature feature;
  std::string text;  ///< what a person calls it
  bool used = false;
  std::string reason;    ///< why it is left out, or empty
  bool forced = false;   ///< used only because it was asked for, or because one that was needs it
  std::string neededBy;  ///< that one, or empty
};

class SceneFeatures {
 public:
  SceneFeatures() = default;

  bool has(Feature feature) const { return (bits_ >> static_cast<int>(feature)) & 1U; }
  std::uint64_t bits() const { return bits_; }
  const std::vector<FeatureLine>& lines() const { return lines_; }

  /// Exactly these; no lines.
  static SceneFeatures ofBits(std::uint64_t bits) {
    SceneFeatures features;
    features.bits_ = bits;
    return features;
  }
  /// Derives the features of what goes to the device. settings.keepAllFeatures switches everything on that
  /// does not contradict the settings, settings.keepFeatures these and what they need (feature_needs.h).
  static SceneFeatures analyse(const Scene& scene, const PrunedScene& pruned, const Settings& settings,
                               const DeviceTraits& traits);
  /// The same where nothing else asks what goes to the device.
  static SceneFeatures analyse(const Scene& scene, const Settings& settings, const DeviceTraits& traits) {
    return analyse(scene, pruneScene(scene, settings), settings, traits);
  }

 private:
  std::uint64_t bits_ = 0;
  std::vector<FeatureLine> lines_;
};

/// Hits that a path may have at most: the settings' bounces, and where rays go straight on the surfaces that
/// they pass besides.
inline int mostHits(const SceneFeatures& features, const Settings& settings) {
  return settings.bounces + (features.has(Feature::STRAIGHT) ? settings.transparentBounces : 0);
}

/// Below this many triangles `--search auto` takes the array: measured crossing, see experiments/.
inline constexpr std::size_t kArrayBelowTriangles = 12;

}  // namespace whittle
