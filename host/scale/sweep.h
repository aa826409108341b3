// The points of a sweep: settings that differ along named axes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/settings.h"

namespace whittle {

/// One value of an axis, as it was asked for, and what it does.
struct AxisValue {
  std::string word;
  std::function<void(Settings&)> set;
};

struct Axis {
  std::string name;  ///< of the option, without its hyphens
  std::vector<AxisValue> values;
};

struct SweepPoint {
  std::vector<std::string> words;  ///< of each axis, in their order
  Settings settings;
};

/// Every combination of the values, the last axis fastest; or, `oneAtATime`, the first value of each, and
/// then every other value of one axis with the others at their first. The first point has the first values:
/// the others are compared with it.
std::vector<SweepPoint> sweepPoints(const Settings& base, const std::vector<Axis>& axes, bool oneAtATime);

/// Whether two points must have the same picture: neither its size nor its samples nor the device differ.
bool haveSamePicture(const Settings& a, const Settings& b);

}  // namespace whittle
