// The reflectance is a Fourier series in the phase that light gains on its way through the film; each term is
// integrated over the wavelengths in closed form.
#include "reference/thin_film.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace whittle::reference {
namespace {

constexpr double kFades = 0.03;  // nm: thinner films go over into none

double schlickAt(double f0, double cosine) { return f0 + (1 - f0) * std::pow(1 - cosine, 5); }

/// A part of a colour matching function over the frequency in 1/m.
struct Gaussian {
  int channel;  ///< of XYZ
  double value, position, variance;
};
constexpr std::array kMatching{
    Gaussian{0, 5.4856e-13, 1.6810e+06, 4.3278e+09}, Gaussian{0, 9.7470e-14, 2.2399e+06, 4.5282e+09},
    Gaussian{1, 4.4201e-13, 1.7953e+06, 9.3046e+09}, Gaussian{2, 5.2481e-13, 2.2084e+06, 6.6121e+09}};
constexpr double kWhite = 1.0685e-7;  ///< their integral

/// Cosines of the phases that light of each channel has after `path` metres and `shift`, integrated.
Vec3 seen(double path, const Vec3& shift) {
  Vec3 xyz(0);
  const double phase = 2 * kPi * path;
  for (const Gaussian& g : kMatching)
    xyz[g.channel] += g.value * std::sqrt(2 * kPi * g.variance) / kWhite *
                      std::cos(g.position * phase + shift[g.channel]) * std::exp(-g.variance * phase * phase);
  return {glm::dot(Vec3(3.2404542, -1.5371385, -0.4985314), xyz),
          glm::dot(Vec3(-0.9692660, 1.8760108, 0.0415560), xyz),
          glm::dot(Vec3(0.0556434, -0.2040259, 1.0572252), xyz)};
}

}  // namespace

Vec3 filmReflectance(const ThinFilm& film, const Vec3& f0, double cosine) {
  const double index = film.index;
  const double cosWithin = std::sqrt(std::max(0.0, 1 - (1 - cosine * cosine) / (index * index)));
  const double R12 = schlickAt(square((index - 1) / (index + 1)), cosine), T = 1 - R12;
  Vec3 R23(0), R123(0), phase(0);
  for (int i = 0; i < 3; ++i) {
    const double root = std::sqrt(std::min(f0[i], 0.9999)), base = (1 + root) / (1 - root);
    R23[i] = schlickAt(square((base - index) / (base + index)), cosWithin);
    R123[i] = std::min(R12 * R23[i], 0.9999);
    phase[i] = base < 0.9999 * index ? 2 * kPi : kPi;
  }
  const Vec3 Rs = T * T * R23 / (1.0 - R123);
  Vec3 sum = R12 + Rs, amplitude = Rs - T;
  const double path = 2 * index * film.thickness * 1e-9 * cosWithin;
  for (const double order : {1.0, 2.0}) {
    amplitude *= glm::sqrt(R123);
    sum += 2.0 * amplitude * seen(order * path, order * phase);
  }
  return sum;
}

Vec3 ThinFilm::over(const Vec3& plain, const Vec3& f0, double cosine) const {
  if (!(share > 0)) return plain;
  const double there = std::clamp(thickness / kFades, 0.0, 1.0);
  const double covered = share * there * there * (3 - 2 * there);
  return glm::mix(plain, glm::clamp(filmReflectance(*this, f0, cosine), 0.0, 1.0), covered);
}

}  // namespace whittle::reference
