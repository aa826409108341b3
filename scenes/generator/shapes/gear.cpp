// Polygons of teeth in polar coordinates, then rounded.
#include "shapes/gear.h"

#include <array>
#include <cmath>
#include <numbers>

namespace generator {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

glm::dvec2 polar(double radius, double angle) {
  return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

/// A point of a tooth: radius, and angle in pitches from the middle of the tooth.
struct ToothPoint {
  double radius, pitches;
};

template <std::size_t N>
std::vector<glm::dvec2> around(int teeth, const std::array<ToothPoint, N>& tooth) {
  std::vector<glm::dvec2> points;
  for (int i = 0; i < teeth; ++i) {
    for (const ToothPoint& p : tooth) points.push_back(polar(p.radius, kTurn * (i + p.pitches) / teeth));
  }
  return points;
}

}  // namespace

Outline gearOutline(const GearSpec& spec) {
  const double r = spec.pitchRadius, tip = spec.tipRadius(), root = spec.rootRadius();
  // The point above the pitch circle is a parabola, cut off at a third of the tooth's width.
  constexpr double kHalf = 0.24;
  const auto ogive = [&](double s) { return ToothPoint{r + s * (tip - r), kHalf * (1 - 0.68 * s * s)}; };
  std::array<ToothPoint, 12> tooth{};
  const std::array<ToothPoint, 6> flank{
      {{root, kHalf}, {r, kHalf}, ogive(0.4), ogive(0.7), ogive(0.9), ogive(1)}};
  for (std::size_t i = 0; i < 6; ++i) {
    tooth[i] = {flank[i].radius, -flank[i].pitches};
    tooth[11 - i] = flank[i];
  }
  return roundCorners(withRadius(around(spec.teeth, tooth), 0.18 * spec.module()), true, 0.5);
}

Outline escapeOutline(int teeth, double tipRadius) {
  const std::array<ToothPoint, 6> tooth{{{0.72 * tipRadius, -0.42},
                                         {0.80 * tipRadius, -0.20},
                                         {0.97 * tipRadius, -0.06},
                                         {tipRadius, 0.10},
                                         {0.93 * tipRadius, 0.13},
                                         {0.72 * tipRadius, 0.26}}};
  return roundCorners(withRadius(around(teeth, tooth), 0.02 * tipRadius), true, 0.4);
}

std::vector<Outline> spokeHoles(int spokes, double hubRadius, double rimRadius, double spokeWidth,
                                double cornerRadius) {
  constexpr int kArcPoints = 12;
  std::vector<Outline> holes;
  for (int i = 0; i < spokes; ++i) {
    std::vector<Corner> corners;
    const auto addArc = [&](double radius, double from, double to) {
      // The spoke's sides are parallel: half its width is a larger angle nearer to the hub.
      for (int k = 0; k <= kArcPoints; ++k) {
        const bool isEnd = k == 0 || k == kArcPoints;
        const glm::dvec2 p = polar(radius, from + (to - from) * k / kArcPoints);
        corners.push_back({p.x, p.y, isEnd ? cornerRadius : radius});
      }
    };
    const double start = kTurn * i / spokes, end = kTurn * (i + 1) / spokes;
    const double atRim = std::asin(0.5 * spokeWidth / rimRadius),
                 atHub = std::asin(0.5 * spokeWidth / hubRadius);
    addArc(rimRadius, start + atRim, end - atRim);
    addArc(hubRadius, end - atHub, start + atHub);
    holes.push_back(reversed(roundCorners(corners, true, 0.3)));
  }
  return holes;
}

}  // namespace generator
