// The local surface at a hit: position, normals, and the material with its textures looked up.
#pragma once

#include <array>
#include <optional>

#include "reference/fresnel.h"
#include "reference/sheen.h"
#include "reference/texture_levels.h"
#include "reference/thin_film.h"
#include "reference/triangle_index.h"
#include "scene/settings.h"

namespace whittle::reference {

/// A clear coat over everything else (KHR_materials_clearcoat).
struct Coat {
  double reflectance = 0;  ///< towards the viewer, times how much of the surface it covers; 0: there is none
  double roughness = 0;
  Vec3 n{0};            ///< its own unit shading normal, n·w_o > 0
  bool smooth = false;  ///< as of the surfel
  bool glossy = false;
};

/// What dispersion makes of a glass: an interface for each colour (KHR_materials_dispersion).
struct Dispersion {
  std::array<TintedFresnel, 3> fresnel;
  std::array<double, 3> eta;  ///< as of the surfel
};

struct Surfel {
  Vec3 position;     ///< world, metres
  Vec3 facing;       ///< N_g: unit geometric normal on the side of the viewer
  Vec3 n;            ///< unit shading normal, n·w_o > 0
  bool front;        ///< seen from the side of the counter-clockwise winding
  double rayOffset;  ///< metres between `position` and the origins of secondary rays
  Vec3 baseColor;    ///< linear
  double alpha;      ///< coverage, in [0,1]
  double metallic;
  double roughness;
  double transmission;
  bool smooth;  ///< reflects as a mirror
  bool glossy;  ///< is not smooth, and reflects by microfacets (Settings::glossy)
  bool volume;  ///< bounds a solid: rays refract
  bool unlit;
  TintedFresnel fresnel;
  double eta;       ///< index beyond over index on the viewer's side
  Vec3 emission;    ///< towards the viewer, W/(m² sr)
  Vec3 sigma_a;     ///< 1/m, of the solid behind the front
  double bend = 0;  ///< curvature: half the divergence, 1/m, of vertex normals turned to the viewer
  /// With Settings::smoothTerminator, where the vertex normals mean a curved surface: from `position` to
  /// that, m.
  std::optional<Vec3> lift = {};
  Coat coat = {};
  Sheen sheen = {};
  ThinFilm film = {};
  Vec3 grain{0};       ///< unit, across n: along it facets are rougher (KHR_materials_anisotropy); 0: none
  double stretch = 0;  ///< square of the strength
  std::optional<Dispersion> split = {};
  double diffuseTransmission = 0;  ///< the share of Lambert's part that leaves on the other side
  Vec3 diffuseTransmissionColor{1};
  std::optional<Vec3> liftBehind = {};  ///< `lift` of the other side, where light comes through from there
};

/// How a ray reads textures: the mean over what it stands for, where its cone is `width` metres wide. Without
/// levels: as they are.
struct Filtering {
  const TextureLevels* levels = nullptr;
  double width = 0;
};

/// The surface as seen along `ray`, which hits it.
Surfel makeSurfel(const Scene& scene, const Settings& settings, const TriangleIndex& triangles,
                  const Ray& ray, const Hit& hit, const Filtering& filtering = {});

/// The same place as light on its other side finds it: position, normals and lift, nothing else.
Surfel turnedOver(Surfel surfel);

/// Whether the alpha mask leaves this hit standing.
bool passesMask(const Scene& scene, const Hit& hit);

/// What a shadow ray keeps, per channel, of the light that crosses the surface at a hit; 0: nothing.
Vec3 shadowTransmittance(const Scene& scene, const TriangleIndex& triangles, const Ray& ray, const Hit& hit);

}  // namespace whittle::reference
