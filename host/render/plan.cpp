// The preparation of a render, with memory that is counted and not taken.
#include "render/plan.h"

#include "render/preparation.h"
#include "render/program_choice.h"
#include "wavefront/stages.h"

namespace whittle {
namespace {

/// Ray queues of a picture whose queues are never cut.
std::size_t usualQueues(const SceneFeatures& features) { return features.has(Feature::IMPULSES) ? 2 : 1; }

/// What all buffers would take if nothing were left out.
std::uint64_t bytesOfEverything(Compute& compute, const Scene& scene, const Settings& settings,
                                const Decisions& decisions, const TriTree& tree) {
  Settings all = settings;
  all.keepAllFeatures = true;
  Decisions everything = decisions;
  everything.pruned = unprunedScene(scene);
  everything.features =
      SceneFeatures::analyse(scene, everything.pruned, all, {compute.device().suitsPackets()});
  everything.lights = lightGroups(scene, everything.pruned, everything.features);
  everything.buffers = SceneFeatures::ofBits(everything.features.bits());
  SceneBuffers memory = allocateScene(compute, scene, settings, everything, tree);
  memory.queues.reserve(usualQueues(everything.features));
  std::vector<BufferStats> buffers;
  memory.report(buffers);
  std::uint64_t bytes = 0;
  for (const auto& b : buffers) bytes += b.bytes;
  return bytes;
}

ProgramChoice programsOf(const DeviceInfo& device, const Settings& settings, const Decisions& decisions) {
  KeptPrograms none;
  RenderHooks hooks;
  hooks.tier = Tier::Auto;
  return choosePrograms(device, none, settings, decisions, hooks);
}

}  // namespace

RenderPlan planRender(const Scene& scene, const Settings& settings) {
  constexpr auto kSizesOnly = Compute::Memory::SizesOnly;
  checkSettings(settings);
  Compute compute = openDevice(settings, kSizesOnly, Compute::Launches::Untimed);
  Decisions decisions = decide(scene, settings, compute.device());
  const ProgramChoice choice = programsOf(compute.device(), settings, decisions);
  decisions.buffers = SceneFeatures::ofBits(decisions.features.bits() | choice.bufferFeatures);
  const PictureBuffers picture = allocatePicture(compute, settings, decisions, kSizesOnly);
  const TriTree tree = buildTree(scene, decisions);
  SceneBuffers memory = allocateScene(compute, scene, settings, decisions, tree);
  memory.queues.reserve(usualQueues(decisions.features));

  RenderPlan plan;
  plan.treeNodes = tree.nodes.size();
  memory.report(plan.buffers);
  picture.report(plan.buffers);
  plan.everythingBytes = picture.order.bytes + picture.film.bytes + picture.aovs.bytes +
                         bytesOfEverything(compute, scene, settings, decisions, tree);
  plan.stages = plannedStages({decisions.features, decisions.lights.size(),
                               mostHits(decisions.features, settings), decisions.hasLateLight});
  plan.general = choice.generalName;
  plan.startsOnGeneral = !choice.general.empty();
  plan.isOwnCompiled = choice.isOwnThere;
  plan.device = compute.device();
  plan.settings = settingsInEffect(settings, decisions, memory.queues);
  plan.features = std::move(decisions.features);
  plan.pruned = std::move(decisions.pruned);
  return plan;
}

}  // namespace whittle
