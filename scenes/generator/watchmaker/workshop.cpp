// Placing, and turns.
#include "watchmaker/workshop.h"

#include <cmath>

namespace generator {

void Workshop::add(const std::string& name, Mesh mesh, const Finish& finish, const Placement& inner) const {
  placeMesh(addMesh(name, std::move(mesh), finish), inner);
}

void Workshop::add(const std::string& name, const Plate& plate, const Finish& faces, const Finish& edges,
                   const Placement& inner) const {
  add(name, plate.faces, faces, inner);
  add(name + " edges", plate.edges, edges, inner);
}

void Workshop::placeMesh(int mesh, const Placement& inner) const {
  if (assembly) {
    assembly->push_back({mesh, within(place, inner)});
  } else {
    scene.placeMesh(mesh, within(place, inner));
  }
}

void Workshop::placeAll(const Assembly& parts) const {
  for (const PlacedMesh& part : parts) placeMesh(part.mesh, part.place);
}

int Workshop::addMesh(const std::string& name, Mesh mesh, const Finish& finish) const {
  const int geometry = scene.addGeometry(finish.isTextured ? std::move(mesh) : untextured(std::move(mesh)));
  return scene.addMesh(name, geometry, finish.material);
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
