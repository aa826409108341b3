// Watertight ray-triangle test (Woop, Benthin, Wald 2013): its mathematics for every width, and the test of one ray.
// The edge functions carry the exact sign of the projected areas (difference of products with two fma), so two
// triangles that share an edge cannot both reject.
#include "lib/search/order.cl"

#include "lib/corners.cl"

/// A ray with the shear that turns its largest axis into +z: o + t d.
typedef struct {
  float o[3];
  float d[3];
  float inverse[3];  // 1/d, ±inf below 1e-18; for boxes only
  int kx, ky, kz;
  float sx, sy, sz;
#if HAS(STRAIGHT)
  Passed passed;
#endif
} Ray;

/// Where the corners of one triangle are: coordinate `axis` of corner k is at[(3 k + axis) stride], m.
typedef struct {
  __global const float* at;
  uint stride;
} Corners;

INLINE Corners cornersOfTriangle(const SceneView* scene, uint index) {
  const CornerPlace place = cornerPlace(scene, index);
  const Corners corners = {scene->leaves + place.first, place.stride};
  return corners;
}

INLINE float coordinate(const Corners* c, int corner, int axis) { return c->at[(uint)(3 * corner + axis) * c->stride]; }

/// The candidate of one triangle test.
typedef struct {
  float t, b1, b2;
  int front;   // the ray meets the front side
  int onEdge;  // perhaps: ownsHit knows
} Candidate;

INLINE float boxInverse(float d) { return fabs(d) > 1e-18f ? 1.0f / d : copysign(INFINITY, d); }

/// A ray with NaN or infinite parts meets nothing; without this test it would visit every box.
INLINE int isFiniteRay(const Ray* r) {
  return isFinite3(real3(r->o[0], r->o[1], r->o[2])) && isFinite3(real3(r->d[0], r->d[1], r->d[2]));
}

Ray makeRay(Real3 o, Real3 d) {
  Ray r;
  r.o[0] = o.x, r.o[1] = o.y, r.o[2] = o.z;
  r.d[0] = d.x, r.d[1] = d.y, r.d[2] = d.z;
  for (int a = 0; a < 3; ++a) r.inverse[a] = boxInverse(r.d[a]);
  const float ax = fabs(d.x), ay = fabs(d.y), az = fabs(d.z);
  r.kz = ax > ay ? (ax > az ? 0 : 2) : (ay > az ? 1 : 2);
  r.kx = r.kz == 2 ? 0 : r.kz + 1;
  r.ky = r.kx == 2 ? 0 : r.kx + 1;
  r.sz = 1.0f / r.d[r.kz];
  r.sx = r.d[r.kx] * r.sz;
  r.sy = r.d[r.ky] * r.sz;
#if HAS(STRAIGHT)
  r.passed = nothingPassed();
#endif
  return r;
}

/// Least and greatest of three.
INLINE void extent(float a, float b, float c, float* lo, float* hi) {
  const float least = a < b ? a : b, greatest = a < b ? b : a;
  *lo = c < least ? c : least;
  *hi = c > greatest ? c : greatest;
}

/// Corners farther along the ray's largest axis than this many times the hit make t imprecise: their rounding is not
/// the hit's. Below it t is off by less than FAR_WIDENING takes care of.
#define FAR_CORNERS 1.5f

/// From corners (x, y) sheared onto the ray: areas u, v, w across from each corner, and whether the ray passes inside,
/// all of them of one sign.
#define EDGE_TEST(Float, Mask, width)                                                                         \
  INLINE Mask edgeTest##width(Float ax, Float ay, Float bx, Float by, Float cx, Float cy, Float* u, Float* v, \
                              Float* w) {                                                                     \
    *u = differenceOfProducts##width(cx, by, cy, bx);                                                         \
    *v = differenceOfProducts##width(ax, cy, ay, cx);                                                         \
    *w = differenceOfProducts##width(bx, ay, by, ax);                                                         \
    return ((*u >= 0.0f) & (*v >= 0.0f) & (*w >= 0.0f)) | ((*u <= 0.0f) & (*v <= 0.0f) & (*w <= 0.0f));       \
  }
EDGE_TEST(float, int, )
EDGE_TEST(float8, int8, 8)
EDGE_TEST(float16, int16, 16)

/// Distance of the hit; det: the sum of its areas, z: the corners' distances along the ray's largest axis, sz: one over
/// the direction there. far: where t is still to be clamped to the triangle's box.
#define HIT_DISTANCE(Float, Mask, width)                                                                        \
  INLINE Float hitDistance##width(Float u, Float v, Float w, Float det, Float sz, Float az, Float bz, Float cz, \
                                  Mask* far) {                                                                  \
    /* Weights first: area times distance would overflow from coordinates of 1e13 m on. */                      \
    const Float weight = sz / det;                                                                              \
    const Float t = fma(u * weight, az, fma(v * weight, bz, w * weight * cz));                                  \
    const Float ab = fabs(az) > fabs(bz) ? fabs(az) : fabs(bz);                                                 \
    const Float corners = ab > fabs(cz) ? ab : fabs(cz);                                                        \
    *far = corners * fabs(sz) > FAR_CORNERS * fabs(t);                                                          \
    return t;                                                                                                   \
  }
HIT_DISTANCE(float, int, )
HIT_DISTANCE(float8, int8, 8)
HIT_DISTANCE(float16, int16, 16)

/// Whether one of a hit's areas may be 0; u is then det - v - w without a rounding.
INLINE int mayLieOnEdge(float v, float w, float det) { return v == 0.0f || w == 0.0f || det == v + w; }

/// On which side of the edge from p to q a ray is that meets it exactly, were it moved by (e, e²) for a tiny e.
INLINE float sideOfEdge(float px, float py, float qx, float qy) { return py != qy ? py - qy : qx - px; }

/// A ray that meets an edge meets all triangles there, so that nothing leaks. Where each of them takes its share of
/// the light, that would be too often: the hit then belongs to the triangle that a ray a tiny way beside it would
/// meet, of neighbours to one (the rule by which rasterisers fill shared edges).
int ownsHit(const float* o, int kx, int ky, int kz, float sx, float sy, const Corners* triangle) {
  float x[3], y[3];
  for (int k = 0; k < 3; ++k) {
    const float z = coordinate(triangle, k, kz) - o[kz];
    x[k] = fma(-sx, z, coordinate(triangle, k, kx) - o[kx]);
    y[k] = fma(-sy, z, coordinate(triangle, k, ky) - o[ky]);
  }
  float u, v, w;
  edgeTest(x[0], y[0], x[1], y[1], x[2], y[2], &u, &v, &w);
  const int positive = u + v + w > 0.0f;
  if (u == 0.0f && (sideOfEdge(x[2], y[2], x[1], y[1]) > 0.0f) != positive) return 0;
  if (v == 0.0f && (sideOfEdge(x[0], y[0], x[2], y[2]) > 0.0f) != positive) return 0;
  if (w == 0.0f && (sideOfEdge(x[1], y[1], x[0], y[0]) > 0.0f) != positive) return 0;
  return 1;
}

/// Whether the ray meets the front: the areas have the sign of -n_g · d / d[kz], and sz is 1 / d[kz].
INLINE int facesRay(float det, float sz) { return (det > 0.0f) == (sz > 0.0f); }

/// t kept between the distances at which the ray enters and leaves the triangle's own box; for triangles with far
/// corners. Else t could lie before the box, and which of two triangles is nearer would depend on the order in which
/// boxes are culled; of a triangle across an axis, a floor, t becomes exact. NaN stays NaN. First all near planes, then
/// all far ones, so that the order of the axes does not matter. clampToBox8 and clampToBox16 follow it;
/// SearchAgreement.GravelOnAPlain holds them to its bits.
INLINE float clampToBox(const Ray* r, const Corners* triangle, float t) {
  float far[3];
  for (int a = 0; a < 3; ++a) {
    float lo, hi;
    extent(coordinate(triangle, 0, a), coordinate(triangle, 1, a), coordinate(triangle, 2, a), &lo, &hi);
    const int down = !(r->inverse[a] >= 0.0f);
    const float near = ((down ? hi : lo) - r->o[a]) * r->inverse[a];
    far[a] = ((down ? lo : hi) - r->o[a]) * r->inverse[a];
    t = near > t ? near : t;
  }
  for (int a = 0; a < 3; ++a) t = far[a] < t ? far[a] : t;
  return t;
}

/// True if the ray meets the triangle at 0 < t <= tMax; `hit` then holds distance and barycentrics. intersectLeaf and
/// intersectAxis do the same for other layouts; SearchAgreement in tests/kernels holds them to the same bits. The
/// host turns a triangle without area into a point (det 0, t not a number): rounding could open it in the plane
/// across the ray.
INLINE int intersectTriangle(const Ray* r, const Corners* triangle, float tMax, Candidate* hit) {
  const float az = coordinate(triangle, 0, r->kz) - r->o[r->kz];
  const float bz = coordinate(triangle, 1, r->kz) - r->o[r->kz];
  const float cz = coordinate(triangle, 2, r->kz) - r->o[r->kz];
  const float ax = fma(-r->sx, az, coordinate(triangle, 0, r->kx) - r->o[r->kx]);
  const float ay = fma(-r->sy, az, coordinate(triangle, 0, r->ky) - r->o[r->ky]);
  const float bx = fma(-r->sx, bz, coordinate(triangle, 1, r->kx) - r->o[r->kx]);
  const float by = fma(-r->sy, bz, coordinate(triangle, 1, r->ky) - r->o[r->ky]);
  const float cx = fma(-r->sx, cz, coordinate(triangle, 2, r->kx) - r->o[r->kx]);
  const float cy = fma(-r->sy, cz, coordinate(triangle, 2, r->ky) - r->o[r->ky]);
  float u, v, w;
  if (!edgeTest(ax, ay, bx, by, cx, cy, &u, &v, &w)) return 0;
  const float det = u + v + w;
  int far;
  float t = hitDistance(u, v, w, det, r->sz, az, bz, cz, &far);
  if (far) t = clampToBox(r, triangle, t);
  if (!(t > 0.0f && t <= tMax)) return 0;
  hit->t = t;
  hit->b1 = v / det;
  hit->b2 = w / det;
  hit->front = facesRay(det, r->sz);
  hit->onEdge = mayLieOnEdge(v, w, det);
  return 1;
}
