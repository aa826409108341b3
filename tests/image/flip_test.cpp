// FLIP: its identities, flat pictures by hand from published CIELab values, and a slow twin that filters in
// two dimensions.
#include "image/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace whittle {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr double kPi = 3.14159265358979323846;

Bytes flat(int width, int height, std::array<std::uint8_t, 3> color) {
  Bytes bytes;
  for (int i = 0; i < width * height; ++i) bytes.insert(bytes.end(), color.begin(), color.end());
  return bytes;
}

/// Grey 128 plus noise of the given size from a linear congruential generator.
Bytes noisy(int width, int height, int amplitude) {
  Bytes bytes;
  std::uint32_t state = 12345;
  for (int i = 0; i < width * height * 3; ++i) {
    state = state * 1664525U + 1013904223U;
    bytes.push_back(
        static_cast<std::uint8_t>(128 + static_cast<int>(state >> 16U) % (2 * amplitude + 1) - amplitude));
  }
  return bytes;
}

/// sRGB green and blue in CIELab under D65 as published (Lindbloom): L, a, b.
constexpr std::array<double, 3> kGreenLab{87.737, -86.185, 83.181}, kBlueLab{32.303, 79.197, -107.864};

/// FLIP of two flat greys whose lightnesses differ by dL: no chroma, no edges; formulas of section 4.1.
double flatGreyFlip(double dL) {
  const double da = 0.01 * (kGreenLab[0] * kGreenLab[1] - kBlueLab[0] * kBlueLab[1]);
  const double db = 0.01 * (kGreenLab[0] * kGreenLab[2] - kBlueLab[0] * kBlueLab[2]);
  const double largest = std::pow(kGreenLab[0] - kBlueLab[0] + std::hypot(da, db), 0.7);
  const double e = std::pow(dL, 0.7), knee = 0.4 * largest;
  return e < knee ? 0.95 * e / knee : 0.95 + 0.05 * (e - knee) / (largest - knee);
}

TEST(Flip, flatGreysMatchTheFormulas) {
  // Lightness of code 119 is 50.03 (CIELab of sRGB (119, 119, 119)). The published Lab values carry three
  // decimals, and the sixth decimal of the white point differs between sources: 2e-3 covers both.
  const auto flipOf = [](std::uint8_t a, std::uint8_t b) {
    return flipMean(flat(20, 12, {a, a, a}), flat(20, 12, {b, b, b}), 20, 12);
  };
  EXPECT_NEAR(flipOf(0, 255), flatGreyFlip(100), 2e-3);
  EXPECT_NEAR(flipOf(119, 255), flatGreyFlip(100 - 50.03), 2e-3);
  EXPECT_NEAR(flipOf(0, 119), flatGreyFlip(50.03), 2e-3);
  EXPECT_GT(flipOf(0, 255), 0.9);
}

TEST(Flip, greenAgainstBlueIsTheWorst) {
  // Flat and farthest apart by the paper's own choice: exactly 1 but for rounding.
  EXPECT_NEAR(flipMean(flat(9, 9, {0, 255, 0}), flat(9, 9, {0, 0, 255}), 9, 9), 1, 1e-9);
}

TEST(Flip, isZeroForEqualAndSymmetricAndBounded) {
  const Bytes a = noisy(40, 30, 100), b = noisy(40, 30, 20);
  for (const double v : flipMap(a, a, 40, 30)) EXPECT_EQ(v, 0);
  const std::vector<double> ab = flipMap(a, b, 40, 30), ba = flipMap(b, a, 40, 30);
  EXPECT_EQ(ab, ba);
  for (const double v : ab) {
    EXPECT_GE(v, 0);
    EXPECT_LE(v, 1);
  }
}

TEST(Flip, growsWithNoise) {
  const Bytes clean = flat(48, 32, {128, 128, 128});
  double last = 0;
  for (const int amplitude : {2, 8, 32, 100}) {
    const double now = flipMean(clean, noisy(48, 32, amplitude), 48, 32);
    EXPECT_GT(now, 1.2 * last) << amplitude;
    last = now;
  }
}

// The twin: one pixel at a time, straight from the paper, kernels in two dimensions.
namespace twin {

using Vec = std::array<double, 3>;
constexpr double kPpd = 67;
constexpr double kXyz[3][3] = {
    {0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}};
constexpr Vec kWhite{0.9504700, 1.0, 1.0888300};

double decode(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

struct Picture {
  const Bytes& bytes;
  int width, height;

  Vec ycxcz(int x, int y) const {
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    Vec t{};
    for (int row = 0; row < 3; ++row) {
      for (int c = 0; c < 3; ++c)
        t[row] += kXyz[row][c] * decode(bytes[(y * width + x) * 3 + c] / 255.0) / kWhite[row];
    }
    return {116 * t[1] - 16, 500 * (t[0] - t[1]), 200 * (t[1] - t[2])};
  }
};

double contrast(int channel, double degrees2) {
  const auto lobe = [&](double a, double b) {
    return a * std::sqrt(kPi / b) * std::exp(-kPi * kPi * degrees2 / b);
  };
  if (channel == 0) return lobe(1, 0.0047);
  if (channel == 1) return lobe(1, 0.0053);
  return lobe(34.1, 0.04) + lobe(13.5, 0.025);
}

Vec huntLab(const Picture& p, int x, int y) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * kPpd));
  Vec sum{}, weight{};
  for (int j = -radius; j <= radius; ++j) {
    for (int i = -radius; i <= radius; ++i) {
      const Vec c = p.ycxcz(x + i, y + j);
      for (int k = 0; k < 3; ++k) {
        const double w = contrast(k, (i * i + j * j) / (kPpd * kPpd));
        sum[k] += w * c[k];
        weight[k] += w;
      }
    }
  }
  for (int k = 0; k < 3; ++k) sum[k] /= weight[k];
  // Back to linear RGB, limited to what a screen shows, and on to CIELab. Inverse matrix as published
  // (Lindbloom, sRGB, D65).
  constexpr double kRgb[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                 {-0.9692660, 1.8760108, 0.0415560},
                                 {0.0556434, -0.2040259, 1.0572252}};
  const double yy = (sum[0] + 16) / 116;
  const Vec xyz{(yy + sum[1] / 500) * kWhite[0], yy, (yy - sum[2] / 200) * kWhite[2]};
  Vec rgb{}, f{};
  for (int r = 0; r < 3; ++r)
    rgb[r] = std::clamp(kRgb[r][0] * xyz[0] + kRgb[r][1] * xyz[1] + kRgb[r][2] * xyz[2], 0.0, 1.0);
  for (int r = 0; r < 3; ++r) {
    const double t = (kXyz[r][0] * rgb[0] + kXyz[r][1] * rgb[1] + kXyz[r][2] * rgb[2]) / kWhite[r];
    f[r] = t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  }
  const double l = 116 * f[1] - 16;
  return {l, 0.01 * l * 500 * (f[0] - f[1]), 0.01 * l * 200 * (f[1] - f[2])};
}

/// Length of the answer to the edge (order 1) or point (order 2) detector.
double feature(const Picture& p, int x, int y, int order) {
  const double sigma = 0.5 * 0.082 * kPpd;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const auto weight = [&](int i, int j) {
    const double g = std::exp(-(i * i + j * j) / (2 * sigma * sigma));
    return order == 1 ? -i * g : (i * i / (sigma * sigma) - 1) * g;
  };
  double positive = 0, negative = 0;
  for (int j = -radius; j <= radius; ++j) {
    for (int i = -radius; i <= radius; ++i) (weight(i, j) > 0 ? positive : negative) += weight(i, j);
  }
  double across = 0, down = 0;
  for (int j = -radius; j <= radius; ++j) {
    for (int i = -radius; i <= radius; ++i) {
      const double w = weight(i, j) / (weight(i, j) > 0 ? positive : -negative);
      across += w * (p.ycxcz(x + i, y + j)[0] + 16) / 116;
      down += w * (p.ycxcz(x + j, y + i)[0] + 16) / 116;
    }
  }
  return std::hypot(across, down);
}

double flip(const Picture& a, const Picture& b, int x, int y) {
  const Vec la = huntLab(a, x, y), lb = huntLab(b, x, y);
  const Bytes greenByte{0, 255, 0}, blueByte{0, 0, 255};
  const Vec green = huntLab({greenByte, 1, 1}, 0, 0), blue = huntLab({blueByte, 1, 1}, 0, 0);
  const auto distance = [](const Vec& p, const Vec& q) {
    return std::pow(std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]), 0.7);
  };
  const double largest = distance(green, blue), e = distance(la, lb), knee = 0.4 * largest;
  const double color = e < knee ? 0.95 * e / knee : 0.95 + 0.05 * (e - knee) / (largest - knee);
  const double edges = std::abs(feature(a, x, y, 1) - feature(b, x, y, 1));
  const double points = std::abs(feature(a, x, y, 2) - feature(b, x, y, 2));
  return std::pow(color, 1 - std::sqrt(std::max(edges, points) / std::sqrt(2.0)));
}

}  // namespace twin

TEST(Flip, matchesTheTwoDimensionalTwin) {
  constexpr int kWidth = 26, kHeight = 22;
  Bytes a = noisy(kWidth, kHeight, 40), b = noisy(kWidth, kHeight, 15);
  for (int y = 6; y < 15; ++y) {
    for (int x = 4; x < 13; ++x) {  // a red square in one, a shifted blue one in the other
      a[(y * kWidth + x) * 3] = 250;
      b[(y * kWidth + x + 5) * 3 + 2] = 240;
    }
  }
  const std::vector<double> map = flipMap(a, b, kWidth, kHeight);
  for (int y = 0; y < kHeight; y += 3) {
    for (int x = 0; x < kWidth; x += 5) {
      // The two use matrices of different numbers of decimals (7 here): 5e-8 in XYZ is at most 3e-5 in chroma
      // and 1e-4 after the way there and back, on differences of 1 and more.
      EXPECT_NEAR(map[y * kWidth + x], twin::flip({a, kWidth, kHeight}, {b, kWidth, kHeight}, x, y), 1e-4)
          << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace whittle
