// The rays of one sample, as whoever traced it computed them: why a pixel is as it is. The kernels' numbers
// are single precision and exact here; the reference's are double.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace whittle {

/// What lets nothing of a light through.
struct Blocker {
  std::uint32_t primitive = 0;  ///< index of the triangle in the scene
  double distance = 0;          ///< from the shadow ray's origin, metres
};

/// A ray towards a light that would have to be free for its light to arrive.
struct ShadowRecord {
  std::uint32_t light = 0;  ///< of the scene's
  glm::dvec3 origin{0}, direction{0};
  double length = 0;           ///< metres
  glm::dvec3 contribution{0};  ///< radiance towards the ray's origin if nothing is in the way, W/(m² sr)
  glm::dvec3 arrived{0};       ///< what of it arrives
  /// Where nothing does: the nearest, if anybody looked for it (findBlockers).
  std::optional<Blocker> blocker = std::nullopt;
};

/// An impulse that is not followed.
struct EndedRecord {
  double throughput = 0;  ///< in the largest channel
  bool byCutoff = false;  ///< else by a limit of depth
};

struct HitRecord {
  std::uint32_t primitive = 0;  ///< index of the triangle in the scene
  std::uint32_t material = 0;   ///< of the scene's
  double b1 = 0, b2 = 0;        ///< barycentrics
  glm::dvec3 position{0};       ///< metres, in the scene's coordinates
  glm::dvec3 normal{0};         ///< of the triangle, unit, towards the ray's origin
};

struct RayRecord {
  int parent = -1;            ///< in the list; −1: an eye ray
  std::uint32_t round = 1;    ///< 1 for eye rays, one more for each ray since
  bool goesStraight = false;  ///< on from where its parent hit
  glm::dvec3 origin{0}, direction{0}, throughput{1};
  std::optional<HitRecord> hit;  ///< none: it leaves the scene
  glm::dvec3 local{0};     ///< emission, background, and light that no shadow ray is sent for, W/(m² sr)
  glm::dvec3 radiance{0};  ///< that and what its shadow rays bring: times throughput its share of the sample
  std::vector<ShadowRecord> shadows;
  std::vector<EndedRecord> ended;
};

/// Sums of throughput times radiance over the rays are the sample's radiance, but for rounding. Parents come
/// before their children.
struct RayTree {
  std::vector<RayRecord> rays;
  glm::dvec3 radiance{0};  ///< of the sample, W/(m² sr)
};

/// What an impulse does at the surface that it comes from.
enum class Passage : std::uint8_t { Reflected, Refracted, Straight };
Passage passageOf(const RayRecord& ray, const RayRecord& parent);
/// What the ray adds to its sample: throughput times radiance.
glm::dvec3 shareOf(const RayRecord& ray);
/// Over all rays of a tree.
glm::dvec3 sumOf(const RayTree& tree);

/// Where a number of samples at most is asked for.
inline constexpr int kAllSamples = 1 << 30;

}  // namespace whittle
