// The surfel: what shading needs to know of the surface at a hit, evaluated from vertices, material and textures.
// Conventions: host/reference/README.md.
#include "lib/fresnel.cl"
#include "lib/texture.cl"

typedef struct {
  float3 position;   // world, m
  float3 n_g;        // unit geometric normal, turned to the viewer
  float3 n;          // unit shading normal, turned likewise
  float3 baseColor;  // linear
  float alpha;       // coverage a
  float metallic;
  float roughness;
  float transmission;
  float3 specularF0;  // dielectric reflectance at normal incidence, and at grazing incidence
  float specularF90;
  float3 emission;  // W/(m² sr), already 0 on a side that does not emit
  float ior;
  float bump;  // m
  int front;
  uint flags;  // MATERIAL_…
  float3 sigma_a;
} Surfel;

float2 interpolate2(__global const float* values, const uint* corner, float b0, float b1, float b2) {
  __global const float* a = values + (size_t)corner[0] * 2;
  __global const float* b = values + (size_t)corner[1] * 2;
  __global const float* c = values + (size_t)corner[2] * 2;
  return (float2)(b0 * a[0] + b1 * b[0] + b2 * c[0], b0 * a[1] + b1 * b[1] + b2 * c[1]);
}

void interpolateUv(const SceneView* scene, const uint* corner, float b0, float b1, float b2, float2* first, float2* second) {
  *first = (float2)(0.0f, 0.0f);
  *second = (float2)(0.0f, 0.0f);
#if HAS(UV0)
  if (scene->uv0) *first = interpolate2(scene->uv0, corner, b0, b1, b2);
#endif
#if HAS(UV1)
  if (scene->uv1) *second = interpolate2(scene->uv1, corner, b0, b1, b2);
#endif
}

/// Base colour and alpha: factor, texture, vertex colour.
float4 baseColorAt(const SceneView* scene, __global const DeviceMaterial* m, const uint* corner, float b0, float b1,
                   float b2, float2 uvFirst, float2 uvSecond) {
  float4 c = (float4)(m->baseColor[0], m->baseColor[1], m->baseColor[2], m->baseColor[3]);
#if HAS(BASE_COLOR_TEXTURE)
  if (m->baseColorTexture >= 0) c *= sampleTexture(scene, m->baseColorTexture, uvFirst, uvSecond, 1);
#endif
#if HAS(VERTEX_COLORS)
  if (scene->colors) {
    const float4 v0 = vload4(corner[0], scene->colors);
    const float4 v1 = vload4(corner[1], scene->colors);
    const float4 v2 = vload4(corner[2], scene->colors);
    c *= b0 * v0 + b1 * v1 + b2 * v2;
  }
#endif
  return c;
}

void loadCorners(const SceneView* scene, uint primitive, uint* corner) {
#if HAS(VERTEX_NORMALS) || HAS(VERTEX_COLORS) || HAS(TEXTURES)
  __global const uint* c = scene->corners + (size_t)primitive * 3;
  corner[0] = c[0];
  corner[1] = c[1];
  corner[2] = c[2];
#else
  corner[0] = corner[1] = corner[2] = 0;  // nothing is interpolated, and the buffer is not there
#endif
}

/// How much of the light a surface lets straight through to a shadow ray; README "Direct light".
/// For a masked triangle: 1 below the cutoff, else 0 (the hit counts).
float3 shadowTransmittance(const SceneView* scene, uint triangleIndex, float b1, float b2, float3 d) {
  __global const DeviceTriangle* triangle = scene->triangles + triangleIndex;
  __global const DeviceMaterial* m = scene->materials + triangle->material;
  const float b0 = 1.0f - b1 - b2;
  uint corner[3];
  loadCorners(scene, triangle->primitive, corner);
  float2 uvFirst, uvSecond;
  interpolateUv(scene, corner, b0, b1, b2, &uvFirst, &uvSecond);
  const float4 c = baseColorAt(scene, m, corner, b0, b1, b2, uvFirst, uvSecond);
  float alpha = 1.0f;
#if HAS(ALPHA_MASK)
  if ((m->flags & MATERIAL_MASK) && c.w < m->alphaCutoff) return (float3)(1.0f, 1.0f, 1.0f);
#endif
#if HAS(ALPHA_BLEND)
  if (m->flags & MATERIAL_BLEND) alpha = c.w > 0.0f ? (c.w < 1.0f ? c.w : 1.0f) : 0.0f;
#endif
  float3 through = (float3)(1.0f - alpha);
#if HAS(TRANSMISSION)
  float transmission = m->transmission;
  float metallic = m->metallic;
#if HAS(TRANSMISSION_TEXTURE)
  if (m->transmissionTexture >= 0) transmission *= sampleTexture(scene, m->transmissionTexture, uvFirst, uvSecond, 0).x;
#endif
#if HAS(METALLIC_ROUGHNESS_TEXTURE)
  if (m->metallicRoughnessTexture >= 0)
    metallic *= sampleTexture(scene, m->metallicRoughnessTexture, uvFirst, uvSecond, 0).z;
#endif
  metallic = clamp(metallic, 0.0f, 1.0f);
  if (transmission > 0.0f && !(m->flags & MATERIAL_UNLIT)) {
    const float3 p0 = load3(triangle->v[0]), p1 = load3(triangle->v[1]), p2 = load3(triangle->v[2]);
    const float3 n_g = normalize3(cross3(p1 - p0, p2 - p0));
    float cosT;
    const float reflected = m->ior == 0.0f ? 1.0f : fresnelDielectric(fmin(fabs(dot3(n_g, d)), 1.0f), m->ior, &cosT);
    through += alpha * transmission * (1.0f - metallic) * (1.0f - reflected) * c.xyz;
  }
#endif
  return clamp(through, 0.0f, 1.0f);  // vertex colours may exceed 1
}

/// 1 if a masked triangle is really there at these barycentrics.
int passesAlphaMask(const SceneView* scene, uint triangleIndex, float b1, float b2) {
  __global const DeviceTriangle* triangle = scene->triangles + triangleIndex;
  __global const DeviceMaterial* m = scene->materials + triangle->material;
  const float b0 = 1.0f - b1 - b2;
  uint corner[3];
  loadCorners(scene, triangle->primitive, corner);
  float2 uvFirst, uvSecond;
  interpolateUv(scene, corner, b0, b1, b2, &uvFirst, &uvSecond);
  return baseColorAt(scene, m, corner, b0, b1, b2, uvFirst, uvSecond).w >= m->alphaCutoff;
}

#if HAS(VERTEX_NORMALS)
/// Interpolated vertex normal, or n_g where a corner has none or the sum is useless.
float3 vertexNormalAt(const SceneView* scene, const uint* corner, float b0, float b1, float b2, float3 n_g) {
  if (!scene->normals) return n_g;
  const float3 a = load3(scene->normals + (size_t)corner[0] * 3);
  const float3 b = load3(scene->normals + (size_t)corner[1] * 3);
  const float3 c = load3(scene->normals + (size_t)corner[2] * 3);
  if (dot3(a, a) == 0.0f || dot3(b, b) == 0.0f || dot3(c, c) == 0.0f) return n_g;
  const float3 sum = b0 * a + b1 * b + b2 * c;
  const float3 n = normalize3(sum);
  return isFinite3(n) ? n : n_g;
}
#endif

#if HAS(NORMAL_TEXTURE)
float3 mappedNormal(const SceneView* scene, __global const DeviceMaterial* m, const uint* corner, float b0, float b1,
                    float b2, float2 uvFirst, float2 uvSecond, float3 n) {
  if (m->normalTexture < 0 || !scene->tangents) return n;
  const float4 a = vload4(corner[0], scene->tangents);
  const float4 b = vload4(corner[1], scene->tangents);
  const float4 c = vload4(corner[2], scene->tangents);
  float3 tangent = b0 * a.xyz + b1 * b.xyz + b2 * c.xyz;
  tangent = normalize3(tangent - n * dot3(n, tangent));
  if (!isFinite3(tangent)) return n;
  const float3 bitangent = a.w * cross3(n, tangent);
  const float4 texel = sampleTexture(scene, m->normalTexture, uvFirst, uvSecond, 0);
  const float x = (texel.x * 2.0f - 1.0f) * m->normalScale;
  const float y = (texel.y * 2.0f - 1.0f) * m->normalScale;
  const float z = texel.z * 2.0f - 1.0f;
  const float3 mapped = normalize3(tangent * x + bitangent * y + n * z);
  return isFinite3(mapped) ? mapped : n;
}
#endif

/// Reflectance at normal and grazing incidence of the dielectric part (KHR_materials_ior, KHR_materials_specular).
void specularReflectance(const SceneView* scene, __global const DeviceMaterial* m, float2 uvFirst, float2 uvSecond,
                         Surfel* s) {
  const float ratio = (m->ior - 1.0f) / (m->ior + 1.0f);
  const float r0 = m->ior == 0.0f ? 1.0f : ratio * ratio;
  s->specularF0 = (float3)(r0);
  s->specularF90 = 1.0f;
#if HAS(SPECULAR_EXTENSION)
  float strength = m->specular;
  float3 tint = load3(m->specularColor);
#if HAS(SPECULAR_TEXTURE)
  if (m->specularTexture >= 0) strength *= sampleTexture(scene, m->specularTexture, uvFirst, uvSecond, 0).w;
#endif
#if HAS(SPECULAR_COLOR_TEXTURE)
  if (m->specularColorTexture >= 0) tint *= sampleTexture(scene, m->specularColorTexture, uvFirst, uvSecond, 1).xyz;
#endif
  const float3 f0 = r0 * tint;
  s->specularF0 = (float3)(f0.x < 1.0f ? f0.x : 1.0f, f0.y < 1.0f ? f0.y : 1.0f, f0.z < 1.0f ? f0.z : 1.0f) * strength;
  s->specularF90 = strength;
#endif
}

/// The surfel at hit (triangle, b1, b2) of a ray along d.
Surfel surfelAt(const SceneView* scene, const RenderConstants* constants, uint triangleIndex, float b1, float b2, float3 d) {
  Surfel s;
  __global const DeviceTriangle* triangle = scene->triangles + triangleIndex;
  __global const DeviceMaterial* m = scene->materials + triangle->material;
  const float b0 = 1.0f - b1 - b2;
  const float3 p0 = load3(triangle->v[0]), p1 = load3(triangle->v[1]), p2 = load3(triangle->v[2]);
  s.position = b0 * p0 + b1 * p1 + b2 * p2;
#if HAS(FIXED_BUMP)
  s.bump = constants->bump;
  if (s.bump < 0.0f)
#endif
  {
    const float3 extent = b0 * fabs(p0) + b1 * fabs(p1) + b2 * fabs(p2);
    const float largest = extent.x > extent.y ? (extent.x > extent.z ? extent.x : extent.z)
                                              : (extent.y > extent.z ? extent.y : extent.z);
    const float scaled = largest * 9.5367431640625e-7f;  // 2^-20
    s.bump = scaled > 1e-30f ? scaled : 1e-30f;
  }
  const float3 n_g = normalize3(cross3(p1 - p0, p2 - p0));
  s.front = dot3(n_g, d) < 0.0f;
  s.flags = m->flags;
  uint corner[3];
  loadCorners(scene, triangle->primitive, corner);
  float2 uvFirst, uvSecond;
  interpolateUv(scene, corner, b0, b1, b2, &uvFirst, &uvSecond);

  float3 n = n_g;
#if HAS(VERTEX_NORMALS)
  n = vertexNormalAt(scene, corner, b0, b1, b2, n_g);
#endif
#if HAS(NORMAL_TEXTURE)
  n = mappedNormal(scene, m, corner, b0, b1, b2, uvFirst, uvSecond, n);
#endif
  s.n_g = s.front ? n_g : -n_g;
  n = s.front ? n : -n;
  s.n = dot3(n, d) < 0.0f ? n : s.n_g;

  const float4 c = baseColorAt(scene, m, corner, b0, b1, b2, uvFirst, uvSecond);
  s.baseColor = c.xyz;
  s.alpha = 1.0f;
#if HAS(ALPHA_BLEND)
  if (m->flags & MATERIAL_BLEND) s.alpha = c.w > 0.0f ? (c.w < 1.0f ? c.w : 1.0f) : 0.0f;
#endif
  s.metallic = m->metallic;
  s.roughness = m->roughness;
#if HAS(METALLIC_ROUGHNESS_TEXTURE)
  if (m->metallicRoughnessTexture >= 0) {
    const float4 texel = sampleTexture(scene, m->metallicRoughnessTexture, uvFirst, uvSecond, 0);
    s.metallic *= texel.z;
    s.roughness *= texel.y;
  }
#endif
  s.metallic = clamp(s.metallic, 0.0f, 1.0f);
  s.roughness = clamp(s.roughness, 0.0f, 1.0f);
  s.transmission = m->transmission;
#if HAS(TRANSMISSION_TEXTURE)
  if (m->transmissionTexture >= 0) s.transmission *= sampleTexture(scene, m->transmissionTexture, uvFirst, uvSecond, 0).x;
#endif
  s.ior = m->ior;
  s.sigma_a = load3(m->sigma_a);
  specularReflectance(scene, m, uvFirst, uvSecond, &s);
  s.emission = (float3)(0.0f);
#if HAS(EMISSION)
  if (s.front || (m->flags & MATERIAL_DOUBLE_SIDED)) {
    s.emission = load3(m->emission);
#if HAS(EMISSION_TEXTURE)
    if (m->emissionTexture >= 0) s.emission *= sampleTexture(scene, m->emissionTexture, uvFirst, uvSecond, 1).xyz;
#endif
  }
#endif
  return s;
}
