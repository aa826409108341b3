// Embree, timed on given rays. Rays are copied from arrays of Embree's structs, block by block, and results
// written back to arrays: what any user of Embree does.
#include "bench/embree_baseline.h"

#include <fmt/format.h>

#ifdef WHITTLE_EMBREE
#if WHITTLE_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

#include <chrono>
#include <limits>
#include <stdexcept>
#endif

namespace whittle {

std::string EmbreeMode::name() const {
  return fmt::format("{}{} {}", robust ? "robust" : "fast", width, coherent ? "coherent" : "incoherent");
}

std::vector<EmbreeMode> embreeModes(bool robustOnly) {
  std::vector<EmbreeMode> modes;
  for (const bool robust : {false, true})
    for (const int width : {1, 8})
      for (const bool coherent : {true, false})
        if (robust || !robustOnly) modes.push_back({robust, width, coherent});
  return modes;
}

#ifdef WHITTLE_EMBREE

bool haveEmbree() { return true; }

namespace {

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A query as either version of Embree is asked: version 4 takes the hint with other arguments, behind the
/// rays.
class Query {
 public:
#if WHITTLE_EMBREE >= 4
  explicit Query(const EmbreeMode& mode) {
    rtcInitIntersectArguments(&nearest_);
    rtcInitOccludedArguments(&any_);
    nearest_.flags = any_.flags = mode.coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  }
  void nearest(RTCScene scene, RTCRayHit& r) { rtcIntersect1(scene, &r, &nearest_); }
  void nearest(RTCScene scene, RTCRayHit8& r) { rtcIntersect8(kAll, scene, &r, &nearest_); }
  void any(RTCScene scene, RTCRay& r) { rtcOccluded1(scene, &r, &any_); }
  void any(RTCScene scene, RTCRay8& r) { rtcOccluded8(kAll, scene, &r, &any_); }
#else
  explicit Query(const EmbreeMode& mode) {
    rtcInitIntersectContext(&context_);
    context_.flags =
        mode.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  void nearest(RTCScene scene, RTCRayHit& r) { rtcIntersect1(scene, &context_, &r); }
  void nearest(RTCScene scene, RTCRayHit8& r) { rtcIntersect8(kAll, scene, &context_, &r); }
  void any(RTCScene scene, RTCRay& r) { rtcOccluded1(scene, &context_, &r); }
  void any(RTCScene scene, RTCRay8& r) { rtcOccluded8(kAll, scene, &context_, &r); }
#endif

 private:
  alignas(32) static constexpr int kAll[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
#if WHITTLE_EMBREE >= 4
  RTCIntersectArguments nearest_;
  RTCOccludedArguments any_;
#else
  RTCIntersectContext context_;
#endif
};

constexpr std::size_t kBlock = 8, kGrain = 512;  // blocks of rays; blocks a task takes at least

}  // namespace

struct EmbreeBaseline::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  double buildSeconds = 0;
  std::unique_ptr<tbb::task_arena> arena;
  std::size_t count = 0;
  std::vector<RTCRay> rays;     // one by one
  std::vector<RTCRay8> blocks;  // by eight; the last one padded with rays that end before they start
  std::vector<QueryHit> hits;
  std::vector<std::uint8_t> blocked;

  /// Runs `each`(block index) over all blocks on all threads.
  template <typename Each>
  double timed(const Each& each) {
    const auto start = std::chrono::steady_clock::now();
    arena->execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.size(), kGrain), [&](const auto& range) {
        // What Embree's manual asks for: denormals off, for each thread.
        _mm_setcsr(_mm_getcsr() | 0x8040U);
        for (std::size_t b = range.begin(); b != range.end(); ++b) each(b);
      });
    });
    return since(start);
  }
};

EmbreeBaseline::EmbreeBaseline(const Scene& scene, bool robust, int threads)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  const int used = threads > 0 ? threads : tbb::this_task_arena::max_concurrency();
  s.arena = std::make_unique<tbb::task_arena>(used);
  s.device = rtcNewDevice(fmt::format("threads={}", used).c_str());
  if (!s.device) throw std::runtime_error("Embree gives no device");
  s.scene = rtcNewScene(s.device);
  rtcSetSceneFlags(s.scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(s.scene, RTC_BUILD_QUALITY_MEDIUM);
  const RTCGeometry mesh = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
      mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene.positions.size()));
  for (std::size_t i = 0; i < scene.positions.size(); ++i)
    for (int a = 0; a < 3; ++a) positions[3 * i + static_cast<std::size_t>(a)] = scene.positions[i][a];
  auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), scene.triangles.size()));
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    corners[3 * i] = scene.triangles[i].v0;
    corners[3 * i + 1] = scene.triangles[i].v1;
    corners[3 * i + 2] = scene.triangles[i].v2;
  }
  const auto start = std::chrono::steady_clock::now();
  s.arena->execute([&] {
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(s.scene, mesh);
    rtcCommitScene(s.scene);
  });
  s.buildSeconds = since(start);
  rtcReleaseGeometry(mesh);
}

EmbreeBaseline::~EmbreeBaseline() {
  rtcReleaseScene(state_->scene);
  rtcReleaseDevice(state_->device);
}

double EmbreeBaseline::buildSeconds() const { return state_->buildSeconds; }

void EmbreeBaseline::load(const RaySet& rays) {
  State& s = *state_;
  s.count = rays.size();
  const std::size_t padded = (s.count + kBlock - 1) / kBlock * kBlock;
  s.rays.assign(padded, RTCRay{});
  s.blocks.assign(padded / kBlock, RTCRay8{});
  s.hits.assign(padded, QueryHit{});
  s.blocked.assign(padded, 0);
  for (std::size_t i = 0; i < padded; ++i) {
    RTCRay r{};
    r.tfar = -1;
    r.dir_z = 1;
    if (i < s.count)
      r = {rays.o[0][i],
           rays.o[1][i],
           rays.o[2][i],
           0,
           rays.d[0][i],
           rays.d[1][i],
           rays.d[2][i],
           0,
           rays.length[i],
           0xffffffffU,
           0,
           0};
    s.rays[i] = r;
    RTCRay8& b = s.blocks[i / kBlock];
    const std::size_t k = i % kBlock;
    b.org_x[k] = r.org_x, b.org_y[k] = r.org_y, b.org_z[k] = r.org_z;
    b.dir_x[k] = r.dir_x, b.dir_y[k] = r.dir_y, b.dir_z[k] = r.dir_z;
    b.tnear[k] = r.tnear, b.tfar[k] = r.tfar, b.time[k] = 0, b.mask[k] = 0xffffffffU;
  }
}

double EmbreeBaseline::nearest(const EmbreeMode& mode) {
  State& s = *state_;
  const auto hitOf = [](float t, unsigned geometry, unsigned primitive) {
    return QueryHit{t, 0, 0, geometry == RTC_INVALID_GEOMETRY_ID ? -1 : std::int64_t{primitive}};
  };
  if (mode.width == 1)
    return s.timed([&](std::size_t block) {
      Query query(mode);
      for (std::size_t i = block * kBlock; i < block * kBlock + kBlock; ++i) {
        RTCRayHit r;
        r.ray = s.rays[i];
        if (i < s.count) r.ray.tfar = std::numeric_limits<float>::infinity();
        r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.nearest(s.scene, r);
        s.hits[i] = hitOf(r.ray.tfar, r.hit.geomID, r.hit.primID);
      }
    });
  return s.timed([&](std::size_t block) {
    Query query(mode);
    RTCRayHit8 r;
    r.ray = s.blocks[block];
    for (float& far : r.ray.tfar) far = far < 0 ? far : std::numeric_limits<float>::infinity();
    for (unsigned& id : r.hit.geomID) id = RTC_INVALID_GEOMETRY_ID;
    query.nearest(s.scene, r);
    for (std::size_t k = 0; k < kBlock; ++k)
      s.hits[block * kBlock + k] = hitOf(r.ray.tfar[k], r.hit.geomID[k], r.hit.primID[k]);
  });
}

double EmbreeBaseline::any(const EmbreeMode& mode) {
  State& s = *state_;
  if (mode.width == 1)
    return s.timed([&](std::size_t block) {
      Query query(mode);
      for (std::size_t i = block * kBlock; i < block * kBlock + kBlock; ++i) {
        RTCRay r = s.rays[i];
        query.any(s.scene, r);
        s.blocked[i] = r.tfar < 0;
      }
    });
  return s.timed([&](std::size_t block) {
    Query query(mode);
    RTCRay8 r = s.blocks[block];
    query.any(s.scene, r);
    for (std::size_t k = 0; k < kBlock; ++k) s.blocked[block * kBlock + k] = r.tfar[k] < 0;
  });
}

const std::vector<QueryHit>& EmbreeBaseline::hits() const { return state_->hits; }
const std::vector<std::uint8_t>& EmbreeBaseline::blocked() const { return state_->blocked; }

#else

bool haveEmbree() { return false; }

struct EmbreeBaseline::State {
  std::vector<QueryHit> hits;
  std::vector<std::uint8_t> blocked;
};

EmbreeBaseline::EmbreeBaseline(const Scene&, bool, int) : state_(std::make_unique<State>()) {}
EmbreeBaseline::~EmbreeBaseline() = default;
double EmbreeBaseline::buildSeconds() const { return 0; }
void EmbreeBaseline::load(const RaySet&) {}
double EmbreeBaseline::nearest(const EmbreeMode&) { return 0; }
double EmbreeBaseline::any(const EmbreeMode&) { return 0; }
const std::vector<QueryHit>& EmbreeBaseline::hits() const { return state_->hits; }
const std::vector<std::uint8_t>& EmbreeBaseline::blocked() const { return state_->blocked; }

#endif

}  // namespace whittle
