// The kernels against the reference on every scene of the project.
#include "support/agreement.h"
#include "support/pictures.h"

namespace whittle::test {
namespace {

class OwnScene : public ::testing::TestWithParam<std::string> {};

TEST_P(OwnScene, AgreesWithTheReference) {
  // Measured: no outlier, every ray count equal. One edge within rounding of a ray may come
  // with other arithmetic.
  expectAgreement(compareWithReference(ownScene(GetParam()), smallSettings()), GetParam(), 1);
}

/// Divisions and roots off by a few units in the last place (OpenCL 1.2, table 7.1, and what its text says of
/// -cl-unsafe-math-optimizations) move a ray by no more than rounding already does: the bounds are those of
/// strict arithmetic.
TEST(RelaxedArithmetic, AgreesWithTheReference) {
  Settings settings = smallSettings();
  settings.relaxedArithmetic = true;
  const Agreement relaxed = compareWithReference(ownScene("cornell_box"), settings);
  expectAgreement(relaxed, "cornell_box, relaxed", 1);
  EXPECT_TRUE(relaxed.kernel.stats.settings.relaxedArithmetic);
}

INSTANTIATE_TEST_SUITE_P(Scenes, OwnScene, ::testing::ValuesIn(ownScenes()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace whittle::test
