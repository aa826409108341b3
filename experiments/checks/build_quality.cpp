// How much slower are rays through the builder's tree than through a full-sweep SAH tree? The renderer's own
// intersect kernels on the same rays, the two trees in turn, medians. Tab-separated lines to standard output.
// usage: build_quality [--runs N] [--rays N] [--null] SCENE.glb ...
// --null: the builder's tree against itself, which shows what the measurement can tell.
#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <string_view>

#include "bench/query_runner.h"
#include "bvh/tree_stats.h"
#include "gltf/loader.h"
#include "tests/support/sweep_tree.h"

namespace whittle {
namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// One kernel with both trees on the device.
struct Pair {
  QueryRunner ours, sweep;

  /// Rates of nearest hits in millions of rays a second, and the median of the ratios run by run: what slows
  /// the machine down slows neighbouring runs alike.
  void race(const RaySet& rays, int runs, const std::string& scene) {
    ours.load(rays);
    sweep.load(rays);
    ours.nearest();
    sweep.nearest();
    std::vector<double> mine, other, ratio;
    for (int i = 0; i < runs; ++i) {
      // Each goes first every second time.
      const double first = i % 2 ? sweep.nearest() : ours.nearest();
      const double second = i % 2 ? ours.nearest() : sweep.nearest();
      mine.push_back(i % 2 ? second : first);
      other.push_back(i % 2 ? first : second);
      ratio.push_back(other.back() / mine.back());
    }
    const double count = 1e-6 * static_cast<double>(rays.size());
    fmt::print("{}\t{}\t{}\t{:.2f}\t{:.2f}\t{:.3f}\n", scene, rays.kind, ours.kernel().name,
               count / median(mine), count / median(other), median(ratio));
    std::fflush(stdout);
  }
};

void measure(Compute& compute, const std::string& file, std::size_t rays, int runs, bool null) {
  Notices notices;
  const Scene scene = loadGltf(file, {}, notices);
  const std::string name = std::filesystem::path(file).stem().string();
  std::vector<glm::uvec3> corners;
  for (const Triangle& t : scene.triangles) corners.emplace_back(t.v0, t.v1, t.v2);
  auto start = std::chrono::steady_clock::now();
  const TriTree tree = buildTriTree(scene.positions, corners);
  const double built = secondsSince(start);
  start = std::chrono::steady_clock::now();
  const TriTree sweep = null ? tree : test::buildSweepTree(scene.positions, corners);
  const TreeStats a = treeStats(tree), b = treeStats(sweep);
  fmt::print(
      stderr,
      "{}: {} triangles; {:.3f} s, cost {:.3f}, {} leaves; full sweep {:.1f} s, cost {:.3f}, {} leaves\n",
      name, corners.size(), built, a.sahCost, a.leaves, secondsSince(start), b.sahCost, b.leaves);
  for (const QueryKernel& kernel : queryKernels()) {
    Pair pair{{compute, scene, tree, kernel}, {compute, scene, sweep, kernel}};
    const RaySet eye = eyeRays(scene, rays);
    pair.race(eye, runs, name);
    pair.race(cosineRays(scene, eye, (pair.ours.load(eye), pair.ours.nearest(), pair.ours.hits())), runs,
              name);
    pair.race(uniformRays(scene, rays), runs, name);
  }
}

}  // namespace
}  // namespace whittle

int main(int argc, char** argv) {
  std::size_t rays = std::size_t{1} << 18;
  int runs = 21;
  bool null = false;
  try {
    whittle::Compute compute(whittle::selectDevice(whittle::listDevices(), ""));
    fmt::print("scene\trays\tkernel\tours\tfull sweep\tratio\n");
    for (int i = 1; i < argc; ++i) {
      if (std::string_view(argv[i]) == "--runs" && i + 1 < argc)
        runs = std::max(1, atoi(argv[++i]));
      else if (std::string_view(argv[i]) == "--rays" && i + 1 < argc)
        rays = static_cast<std::size_t>(std::max(1, atoi(argv[++i])));
      else if (std::string_view(argv[i]) == "--null")
        null = true;
      else
        whittle::measure(compute, argv[i], rays, runs, null);
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "build_quality: {}\n", e.what());
    return 1;
  }
}
