// Fresnel reflectance: exact for dielectrics, Schlick 1994 for metals and for the microfacet lobe (glTF 2.0, appendix B).
#include "lib/lanes.cl"

/// Unpolarised reflectance at an interface; eta = n_t / n_i, cosine = n·w_o in [0, 1]. 1 at total reflection.
/// cosT receives the cosine of the refracted ray (0 at total reflection).
INLINE float fresnelDielectric(float cosine, float eta, float* cosT) {
  const float sin2 = 1.0f - cosine * cosine;
  const float sin2T = (sin2 > 0.0f ? sin2 : 0.0f) / (eta * eta);
  *cosT = 0.0f;
  if (!(sin2T < 1.0f)) return 1.0f;
  const float c = sqrt(1.0f - sin2T);
  *cosT = c;
  if (eta == 1.0f) return 0.0f;
  const float s = (cosine - eta * c) / (cosine + eta * c);
  const float p = (eta * cosine - c) / (eta * cosine + c);
  return 0.5f * (s * s + p * p);
}

/// (1 - cosine)^5
INLINE Real schlickWeight(Real cosine) {
  const Real m = 1.0f - cosine;
  const Real m2 = m * m;
  return m2 * m2 * m;
}
