// Iridescence (KHR_materials_iridescence): what a surface reflects under a film as thin as waves of light are long.
// Belcour and Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", 2017, with
// the extension's simplifications: Schlick's reflectance at both interfaces, two orders of interference, air outside.
#include "lib/surface/fresnel.cl"

typedef struct {
  Real share;      // of the surface that has a film
  Real index;      // of refraction, at least 1
  Real thickness;  // nm
} ThinFilm;

#define FILM_FADES 0.03f  // nm: a thinner film goes over into none

/// XYZ of a cosine of the frequency whose argument is `shift` more than 2 pi path/wavelength, integrated over the eye's
/// sensitivities (sums of Gaussians over the frequency, made to be 1 for no path), as linear sRGB. path: nm.
INLINE float3 interference(float path, float3 shift) {
  const float phase = 2e-9f * PI * path, squared = phase * phase;
  const float x = 0.84659f * exp(-4.3278e9f * squared), y = 1.0002219f * exp(-9.3046e9f * squared);
  const float z = 1.0011225f * exp(-6.6121e9f * squared), second = 0.15386831f * exp(-4.5282e9f * squared);
  float xyz[3];
  xyz[0] = x * cos(1.6810e6f * phase + shift.x) + second * cos(2.2399e6f * phase + shift.x);
  xyz[1] = y * cos(1.7953e6f * phase + shift.y);
  xyz[2] = z * cos(2.2084e6f * phase + shift.z);
  return (float3)(3.2404542f * xyz[0] - 1.5371385f * xyz[1] - 0.4985314f * xyz[2],
                  -0.9692660f * xyz[0] + 1.8760108f * xyz[1] + 0.0415560f * xyz[2],
                  0.0556434f * xyz[0] - 0.2040259f * xyz[1] + 1.0572252f * xyz[2]);
}

/// What a film of that index and thickness (nm) over a surface of reflectance f0 reflects at that angle to its normal.
INLINE float3 filmReflectance(float cosine, float index, float thickness, float3 f0) {
  const float sin2 = (1.0f - cosine * cosine) / (index * index);
  const float within = sqrt(sin2 < 1.0f ? 1.0f - sin2 : 0.0f);
  const float ratio = (index - 1.0f) / (index + 1.0f), ratio2 = ratio * ratio;
  float m = 1.0f - cosine, m2 = m * m;
  const float outer = ratio2 + (1.0f - ratio2) * m2 * m2 * m, enters = 1.0f - outer;
  // The surface's own index, as though it were clear.
  const float3 root = sqrt(
      (float3)(f0.x < 0.9999f ? f0.x : 0.9999f, f0.y < 0.9999f ? f0.y : 0.9999f, f0.z < 0.9999f ? f0.z : 0.9999f));
  const float3 base = (1.0f + root) / (1.0f - root);
  float3 inner = (base - index) / (base + index);
  inner *= inner;
  m = 1.0f - within, m2 = m * m;
  inner += (1.0f - inner) * (m2 * m2 * m);
  // Half a wave is lost at each interface to something denser: at the first in any case.
  // 0.9999: a film of the surface's own index loses none there.
  const float3 own = base / (0.9999f * index);
  const float3 shift = (float3)(own.x < 1.0f ? 2.0f * PI : PI, own.y < 1.0f ? 2.0f * PI : PI,
                                own.z < 1.0f ? 2.0f * PI : PI);
  float3 round = outer * inner;
  round = (float3)(round.x < 0.9999f ? round.x : 0.9999f, round.y < 0.9999f ? round.y : 0.9999f,
                   round.z < 0.9999f ? round.z : 0.9999f);
  const float3 returned = enters * enters * inner / (1.0f - round), each = sqrt(round);
  const float path = 2.0f * index * thickness * within;
  float3 order = (returned - enters) * each;
  float3 sum = outer + returned + 2.0f * order * interference(path, shift);
  order *= each;
  return sum + 2.0f * order * interference(2.0f * path, 2.0f * shift);
}

/// `plain`, the reflectance of a surface without a film, where that has none; f0 is its own at normal incidence.
INLINE Real3 belowFilm(const ThinFilm* film, Real cosine, Real3 f0, Real3 plain) {
  if (!some(film->share > 0.0f)) return plain;
  float at[LANES], index[LANES], thickness[LANES], share[LANES], own[3][LANES];
  STORE(cosine, at);
  STORE(film->index, index);
  STORE(film->thickness, thickness);
  STORE(film->share, share);
  STORE(f0.x, own[0]);
  STORE(f0.y, own[1]);
  STORE(f0.z, own[2]);
  for (uint k = 0; k < LANES; ++k) {
    if (!(share[k] > 0.0f)) continue;
    const float3 r = filmReflectance(at[k], index[k], thickness[k], (float3)(own[0][k], own[1][k], own[2][k]));
    own[0][k] = r.x, own[1][k] = r.y, own[2][k] = r.z;
  }
  const Real3 whole = real3(clampUnit(LOAD(own[0])), clampUnit(LOAD(own[1])), clampUnit(LOAD(own[2])));
  const Real there = clampUnit(film->thickness / FILM_FADES);
  const Real covered = film->share * there * there * (3.0f - 2.0f * there);
  return choose3(film->share > 0.0f, add3(plain, scale3(covered, sub3(whole, plain))), plain);
}
