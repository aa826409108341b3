// Radiance of rays that leave the scene; conventions: host/reference/README.md.
#include "lib/lanes.cl"
#include "lib/scene.cl"

#if HAS(BACKGROUND_MAP)
INLINE float3 backgroundTexel(const SceneView* scene, const RenderConstants* constants, int x, int y) {
  const int w = constants->backgroundWidth, h = constants->backgroundHeight;
  x = x < 0 ? x + w : (x >= w ? x - w : x);
  x = x < 0 ? 0 : (x >= w ? w - 1 : x);
  y = y < 0 ? 0 : (y >= h ? h - 1 : y);
  return load3(scene->background + ((size_t)y * w + x) * 3);
}

/// The same, in lanes.
INLINE Real3 backgroundTexels(const SceneView* scene, const RenderConstants* constants, Mask x, Mask y) {
  const Mask w = (Mask)(constants->backgroundWidth), h = (Mask)(constants->backgroundHeight), zero = (Mask)(0);
  x = x < 0 ? x + w : (x >= w ? x - w : x);
  x = x < 0 ? zero : (x >= w ? w - 1 : x);
  y = y < 0 ? zero : (y >= h ? h - 1 : y);
  return gather3(scene->background, AS_NATURAL(y * w + x) * 3u);
}
#endif

/// Radiance of rays that leave the scene along d, where `seen`.
INLINE Real3 backgroundAlong(const SceneView* scene, const RenderConstants* constants, Real3 d, Mask seen) {
  const Real3 uniform = real3(constants->background[0], constants->background[1], constants->background[2]);
#if HAS(BACKGROUND_MAP)
  if (constants->backgroundWidth > 0 && some(seen)) {
    // Lane by lane, as those of vectors may round otherwise.
    float across[LANES], down[LANES], ahead[LANES];
    int wanted[LANES];
    STORE(d.x, across);
    STORE(d.y, down);
    STORE(d.z, ahead);
    STORE(seen, wanted);
    for (uint k = 0; k < LANES; ++k) {
      if (!wanted[k]) continue;
      across[k] = atan2(across[k], -ahead[k]);
      down[k] = acos(down[k] > -1.0f ? (down[k] < 1.0f ? down[k] : 1.0f) : -1.0f);
    }
    const Real u = constants->backgroundAhead + LOAD(across) * (0.5f / PI);
    const Real x = u * (float)constants->backgroundWidth - 0.5f;
    const Real y = LOAD(down) * (1.0f / PI) * (float)constants->backgroundHeight - 0.5f;
    const Real fx = floor(x), fy = floor(y);
    const Real wx = x - fx, wy = y - fy;
    const Mask ix = TO_WHOLE(fx), iy = TO_WHOLE(fy);
    const Real3 t00 = backgroundTexels(scene, constants, ix, iy), t10 = backgroundTexels(scene, constants, ix + 1, iy),
                t01 = backgroundTexels(scene, constants, ix, iy + 1),
                t11 = backgroundTexels(scene, constants, ix + 1, iy + 1);
    const Real3 top = add3(scale3(1.0f - wx, t00), scale3(wx, t10)),
                low = add3(scale3(1.0f - wx, t01), scale3(wx, t11));
    return mul3(uniform, add3(scale3(1.0f - wy, top), scale3(wy, low)));
  }
#endif
  return uniform;
}
