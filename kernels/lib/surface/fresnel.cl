// Fresnel reflectance: exact for dielectrics, Schlick 1994 for metals and for the microfacet lobe (glTF
// 2.0, appendix B).
#include "lib/lanes.cl"

/// Unpolarised reflectance at an interface; eta = n_t / n_i, cosine = n·w_o in [0, 1]. 1 at total reflection, where
/// `total` is set: no light passes.
INLINE Real fresnelDielectric(Real cosine, Real eta, Mask* total) {
  const Real sin2 = 1.0f - cosine * cosine;
  const Real sin2T = (sin2 > 0.0f ? sin2 : (Real)(0.0f)) / (eta * eta);
  *total = !(sin2T < 1.0f);
  const Real c = sqrt(1.0f - sin2T);
  const Real s = (cosine - eta * c) / (cosine + eta * c);
  const Real p = (eta * cosine - c) / (eta * cosine + c);
  const Real r = eta == 1.0f ? (Real)(0.0f) : 0.5f * (s * s + p * p);
  return *total ? (Real)(1.0f) : r;
}

/// (1 - cosine)^5
INLINE Real schlickWeight(Real cosine) {
  const Real m = 1.0f - cosine;
  const Real m2 = m * m;
  return m2 * m2 * m;
}
