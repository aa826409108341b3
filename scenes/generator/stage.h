// What the parts of a composition are added to: a place in a scene, in a unit of its own, and finishes.
#pragma once

#include <utility>
#include <vector>

#include "gltf_builder.h"
#include "shapes/plate.h"
#include "textures/bake.h"

namespace generator {

/// A material; meshes of one without textures lose their texture coordinates.
struct Finish {
  int material = -1;
  bool isTextured = false;
};

/// Meshes and where they lie in a whole that can be placed more than once.
struct PlacedMesh {
  int mesh;
  Placement place;
};
using Assembly = std::vector<PlacedMesh>;

struct Stage {
  GltfBuilder& scene;
  Placement place;  ///< of the origin of what is added; its scale makes metres of the stage's unit
  Assembly* assembly = nullptr;  ///< where there is one, parts go there and not into the scene

  void add(const std::string& name, Mesh mesh, const Finish& finish, const Placement& inner = {}) const;
  void add(const std::string& name, const Plate& plate, const Finish& faces, const Finish& edges,
           const Placement& inner = {}) const;
  /// For placeMesh().
  int addMesh(const std::string& name, Mesh mesh, const Finish& finish) const;
  void placeMesh(int mesh, const Placement& inner) const;
  void placeAll(const Assembly& parts) const;
};

/// A stage with the materials of its composition.
template <class Finishes>
struct FurnishedStage : Stage {
  Finishes finishes;

  /// The same stage with another origin, itself placed within this one.
  FurnishedStage at(const Placement& inner) const {
    return {{scene, within(place, inner), assembly}, finishes};
  }
};

/// The turn that takes +Y to `direction`.
glm::dquat upTo(glm::dvec3 direction);
/// The turn by `degrees` about `axis`.
glm::dquat turnAbout(glm::dvec3 axis, double degrees);

/// Adds a material without textures, and one whose textures are baked (textures/bake.h).
Finish plainFinish(GltfBuilder& scene, const MaterialSpec& spec);
Finish bakedFinish(GltfBuilder& scene, const MaterialSpec& spec, const BakeSize& size,
                   const SurfaceFunction& surface);

/// A baked matte surface that glows in its own colours times `glow`, as light that is thrown back would make
/// it, were it followed.
Finish glowingFinish(GltfBuilder& scene, const std::string& name, double metres, glm::dvec3 glow,
                     const SurfaceFunction& surface);

}  // namespace generator
