// Triangle meshes of the project's scenes: plain arrays and the few shapes that the scenes are made of.
// Local space, metres, right-handed, +Y up, counter-clockwise from the front, as in glTF 2.0.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace generator {

/// Per-vertex arrays are empty or as long as `positions`.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec2> uv0;
  std::vector<glm::vec2> uv1;
  std::vector<glm::vec4> colors;
  std::vector<std::uint32_t> indices;
};

/// cos and sin of the i-th of n parts of a full turn, exact at the quarters so that seams close.
glm::dvec2 onCircle(int i, int n);

/// Adds the rectangle corner, corner + u, corner + u + v, corner + v; its front looks along u × v. uv0 runs
/// from (0, repeat.y) at `corner` to (repeat.x, 0) opposite it, so that a picture stands upright where v
/// points up; tangents go with it.
void addQuad(Mesh& mesh, glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, glm::dvec2 repeat = {1, 1});

/// That rectangle alone.
Mesh makeQuad(glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, glm::dvec2 repeat = {1, 1});

/// An axis-aligned box with outward faces.
void addBox(Mesh& mesh, glm::dvec3 low, glm::dvec3 high);

/// A sphere with smooth normals about the origin. Its positions are its normals where radius = 1.
Mesh makeSphere(double radius, int segments, int rings);
/// The unit sphere that every scene uses: round at 1280 pixels, small enough for a scene file.
Mesh makeUnitSphere();

/// A tube around +Y from y = 0 to `height`, open at both ends, smooth normals outwards.
Mesh makeCylinder(double radius, double height, int segments);

/// A ring around the Z axis, smooth normals.
Mesh makeTorus(double radius, double tubeRadius, int segments, int tubeSegments);

/// Rows × columns squares in the plane y = 0 about the origin with their front up, every second one: the
/// other half belongs to a call with the other `parity`.
Mesh makeCheckers(int rows, int columns, double side, int parity);

/// Adds `more` behind what is there; both have the same arrays.
void append(Mesh& mesh, const Mesh& more);

/// Moved by a matrix that turns, moves and scales evenly.
Mesh moved(Mesh mesh, const glm::dmat4& matrix);

/// Without what textures need.
Mesh untextured(Mesh mesh);

/// The same surface with its front on the other side: the wall of a hollow inside a solid.
Mesh insideOut(Mesh mesh);

}  // namespace generator
