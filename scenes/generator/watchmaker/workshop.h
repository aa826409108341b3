// What the parts of the watchmaker's bench share: finishes and a place. Everything in this folder is in
// millimetres: X to the right, Y up from the bench top, Z towards the camera.
#pragma once

#include <utility>

#include "gltf_builder.h"
#include "shapes/plate.h"

namespace generator {

/// A material; meshes of one without textures lose their texture coordinates.
struct Finish {
  int material = -1;
  bool isTextured = false;
};

struct Finishes {
  // metals; `polished` ones are mirrors
  Finish polishedGold, polishedBrass, polishedSteel, satinSteel, bluedSteel, gilt, wheelBrass, pearledNickel,
      stripedNickel;
  // glass and stones
  Finish crystal, ruby, oil, pane;
  // the bench and the room
  Finish walnut, darkWood, leather, stitch, cloth, enamel, dial, ink, marble, plaster, tiles;
  // what glows
  Finish bulb, shadeInside, lantern, blind;
};

Finishes addFinishes(GltfBuilder& scene);

/// Meshes and where they lie in a whole that can be placed more than once.
struct PlacedMesh {
  int mesh;
  Placement place;
};
using Assembly = std::vector<PlacedMesh>;

struct Workshop {
  GltfBuilder& scene;
  Finishes finishes;
  Placement place;               ///< of the origin of what is added; its scale makes metres of millimetres
  Assembly* assembly = nullptr;  ///< where there is one, parts go there and not into the scene

  /// The same workshop with another origin, itself placed within this one.
  Workshop at(const Placement& inner) const { return {scene, finishes, within(place, inner), assembly}; }

  void add(const std::string& name, Mesh mesh, const Finish& finish, const Placement& inner = {}) const;
  void add(const std::string& name, const Plate& plate, const Finish& faces, const Finish& edges,
           const Placement& inner = {}) const;
  /// For placeMesh().
  int addMesh(const std::string& name, Mesh mesh, const Finish& finish) const;
  void placeMesh(int mesh, const Placement& inner) const;
  void placeAll(const Assembly& parts) const;
};

/// The turn that takes +Y to `direction`.
glm::dquat upTo(glm::dvec3 direction);
/// The turn by `degrees` about `axis`.
glm::dquat turnAbout(glm::dvec3 axis, double degrees);

// The parts, each where it lies in the composition or at the origin of `workshop`.
Assembly makeMovement(const Workshop& workshop);  ///< dial side down; +Y to whoever looks at the wheels
void addWatch(const Workshop& workshop, const Assembly& movement);  ///< case, lid, movement, on its stand
void addBench(const Workshop& workshop);
void addTools(const Workshop& workshop);
void addTray(const Workshop& workshop);
void addLamp(const Workshop& workshop);
void addMagnifier(const Workshop& workshop);
void addGlassware(const Workshop& workshop, const Assembly& movement);
void addTableClock(const Workshop& workshop);
void addRoomAround(const Workshop& workshop);
void addCity(const Workshop& workshop);

}  // namespace generator
