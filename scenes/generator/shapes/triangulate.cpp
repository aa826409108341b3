// Ear clipping (Meisters 1975); holes are first joined to the outer loop by bridges, as Eberly describes
// (Triangulation by Ear Clipping, 2002). Quadratic in the number of points, which are thousands here.
#include "shapes/triangulate.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace generator {
namespace {

struct LoopPoint {
  glm::dvec2 position;
  std::uint32_t index;
};
using Loop = std::vector<LoopPoint>;

/// Twice the signed area of a, b, c: above 0 where they run counter-clockwise.
double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool isInside(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

std::size_t rightmost(const Loop& loop) {
  const auto isLess = [](const LoopPoint& a, const LoopPoint& b) { return a.position.x < b.position.x; };
  return static_cast<std::size_t>(std::max_element(loop.begin(), loop.end(), isLess) - loop.begin());
}

/// Where the ray from `from` along +x first meets `outer`: the place, and the end of the edge that lies
/// farther right.
struct Sight {
  double x = std::numeric_limits<double>::infinity();
  std::size_t corner = 0;
};

Sight lookRight(const Loop& outer, glm::dvec2 from) {
  Sight sight;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const std::size_t j = (i + 1) % outer.size();
    const glm::dvec2 a = outer[i].position, b = outer[j].position;
    if (a.y > from.y || b.y < from.y || a.y == b.y) continue;  // what faces the hole runs upwards
    const double x = a.x + (from.y - a.y) / (b.y - a.y) * (b.x - a.x);
    if (x >= from.x && x < sight.x) sight = {x, a.x > b.x ? i : j};
  }
  if (sight.x == std::numeric_limits<double>::infinity()) throw std::logic_error("a hole outside its loop");
  return sight;
}

/// The point of `outer` that the rightmost point of a hole sees.
std::size_t bridgeEnd(const Loop& outer, glm::dvec2 from) {
  const Sight sight = lookRight(outer, from);
  const glm::dvec2 wall(sight.x, from.y), corner = outer[sight.corner].position;
  const bool isAbove = corner.y > from.y;
  std::size_t best = sight.corner;
  double bestSlope = std::numeric_limits<double>::infinity(), bestX = 0;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const glm::dvec2 p = outer[i].position;
    if (p.x < from.x || p == corner) continue;
    if (isAbove ? !isInside(p, from, wall, corner) : !isInside(p, from, corner, wall)) continue;
    const std::size_t n = outer.size();
    if (turn(outer[(i + n - 1) % n].position, p, outer[(i + 1) % n].position) >= 0) continue;  // not reflex
    const double slope = std::abs(p.y - from.y) / (p.x - from.x);
    if (slope < bestSlope || (slope == bestSlope && p.x < bestX)) {
      best = i;
      bestSlope = slope;
      bestX = p.x;
    }
  }
  return best;
}

void joinHole(Loop& outer, const Loop& hole) {
  const std::size_t start = rightmost(hole), end = bridgeEnd(outer, hole[start].position);
  Loop bridge;
  for (std::size_t i = 0; i <= hole.size(); ++i) bridge.push_back(hole[(start + i) % hole.size()]);
  bridge.push_back(outer[end]);
  outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(end) + 1, bridge.begin(), bridge.end());
}

bool isEar(const Loop& loop, std::size_t i) {
  const std::size_t n = loop.size();
  const glm::dvec2 a = loop[(i + n - 1) % n].position, b = loop[i].position, c = loop[(i + 1) % n].position;
  if (turn(a, b, c) <= 0) return false;
  const glm::dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
  for (const LoopPoint& other : loop) {
    const glm::dvec2 p = other.position;
    if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) continue;
    if (p != a && p != b && p != c && isInside(p, a, b, c)) return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<std::vector<glm::dvec2>>& loops) {
  std::vector<Loop> parts;
  std::uint32_t index = 0;
  for (const auto& positions : loops) {
    Loop& part = parts.emplace_back();
    for (const glm::dvec2& position : positions) part.push_back({position, index++});
  }
  Loop loop = parts[0];
  std::vector<Loop> holes(parts.begin() + 1, parts.end());
  std::stable_sort(holes.begin(), holes.end(), [](const Loop& a, const Loop& b) {
    return a[rightmost(a)].position.x > b[rightmost(b)].position.x;
  });
  for (const Loop& hole : holes) joinHole(loop, hole);

  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::size_t at = 0, failed = 0;
  while (loop.size() > 3) {
    at %= loop.size();
    if (!isEar(loop, at)) {
      if (++failed > loop.size()) throw std::logic_error("a loop that crosses itself has no triangles");
      ++at;
      continue;
    }
    failed = 0;
    const std::size_t n = loop.size();
    triangles.push_back({loop[(at + n - 1) % n].index, loop[at].index, loop[(at + 1) % n].index});
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(at));
    ++at;  // ears side by side, not a fan around one point
  }
  triangles.push_back({loop[0].index, loop[1].index, loop[2].index});
  return triangles;
}

}  // namespace generator
