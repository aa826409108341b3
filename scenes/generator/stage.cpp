// Placing, and turns.
#include "stage.h"

#include <cmath>

namespace generator {

void Stage::add(const std::string& name, Mesh mesh, const Finish& finish, const Placement& inner) const {
  placeMesh(addMesh(name, std::move(mesh), finish), inner);
}

void Stage::add(const std::string& name, const Plate& plate, const Finish& faces, const Finish& edges,
                const Placement& inner) const {
  add(name, plate.faces, faces, inner);
  add(name + " edges", plate.edges, edges, inner);
}

void Stage::placeMesh(int mesh, const Placement& inner) const {
  if (assembly) {
    assembly->push_back({mesh, within(place, inner)});
  } else {
    scene.placeMesh(mesh, within(place, inner));
  }
}

void Stage::placeAll(const Assembly& parts) const {
  for (const PlacedMesh& part : parts) placeMesh(part.mesh, part.place);
}

int Stage::addMesh(const std::string& name, Mesh mesh, const Finish& finish) const {
  const int geometry = scene.addGeometry(finish.isTextured ? std::move(mesh) : untextured(std::move(mesh)));
  return scene.addMesh(name, geometry, finish.material);
}

Finish plainFinish(GltfBuilder& scene, const MaterialSpec& spec) { return {scene.addMaterial(spec), false}; }

Finish bakedFinish(GltfBuilder& scene, const MaterialSpec& spec, const BakeSize& size,
                   const SurfaceFunction& surface) {
  return {scene.addMaterial(withTextures(scene, spec, size, surface)), true};
}

Finish glowingFinish(GltfBuilder& scene, const std::string& name, double metres, glm::dvec3 glow,
                     const SurfaceFunction& surface) {
  MaterialSpec spec = withTextures(scene, matte(name, {}), {1024, 1024, metres}, surface);
  spec.emission = glow;
  spec.emissionTexture = spec.baseColorTexture;
  return {scene.addMaterial(spec), true};
}

glm::dquat upTo(glm::dvec3 direction) {
  const glm::dvec3 to = glm::normalize(direction), up(0, 1, 0);
  if (to.y < -0.999999) return {0, 1, 0, 0};
  const glm::dvec3 axis = glm::cross(up, to);
  return glm::normalize(glm::dquat(1 + to.y, axis.x, axis.y, axis.z));
}

glm::dquat turnAbout(glm::dvec3 axis, double degrees) {
  const double half = glm::radians(degrees) / 2;
  return {std::cos(half), std::sin(half) * glm::normalize(axis)};
}

}  // namespace generator
