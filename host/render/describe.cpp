// See describe.h.
#include "render/describe.h"

namespace whittle {

void describeScene(Stats& stats, const Scene& scene) {
  stats.scene.file = scene.file;
  stats.scene.triangles = scene.triangles.size();
  stats.scene.droppedTriangles = scene.droppedTriangles;
  stats.scene.materials = scene.materials.size();
  stats.scene.lights = scene.lights.size();
  stats.scene.textures = scene.images.size();
}

void describeDevice(Stats& stats, const DeviceInfo& d, int threads) {
  const bool isKept = threads > 0 && keepsToThreads(d, threads);
  stats.device = {d.platform,        d.name,         d.version,
                  d.driver,          d.computeUnits, isKept ? threads : static_cast<int>(processorsOf(d)),
                  d.facts.givesTimes};
}

void describeDecisions(Stats& stats, const Decisions& decisions) {
  stats.searchUsed = decisions.features.has(Feature::TREE) ? "tree" : "array";
  for (const auto& line : decisions.features.lines()) {
    if (line.used)
      stats.featuresUsed.push_back(line.text);
    else
      stats.featuresLeftOut.emplace_back(line.text, line.reason);
    if (line.forced) stats.featuresForced.push_back(line.text);
  }
  stats.pruning = decisions.pruned.pruning;
}

void describeRays(Stats& stats, BiasBound& bias, Wavefront& wavefront, const SamplingLoop& loop) {
  const RayTally& t = wavefront.tally();
  stats.rays = {t.primary, t.impulse, t.shadow};
  stats.dropped = t.produced - t.finished;
  stats.samples = {loop.counts().least(), loop.counts().most(), loop.counts().mean()};
  stats.error = loop.error();
  stats.ended = endedThroughput(t.ended);
  stats.biasBound = bias(loop.endedPerSample());
  stats.nonFinite = wavefront.nonFinite();
}

}  // namespace whittle
