// What a material says at a point of a triangle, textures included, where more than shading asks.
#include "lib/surface/point.cl"

INLINE void metallicRoughnessAt(const SceneView* scene, const TrianglePoint* at, Real* metallic, Real* roughness) {
  *metallic = MATERIAL(at, metallic);
  *roughness = MATERIAL(at, roughness);
#if HAS(TEXTURES) && HAS(METALLIC_ROUGHNESS_TEXTURE)
  const Rgba texel = TEXTURE_AT(scene, at, metallicRoughnessTexture);
  *metallic *= texel.c[2];
  *roughness *= texel.c[1];
#endif
  *metallic = clampUnit(*metallic);
  *roughness = clampUnit(*roughness);
}

INLINE Real transmissionAt(const SceneView* scene, const TrianglePoint* at) {
  Real transmission = MATERIAL(at, transmission);
#if HAS(TEXTURES) && HAS(TRANSMISSION)
  const Rgba texel = TEXTURE_AT(scene, at, transmissionTexture);
  transmission *= texel.c[0];
#endif
  return transmission;
}
