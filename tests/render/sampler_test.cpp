// Several samples for each pixel: the kernels' samplers and random choices against the reference's.
#include <cmath>

#include "support/agreement.h"
#include "support/pictures.h"

namespace whittle::test {
namespace {

struct SamplerCase {
  const char* name;
  Sampler sampler;
  int raysPerPixel;
  ImpulseMode impulses = ImpulseMode::All;
};
void PrintTo(const SamplerCase& c, std::ostream* out) { *out << c.name; }

class Samplers : public ::testing::TestWithParam<SamplerCase> {};

TEST_P(Samplers, AgreeWithTheReference) {
  Settings settings = wholeSettings(5);
  settings.width = 48;
  settings.height = 27;
  settings.sampler = GetParam().sampler;
  settings.raysPerPixel = GetParam().raysPerPixel;
  settings.impulses = GetParam().impulses;
  settings.seed = 7;
  const Agreement agreement = compareWithReference(ownScene("refraction"), settings);
  // 20 736 rays in the larger case: a few lie within rounding of an edge.
  expectAgreement(agreement, GetParam().name, 4);
  EXPECT_GT(agreement.kernel.stats.rays.impulse, 500U);
}

INSTANTIATE_TEST_SUITE_P(All, Samplers,
                         ::testing::Values(SamplerCase{"random4", Sampler::Random, 4},
                                           SamplerCase{"random16", Sampler::Random, 16},
                                           SamplerCase{"stratified4", Sampler::Stratified, 4},
                                           SamplerCase{"stratified16", Sampler::Stratified, 16},
                                           SamplerCase{"sobol4", Sampler::Sobol, 4},
                                           SamplerCase{"sobol16", Sampler::Sobol, 16},
                                           SamplerCase{"one1", Sampler::Random, 1, ImpulseMode::One},
                                           SamplerCase{"one16", Sampler::Sobol, 16, ImpulseMode::One}),
                         [](const auto& one) { return one.param.name; });

double meanLuminance(const FloatImage& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    sum += 0.2126 * image.pixels[i] + 0.7152 * image.pixels[i + 1] + 0.0722 * image.pixels[i + 2];
  return sum / (static_cast<double>(image.pixels.size()) / 3);
}

TEST(OneImpulse, IsUnbiased) {
  Settings settings = wholeSettings(6);
  settings.width = 32;
  settings.height = 18;
  settings.raysPerPixel = 256;
  const Scene scene = ownScene("refraction");
  const RenderResult all = renderOnDevice(scene, settings);
  settings.impulses = ImpulseMode::One;
  const RenderResult one = renderOnDevice(scene, settings);
  EXPECT_LT(one.stats.rays.impulse, all.stats.rays.impulse / 2) << "one branch instead of a tree";
  // The same positions in the pixels, so only the choice differs; the estimate, RMS over pixels, counts the
  // edges too.
  const double standardError = one.stats.error.back().estimate / std::sqrt(32.0 * 18.0);
  EXPECT_NEAR(meanLuminance(one.radiance), meanLuminance(all.radiance), 4 * standardError);
  EXPECT_LT(4 * standardError, 0.01 * meanLuminance(all.radiance)) << "or the test says little";
}

TEST(Samples, SeedsAndSamplersDiffer) {
  Settings settings = wholeSettings(1);
  settings.raysPerPixel = 4;
  const Scene scene = ownScene("anti_aliasing");
  const FloatImage first = renderOnDevice(scene, settings).radiance;
  settings.seed = 1;
  EXPECT_GT(differingPixels(first, renderOnDevice(scene, settings).radiance), 100U);
  settings.seed = 0;
  settings.sampler = Sampler::Sobol;
  EXPECT_GT(differingPixels(first, renderOnDevice(scene, settings).radiance), 100U);
}

}  // namespace
}  // namespace whittle::test
