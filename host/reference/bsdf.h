// What a surface does with light: the part that spreads it (met by lights) and the impulses (met by rays).
#pragma once

#include <array>
#include <span>

#include "reference/surfel.h"

namespace whittle::reference {

/// BSDF for light from w_i (unit, on either side), 1/sr, without impulses and without coverage.
/// `withoutGloss`: what a glossy surfel's impulses have is left out.
Vec3 spreadingBsdf(const Surfel& surfel, const Vec3& w_i, const Vec3& w_o, bool withoutGloss = false);

/// What a lit surface sends back of radiance 1 from all sides: Lambert's part, and where it is rough its
/// metal. What it reflects otherwise is in its impulses.
Vec3 ambientReflectance(const Surfel& surfel, const Vec3& w_o);

/// The delta part of the BSDF: all light goes one way.
struct Impulse {
  Vec3 w_i;               ///< unit, from the surface
  Vec3 magnitude;         ///< RGB factor
  bool through;           ///< leaves on the side that the viewer is not on
  bool straight = false;  ///< goes on the way the light came, as though nothing were there
  bool splits = false;    ///< one of the colours of a refraction; with the others it is one to all limits
  double eta = 1;         ///< of such a colour: index beyond over index on the viewer's side
};

/// None of them dark: at most two, of which a refraction may be three.
struct Impulses {
  std::array<Impulse, 4> items;
  int count = 0;

  void add(const Impulse& impulse) {
    if (!isDark(impulse.magnitude)) items[count++] = impulse;
  }
  std::span<const Impulse> all() const { return {items.data(), static_cast<std::size_t>(count)}; }
};

/// `facets`: of a glossy surfel which of the microfacets that w_o sees, a point of the unit square.
Impulses impulsesOf(const Surfel& surfel, const Vec3& w_o, const Vec2& facets = Vec2(0));

/// Without the colours of a refraction that the throughput has nothing of.
Impulses carriedBy(const Impulses& impulses, const Vec3& throughput);

/// One of them, chosen with probability in proportion to its luminance by `u` in [0,1), divided by that.
Impulses chooseOne(const Impulses& impulses, double u);

}  // namespace whittle::reference
