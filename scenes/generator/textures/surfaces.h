// Surfaces of the scene kit, each a file of its own. All repeat without a seam over `metres`, and no hash
// series is used by two of them.
#pragma once

#include "textures/bake.h"

namespace generator {

/// Boards along x, `boards` of them, of a dark hardwood: growth rings cut at a slant, fine pores, worn
/// varnish.
SurfaceFunction woodSurface(int boards);

/// White marble with grey veins.
SurfaceFunction marbleSurface();

/// Lime plaster, trowelled by hand.
SurfaceFunction plasterSurface(glm::dvec3 color);

/// Glazed square tiles, `perSide` × `perSide`, with joints of mortar.
SurfaceFunction tileSurface(int perSide, glm::dvec3 glaze);

/// Metal brushed along x: fine scratches of different length. `depth` metres from crest to crest.
SurfaceFunction brushedMetalSurface(glm::dvec3 color, double roughness, double depth);

/// Metal with rows of overlapping discs that a rotating peg has polished: perlage. `perSide` discs a side.
SurfaceFunction pearledMetalSurface(int perSide, glm::dvec3 color, double roughness);

/// Metal with broad parallel ridges along y, `stripes` of them: Geneva stripes.
SurfaceFunction stripedMetalSurface(int stripes, glm::dvec3 color, double roughness);

/// Plain weave of `threads` threads each way.
SurfaceFunction fabricSurface(int threads, glm::dvec3 color);

/// Leather: pebbles between creases, `pebbles` a side.
SurfaceFunction leatherSurface(int pebbles, glm::dvec3 color);

}  // namespace generator
