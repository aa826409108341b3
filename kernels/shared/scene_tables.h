// Lights and materials as host and kernels both know them, one row each: light types, texture slots, factors,
// what only some materials do. Who needs a list of them walks these tables; nobody writes a second one.
#ifndef WHITTLE_SCENE_TABLES_H
#define WHITTLE_SCENE_TABLES_H

// X(Kind, NAME, word, unit, isPlaced, isAimed, hasCone): LightKind::Kind on the host, LIGHT_NAME in kernels,
// the feature NAME_LIGHTS; what glTF and a person call it; the unit of its intensity; which fields of Light
// it uses: position and range, direction, the two cone angles. A light with a place falls off with the
// squared distance. Surface: all triangles that glow (--area-lights). Sky: the background (--sky-light). No file has
// these two.
#define WHITTLE_LIGHT_TYPES(X)                                  \
  X(Point, POINT, "point", "W/sr", 1, 0, 0)                     \
  X(Directional, DIRECTIONAL, "directional", "W/m²", 0, 1, 0)   \
  X(Spot, SPOT, "spot", "W/sr", 1, 1, 1)                        \
  X(Surface, SURFACE, "surface", "times its emission", 0, 0, 0) \
  X(Sky, SKY, "sky", "times the background", 0, 0, 0)

// X(slot, FEATURE, encoding, factor, (OTHERS)): the member of Material, and of DeviceMaterial that holds its
// index; the feature of reading it; how its colours are stored; what is multiplied by it, of a material m
// (where that is 0 it is not read; 1: it always is); the features of which one must be there for it to show,
// UNLIT among them where an unlit surface shows it.
#define WHITTLE_TEXTURE_SLOTS(X) WHITTLE_OWN_TEXTURE_SLOTS(X) WHITTLE_PART_TEXTURE_SLOTS(X)
// Those that have a feature of their own.
#define WHITTLE_OWN_TEXTURE_SLOTS(X)                                                                  \
  X(baseColorTexture, BASE_COLOR_TEXTURE, SRGB, 1.0F, (LIGHTS, IMPULSES, UNLIT, ALPHA_MASK, AMBIENT)) \
  X(metallicRoughnessTexture, METALLIC_ROUGHNESS_TEXTURE, LINEAR, 1.0F, (LIGHTS, IMPULSES, AMBIENT))  \
  X(normalTexture, NORMAL_TEXTURE, LINEAR, 1.0F, (LIGHTS, IMPULSES))
// Those that are read with the feature of what they belong to: a lookup asks whether anything is there.
#define WHITTLE_PART_TEXTURE_SLOTS(X)                                                                        \
  X(emissionTexture, EMISSION, SRGB, m.emission, (EMISSION))                                                 \
  X(specularTexture, SPECULAR_EXTENSION, LINEAR, m.specular, (SPECULAR_EXTENSION))                           \
  X(specularColorTexture, SPECULAR_EXTENSION, SRGB, m.specularColor, (SPECULAR_EXTENSION))                   \
  X(transmissionTexture, TRANSMISSION, LINEAR, m.transmission, (TRANSMISSION))                               \
  X(clearcoatTexture, CLEARCOAT, LINEAR, m.clearcoat, (CLEARCOAT))                                           \
  X(clearcoatRoughnessTexture, CLEARCOAT, LINEAR, m.clearcoat, (CLEARCOAT))                                  \
  X(clearcoatNormalTexture, CLEARCOAT, LINEAR, m.clearcoat, (CLEARCOAT))                                     \
  X(sheenColorTexture, SHEEN, SRGB, m.sheenColor, (SHEEN))                                                   \
  X(sheenRoughnessTexture, SHEEN, LINEAR, m.sheenColor, (SHEEN))                                             \
  X(iridescenceTexture, IRIDESCENCE, LINEAR, m.iridescence, (IRIDESCENCE))                                   \
  X(iridescenceThicknessTexture, IRIDESCENCE, LINEAR, m.iridescence, (IRIDESCENCE))                          \
  X(anisotropyTexture, ANISOTROPY, LINEAR, m.anisotropy, (ANISOTROPY))                                       \
  X(diffuseTransmissionTexture, DIFFUSE_TRANSMISSION, LINEAR, m.diffuseTransmission, (DIFFUSE_TRANSMISSION)) \
  X(diffuseTransmissionColorTexture, DIFFUSE_TRANSMISSION, SRGB, m.diffuseTransmission, (DIFFUSE_TRANSMISSION))

// The numbers of a material, of the same name in Material and DeviceMaterial, in the order of the latter:
// VECTOR(name, size, least, most, isUnlit), SCALAR(name, least, most, isUnlit). What they may be: outside of
// that the loader warns, and there may be no bound on radiance. Whether an unlit surface shows them.
#define WHITTLE_MATERIAL_FACTORS(VECTOR, SCALAR)             \
  VECTOR(baseColor, 4, 0, 1, 1)                              \
  VECTOR(emission, 3, 0, FLT_MAX, 0) /* W/(m² sr) */        \
  SCALAR(metallic, 0, 1, 0)                                  \
  VECTOR(sigma_a, 3, 0, INFINITY, 1) /* 1/m */               \
  SCALAR(roughness, 0, 1, 0)                                 \
  VECTOR(specularColor, 3, 0, FLT_MAX, 0)                    \
  SCALAR(specular, 0, 1, 0)                                  \
  SCALAR(transmission, 0, 1, 0)                              \
  SCALAR(ior, 0, FLT_MAX, 0)                                 \
  SCALAR(alphaCutoff, 0, FLT_MAX, 1)                         \
  SCALAR(normalScale, -FLT_MAX, FLT_MAX, 0)                  \
  SCALAR(clearcoat, 0, 1, 0)                                 \
  SCALAR(clearcoatRoughness, 0, 1, 0)                        \
  SCALAR(clearcoatNormalScale, -FLT_MAX, FLT_MAX, 0)         \
  VECTOR(sheenColor, 3, 0, 1, 0)                             \
  SCALAR(sheenRoughness, 0, 1, 0)                            \
  SCALAR(iridescence, 0, 1, 0)                               \
  SCALAR(iridescenceIor, 1, FLT_MAX, 0)                      \
  SCALAR(leastThickness, 0, FLT_MAX, 0) /* nm */             \
  SCALAR(mostThickness, 0, FLT_MAX, 0)                       \
  SCALAR(anisotropy, 0, 1, 0)                                \
  SCALAR(anisotropyRotation, -FLT_MAX, FLT_MAX, 0) /* rad */ \
  SCALAR(dispersion, 0, FLT_MAX, 0)                          \
  SCALAR(diffuseTransmission, 0, 1, 0)                       \
  VECTOR(diffuseTransmissionColor, 3, 0, 1, 0)

// What only some materials do: X(FEATURE, isAsked, reason, (OTHERS)): the feature; whether a material m asks
// for it; what a person is told where none does; the features of which one must be there for it to show.
#define WHITTLE_MATERIAL_FEATURES(X)                                                                                   \
  X(METAL, isMetallic(m), "no material is metallic", (MICROFACET, MIRROR, REFRACTION))                                 \
  X(SPECULAR_EXTENSION, changesSpecular(m), "no material changes its specular strength or colour", (LIGHTS, IMPULSES)) \
  X(TRANSMISSION, transmits(m), "no material transmits", (IMPULSES))                                                   \
  X(ABSORPTION, absorbs(m), "no volume absorbs", (TRANSMISSION, UNLIT)) /* a way in */                                 \
  X(CLEARCOAT, isCoated(m), "no material has a clear coat", (LIGHTS, IMPULSES, EMISSION, AMBIENT))                     \
  X(SHEEN, hasSheen(m), "no material has a sheen", (LIGHTS, IMPULSES, AMBIENT))                                        \
  X(IRIDESCENCE, isIridescent(m), "no material is iridescent", (LIGHTS, IMPULSES, AMBIENT))                            \
  X(ANISOTROPY, isAnisotropic(m), "no material is anisotropic", (MICROFACET, GLOSS))                                   \
  X(DISPERSION, disperses(m), "no glass splits colours", (LIGHTS, IMPULSES, AMBIENT))                                  \
  X(DIFFUSE_TRANSMISSION, transmitsDiffusely(m), "no material lets light through diffusely", (LIGHTS, AMBIENT))

#endif
