// Values between keyframes: glTF 2.0, 3.11 and appendix C. Knows nothing of files.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace whittle::gltf {

enum class Interpolation { Step, Linear, CubicSpline };

/// As a file names it; nothing for other names.
std::optional<Interpolation> interpolationCalled(std::string_view name);

/// What becomes of values half way: their mean, or, of unit quaternions, the turn half way.
enum class Blend { Straight, Turn };

struct Keyframes {
  Interpolation interpolation = Interpolation::Linear;
  Blend blend = Blend::Straight;
  std::vector<float> times;   ///< seconds, finite, not falling, one at least
  std::vector<float> values;  ///< `width` of each; of splines in-tangents, values, out-tangents
  std::size_t width = 0;
};

/// `width` values; before the first keyframe and after the last one, theirs. Of Blend::Turn a quaternion of
/// length 1 (x, y, z, w), or the file's where that has no length.
std::vector<double> valueAt(const Keyframes& keys, double seconds);

}  // namespace whittle::gltf
