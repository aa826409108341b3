// Programs cut down by what their text asks for: the conditions are read as a compiler reads them, and no
// stage is left out.
#include "programs/kernel_programs.h"

#include <gtest/gtest.h>

#include "programs/compiler_process.h"
#include "programs/referenced_features.h"
#include "support/test_device.h"
#include "wavefront/stages.h"

namespace whittle::test {
namespace {

constexpr std::uint64_t bit(Feature f) { return std::uint64_t{1} << static_cast<int>(f); }

const std::uint64_t kTree = bit(Feature::TREE), kMirror = bit(Feature::MIRROR), kMetal = bit(Feature::METAL),
                    kUnlit = bit(Feature::UNLIT), kAll = kTree | kMirror | kMetal | kUnlit;

TEST(ReferencedFeatures, WhatNoLineAsksForIsLeftOut) {
  EXPECT_EQ(referencedFeatures("", kAll), 0U);
  EXPECT_EQ(referencedFeatures("int a;\n#if HAS(TREE)\n#endif\n", kAll), kTree);
  EXPECT_EQ(referencedFeatures("#if HAS(TREE)\n#endif\n", kMirror), 0U) << "asked for, and not there";
  EXPECT_EQ(referencedFeatures("#if HAS(TREE)  // and HAS(METAL)\n#endif\n", kAll), kTree)
      << "a remark asks nothing";
}

TEST(ReferencedFeatures, OnlyTheBranchThatIsCompiledAsks) {
  const std::string nested =
      "#if HAS(TREE)\n#if HAS(MIRROR)\n#endif\n#else\n#if HAS(METAL)\n#endif\n#endif\n";
  EXPECT_EQ(referencedFeatures(nested, kAll), kTree | kMirror);
  EXPECT_EQ(referencedFeatures(nested, kAll & ~kTree), kMetal);
  const std::string chain =
      "#if HAS(TREE)\n#elif HAS(MIRROR)\n#if HAS(METAL)\n#endif\n#else\n#if HAS(UNLIT)\n#endif\n#endif\n";
  EXPECT_EQ(referencedFeatures(chain, kAll), kTree);
  EXPECT_EQ(referencedFeatures(chain, kAll & ~kTree), kMirror | kMetal);
  EXPECT_EQ(referencedFeatures(chain, kUnlit | kMetal), kUnlit);
}

TEST(ReferencedFeatures, AConditionEndsWhereItsAnswerIsKnown) {
  const auto asked = [](const std::string& condition, std::uint64_t bits) {
    return referencedFeatures("#if " + condition + "\n#if HAS(UNLIT)\n#endif\n#endif\n", bits);
  };
  EXPECT_EQ(asked("HAS(TREE) || HAS(MIRROR)", kAll), kTree | kUnlit);
  EXPECT_EQ(asked("HAS(TREE) || HAS(MIRROR)", kMirror | kUnlit), kMirror | kUnlit);
  EXPECT_EQ(asked("HAS(TREE) && HAS(MIRROR)", kMirror | kUnlit), 0U);
  EXPECT_EQ(asked("!HAS(TREE) && HAS(MIRROR)", kMirror | kUnlit), kMirror | kUnlit);
  EXPECT_EQ(asked("!(HAS(TREE) || HAS(METAL)) || HAS(MIRROR)", kTree | kMetal | kUnlit), kTree);
  EXPECT_EQ(asked("HAS(METAL) && (HAS(TREE) || HAS(MIRROR)) && HAS(UNLIT)", kMetal | kMirror | kUnlit),
            kMetal | kMirror | kUnlit);
}

TEST(ReferencedFeatures, WhatIsNotAFeatureMayGoEitherWay) {
  const std::string both = "#else\n#if HAS(MIRROR)\n#endif\n#endif\n";
  for (const char* condition : {"#if defined(__AVX__)\n", "#ifdef __clang__\n", "#ifndef X\n",
                                "#if defined(__AVX__) && defined(__clang__)\n", "#if __VERSION__ >= 120\n",
                                "#if defined(__AVX__) || !HAS(METAL)\n"})
    EXPECT_EQ(referencedFeatures(condition + std::string("#if HAS(TREE)\n#endif\n") + both, kAll & ~kMetal),
              condition == std::string("#if defined(__AVX__) || !HAS(METAL)\n") ? kTree : (kTree | kMirror))
        << condition;
}

/// A wrong number here is code for another layout of the queues: memory written past its end.
TEST(ReferencedFeatures, LinesThatAreNoConditionsAskToo) {
  EXPECT_EQ(referencedFeatures("#define BRANCHES (HAS(MIRROR) ? 2 : 1)\n", kAll), kMirror);
  EXPECT_EQ(referencedFeatures("for (int k = 0; k < HAS(METAL) + HAS(TREE); ++k) f(k);\n", kAll),
            kMetal | kTree);
  EXPECT_EQ(referencedFeatures("#if HAS(TREE)\n#else\nint n = HAS(MIRROR);\n#endif\n", kAll), kTree);
  EXPECT_EQ(referencedFeatures("#define HAS(feature) ((SCENE_FEATURES >> BIT_##feature) & 1)\n", kAll), 0U);
  EXPECT_EQ(referencedFeatures("WAS_HAS(MIRROR) // HAS(METAL)\n", kAll), 0U);
}

TEST(ReferencedFeatures, AFeatureThatDoesNotExistIsAnError) {
  EXPECT_THROW(referencedFeatures("#if HAS(NO_SUCH)\n#endif\n", 0), std::runtime_error);
}

/// Point lights are what is left of the kinds, random places what is left of the samplers; the host alone
/// asks for BOTH_BRANCHES.
TEST(KernelPrograms, EveryFeatureIsAskedForBySomeProgram) {
  std::uint64_t asked =
      bit(Feature::POINT_LIGHTS) | bit(Feature::SAMPLER_RANDOM) | bit(Feature::BOTH_BRANCHES);
  std::uint64_t all = 0;
#define WHITTLE_ALL(name, number, text) all |= std::uint64_t{1} << (number);
  WHITTLE_FEATURES(WHITTLE_ALL)
#undef WHITTLE_ALL
  const std::uint64_t searchesAlpha = all & ~bit(Feature::ALPHA_MASK);
  for (const std::uint64_t bits : {all, searchesAlpha, all & ~bit(Feature::FILTERED_SHADOWS),
                                   all & ~bit(Feature::MIRROR), all & ~bit(Feature::VERTEX_NORMALS)})
    for (const auto& program :
         kernelPrograms(SceneFeatures::ofBits(bits), plannedStages({SceneFeatures::ofBits(bits), 2, 16})))
      asked |= program.features;
  EXPECT_EQ(asked, all);
}

TEST(KernelPrograms, EveryPlannedStageIsInOne) {
  const SceneFeatures all = SceneFeatures::ofBits(~std::uint64_t{0} >> 1);
  auto stages = plannedStages({all, 2, 16});
  std::vector<std::string> found;
  for (const auto& program : kernelPrograms(all, stages)) {
    for (const auto& kernel : program.kernels)
      EXPECT_NE(program.source.find(" " + kernel + "("), std::string::npos) << kernel;
    found.insert(found.end(), program.kernels.begin(), program.kernels.end());
  }
  std::sort(found.begin(), found.end());
  std::sort(stages.begin(), stages.end());
  EXPECT_EQ(found, stages);
}

/// Scenes that differ in how they are shaded share all other code.
TEST(KernelPrograms, ShadingAloneAsksHowSurfacesLook) {
  const std::uint64_t plain =
      bit(Feature::PACKETS) | bit(Feature::TREE) | bit(Feature::LIGHTS) | bit(Feature::IMPULSES);
  const std::uint64_t rich = plain | bit(Feature::TEXTURES) | bit(Feature::UV0) |
                             bit(Feature::BASE_COLOR_TEXTURE) | bit(Feature::VERTEX_NORMALS) |
                             bit(Feature::MIRROR) | bit(Feature::METAL) | bit(Feature::SHADOWS);
  const auto stages = plannedStages({SceneFeatures::ofBits(rich), 1, 8});
  const auto one = kernelPrograms(SceneFeatures::ofBits(plain), stages),
             two = kernelPrograms(SceneFeatures::ofBits(rich), stages);
  ASSERT_EQ(one.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(one[i].features == two[i].features, one[i].name != "shading") << one[i].name;
}

/// Searches must agree with each other to the bit, and the film's compensated sums must stay.
TEST(KernelPrograms, ShadingAloneIsRelaxedAndOnlyWhenAskedFor) {
  const SceneFeatures all = SceneFeatures::ofBits(~std::uint64_t{0} >> 1);
  for (const auto& program : kernelPrograms(all, plannedStages({all, 2, 16}))) {
    const std::string strict = buildOptions(program, {1024, 8}),
                      relaxed = buildOptions(program, {1024, 8, true});
    EXPECT_EQ(strict.find("relaxed"), std::string::npos) << strict;
    EXPECT_EQ(relaxed, strict + (program.name == "shading" ? " -cl-fast-relaxed-math" : "")) << program.name;
  }
}

TEST(KernelPrograms, TheCompilerProcessIsToldEverything) {
  const CompilerJob job{3, 0xabcdef0123456789, {1024, 8, true}, "a folder", {"shade", "film"}, 0, true};
  const CompilerJob heard = compilerJob(commandLine(job));
  EXPECT_EQ(heard.device, job.device);
  EXPECT_EQ(heard.features, job.features);
  EXPECT_EQ(heard.target.compactChunk, job.target.compactChunk);
  EXPECT_EQ(heard.target.workGroup, job.target.workGroup);
  EXPECT_TRUE(heard.target.relaxedArithmetic);
  EXPECT_EQ(heard.folder, job.folder);
  EXPECT_EQ(heard.stages, job.stages);
  EXPECT_EQ(heard.first, 0);
  EXPECT_TRUE(heard.isBeside);
  EXPECT_FALSE(compilerJob(commandLine({0, 0, {32, 64}, {}, {}})).target.relaxedArithmetic);
}

TEST(KernelPrograms, OthersAreCompiledBesideOnlyWhereThatTakesAWhile) {
  Compute compute = openTestDevice();
  const SceneFeatures features = SceneFeatures::ofBits(bit(Feature::PACKETS));
  const auto programs = kernelPrograms(features, plannedStages({features, 0, 1}));
  const CompileTarget target{1024, 8};
  compilePrograms(compute, programs, target);
  int asked = 0;
  const auto built = compilePrograms(compute, programs, target, [&] {
    ++asked;
    return [] {};
  });
  EXPECT_EQ(built.size(), programs.size());
  if (!std::getenv("POCL_KERNEL_CACHE")) {
    EXPECT_EQ(asked, 0) << "all of it was on disk";
  }
}

}  // namespace
}  // namespace whittle::test
