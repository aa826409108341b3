// In which order a ray meets things. Nearest first; of equal distances the lowest index in the scene. With STRAIGHT a
// ray that went straight on keeps its origin and looks for what comes strictly after the surface that it passed, so
// that nothing is lost between two surfaces, however close; and a blended surface comes a little earlier than it lies
// (COAT_ORDER in layout.h). The host's twin: nearestSurface in host/reference/trace.cpp.
#include "lib/scene.cl"
#include "lib/search/one_lane.cl"

/// Ties: true if triangle a has a lower index in the scene than b (both in leaf order), or b is none. Looked up only
/// then: it is one more line of memory.
INLINE int comesFirst(const SceneView* scene, uint a, uint b) {
  return b == NO_HIT || scene->triangles[a].primitive < scene->triangles[b].primitive;
}

#if HAS(ONE_SIDED)
/// Whether the triangle is there for an eye or impulse ray that meets this side of it.
INLINE int showsSide(const SceneView* scene, uint index, int front) {
  return front || !(scene->triangles[index].flags & TRIANGLE_ONE_SIDED);
}
#endif

#if HAS(STRAIGHT)
/// The last surface that a ray went straight through.
typedef struct {
  float order;     // 0: none
  uint primitive;  // index in the scene
  float tMin;      // boxes that end before this hold nothing that comes later
} Passed;

/// Above the rounding of boxes and distances (FAR_WIDENING) and COAT_ORDER.
#define PASSED_MARGIN 0.9999924f  // 1 - 2^-17
/// What may come before order t lies before t times this.
#define ORDER_WIDENING 1.0000019f

INLINE Passed nothingPassed(void) {
  const Passed none = {0.0f, 0u, 0.0f};
  return none;
}

/// From the planes of a ray queue.
INLINE Passed passedSurface(const SceneView* scene, float order, uint triangle) {
  Passed passed = nothingPassed();
  if (!(order > 0.0f)) return passed;
  passed.order = order;
  passed.primitive = scene->triangles[triangle].primitive;
  passed.tMin = order * PASSED_MARGIN;
  return passed;
}

/// The order of a hit at distance t.
INLINE float orderOf(const SceneView* scene, uint index, float t) {
  return scene->triangles[index].flags & TRIANGLE_COATS ? t * COAT_ORDER : t;
}

INLINE int comesAfter(const SceneView* scene, const Passed* passed, uint index, float order) {
  return order > passed->order || (order == passed->order && scene->triangles[index].primitive > passed->primitive);
}
#endif
