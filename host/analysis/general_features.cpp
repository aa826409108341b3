// See general_features.h. A new feature is in both programs; it belongs into one of the lists here if it
// costs time where nothing asks for it, or if kernels that have it write to buffers that only it has.
#include "analysis/general_features.h"

#include "analysis/feature_needs.h"

namespace whittle {
namespace {

template <typename... F>
constexpr std::uint64_t maskOf(F... features) {
  return (bitOf(features) | ...);
}

/// They have a plane of the film or of the hits to themselves, end rays where nobody asks, or stand for
/// another way than the usual one.
constexpr std::uint64_t kNeverGeneral =
    maskOf(Feature::COVERAGE, Feature::COST, Feature::FAR_PLANE, Feature::ONE_IMPULSE);

/// Each takes time at every hit or ray.
constexpr std::uint64_t kRichAlone =
    maskOf(Feature::LIGHT_SIZE, Feature::SURFACE_LIGHTS, Feature::SKY_LIGHTS, Feature::GLOSS, Feature::LENS,
           Feature::CUTOFF, Feature::AOVS, Feature::NEAR_PLANE, Feature::CLEARCOAT, Feature::SHEEN,
           Feature::IRIDESCENCE, Feature::ANISOTROPY, Feature::DISPERSION, Feature::DIFFUSE_TRANSMISSION);

/// What a general program must not have, given what the scene has.
std::uint64_t unwanted(const SceneFeatures& features, const Settings& settings) {
  std::uint64_t bits = barredBits(settings);
  if (settings.impulses == ImpulseMode::One) bits |= bitOf(Feature::BOTH_BRANCHES);
  // Impulses of one bounce are counted and not followed: only where there are buffers for them.
  if (settings.bounces <= 1 && !features.has(Feature::IMPULSES)) bits |= bitOf(Feature::IMPULSES);
  return bits;
}

}  // namespace

std::array<GeneralProgram, 2> generalPrograms(bool packets) {
  std::uint64_t all = 0;
  for (const Feature f : allFeatures()) all |= bitOf(f);
  all &= ~kNeverGeneral;
  if (!packets) all &= ~bitOf(Feature::PACKETS);
  return {{{"plain", all & ~kRichAlone}, {"rich", all}}};
}

std::optional<GeneralProgram> generalProgramFor(const SceneFeatures& features, const Settings& settings) {
  if (settings.keepAllFeatures || settings.relaxedArithmetic) return std::nullopt;
  const std::uint64_t bad = unwanted(features, settings);
  for (const GeneralProgram& program : generalPrograms(features.has(Feature::PACKETS)))
    if ((features.bits() & ~program.features) == 0 && (program.features & bad) == 0) return program;
  return std::nullopt;
}

std::uint64_t generalBufferFeatures(const GeneralProgram& program) {
  return program.features & maskOf(Feature::TREE, Feature::TEXTURES, Feature::ABSORPTION, Feature::STRAIGHT,
                                   Feature::IMPULSES, Feature::BOTH_BRANCHES, Feature::TEXTURE_LEVELS,
                                   Feature::DISPERSION);
}

}  // namespace whittle
