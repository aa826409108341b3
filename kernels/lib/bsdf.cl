// Scattering at a surfel: the finite part (Lambert and the glTF microfacet lobe) for direct light, and the impulses
// (mirror reflection, refraction, straight transmission). Formulas: host/reference/README.md.
#include "lib/surfel.cl"

INLINE int isSmooth(const RenderConstants* constants, const Surfel* s) { return s->roughness < constants->mirrorRoughness; }

/// Ratio of indices n_t/n_i for light arriving from the viewer's side.
INLINE float interfaceEta(const Surfel* s) {
  return (s->front || !(s->flags & MATERIAL_VOLUME)) ? s->ior : 1.0f / s->ior;
}

/// Dielectric reflectance seen along w_o; total: set at total reflection. cosT as in fresnelDielectric.
INLINE float3 dielectricReflectance(const Surfel* s, float cosine, float* cosT, int* total) {
  *total = 0;
  *cosT = cosine;
  const float ratio = (s->ior - 1.0f) / (s->ior + 1.0f);
  const float r0 = ratio * ratio;
  if (s->ior == 0.0f || r0 >= 1.0f) return s->specularF0;
  const float r = fresnelDielectric(cosine, interfaceEta(s), cosT);
  if (r >= 1.0f) {
    *total = *cosT == 0.0f;
    if (*total) return (float3)(1.0f);
  }
#if HAS(SPECULAR_EXTENSION)
  if (s->specularF90 == 1.0f && s->specularF0.x == r0 && s->specularF0.y == r0 && s->specularF0.z == r0)
    return (float3)(r);  // untinted: the bits of the kernels without this extension
  const float3 scaled = s->specularF0 + ((float3)(s->specularF90) - s->specularF0) * ((r - r0) / (1.0f - r0));
  return clamp(scaled, 0.0f, 1.0f);  // dense dielectrics dip below R0
#else
  return (float3)(r);
#endif
}

/// f(w_i, w_o), 1/sr, without impulses; both directions on the side of n.
INLINE float3 finiteScattering(const RenderConstants* constants, const Surfel* s, float3 w_o, float3 w_i) {
  const float cosO = dot3(s->n, w_o);
  const float dielectric = 1.0f - s->metallic;
  const float3 diffuse = s->baseColor * (1.0f / PI) * (1.0f - s->transmission);
  if (isSmooth(constants, s)) {
    float cosT;
    int total;
    const float3 r = dielectricReflectance(s, fmin(cosO, 1.0f), &cosT, &total);
    return dielectric * ((float3)(1.0f) - r) * diffuse;
  }
#if HAS(MICROFACET)
  const float cosI = dot3(s->n, w_i);
  const float3 h = normalize3(w_i + w_o);
  const float cosH = dot3(s->n, h);
  const float cosD = clamp(dot3(w_o, h), 0.0f, 1.0f);
  const float squared = s->roughness * s->roughness;
  const float alpha = squared > 1e-3f ? squared : 1e-3f;  // a mirror's lobe would be 0/0
  const float a2 = alpha * alpha;
  const float k = cosH * cosH * (a2 - 1.0f) + 1.0f;
  const float distribution = a2 / (PI * k * k);
  const float visibility =
      0.5f / (cosI * sqrt(a2 + (1.0f - a2) * cosO * cosO) + cosO * sqrt(a2 + (1.0f - a2) * cosI * cosI));
  const float lobe = distribution * visibility;
  const float3 fresnel = schlick(s->specularF0, (float3)(s->specularF90), cosD);
  const float largest = fmax(fmax(fresnel.x, fresnel.y), fresnel.z);
  float3 f = dielectric * ((1.0f - largest) * diffuse + fresnel * lobe);
#if HAS(METAL)
  f += s->metallic * schlick(s->baseColor, (float3)(1.0f), cosD) * lobe;
#endif
  return f;
#else
  return dielectric * diffuse;
#endif
}

/// A direction with an RGB magnitude; magnitude 0: there is none.
typedef struct {
  float3 w_i;
  float3 magnitude;
} Impulse;

#if HAS(MIRROR) || HAS(REFRACTION)
INLINE Impulse mirrorImpulse(const RenderConstants* constants, const Surfel* s, float3 w_o, float cosine, float3 reflectance, int total) {
  Impulse impulse;
  const float3 n = s->n;
  impulse.w_i = 2.0f * cosine * n - w_o;
  if (!(dot3(s->n_g, impulse.w_i) > 0.0f)) impulse.w_i = 2.0f * dot3(s->n_g, w_o) * s->n_g - w_o;
  impulse.w_i = normalize3(impulse.w_i);
  impulse.magnitude = (float3)(0.0f);
  const int inside = total && (s->flags & MATERIAL_VOLUME) && s->transmission > 0.0f;
  if (isSmooth(constants, s) || inside) {
    impulse.magnitude = (1.0f - s->metallic) * reflectance;
#if HAS(METAL)
    impulse.magnitude += s->metallic * schlick(s->baseColor, (float3)(1.0f), cosine);
#endif
    impulse.magnitude *= s->alpha;
  }
  return impulse;
}
#endif

#if HAS(TRANSMISSION)
#if HAS(REFRACTION)
/// Refracted direction about n, or 0 at total reflection.
INLINE float3 refracted(float3 n, float3 w_o, float eta) {
  const float cosine = fmin(dot3(n, w_o), 1.0f);
  const float sin2 = 1.0f - cosine * cosine;
  const float sin2T = (sin2 > 0.0f ? sin2 : 0.0f) / (eta * eta);
  if (!(sin2T < 1.0f)) return (float3)(0.0f);
  return normalize3((cosine / eta - sqrt(1.0f - sin2T)) * n - w_o / eta);
}
#endif

INLINE Impulse transmissionImpulse(const Surfel* s, float3 w_o, float3 reflectance) {
  Impulse impulse;
  impulse.w_i = -w_o;
  impulse.magnitude = s->alpha * (1.0f - s->metallic) * s->transmission * s->baseColor * ((float3)(1.0f) - reflectance);
#if HAS(REFRACTION)
  const float eta = interfaceEta(s);
  if ((s->flags & MATERIAL_VOLUME) && s->ior == 0.0f) {
    impulse.magnitude = (float3)(0.0f);
  } else if ((s->flags & MATERIAL_VOLUME) && eta != 1.0f) {
    impulse.w_i = refracted(s->n, w_o, eta);
    if (!(dot3(s->n_g, impulse.w_i) < 0.0f)) impulse.w_i = refracted(s->n_g, w_o, eta);
    if (!(dot3(s->n_g, impulse.w_i) < 0.0f)) impulse.magnitude = (float3)(0.0f);
  }
#endif
  return impulse;
}
#endif

/// The impulses of a surfel, at most two, in their fixed order.
INLINE void impulsesAt(const RenderConstants* constants, const Surfel* s, float3 w_o, Impulse* first, Impulse* second) {
  first->magnitude = (float3)(0.0f);
  second->magnitude = (float3)(0.0f);
  first->w_i = second->w_i = -w_o;
#if HAS(IMPULSES)
  const float straight = 1.0f - s->alpha;
#if HAS(UNLIT)
  if (s->flags & MATERIAL_UNLIT) {
    first->magnitude = (float3)(straight);
    return;
  }
#endif
#if HAS(MIRROR) || HAS(REFRACTION) || HAS(TRANSMISSION)
  const float cosine = fmin(dot3(s->n, w_o), 1.0f);
  float cosT;
  int total;
  const float3 reflectance = dielectricReflectance(s, cosine, &cosT, &total);
#endif
#if HAS(MIRROR) || HAS(REFRACTION)
  *first = mirrorImpulse(constants, s, w_o, cosine, reflectance, total);
#endif
#if HAS(TRANSMISSION)
  if (s->transmission > 0.0f) *second = transmissionImpulse(s, w_o, reflectance);
#endif
#if HAS(ALPHA_BLEND)
  if (s->alpha < 1.0f) {
    const int bends = (s->flags & MATERIAL_VOLUME) && anyPositive(second->magnitude);
    if (bends) {
      first->w_i = -w_o;  // three directions would be needed: the reflection is left out
      first->magnitude = (float3)(straight);
    } else {
      Impulse reflection = *first;
      first->w_i = -w_o;
      first->magnitude = second->magnitude + (float3)(straight);
      *second = reflection;
    }
  }
#endif
#endif
}
