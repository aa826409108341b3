// See sweep.h.
#include "scale/sweep.h"

namespace whittle {

std::vector<SweepPoint> sweepPoints(const Settings& base, const std::vector<Axis>& axes, bool oneAtATime) {
  std::vector<SweepPoint> points{{{}, base}};
  for (const Axis& axis : axes) {
    std::vector<SweepPoint> more;
    for (const SweepPoint& point : points) {
      // Of one at a time the first point alone, which has every axis at its first value, gets the others.
      const bool varies = !oneAtATime || &point == &points.front();
      for (const AxisValue& value : axis.values) {
        if (!varies && &value != &axis.values.front()) break;
        SweepPoint next = point;
        next.words.push_back(value.word);
        value.set(next.settings);
        more.push_back(std::move(next));
      }
    }
    points = std::move(more);
  }
  return points;
}

bool haveSamePicture(const Settings& a, const Settings& b) {
  return a.width == b.width && a.height == b.height && a.raysPerPixel == b.raysPerPixel &&
         a.device == b.device;
}

}  // namespace whittle
