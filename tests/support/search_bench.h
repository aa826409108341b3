// The real intersect and occlude kernels on rays of the test's choice, in each of the forms of the
// search, and a brute force in double precision to judge them by.
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "kernels/shared/layout.h"
#include "support/kernel_bench.h"
#include "support/random_scenes.h"
#include "wavefront/device_scene.h"

namespace whittle::test {

struct SearchForm {
  const char* name;
  Search search;
  Lanes lanes;
};
/// Those that the device under test is given by the renderer: packets only where they suit it.
inline const std::vector<SearchForm>& searchForms() {
  static const std::vector<SearchForm> forms = [] {
    std::vector<SearchForm> all{{"single/array", Search::Array, Lanes::One},
                                {"single/tree", Search::Tree, Lanes::One},
                                {"packet/array", Search::Array, Lanes::Sixteen},
                                {"packet/tree", Search::Tree, Lanes::Sixteen}};
    if (!testDevice().suitsPackets()) all.resize(2);
    return all;
  }();
  return forms;
}

struct TestRay {
  glm::vec3 o, d;
};

/// What intersect wrote; primitive -1: nothing hit.
struct TestHit {
  float t, b1, b2;
  std::int64_t primitive;
  bool operator==(const TestHit& other) const = default;
};

/// An opaque scene with one light, so that shadow rays are compiled in.
inline Scene sceneOf(const TriangleMesh& mesh) {
  Scene scene;
  scene.positions = mesh.positions;
  for (const glm::uvec3& t : mesh.triangles) scene.triangles.push_back({t.x, t.y, t.z, 0});
  scene.materials.emplace_back();
  scene.materials[0].doubleSided = true;  // searches meet both sides
  scene.lights.emplace_back();
  scene.cameras.emplace_back();
  return scene;
}

/// The device, and the programs built so far; scenes that need the same features share one.
struct SearchLab {
  Compute compute = openTestDevice();
  std::map<std::uint64_t, cl::Program> programs;
};

class SearchBench {
 public:
  /// `testKernels` are appended to the program, which has the searches' one lane; give the same text for the
  /// same lab.
  SearchBench(SearchLab& lab, const Scene& scene, const SearchForm& form, const std::string& testKernels = {})
      : compute_(lab.compute) {
    Settings settings;
    settings.search = form.search;
    settings.lanes = form.lanes;
    const auto features = SceneFeatures::analyse(scene, settings, {true});
    program = lab.programs[features.bits()];
    if (!program())
      program = lab.programs[features.bits()] = compute_.build(
          assembleKernelSource(
              {"lib/search/one_lane.cl", "lib/surface/ray_offset.cl", "intersect.cl", "occlude.cl"},
              testKernelFolder()) +
              "#line 1 \"test kernels\"\n" + testKernels,
          buildOptions(features.bits(), 1024));
    stages.emplace(compute_, std::vector{program}, kWorkGroup, LaunchWidths{features.has(Feature::PACKETS)});
    std::vector<glm::uvec3> corners;
    for (const Triangle& t : scene.triangles) corners.emplace_back(t.v0, t.v1, t.v2);
    if (form.search == Search::Tree) {
      tree_ = buildTriTree(scene.positions, corners);
    } else {
      for (std::uint32_t i = 0; i < corners.size(); ++i) tree_.order.push_back(i);
    }
    deviceScene = uploadScene(compute_, scene, tree_, features);
    counters_ = compute_.upload("counters", std::vector<std::uint32_t>(COUNTERS, 0));
  }

  /// Nearest hits. The rays stand at the end of a queue behind others, so that `first` counts.
  std::vector<TestHit> nearest(const std::vector<TestRay>& rays) {
    const auto count = static_cast<std::uint32_t>(rays.size()), first = 3U,
               capacity = (count + first + PACKET_RAYS - 1) / PACKET_RAYS * PACKET_RAYS;
    std::vector<float> queue(std::size_t{RAY_PLANES} * capacity + QUEUE_PADDING, std::nanf(""));
    for (std::uint32_t i = 0; i < count; ++i) {
      for (int a = 0; a < 3; ++a) {
        queue[static_cast<std::size_t>(RAY_O + a) * capacity + first + i] = rays[i].o[a];
        queue[static_cast<std::size_t>(RAY_D + a) * capacity + first + i] = rays[i].d[a];
      }
    }
    const Buffer in = compute_.upload("rays", queue);
    const std::vector<float> rubbish(std::size_t{HIT_PLANES} * capacity + QUEUE_PADDING, std::nanf(""));
    const Buffer out = compute_.upload("hits", rubbish);
    stages->run(stages::Intersect{.scene = deviceScene,
                                  .first = first,
                                  .count = count,
                                  .capacity = capacity,
                                  .rays = in,
                                  .hits = out,
                                  .counters = counters_});
    std::vector<float> hits(rubbish.size());
    compute_.read(out, 0, out.bytes, hits.data());
    std::vector<TestHit> result(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto plane = [&](int p) { return hits[static_cast<std::size_t>(p) * capacity + i]; };
      const float word = plane(HIT_TRIANGLE);
      std::uint32_t triangle;
      std::memcpy(&triangle, &word, sizeof(triangle));
      result[i] = {plane(HIT_T), plane(HIT_B1), plane(HIT_B2),
                   triangle == NO_HIT ? -1 : std::int64_t{tree_.order.at(triangle - firstTriangle)}};
      if (triangle == NO_HIT) result[i].t = INFINITY, result[i].b1 = result[i].b2 = 0;
    }
    return result;
  }

  /// Whether something lies at 0 < t < length, for each ray; the queue visits them in reverse.
  std::vector<bool> occluded(const std::vector<TestRay>& rays, const std::vector<float>& lengths) {
    const auto count = static_cast<std::uint32_t>(rays.size()),
               capacity = (count + PACKET_RAYS - 1) / PACKET_RAYS * PACKET_RAYS;
    std::vector<float> shadows(std::size_t{SHADOW_PLANES} * capacity + QUEUE_PADDING, std::nanf(""));
    std::vector<std::uint32_t> order(capacity);
    for (std::uint32_t i = 0; i < count; ++i) {
      for (int a = 0; a < 3; ++a) {
        shadows[static_cast<std::size_t>(SHADOW_O + a) * capacity + i] = rays[i].o[a];
        shadows[static_cast<std::size_t>(SHADOW_D + a) * capacity + i] = rays[i].d[a];
        shadows[static_cast<std::size_t>(SHADOW_CONTRIBUTION + a) * capacity + i] = 1.0F;
      }
      shadows[static_cast<std::size_t>(SHADOW_LENGTH) * capacity + i] = lengths[i];
      order[i] = count - 1 - i;
    }
    const Buffer candidates = compute_.upload("shadows", shadows),
                 queue = compute_.upload("shadowQueue", order);
    const Buffer radiance =
        compute_.upload("entryRadiance", std::vector<float>(std::size_t{3} * capacity, 0.0F));
    stages->run(stages::Occlude{.scene = deviceScene,
                                .count = count,
                                .capacity = capacity,
                                .shadowQueue = queue,
                                .shadows = candidates,
                                .entryRadiance = radiance,
                                .counters = counters_});
    std::vector<float> light(count);
    compute_.read(radiance, 0, count * sizeof(float), light.data());
    std::vector<bool> result(count);
    for (std::uint32_t i = 0; i < count; ++i) result[i] = light[i] == 0.0F;
    return result;
  }

  const TriTree& tree() const { return tree_; }

  cl::Program program;
  std::optional<StageRunner> stages;
  DeviceScene deviceScene;
  std::uint32_t firstTriangle = 0;  ///< where a test has moved the first triangle of the tree to

 private:
  Compute& compute_;
  TriTree tree_;
  Buffer counters_;
};

/// One triangle met by a ray, in double precision.
struct ExactHit {
  std::int64_t primitive;
  double t;
  double inset;   ///< distance of the ray from the nearest edge, m, positive inside
  double cosine;  ///< |cos| between ray and normal
  double extent;  ///< largest distance of a corner from the origin along an axis, m: what float rounding
                  ///< grows with
};

/// All triangles that the ray's line meets at t > 0, or passes by at no more than `margin` times their
/// extent. Plane equation and edge distances in double: not the watertight test that the kernels run.
inline std::vector<ExactHit> exactHits(const Scene& scene, const TestRay& ray, double margin) {
  std::vector<ExactHit> hits;
  const glm::dvec3 o(ray.o), d(ray.d);
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const Triangle& triangle = scene.triangles[i];
    const glm::dvec3 p[3] = {glm::dvec3(scene.positions[triangle.v0]) - o,
                             glm::dvec3(scene.positions[triangle.v1]) - o,
                             glm::dvec3(scene.positions[triangle.v2]) - o};
    const glm::dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double facing = glm::dot(n, d);
    double extent = 0.0, inset = INFINITY;
    for (int k = 0; k < 3; ++k) {
      for (int a = 0; a < 3; ++a) extent = std::max(extent, std::abs(p[k][a]));
      const glm::dvec3 from = p[k], edge = p[(k + 1) % 3] - from;
      const glm::dvec3 across = glm::cross(edge, d);  // perpendicular to ray and edge
      const double length = glm::length(across);
      if (length > 0) inset = std::min(inset, glm::dot(across, from) / length * (facing > 0 ? 1.0 : -1.0));
    }
    if (facing == 0.0 || inset < -margin * extent) continue;
    const double t = glm::dot(n, p[0]) / facing;
    if (t > -margin * extent)
      hits.push_back({static_cast<std::int64_t>(i), t, inset,
                      std::abs(facing) / glm::length(n) / glm::length(d), extent});
  }
  return hits;
}

/// Judges the answer of a float search: "" if exact arithmetic agrees or the answer differs
/// by rounding alone.
inline std::string judge(const Scene& scene, const TestRay& ray, const TestHit& hit) {
  // Rounding of the sheared corners: some 5 roundings of 2^-24 relative to the extent; 16 leaves room
  // for the division.
  const double rounding = 16 * 0x1p-24;
  const auto hits = exactHits(scene, ray, rounding);
  const auto slackT = [&](const ExactHit& h) {
    return rounding * h.extent / h.cosine + rounding * std::abs(h.t);
  };
  double tOf = INFINITY, slack = 0.0;
  if (hit.primitive >= 0) {
    const auto own = std::find_if(hits.begin(), hits.end(),
                                  [&](const ExactHit& h) { return h.primitive == hit.primitive; });
    if (own == hits.end()) return fmt::format("triangle {} is not on the ray", hit.primitive);
    tOf = own->t, slack = slackT(*own);
    if (std::abs(tOf - static_cast<double>(hit.t)) > slack)
      return fmt::format("t is {}, exactly {}", hit.t, tOf);
  }
  for (const ExactHit& h : hits)
    if (h.inset > rounding * h.extent && h.t > slackT(h) && h.t + slackT(h) < tOf - slack)
      return fmt::format("triangle {} at {} is nearer than {} at {}", h.primitive, h.t, hit.primitive, tOf);
  return {};
}

}  // namespace whittle::test
