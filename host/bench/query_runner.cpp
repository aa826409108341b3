// Runs the search kernels on given rays, as a render would.
#include "bench/query_runner.h"

#include <fmt/format.h>

#include <bit>
#include <chrono>
#include <limits>

#include "cl/device_facts.h"
#include "cl/kernel_source.h"
#include "kernels/shared/layout.h"

namespace whittle {
namespace {

/// What the searches see of a scene.
Scene bareScene(const Scene& scene) {
  Scene bare;
  bare.positions = scene.positions;
  bare.triangles = scene.triangles;
  for (Triangle& t : bare.triangles) t.material = 0;
  bare.materials.emplace_back();
  bare.lights.emplace_back();
  return bare;
}

void copyPlane(std::vector<float>& queue, std::uint32_t capacity, std::uint32_t plane,
               const std::vector<float>& values) {
  std::copy(values.begin(), values.end(),
            queue.begin() + static_cast<std::ptrdiff_t>(std::size_t{plane} * capacity));
}

}  // namespace

const std::vector<QueryKernel>& queryKernels() {
  constexpr std::uint64_t common = bitOf(Feature::TREE) | bitOf(Feature::SHADOWS) | bitOf(Feature::LIGHTS);
  static const std::vector<QueryKernel> kernels{
      {"packet16", common | bitOf(Feature::PACKETS)},
      {"single2", common},
  };
  return kernels;
}

QueryRunner::QueryRunner(Compute& compute, const Scene& scene, const TriTree& tree, const QueryKernel& kernel,
                         const std::optional<std::filesystem::path>& kernelFolder)
    : compute_(compute), tree_(tree), kernel_(kernel) {
  const std::uint32_t budget = loopBudget(compute.device());
  const std::string options =
      fmt::format("-cl-std=CL1.2 -D SCENE_FEATURES=0x{:x} -D LOOP_BUDGET={}", kernel.features, budget);
  if (budget > 0) counters_ = compute_.upload("counters", std::vector<std::uint32_t>(COUNTERS, 0));
  const std::vector programs{
      compute_.build(assembleKernelSource({"intersect.cl", "occlude.cl"}, kernelFolder), options)};
  const SceneFeatures features = SceneFeatures::ofBits(kernel.features);
  stages_.emplace(compute_, programs, defaultWorkGroup(features),
                  LaunchWidths{features.has(Feature::PACKETS)});
  scene_ = uploadScene(compute_, bareScene(scene), tree_, features);
}

std::size_t QueryRunner::sceneBytes() const {
  std::size_t bytes = 0;
  for (const Buffer* b : scene_.buffers()) bytes += b->bytes;
  return bytes;
}

std::size_t QueryRunner::nodeBytes() const { return scene_.bvh8Nodes.bytes + scene_.nodes.bytes; }

std::size_t QueryRunner::triangleBytes() const { return scene_.leaves.bytes; }

void QueryRunner::load(const RaySet& rays) {
  count_ = static_cast<std::uint32_t>(rays.size());
  capacity_ = (count_ + 63) / 64 * 64;
  std::vector<float> queue(std::size_t{RAY_PLANES} * capacity_ + QUEUE_PADDING);
  std::vector<float> shadows(std::size_t{SHADOW_PLANES} * capacity_ + QUEUE_PADDING, 1.0F);
  std::vector<std::uint32_t> order(capacity_ + QUEUE_PADDING);
  for (std::uint32_t i = 0; i < count_; ++i) order[i] = i;
  for (std::uint32_t a = 0; a < 3; ++a) {
    copyPlane(queue, capacity_, RAY_O + a, rays.o[a]);
    copyPlane(queue, capacity_, RAY_D + a, rays.d[a]);
    copyPlane(shadows, capacity_, SHADOW_O + a, rays.o[a]);
    copyPlane(shadows, capacity_, SHADOW_D + a, rays.d[a]);
  }
  std::vector<float> length = rays.length;
  for (float& l : length) l = std::min(l, std::numeric_limits<float>::max());
  copyPlane(shadows, capacity_, SHADOW_LENGTH, length);
  rays_ = compute_.upload("rays", queue);
  shadows_ = compute_.upload("shadows", shadows);
  queue_ = compute_.upload("shadowQueue", order);
  hits_ = compute_.allocate("hits", (std::size_t{HIT_PLANES} * capacity_ + QUEUE_PADDING) * sizeof(float));
  radiance_ = compute_.allocate("entryRadiance", std::size_t{3} * capacity_ * sizeof(float));
  compute_.fillZero(hits_);
}

double QueryRunner::nearest() {
  clTry("waiting for earlier kernels", [&] { compute_.queue().finish(); });
  const auto start = std::chrono::steady_clock::now();
  stages_->run(stages::Intersect{.scene = scene_,
                                 .count = count_,
                                 .capacity = capacity_,
                                 .rays = rays_,
                                 .hits = hits_,
                                 .counters = counters_});
  clTry("waiting for the nearest hits", [&] { compute_.queue().finish(); });
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void QueryRunner::checkWalks() {
  if (!counters_) return;
  std::uint32_t spent = 0;
  compute_.read(counters_, COUNTER_SPENT_WALK * sizeof(std::uint32_t), sizeof(spent), &spent);
  if (spent != 0) throw ClError(compute_.device().name + ": its driver ends loops before some rays are done");
}

double QueryRunner::any() {
  compute_.fillZero(radiance_);
  clTry("waiting for earlier kernels", [&] { compute_.queue().finish(); });
  const auto start = std::chrono::steady_clock::now();
  stages_->run(stages::Occlude{.scene = scene_,
                               .count = count_,
                               .capacity = capacity_,
                               .shadowQueue = queue_,
                               .shadows = shadows_,
                               .entryRadiance = radiance_,
                               .counters = counters_});
  clTry("waiting for the shadow rays", [&] { compute_.queue().finish(); });
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<QueryHit> QueryRunner::hits() {
  checkWalks();
  std::vector<float> planes(std::size_t{HIT_PLANES} * capacity_);
  compute_.read(hits_, 0, planes.size() * sizeof(float), planes.data());
  std::vector<QueryHit> result(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    const auto triangle = std::bit_cast<std::uint32_t>(planes[HIT_TRIANGLE * std::size_t{capacity_} + i]);
    result[i] = {planes[HIT_T * std::size_t{capacity_} + i], planes[HIT_B1 * std::size_t{capacity_} + i],
                 planes[HIT_B2 * std::size_t{capacity_} + i],
                 triangle == NO_HIT ? -1 : std::int64_t{tree_.order.at(triangle)}};
  }
  return result;
}

std::vector<bool> QueryRunner::blocked() {
  checkWalks();
  std::vector<float> light(count_);
  compute_.read(radiance_, 0, count_ * sizeof(float), light.data());
  std::vector<bool> result(count_);
  for (std::size_t i = 0; i < count_; ++i) result[i] = light[i] == 0.0F;
  return result;
}

}  // namespace whittle
