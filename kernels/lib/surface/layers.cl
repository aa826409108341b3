// What a material says of fibres and of a film over the surface, and of light from behind it, textures included.
#include "lib/surface/material.cl"
#include "lib/surface/sheen.cl"
#include "lib/surface/thin_film.cl"

#if HAS(SHEEN)
INLINE Sheen sheenAt(const SceneView* scene, const TrianglePoint* at) {
  Sheen sheen;
  sheen.color = MATERIAL3(at, sheenColor);
  sheen.roughness = MATERIAL(at, sheenRoughness);
#if HAS(TEXTURES)
  const Rgba color = TEXTURE_AT(scene, at, sheenColorTexture), rough = TEXTURE_AT(scene, at, sheenRoughnessTexture);
  sheen.color = mul3(sheen.color, real3(color.c[0], color.c[1], color.c[2]));
  sheen.roughness *= rough.c[3];
#endif
  sheen.roughness = clampUnit(sheen.roughness);
  sheen.largest = largestOfThree(sheen.color.x, sheen.color.y, sheen.color.z);
  return sheen;
}
#endif

#if HAS(DIFFUSE_TRANSMISSION)
/// The share of Lambert's part that leaves on the other side, and its colour.
INLINE Real diffuseTransmissionAt(const SceneView* scene, const TrianglePoint* at, Real3* color) {
  Real share = MATERIAL(at, diffuseTransmission);
  *color = MATERIAL3(at, diffuseTransmissionColor);
#if HAS(TEXTURES)
  const Rgba part = TEXTURE_AT(scene, at, diffuseTransmissionTexture),
             tint = TEXTURE_AT(scene, at, diffuseTransmissionColorTexture);
  share *= part.c[3];
  *color = mul3(*color, real3(tint.c[0], tint.c[1], tint.c[2]));
#endif
  return clampUnit(share);
}
#endif

#if HAS(IRIDESCENCE)
INLINE ThinFilm filmAt(const SceneView* scene, const TrianglePoint* at) {
  ThinFilm film;
  film.share = MATERIAL(at, iridescence);
  film.index = MATERIAL(at, iridescenceIor);
  film.thickness = MATERIAL(at, mostThickness);
#if HAS(TEXTURES)
  const Rgba share = TEXTURE_AT(scene, at, iridescenceTexture);
  const Rgba blended = TEXTURE_AT(scene, at, iridescenceThicknessTexture);
  const Real least = MATERIAL(at, leastThickness);
  film.share *= share.c[0];
  film.thickness = least + (film.thickness - least) * blended.c[1];
#endif
  film.share = clampUnit(film.share);
  return film;
}
#endif
