// A closed box-shaped room: what the Cornell-like scenes share.
#pragma once

#include "gltf_builder.h"

namespace generator {

/// Materials of the six walls of the room from `low` to `high`, fronts inwards.
struct RoomMaterials {
  int left, right, floor, ceiling, back, front;
};

void addRoom(GltfBuilder& scene, glm::dvec3 low, glm::dvec3 high, const RoomMaterials& materials);

/// A lamp panel of `width` × `depth` metres whose centre hangs at `at`, shining down with `radiance`, and
/// under it a point light that stands for its light (an emitter by itself lights nothing in Whitted's model).
void addCeilingLamp(GltfBuilder& scene, glm::dvec3 at, double width, double depth, double radiance,
                    double intensity);

}  // namespace generator
