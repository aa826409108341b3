// Walls and lamp of the Cornell-like rooms.
#include "room.h"

namespace generator {

void addRoom(GltfBuilder& scene, glm::dvec3 low, glm::dvec3 high, const RoomMaterials& materials) {
  const glm::dvec3 d = high - low, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  const auto wall = [&](const char* name, glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, int material) {
    Mesh mesh;
    addQuad(mesh, corner, u, v);
    mesh.uv0.clear();
    mesh.tangents.clear();
    scene.add(name, std::move(mesh), material);
  };
  wall("left wall", low + z, -z, y, materials.left);
  wall("right wall", low + x, z, y, materials.right);
  wall("floor", low + z, x, -z, materials.floor);
  wall("ceiling", low + y, x, z, materials.ceiling);
  wall("back wall", low, x, y, materials.back);
  wall("front wall", low + x + z, -x, y, materials.front);
}

void addCeilingLamp(GltfBuilder& scene, glm::dvec3 at, double width, double depth, double radiance,
                    double intensity) {
  Mesh panel;
  addQuad(panel, at - glm::dvec3(width / 2, 0, depth / 2), {width, 0, 0}, {0, 0, depth});
  panel.uv0.clear();
  panel.tangents.clear();
  scene.add("lamp panel", std::move(panel), scene.addMaterial(lamp("lamp", glm::dvec3(radiance))));
  LightSpec light;
  light.name = "lamp light";
  light.intensity = intensity;
  light.position = at - glm::dvec3(0, 0.08, 0);
  scene.addLight(light);
}

}  // namespace generator
