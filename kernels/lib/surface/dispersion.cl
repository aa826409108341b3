// What dispersion makes of a glass: red, green and blue have an index each, about the material's own, and so each a way
// of its own through the surface (KHR_materials_dispersion). Formulas: host/reference/README.md.
#include "lib/surface/footprint.cl"
#include "lib/surface/material.cl"

#if HAS(DISPERSION)
/// How far the indices of red and blue are from that of green, which is `ior`; 0 where colours stay together.
INLINE Real halfSpreadAt(const TrianglePoint* at, Natural flags, Real transmission, Real ior) {
  const Real away = (ior - 1.0f) * 0.025f * MATERIAL(at, dispersion);
  const Mask splits = ((flags & MATERIAL_VOLUME) != 0) & (transmission > 0.0f) & (away > 0.0f);
  return splits ? away : (Real)(0.0f);
}

/// Of red (0), green or blue (2).
INLINE Real channelIndex(Real ior, Real halfSpread, uint channel) {
  const Real own = ior + ((float)channel - 1.0f) * halfSpread;
  const Real least = own > 1.0f ? own : (Real)(1.0f);
  return halfSpread > 0.0f ? least : ior;
}
#endif
