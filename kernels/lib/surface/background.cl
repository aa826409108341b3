// Radiance of rays that leave the scene; conventions: host/reference/README.md.
#include "lib/scene.cl"

#if HAS(BACKGROUND_MAP)
INLINE float3 backgroundTexel(const SceneView* scene, const RenderConstants* constants, int x, int y) {
  const int w = constants->backgroundWidth, h = constants->backgroundHeight;
  x = x < 0 ? x + w : (x >= w ? x - w : x);
  x = x < 0 ? 0 : (x >= w ? w - 1 : x);
  y = y < 0 ? 0 : (y >= h ? h - 1 : y);
  return load3(scene->background + ((size_t)y * w + x) * 3);
}
#endif

/// Radiance of a ray that leaves the scene along d.
INLINE float3 backgroundRadiance(const SceneView* scene, const RenderConstants* constants, float3 d) {
  const float3 uniformRadiance = (float3)(constants->background[0], constants->background[1], constants->background[2]);
#if HAS(BACKGROUND_MAP)
  if (constants->backgroundWidth > 0) {
    const float cosine = d.y > -1.0f ? (d.y < 1.0f ? d.y : 1.0f) : -1.0f;
    const float u = constants->backgroundAhead + atan2(d.x, -d.z) * (0.5f / PI);
    const float x = u * (float)constants->backgroundWidth - 0.5f;
    const float y = acos(cosine) * (1.0f / PI) * (float)constants->backgroundHeight - 0.5f;
    const float fx = floor(x), fy = floor(y);
    const float wx = x - fx, wy = y - fy;
    const int ix = (int)fx, iy = (int)fy;
    const float3 top = backgroundTexel(scene, constants, ix, iy) * (1.0f - wx) +
                       backgroundTexel(scene, constants, ix + 1, iy) * wx;
    const float3 low = backgroundTexel(scene, constants, ix, iy + 1) * (1.0f - wx) +
                       backgroundTexel(scene, constants, ix + 1, iy + 1) * wx;
    return uniformRadiance * (top * (1.0f - wy) + low * wy);
  }
#endif
  return uniformRadiance;
}
