// FLIP for LDR pictures: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild 2020, HPG; section
// and equation numbers below are the paper's. All filters are sums of separable ones and are applied so;
// borders repeat the outermost pixel.
#include "image/flip.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <stdexcept>

#include "image/tone_map.h"

namespace whittle {
namespace {

using glm::dvec3;
using std::numbers::pi;

/// sRGB primaries with the D65 white (IEC 61966-2-1); columns are the primaries.
const glm::dmat3 kRgbToXyz(dvec3(10135552, 5226840, 474992) / 24577794.0,
                           dvec3(8788810, 17577620, 2929604) / 24577794.0,
                           dvec3(4435075, 1774030, 23358375) / 24577794.0);

/// One plane of doubles, row 0 at the top.
struct Plane {
  int width = 0, height = 0;
  std::vector<double> v;
};

/// A filter of 2·radius + 1 weights.
using Taps = std::vector<double>;

struct Filters {
  Taps luminance, redGreen;        // CSF, 4.1.1
  std::array<Taps, 2> blueYellow;  // two Gaussians
  Taps smooth, edge, point;        // features, 4.2
};

Taps gaussianTaps(int radius, double exponentPerPixel2) {
  Taps taps(2 * radius + 1);
  for (int i = -radius; i <= radius; ++i) taps[i + radius] = std::exp(-exponentPerPixel2 * i * i);
  return taps;
}

double sum(const Taps& taps) {
  double s = 0;
  for (const double t : taps) s += t;
  return s;
}

Taps scaled(Taps taps, double factor) {
  for (double& t : taps) t *= factor;
  return taps;
}

/// Positive weights sum to 1, negative ones to -1 (4.2).
Taps balanced(Taps taps) {
  double positive = 0, negative = 0;
  for (const double t : taps) (t > 0 ? positive : negative) += t;
  for (double& t : taps) t /= t > 0 ? positive : -negative;
  return taps;
}

/// Contrast sensitivity in space (Eq. 1-4, Table 1): a·sqrt(pi/b)·exp(-pi² x²/b), x in degrees.
void addContrastFilters(Filters& f, double ppd) {
  constexpr double kLuminanceB = 0.0047, kRedGreenB = 0.0053;
  constexpr std::array<double, 2> kBlueYellowA{34.1, 13.5}, kBlueYellowB{0.04, 0.025};
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kBlueYellowB[0] / (2 * pi * pi)) * ppd));
  const auto taps = [&](double b) { return gaussianTaps(radius, pi * pi / (b * ppd * ppd)); };
  f.luminance = scaled(taps(kLuminanceB), 1 / sum(taps(kLuminanceB)));
  f.redGreen = scaled(taps(kRedGreenB), 1 / sum(taps(kRedGreenB)));
  std::array<double, 2> factor{};
  double total = 0;
  for (int i = 0; i < 2; ++i) {
    f.blueYellow[i] = taps(kBlueYellowB[i]);
    factor[i] = kBlueYellowA[i] * std::sqrt(pi / kBlueYellowB[i]);
    total += factor[i] * sum(f.blueYellow[i]) * sum(f.blueYellow[i]);
  }
  for (int i = 0; i < 2; ++i) f.blueYellow[i] = scaled(f.blueYellow[i], std::sqrt(factor[i] / total));
}

/// First and second derivative of a Gaussian as wide as the eye's edge detectors, 0.082 degrees (4.2).
void addFeatureFilters(Filters& f, double ppd) {
  const double sigma = 0.5 * 0.082 * ppd;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const Taps gaussian = gaussianTaps(radius, 1 / (2 * sigma * sigma));
  f.smooth = scaled(gaussian, 1 / sum(gaussian));
  f.edge = f.point = gaussian;
  for (int i = -radius; i <= radius; ++i) {
    f.edge[i + radius] *= -i;
    f.point[i + radius] *= i * i / (sigma * sigma) - 1;
  }
  f.edge = balanced(f.edge);
  f.point = balanced(f.point);
}

Filters makeFilters(double ppd) {
  Filters f;
  addContrastFilters(f, ppd);
  addFeatureFilters(f, ppd);
  return f;
}

Plane filterRows(const Plane& in, const Taps& taps) {
  const int radius = static_cast<int>(taps.size() / 2), last = in.width - 1;
  Plane out{in.width, in.height, std::vector<double>(in.v.size())};
  tbb::parallel_for(0, in.height, [&](int y) {
    const double* row = &in.v[static_cast<std::size_t>(y) * in.width];
    for (int x = 0; x <= last; ++x) {
      double s = 0;
      for (int k = -radius; k <= radius; ++k) s += taps[k + radius] * row[std::clamp(x + k, 0, last)];
      out.v[static_cast<std::size_t>(y) * in.width + x] = s;
    }
  });
  return out;
}

Plane filterColumns(const Plane& in, const Taps& taps) {
  const int radius = static_cast<int>(taps.size() / 2), last = in.height - 1;
  Plane out{in.width, in.height, std::vector<double>(in.v.size())};
  tbb::parallel_for(0, in.height, [&](int y) {
    double* row = &out.v[static_cast<std::size_t>(y) * in.width];
    for (int k = -radius; k <= radius; ++k) {
      const double* from = &in.v[static_cast<std::size_t>(std::clamp(y + k, 0, last)) * in.width];
      for (int x = 0; x < in.width; ++x) row[x] += taps[k + radius] * from[x];
    }
  });
  return out;
}

Plane filter(const Plane& in, const Taps& across, const Taps& down) {
  return filterColumns(filterRows(in, across), down);
}

/// XYZ relative to the white, which is what both opponent spaces start from.
dvec3 relativeXyz(const dvec3& rgb) { return kRgbToXyz * rgb / (kRgbToXyz * dvec3(1)); }

/// Linearised CIELab (4.1.1): what the contrast filters act on.
dvec3 toYcxcz(const dvec3& rgb) {
  const dvec3 t = relativeXyz(rgb);
  return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

dvec3 fromYcxcz(const dvec3& c) {
  const double y = (c.x + 16) / 116;
  return glm::inverse(kRgbToXyz) * (dvec3(y + c.y / 500, y, y - c.z / 200) * (kRgbToXyz * dvec3(1)));
}

/// CIELab with chroma scaled by lightness (Hunt effect, Eq. 6).
dvec3 toHuntLab(const dvec3& rgb) {
  constexpr double kDelta = 6.0 / 29.0;
  dvec3 f = relativeXyz(rgb);
  for (int k = 0; k < 3; ++k) {
    f[k] = f[k] > kDelta * kDelta * kDelta ? std::cbrt(f[k]) : f[k] / (3 * kDelta * kDelta) + 4.0 / 29.0;
  }
  const double lightness = 116 * f.y - 16;
  return {lightness, 0.01 * lightness * 500 * (f.x - f.y), 0.01 * lightness * 200 * (f.y - f.z)};
}

/// Lightness and chroma apart (HyAB, Eq. 7): better than a Euclidean distance for large differences.
double hyab(const dvec3& a, const dvec3& b) {
  const dvec3 d = a - b;
  return std::abs(d.x) + std::hypot(d.y, d.z);
}

constexpr double kColorPower = 0.7, kFeaturePower = 0.5;

/// Compresses the upper end of the colour differences into [0.95, 1] (Eq. 8-9).
double redistribute(double difference, double largest) {
  constexpr double kShare = 0.4, kTop = 0.95;
  const double knee = kShare * largest;
  return difference < knee ? kTop / knee * difference
                           : kTop + (difference - knee) / (largest - knee) * (1 - kTop);
}

/// One picture prepared for the comparison.
struct Prepared {
  std::vector<dvec3> lab;  // filtered, Hunt-adjusted
  Plane edgeX, edgeY, pointX, pointY;
};

Prepared prepare(std::span<const std::uint8_t> bytes, int width, int height, const Filters& f) {
  const std::size_t count = static_cast<std::size_t>(width) * height;
  std::array<double, 256> linear{};
  for (int i = 0; i < 256; ++i) linear[i] = srgbDecode(i / 255.0);
  Plane y{width, height, std::vector<double>(count)}, cx = y, cz = y, luma = y;
  for (std::size_t i = 0; i < count; ++i) {
    const dvec3 c = toYcxcz({linear[bytes[i * 3]], linear[bytes[i * 3 + 1]], linear[bytes[i * 3 + 2]]});
    y.v[i] = c.x;
    cx.v[i] = c.y;
    cz.v[i] = c.z;
    luma.v[i] = (c.x + 16) / 116;
  }
  y = filter(y, f.luminance, f.luminance);
  cx = filter(cx, f.redGreen, f.redGreen);
  const Plane narrow = filter(cz, f.blueYellow[1], f.blueYellow[1]);
  cz = filter(cz, f.blueYellow[0], f.blueYellow[0]);
  Prepared p;
  p.lab.resize(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const dvec3 rgb = fromYcxcz({y.v[i], cx.v[i], cz.v[i] + narrow.v[i]});
    p.lab[i] = toHuntLab(glm::clamp(rgb, 0.0, 1.0));
  });
  p.edgeX = filter(luma, f.edge, f.smooth);
  p.edgeY = filter(luma, f.smooth, f.edge);
  p.pointX = filter(luma, f.point, f.smooth);
  p.pointY = filter(luma, f.smooth, f.point);
  return p;
}

/// Eq. 10-11: the larger of the two changes, as a power in [0, 1].
double featureDifference(const Prepared& a, const Prepared& b, std::size_t i) {
  const double edge =
      std::abs(std::hypot(a.edgeX.v[i], a.edgeY.v[i]) - std::hypot(b.edgeX.v[i], b.edgeY.v[i]));
  const double point =
      std::abs(std::hypot(a.pointX.v[i], a.pointY.v[i]) - std::hypot(b.pointX.v[i], b.pointY.v[i]));
  return std::min(1.0, std::pow(std::max(edge, point) / std::numbers::sqrt2, kFeaturePower));
}

}  // namespace

std::vector<double> flipMap(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, int width,
                            int height) {
  const std::size_t count = static_cast<std::size_t>(width) * height;
  if (a.size() != count * 3 || b.size() != count * 3)
    throw std::invalid_argument("flipMap: not width x height x 3 bytes");
  const Filters filters = makeFilters(kFlipPixelsPerDegree);
  const Prepared pa = prepare(a, width, height, filters), pb = prepare(b, width, height, filters);
  // Pure green against pure blue are the farthest apart that a screen can show (4.1.3).
  const double largest = std::pow(hyab(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1})), kColorPower);
  std::vector<double> map(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const double color = redistribute(std::pow(hyab(pa.lab[i], pb.lab[i]), kColorPower), largest);
    map[i] = std::pow(color, 1 - featureDifference(pa, pb, i));
  });
  return map;
}

double flipMean(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, int width, int height) {
  const std::vector<double> map = flipMap(a, b, width, height);
  double total = 0;
  for (int y = 0; y < height; ++y) {
    double row = 0;
    for (int x = 0; x < width; ++x) row += map[static_cast<std::size_t>(y) * width + x];
    total += row;
  }
  return total / static_cast<double>(map.size());
}

}  // namespace whittle
