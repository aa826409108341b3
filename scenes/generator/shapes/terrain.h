// Land that rain has shaped.
#pragma once

#include "mesh.h"

namespace generator {

/// A square of land about the origin.
struct TerrainSpec {
  int squares = 256;     ///< on a side
  double side = 200;     ///< metres
  double relief = 40;    ///< metres between about the lowest and the highest point
  int droplets = 60000;  ///< of rain, each carries earth downhill until it runs dry or leaves
  std::uint32_t series = 11000;
};

/// Heights on a grid of (squares + 1)² points, metres, row after row from -Z to +Z.
class Terrain {
 public:
  explicit Terrain(const TerrainSpec& spec);

  /// Metres at a place, bilinear; a place outside has the height of the border.
  double heightAt(double x, double z) const;
  /// Unit length.
  glm::dvec3 normalAt(double x, double z) const;

 private:
  friend class Rain;

  TerrainSpec spec_;
  std::vector<double> heights_;
};

/// 2 · squares² triangles with vertex colours: rock where it is steep, grass where it is not, and gravel
/// where water ran.
Mesh meshOf(const Terrain& terrain, const TerrainSpec& spec);

}  // namespace generator
