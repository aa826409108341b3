// See ray_recorder.h. The layout of the queues is that of kernels/shared/layout.h; children follow their
// parents in the order of kernels/compact.cl.
#include "wavefront/ray_recorder.h"

#include <array>
#include <glm/geometric.hpp>
#include <limits>

#include "kernels/shared/layout.h"

namespace whittle {
namespace {

/// Of a shadow ray: the kernels' longest goes on for ever.
double metresOf(float length) {
  return length < std::numeric_limits<float>::max() ? static_cast<double>(length)
                                                    : std::numeric_limits<double>::infinity();
}

}  // namespace

RayRecorder::RayRecorder(Compute& compute, const RayQueues& queues, const DeviceScene& scene,
                         const SceneFeatures& features)
    : compute_(compute),
      queues_(queues),
      reader_(compute, queues),
      scene_(scene),
      features_(features),
      entries_(2) {
  rays_.emplace_back();
  entries_[1] = {0};
}

void RayRecorder::readRays(const ObservedSegment& s) {
  const auto& entries = entries_[s.bounce];
  segment_.assign(entries.begin() + s.segment.begin, entries.begin() + s.segment.end);
  const std::uint32_t count = s.segment.count();
  const auto origins = reader_.vectors(s.queue, RAY_O, s.segment.begin, count),
             directions = reader_.vectors(s.queue, RAY_D, s.segment.begin, count),
             throughputs = reader_.throughputs(s);
  for (std::uint32_t i = 0; i < count; ++i) {
    RayRecord& ray = of(i);
    ray.round = s.bounce;
    ray.origin = origins[i], ray.direction = directions[i], ray.throughput = throughputs[i];
  }
}

void RayRecorder::readHits(std::uint32_t count) {
  const auto triangles = reader_.plane<std::uint32_t>(queues_.hits, HIT_TRIANGLE, 0, count);
  const auto b1 = reader_.plane<float>(queues_.hits, HIT_B1, 0, count),
             b2 = reader_.plane<float>(queues_.hits, HIT_B2, 0, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t index = triangles[i];
    if (index == NO_HIT) continue;
    device::DeviceTriangle t;
    compute_.read(scene_.triangles, index * sizeof(t), sizeof(t), &t);
    const std::array<glm::vec3, 3> corners = readCorners(compute_, scene_, index, t);
    const auto corner = [&](std::size_t c) { return glm::dvec3(corners[c]); };
    const glm::dvec3 e1 = corner(1) - corner(0), e2 = corner(2) - corner(0);
    glm::dvec3 normal = glm::normalize(glm::cross(e1, e2));
    if (glm::dot(normal, of(i).direction) > 0) normal = -normal;
    const double u = static_cast<double>(b1[i]), v = static_cast<double>(b2[i]);
    of(i).hit = HitRecord{t.primitive, t.material, u, v, corner(0) + u * e1 + v * e2, normal};
  }
}

void RayRecorder::readImpulses(std::uint32_t count, std::uint32_t bounce) {
  if (entries_.size() < bounce + 2) entries_.resize(bounce + 2);
  entries_[bounce + 1].clear();
  if (!queues_.impulses) return;
  const std::uint32_t sets = features_.has(Feature::BOTH_BRANCHES) ? 2 : 1;
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::uint32_t k = 0; k < sets; ++k) {
      const bool splits = k == 1 && (flags_[i] & ENTRY_SPLIT1) == ENTRY_SPLIT1;
      if (!splits && (flags_[i] & (ENTRY_ENDED0 << k))) {
        const float share =
            reader_.plane<float>(queues_.impulses, k * queues_.impulsePlanes() + IMPULSE_THROUGHPUT, i, 1)[0];
        of(i).ended.push_back({static_cast<double>(std::abs(share)), share < 0.0F});
      }
      if (!(flags_[i] & (ENTRY_IMPULSE0 << k))) continue;
      RayRecord child;
      child.parent = static_cast<int>(segment_[i]);
      child.goesStraight = features_.has(Feature::STRAIGHT) && (flags_[i] & (ENTRY_STRAIGHT0 << k));
      for (std::uint32_t ray = 0; ray < (splits ? carriedChannels(i) : 1); ++ray) {
        entries_[bounce + 1].push_back(rays_.size());
        rays_.push_back(child);
      }
    }
}

std::uint32_t RayRecorder::carriedChannels(std::uint32_t entry) const {
  std::uint32_t carried = 0;
  for (std::uint32_t channel = 0; channel < 3; ++channel)
    carried += reader_.plane<float>(queues_.impulses, queues_.impulsePlanes() + IMPULSE_THROUGHPUT + channel,
                                    entry, 1)[0] > 0.0F;
  return carried;
}

void RayRecorder::shaded(const ObservedSegment& s, const LightTurn& turn) {
  const std::uint32_t count = s.segment.count();
  if (turn.isFirst) {
    readRays(s);
    readHits(count);
  }
  flags_.assign(count, 0);
  if (queues_.flags)
    compute_.read(queues_.flags, std::size_t{turn.set} * queues_.capacity(), count, flags_.data());
  const auto local = reader_.vectors(s.radiance, 0, 0, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    // Light that needs no shadow ray comes with its own turn, or the first of its group.
    of(i).local += turn.isFirst ? local[i] : local[i] - of(i).radiance;
    of(i).radiance = local[i];
  }
  if (turn.hasRays) {
    const std::uint32_t set = turn.set * SHADOW_PLANES;
    const auto origins = reader_.vectors(queues_.shadows, set + SHADOW_O, 0, count),
               directions = reader_.vectors(queues_.shadows, set + SHADOW_D, 0, count),
               contributions = reader_.vectors(queues_.shadows, set + SHADOW_CONTRIBUTION, 0, count);
    const auto lengths = reader_.plane<float>(queues_.shadows, set + SHADOW_LENGTH, 0, count);
    for (std::uint32_t i = 0; i < count; ++i)
      if (flags_[i] & ENTRY_SHADOW)
        of(i).shadows.push_back(
            {turn.light, origins[i], directions[i], metresOf(lengths[i]), contributions[i], {}});
  }
  if (turn.isFirst) readImpulses(count, s.bounce);
}

void RayRecorder::lit(const ObservedSegment& s, const LightTurn& turn) {
  const auto after = reader_.vectors(s.radiance, 0, 0, s.segment.count());
  for (std::uint32_t i = 0; i < s.segment.count(); ++i) {
    RayRecord& ray = of(i);
    if (!ray.shadows.empty() && ray.shadows.back().light == turn.light)
      ray.shadows.back().arrived = after[i] - ray.radiance;
    ray.radiance = after[i];
  }
}

}  // namespace whittle
