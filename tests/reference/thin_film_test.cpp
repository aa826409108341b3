// Iridescence: a film that is not there, and the closed form against waves that are added up one by one.
#include "reference/thin_film.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>

#include "reference/fresnel.h"

namespace whittle::test {
namespace {

using reference::Vec3;

TEST(ThinFilm, OfNoThicknessIsTheSurfaceAlone) {
  const Vec3 f0(0.04, 0.3, 0.9);
  for (const double cosine : {1.0, 0.6, 0.2}) {
    const Vec3 bare = reference::schlick(f0, Vec3(1), cosine);
    const Vec3 film = reference::ThinFilm{1, 1.8, 0}.over(bare, f0, cosine);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(film[c], bare[c], 1e-9) << cosine;
  }
}

/// Reflectance of a film for one wavelength (nm) at normal incidence: Airy's sum of all orders.
double airy(double index, double thickness, double baseIndex, double wavelength) {
  const double r1 = (1 - index) / (1 + index), r2 = (index - baseIndex) / (index + baseIndex);
  const std::complex<double> turn = std::polar(1.0, 4 * reference::kPi * index * thickness / wavelength);
  return std::norm((r1 + r2 * turn) / (1.0 + r1 * r2 * turn));
}

/// The same seen by the sensitivities that the approximation takes: sums of Gaussians over the frequency.
Vec3 seenAiry(double index, double thickness, double baseIndex) {
  struct Gaussian {
    int channel;
    double value, position, variance;
  };
  constexpr std::array<Gaussian, 4> kParts{{{0, 5.4856e-13, 1.6810e6, 4.3278e9},
                                            {0, 9.7470e-14, 2.2399e6, 4.5282e9},
                                            {1, 4.4201e-13, 1.7953e6, 9.3046e9},
                                            {2, 5.2481e-13, 2.2084e6, 6.6121e9}}};
  Vec3 xyz(0);
  for (const Gaussian& g : kParts)
    for (int i = -2000; i <= 2000; ++i) {  // five deviations to each side
      // cos(2π p s) exp(−v (2π s)²) is the mean of cos(2π k s) over a Gaussian of variance 2v about p.
      const double step = 5 * std::sqrt(2 * g.variance) / 2000, k = g.position + i * step;
      const double density = std::exp(-(k - g.position) * (k - g.position) / (4 * g.variance)) /
                             std::sqrt(4 * reference::kPi * g.variance);
      xyz[g.channel] += g.value * std::sqrt(2 * reference::kPi * g.variance) / 1.0685e-7 * density * step *
                        airy(index, thickness, baseIndex, 1e9 / k);
    }
  return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
          -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
          0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

/// White seen so is the matrix's white, which is not quite 1 in each channel. Orders beyond the second are
/// left out, which is at most 2 (R12 R23)^1.5 = 4e-4 for these; the rest is the quadrature's.
TEST(ThinFilm, AddsUpWavesAsAiryDoes) {
  for (const double f0 : {0.04, 0.2})
    for (const double index : {1.3, 1.8})
      for (const double thickness : {120.0, 250.0, 400.0, 700.0}) {
        const double root = std::sqrt(f0), base = (1 + root) / (1 - root);
        const Vec3 film = reference::filmReflectance({1, index, thickness}, Vec3(f0), 1);
        const Vec3 sum = seenAiry(index, thickness, base);
        const Vec3 white = seenAiry(1, 0, 1e9);  // everything is reflected
        double mean = 0;
        for (int i = 0; i < 64; ++i) mean += airy(index, i / 64.0 * 500, base, 1000 * index) / 64;
        for (int c = 0; c < 3; ++c)  // colour: how far off the mean over all phases
          EXPECT_NEAR(film[c] - mean, sum[c] - mean * white[c], 1e-3)
              << "f0 " << f0 << " index " << index << " thickness " << thickness << " channel " << c;
      }
}

TEST(ThinFilm, CoversItsShare) {
  const Vec3 f0(0.04), plain(0.1, 0.2, 0.3);
  const reference::ThinFilm whole{1, 1.4, 300}, none{0, 1.4, 300}, half{0.5, 1.4, 300};
  const Vec3 film = whole.over(plain, f0, 0.8);
  EXPECT_EQ(none.over(plain, f0, 0.8), plain);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(half.over(plain, f0, 0.8)[c], (film[c] + plain[c]) / 2, 1e-12);
}

TEST(ThinFilm, ReflectsBetweenNothingAndEverything) {
  for (const double f0 : {0.0, 0.04, 0.5, 1.0})
    for (const double index : {1.0, 1.33, 2.0, 3.0})
      for (double thickness = 0; thickness < 2000; thickness += 37)
        for (const double cosine : {1.0, 0.5, 0.05, 0.0}) {
          const Vec3 r = reference::ThinFilm{1, index, thickness}.over(Vec3(0.5), Vec3(f0), cosine);
          for (int c = 0; c < 3; ++c)
            EXPECT_TRUE(r[c] >= 0 && r[c] <= 1) << f0 << ' ' << index << ' ' << thickness;
        }
}

}  // namespace
}  // namespace whittle::test
