// Which rays of a packet run the same way, and bounds of those. Rays of a mirror that bends, or of two surfaces, fall
// into groups: each goes down the tree by itself, the other lanes asleep.
#include "lib/search/bvh8.cl"
#include "lib/search/packet.cl"

#if HAS(TREE) && HAS(PACKETS)

/// Bounds of a packet: what can make the distance to a plane least and greatest.
typedef struct {
  float nearOrigin[3];  // origin for which the near plane's distance is least
  float farOrigin[3];   // origin for which the far plane's distance is greatest
  float inverseLo[3], inverseHi[3];
  int nearPlane[3];  // floats from a node to its near planes: 8 · axis, and 24 for hi
  int down[3];       // 1: directions are negative
#if HAS(STRAIGHT)
  float tMin;  // the least of the rays
#endif
} PacketBounds;

/// Rays go together whose directions have the same signs and lie as near to the first of them on each axis; fewer than
/// PACKET_LEAST are faster one by one, and after PACKET_TRIES rays without company none is looked for (experiments/).
#define PACKET_SPREAD 0.35f
#define PACKET_LEAST 8
#define PACKET_TRIES 2

#define ALL_LANES 0xffffu

/// Which rays of a packet are still to go; one bit for each lane.
typedef struct {
  uint left;
  uint alone;    // of those done: they go one by one
  uint down[3];  // directions that are negative on an axis
} Lanes;

/// Lanes that are awake; those with a direction next to parallel to an axis go alone.
INLINE Lanes lanesOf(const Packet* p, float16 tMax) {
  Lanes lanes;
  const uint awake = laneBits16(tMax >= 0.0f);
  int16 regular = (int16)(-1);
  for (int a = 0; a < 3; ++a) {
    lanes.down[a] = laneBits16(p->d[a] < 0.0f);
    regular &= fabs(p->inverse[a]) < INFINITY;
  }
  lanes.left = awake & laneBits16(regular);
  lanes.alone = awake & ~lanes.left;
  return lanes;
}

/// Takes lanes from those left that are worth a way together. 0: there are none, all others go alone.
INLINE uint nextGroup(const Packet* p, Lanes* lanes) {
  uint asked = lanes->left;
  for (int tries = 0; tries < PACKET_TRIES && popcount(asked) >= PACKET_LEAST; ++tries) {
    const uint first = lowestBit(asked);
    uint same = lanes->left;
    for (int a = 0; a < 3; ++a) same &= lanes->down[a] >> first & 1u ? lanes->down[a] : ~lanes->down[a];
    if (popcount(same) < PACKET_LEAST) {
      asked &= ~same;
      continue;
    }
    int16 near = (int16)(-1);
    for (int a = 0; a < 3; ++a) near &= fabs(p->d[a] - ((const float*)&p->d[a])[first]) <= PACKET_SPREAD;
    same &= laneBits16(near);
    if (popcount(same) >= PACKET_LEAST) {
      lanes->left &= ~same;
      return same;
    }
    asked &= ~same;
  }
  lanes->alone |= lanes->left;
  return 0;
}

/// Bounds of the rays in `lanes`, one bit for each, which are alike.
INLINE PacketBounds boundPacket(const Packet* p, uint lanes) {
  const float16 *o = p->o, *inverse = p->inverse;
  float16 ownOrigins[3], ownInverses[3];
  if (lanes != ALL_LANES) {
    // The others as copies of the first, so that they widen nothing.
    const uint first = lowestBit(lanes);
    const int16 mask = lanesOfBits(lanes);
    for (int a = 0; a < 3; ++a) {
      ownOrigins[a] = select((float16)(((const float*)&o[a])[first]), o[a], mask);
      ownInverses[a] = select((float16)(((const float*)&inverse[a])[first]), inverse[a], mask);
    }
    o = ownOrigins, inverse = ownInverses;
  }
  PacketBounds b;
  for (int a = 0; a < 3; ++a) {
    const float lo = least16(o[a]), hi = greatest16(o[a]);
    b.inverseLo[a] = least16(inverse[a]);
    b.inverseHi[a] = greatest16(inverse[a]);
    b.down[a] = b.inverseHi[a] < 0.0f;
    b.nearOrigin[a] = b.down[a] ? lo : hi;
    b.farOrigin[a] = b.down[a] ? hi : lo;
    b.nearPlane[a] = a * 8 + 24 * b.down[a];
  }
#if HAS(STRAIGHT)
  b.tMin = least16(select((float16)(INFINITY), p->tMin, lanesOfBits(lanes)));
#endif
  return b;
}

#endif
