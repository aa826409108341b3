// The kernels against the reference on every scene of the project.
#include "agreement.h"
#include "pictures.h"

namespace whittle::test {
namespace {

class OwnScene : public ::testing::TestWithParam<std::string> {};

TEST_P(OwnScene, AgreesWithTheReference) {
  // Measured: no outlier, every ray count equal. One edge within rounding of a ray may come with other
  // arithmetic.
  expectAgreement(compareWithReference(ownScene(GetParam()), smallSettings()), GetParam(), 1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, OwnScene, ::testing::ValuesIn(ownScenes()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace whittle::test
