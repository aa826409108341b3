// Sheen (KHR_materials_sheen): fibres that stand up from the surface scatter light at grazing angles (Conty Estevez and
// Kulla, "Production Friendly Microfacet Sheen BRDF", 2017). What lies below receives what they leave.
#include "lib/lanes.cl"

/// How fibres of a surface scatter; `largest` of the colour's channels, 0: there are none.
typedef struct {
  Real3 color;
  Real largest;
  Real roughness;  // perceptual
} Sheen;

#define SMOOTHEST_SHEEN 0.07f  // below it one pixel in thousands would be bright
#define SHEEN_GRAZING 1e-4f    // cosines count as at least this
#define SHEEN_STEPS 15         // of the table, each way
// The share of white light from w_o that white fibres scatter: rows by roughness, columns by the square root of the
// cosine, both in even steps of [0, 1]. Integrated numerically; the reference integrates by itself
// (tests/render/layers_test.cpp).
__constant float sheenAlbedos[(SHEEN_STEPS + 1) * (SHEEN_STEPS + 1)] = {
    2.676752f,    2.829527f,   2.096249f,     1.316939f,     0.7200959f,    0.336261f,     0.1287916f,    0.03811133f,
    0.008011629f, 0.00106274f, 7.484019e-05f, 2.143323e-06f, 0.0f,          0.0f,          0.0f,          0.0f,
    2.676752f,    2.829527f,   2.096249f,     1.316939f,     0.7200959f,    0.336261f,     0.1287916f,    0.03811133f,
    0.008011629f, 0.00106274f, 7.484019e-05f, 2.143323e-06f, 0.0f,          0.0f,          0.0f,          0.0f,
    1.455429f,    1.643484f,   1.395707f,     1.062798f,     0.7540479f,    0.5000457f,    0.3072397f,    0.1721219f,
    0.08589855f,  0.03695164f, 0.01305873f,   0.003520872f,  0.0006408128f, 6.098951e-05f, 1.559992e-06f, 0.0f,
    1.026232f,    1.19396f,    1.073305f,     0.8820848f,    0.6900946f,    0.5179421f,    0.372096f,     0.2540279f,
    0.162953f,    0.09665603f, 0.05179728f,   0.0242261f,    0.009387216f,  0.002669441f,  0.0004079741f, 3.754093e-06f,
    0.8301715f,   0.9838276f,  0.9125607f,    0.7810095f,    0.6427384f,    0.5134554f,    0.3982169f,    0.2986027f,
    0.2149531f,   0.1470393f,  0.09419326f,   0.05534689f,   0.02905873f,   0.01266932f,   0.003813483f,  0.0002814307f,
    0.729387f,    0.8759315f,  0.8291529f,    0.7278494f,    0.6179322f,    0.512675f,     0.4162145f,    0.3297859f,
    0.2537296f,   0.1881461f,  0.1330512f,    0.08846757f,   0.05457132f,   0.02970436f,   0.01261817f,   0.002418993f,
    0.6781902f,   0.8224545f,  0.78971f,      0.705249f,     0.6113734f,    0.5201617f,    0.435225f,     0.3574982f,
    0.2871393f,   0.224186f,   0.1687458f,    0.1211809f,    0.08252305f,   0.0513754f,    0.0268143f,    0.008589215f,
    0.6571471f,   0.8022662f,  0.7783024f,    0.7035212f,    0.6188448f,    0.535844f,     0.4578454f,    0.3855642f,
    0.3189707f,   0.2579569f,  0.2025526f,    0.153192f,     0.1114282f,    0.07580738f,   0.04529311f,   0.0196937f,
    0.6564466f,   0.8042536f,  0.7860013f,    0.716588f,     0.6369042f,    0.5584201f,    0.4843188f,    0.4151525f,
    0.3507264f,   0.2907837f,  0.2352403f,    0.1845176f,    0.140537f,     0.1016978f,    0.06672049f,   0.03525148f,
    0.6701901f,   0.8214344f,  0.8068292f,    0.7399516f,    0.6624926f,    0.5860628f,    0.5137799f,    0.4460651f,
    0.3825787f,   0.3229298f,  0.266927f,     0.2149614f,    0.1692389f,    0.1280156f,    0.08978914f,   0.05404667f,
    0.6939099f,   0.8484037f,  0.8358946f,    0.7696189f,    0.6925331f,    0.6165145f,    0.5446517f,    0.4772493f,
    0.4138368f,   0.3539069f,  0.2971779f,    0.2440153f,    0.1968498f,    0.1538268f,    0.1132898f,    0.07464637f,
    0.7232404f,   0.8800356f,  0.8684176f,    0.8014974f,    0.7236527f,    0.6470623f,    0.5747926f,    0.5070379f,
    0.4432076f,   0.3826936f,  0.3251422f,    0.2709014f,    0.2225757f,    0.1782362f,    0.1361385f,    0.09568669f,
    0.753122f,    0.9107834f,  0.8992152f,    0.8310792f,    0.7520387f,    0.6745315f,    0.6015908f,    0.5333042f,
    0.4689731f,   0.4079037f,  0.3496854f,    0.294654f,     0.2455439f,    0.2003825f,    0.1573847f,    0.1159952f,
    0.7774217f,   0.9343938f,  0.9225168f,    0.8533526f,    0.7734332f,    0.6953445f,    0.6220671f,    0.5535921f,
    0.4891293f,   0.4279155f,  0.3694951f,    0.3141929f,    0.2648396f,    0.2194421f,    0.1762003f,    0.1346132f,
    0.7890823f,   0.9440411f,  0.9321022f,    0.8629428f,    0.7832733f,    0.7056598f,    0.6330108f,    0.5652413f,
    0.501496f,    0.4409612f,  0.3831461f,    0.3283627f,    0.2795166f,    0.2346135f,    0.1918462f,    0.1507602f,
    0.780971f,    0.9329378f,  0.9217923f,    0.8544964f,    0.7769911f,    0.7016038f,    0.6311538f,    0.5655147f,
    0.5038023f,   0.4451763f,  0.3891192f,    0.3359263f,    0.2885699f,    0.2450723f,    0.2036147f,    0.1637668f,
};

/// At cosines of one lane each, between the table's values.
INLINE Real sheenAlbedo(const Sheen* sheen, Real cosine) {
  float root[LANES], roughness[LANES], largest[LANES];
  STORE(sqrt(clampUnit(cosine)), root);
  STORE(sheen->roughness, roughness);
  STORE(sheen->largest, largest);
  for (uint k = 0; k < LANES; ++k) {
    if (!(largest[k] > 0.0f)) {
      root[k] = 0.0f;
      continue;
    }
    const float x = root[k] * SHEEN_STEPS, y = roughness[k] * SHEEN_STEPS;
    const int i = x < SHEEN_STEPS ? (int)x : SHEEN_STEPS - 1, j = y < SHEEN_STEPS ? (int)y : SHEEN_STEPS - 1;
    __constant const float* at = sheenAlbedos + j * (SHEEN_STEPS + 1) + i;
    const float u = x - (float)i, v = y - (float)j;
    const float low = at[0] + u * (at[1] - at[0]);
    const float high = at[SHEEN_STEPS + 1] + u * (at[SHEEN_STEPS + 2] - at[SHEEN_STEPS + 1]);
    root[k] = low + v * (high - low);
  }
  return LOAD(root);
}

/// The larger one of light that goes one way and the other.
INLINE Real sheenAlbedoBetween(const Sheen* sheen, Real cosO, Real cosI) {
  const Real o = sheenAlbedo(sheen, cosO), i = sheenAlbedo(sheen, cosI);
  return o > i ? o : i;
}

/// What the fibres leave to what lies below.
INLINE Real belowSheen(const Sheen* sheen, Real albedo) {
  const Real kept = 1.0f - sheen->largest * albedo;
  return kept > 0.0f ? kept : (Real)(0.0f);
}

/// How much of a way at that cosine others stand in: the logarithm of Λ where the cosine is below a half.
INLINE float fibresInWay(float x, float alpha) {
  const float t = (1.0f - alpha) * (1.0f - alpha);
  const float a = 21.5473f + t * (25.3245f - 21.5473f), b = 3.82987f + t * (3.32435f - 3.82987f);
  const float c = 0.19823f + t * (0.16801f - 0.19823f), d = -1.97760f + t * (1.97760f - 1.27393f);
  const float e = -4.32054f + t * (4.32054f - 4.85967f);
  return a / (1.0f + b * pow(x, c)) + d * x + e;
}

INLINE float fibreLambda(float cosine, float alpha) {
  const float way = cosine < 0.5f ? fibresInWay(cosine, alpha)
                                  : 2.0f * fibresInWay(0.5f, alpha) - fibresInWay(1.0f - cosine, alpha);
  return exp(way);
}

/// Distribution times visibility, 1/sr.
INLINE float fibreLobe(float roughness, float cosO, float cosI, float cosH) {
  const float r = roughness > SMOOTHEST_SHEEN ? roughness : SMOOTHEST_SHEEN, alpha = r * r;
  const float o = cosO > SHEEN_GRAZING ? cosO : SHEEN_GRAZING, i = cosI > SHEEN_GRAZING ? cosI : SHEEN_GRAZING;
  const float sin2 = 1.0f - cosH * cosH;
  const float distribution = (2.0f + 1.0f / alpha) * pow(sin2 > 0.0f ? sin2 : 0.0f, 0.5f / alpha) / (2.0f * PI);
  return distribution / ((1.0f + fibreLambda(o, alpha) + fibreLambda(i, alpha)) * (4.0f * o * i));
}

/// The same where there are fibres; `albedo` of both directions: where it is above 1 they would give off more than they
/// receive.
INLINE Real sheenLobe(const Sheen* sheen, Real cosO, Real cosI, Real cosH, Real albedo) {
  float o[LANES], i[LANES], h[LANES], roughness[LANES], largest[LANES];
  STORE(cosO, o);
  STORE(cosI, i);
  STORE(cosH, h);
  STORE(sheen->roughness, roughness);
  STORE(sheen->largest, largest);
  for (uint k = 0; k < LANES; ++k) o[k] = largest[k] > 0.0f ? fibreLobe(roughness[k], o[k], i[k], h[k]) : 0.0f;
  return LOAD(o) / (albedo > 1.0f ? albedo : (Real)(1.0f));
}
