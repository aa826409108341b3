// Times each contender in turn and compares what rays find.
#include "bench/bench.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/embree_baseline.h"
#include "bench/query_runner.h"
#include "bvh/bvh8.h"
#include "cl/device_facts.h"
#include "scene/input_error.h"

namespace whittle {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// One opponent or kernel in a race over the same rays.
struct Runner {
  std::function<double()> run;
  std::vector<double> seconds;
};

/// All runners in turn, `runs` times after one to warm up.
void race(std::vector<Runner>& runners, int runs) {
  for (Runner& r : runners) r.run();
  for (int i = 0; i < runs; ++i)
    for (Runner& r : runners) r.seconds.push_back(r.run());
}

/// Another triangle at another distance: at the same distance two triangles share
/// an edge, or lie in one plane.
std::size_t differing(const std::vector<QueryHit>& a, const std::vector<QueryHit>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].triangle == b[i].triangle) continue;
    const bool near = a[i].triangle >= 0 && b[i].triangle >= 0 && std::abs(a[i].t - b[i].t) <= 1e-4F * a[i].t;
    count += !near;
  }
  return count;
}

class Bench {
 public:
  Bench(const Scene& scene, const BenchOptions& options)
      : scene_(scene),
        options_(options),
        compute_(selectDevice(listDevices(), options.device)),
        modes_(haveEmbree() ? embreeModes(options.robustOnly) : std::vector<EmbreeMode>{}) {
    learnFacts(compute_);
    if (scene.triangles.empty()) throw InputError(scene.file + ": no triangles to search");
    build();
  }

  BenchResult run() {
    result_.launchSeconds = measureLaunch();
    RaySet eye = eyeRays(scene_, static_cast<std::size_t>(options_.rays));
    const auto eyeHits = measure(eye);
    measure(shadowRays(scene_, eye, eyeHits));
    const RaySet mirror = mirrorRays(scene_, eye, eyeHits, "mirror1");
    const auto mirrorHits = measure(mirror);
    measure(mirrorRays(scene_, mirror, mirrorHits, "mirror2"));
    measure(refractedRays(scene_, eye, eyeHits));
    measure(cosineRays(scene_, eye, eyeHits));
    measure(uniformRays(scene_, static_cast<std::size_t>(options_.rays)));
    return std::move(result_);
  }

 private:
  void say(const std::string& text) const {
    if (options_.phase) options_.phase(text);
  }

  void build() {
    say("building the tree");
    std::vector<glm::uvec3> corners;
    corners.reserve(scene_.triangles.size());
    for (const auto& t : scene_.triangles) corners.emplace_back(t.v0, t.v1, t.v2);
    std::vector<double> ours, theirs;
    for (int i = 0; i < std::max(1, std::min(3, options_.runs)); ++i) {
      const auto start = std::chrono::steady_clock::now();
      tree_ = buildTriTree(scene_.positions, corners);
      // What packets search; the two-wide tree is on the way there.
      const Bvh8 wide = buildBvh8(tree_);
      eachLeafPart(
          wide, tree_,
          [&](std::uint32_t triangle) {
            const glm::uvec3& t = corners[triangle];
            return std::array{scene_.positions[t.x], scene_.positions[t.y], scene_.positions[t.z]};
          },
          [](std::size_t, std::span<const float>) {});
      ours.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      if (!haveEmbree()) continue;
      say("building Embree's tree");
      if (!options_.robustOnly)
        theirs.push_back(makeEmbree(fast_, false));
      else
        theirs.push_back(makeEmbree(robust_, true));
    }
    if (haveEmbree() && !robust_) makeEmbree(robust_, true);
    say("compiling kernels");
    for (const QueryKernel& kernel : queryKernels())
      kernels_.push_back(
          std::make_unique<QueryRunner>(compute_, scene_, tree_, kernel, options_.kernelFolder));
    result_.triangles = scene_.triangles.size();
    result_.threads =
        options_.threads > 0 ? options_.threads : static_cast<int>(compute_.device().computeUnits);
    result_.device = compute_.device().name;
    result_.buildSeconds = median(ours);
    result_.embreeSeconds = theirs.empty() ? 0 : median(theirs);
    const auto perTriangle = [&](std::size_t bytes) {
      return static_cast<double>(bytes) / static_cast<double>(scene_.triangles.size());
    };
    result_.bytesPerTriangle = perTriangle(kernels_.front()->sceneBytes());
    for (const auto& k : kernels_)
      result_.kernels.push_back(
          {k->kernel().name, perTriangle(k->nodeBytes()), perTriangle(k->triangleBytes())});
  }

  double makeEmbree(std::unique_ptr<EmbreeBaseline>& out, bool robust) {
    out.reset();
    out = std::make_unique<EmbreeBaseline>(scene_, robust, options_.threads);
    return out->buildSeconds();
  }

  double measureLaunch() {
    QueryRunner& kernel = *kernels_.front();
    kernel.load(eyeRays(scene_, 1));
    std::vector<Runner> runner{{[&] { return kernel.nearest(); }, {}}};
    race(runner, options_.runs);
    return median(runner.front().seconds);
  }

  /// Kernels that take part, the renderer's choice first.
  std::vector<QueryRunner*> contenders() {
    std::vector<QueryRunner*> chosen;
    for (auto& k : kernels_)
      if (chosen.empty() || options_.allKernels) chosen.push_back(k.get());
    return chosen;
  }

  /// Both queries of one kind of ray by all contenders; returns what the renderer's kernel hits.
  std::vector<QueryHit> measure(const RaySet& rays) {
    if (rays.size() == 0) return {};
    const auto chosen = contenders();
    say(rays.kind + " rays");
    for (QueryRunner* k : chosen) k->load(rays);
    for (EmbreeBaseline* e : {fast_.get(), robust_.get()})
      if (e) e->load(rays);
    measure(rays, chosen, "nearest");
    measure(rays, chosen, "any");
    return chosen.front()->hits();
  }

  void measure(const RaySet& rays, const std::vector<QueryRunner*>& chosen, const std::string& query) {
    const bool nearest = query == "nearest";
    std::vector<Runner> runners;
    runners.reserve(chosen.size() + modes_.size());
    for (QueryRunner* k : chosen) runners.push_back({[=] { return nearest ? k->nearest() : k->any(); }, {}});
    for (const EmbreeMode& m : modes_) {
      EmbreeBaseline* e = m.robust ? robust_.get() : fast_.get();
      runners.push_back({[=] { return nearest ? e->nearest(m) : e->any(m); }, {}});
    }
    race(runners, options_.runs);
    const auto rate = [&](const Runner& r) {
      return static_cast<double>(rays.size()) / median(r.seconds) * 1e-6;
    };
    std::size_t best = 0;
    for (std::size_t m = 1; m < modes_.size(); ++m)
      if (rate(runners[chosen.size() + m]) > rate(runners[chosen.size() + best])) best = m;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      BenchRow row{rays.kind, query, chosen[k]->kernel().name, rays.size(), rate(runners[k]), {}, 0, 0, 0};
      if (!modes_.empty()) {
        row.embreeMode = modes_[best].name();
        row.embreeMraysPerSecond = rate(runners[chosen.size() + best]);
        row.ratio = row.mraysPerSecond / row.embreeMraysPerSecond;
        row.disagree = disagreement(*chosen[k], nearest);
      }
      result_.rows.push_back(row);
    }
  }

  std::size_t disagreement(QueryRunner& kernel, bool nearest) {
    const EmbreeMode judge{true, 1, true};
    if (nearest) {
      robust_->nearest(judge);
      return differing(kernel.hits(), robust_->hits());
    }
    robust_->any(judge);
    const auto ours = kernel.blocked();
    std::size_t count = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) count += ours[i] != (robust_->blocked()[i] != 0);
    return count;
  }

  const Scene& scene_;
  const BenchOptions& options_;
  Compute compute_;
  std::vector<EmbreeMode> modes_;
  TriTree tree_;
  std::vector<std::unique_ptr<QueryRunner>> kernels_;
  std::unique_ptr<EmbreeBaseline> fast_, robust_;
  BenchResult result_;
};

}  // namespace

BenchResult runBench(const Scene& scene, const BenchOptions& options) {
  prepareCpuThreads(options.threads, 0);
  std::optional<tbb::global_control> limit;
  if (options.threads > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
  return Bench(scene, options).run();
}

}  // namespace whittle
