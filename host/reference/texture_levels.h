// The smaller levels of textures, each the mean of the one before; README.md, "Footprints".
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle::reference {

enum class Encoding { Linear, Srgb };

/// What is averaged of an image.
struct Mean {
  Encoding encoding = Encoding::Linear;
  bool byAlpha = false;  ///< each texel's colour counts by its alpha
  auto operator<=>(const Mean&) const = default;
};

class TextureLevels {
 public:
  /// Of all images that materials read with a filter; none where the settings ask for none.
  TextureLevels(const Scene& scene, const Settings& settings);

  /// The levels of a slot's image, the image itself first; null: it is read as it is.
  const std::vector<const Image*>* of(const TextureSlot& slot, const Mean& mean) const;
  /// How many lookups there are along a footprint, at most.
  int probes() const { return probes_; }

 private:
  struct Pyramid {
    std::vector<Image> made;
    std::vector<const Image*> levels;
  };
  std::map<std::pair<int, Mean>, Pyramid> pyramids_;
  int probes_;
};

/// How the base colour is averaged: of what has holes only what is there counts.
Mean meanOfBaseColor(const Material& material);

/// The next smaller level.
Image smaller(const Image& image, const Mean& mean);

}  // namespace whittle::reference
