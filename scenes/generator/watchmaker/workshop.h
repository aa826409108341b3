// What the parts of the watchmaker's bench share: finishes and a place. Everything in this folder is in
// millimetres: X to the right, Y up from the bench top, Z towards the camera.
#pragma once

#include "stage.h"

namespace generator {

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

using Workshop = FurnishedStage<Finishes>;

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
