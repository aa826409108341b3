// The project's scenes, one function and one file for each. scenes/README.md says what each is for.
#pragma once

#include "gltf_builder.h"

namespace generator {

void buildCornellBox(GltfBuilder& scene);
void buildMirrorBox(GltfBuilder& scene);
void buildSpotCone(GltfBuilder& scene);
void buildEmission(GltfBuilder& scene);
void buildShadow(GltfBuilder& scene);
void buildMirror(GltfBuilder& scene);
void buildRefraction(GltfBuilder& scene);
void buildAntiAliasing(GltfBuilder& scene);
void buildWhiteFurnace(GltfBuilder& scene);
void buildNestedGlass(GltfBuilder& scene);
void buildTextured(GltfBuilder& scene);
/// Hills of n × n squares (2n² triangles) that fill the same part of the picture whatever n is.
void buildHeightField(GltfBuilder& scene, int n);
/// The whole-frame benchmark: 560 × 560 squares (627 200 triangles), one point light, mirror spheres above.
void buildFrame(GltfBuilder& scene);
/// Triangles of a millimetre beside triangles of 120 km and slivers a millimetre wide: what is hard
/// on a tree.
void buildMixed(GltfBuilder& scene);
/// A composition of 1.5 million triangles: a watchmaker's bench at dusk.
void buildWatchmaker(GltfBuilder& scene);
/// A composition: a breakfast table by a window in the first sun.
void buildBreakfast(GltfBuilder& scene);
/// A composition: a diner of chrome and neon after the rain, at dusk.
void buildDiner(GltfBuilder& scene);
/// Eroded land with woods and meadows, 6 million triangles of copies.
void buildValley(GltfBuilder& scene);

}  // namespace generator
