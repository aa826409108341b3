// Cases 29 and 32: sums of many samples, and how fast the edge of a half plane converges.
#include "forms.h"

namespace whittle::test {
namespace {

TEST(CaseFilm, AMillionTimesATenth) {
  Scene scene;
  scene.background.radiance = glm::vec3(0.1F);
  scene.cameras.resize(1);
  Settings settings = caseSettings(1, 1);
  settings.raysPerPixel = 1000000;
  const RenderResult result = seen(scene, settings);
  Worst worst;
  worst.absolute(red(result.radiance), static_cast<double>(0.1F));
  record({"29", "one pixel of 10^6 samples of a background of 0.1", "0.1", worst.result(), worst.error(),
          "absolute", 1e-6});
}

struct Edge {
  double slope;  ///< the bright side lies below y = slope x + rise, in pixels from the picture's middle
  double rise;
};

/// Area of pixel [x, x+1] × [y, y+1] below the line: the integral of the clamped height, exact
/// for straight pieces.
double areaBelow(const Edge& e, double x, double y) {
  const auto integral = [&](double height) {  // of max(0, line − height) over [x, x+1]
    const double a = e.slope * x + e.rise - height, b = a + e.slope;
    if (a <= 0 && b <= 0) return 0.0;
    if (a >= 0 && b >= 0) return (a + b) / 2;
    const double most = std::max(a, b);
    return most * most / (2 * std::abs(e.slope));
  };
  return integral(y) - integral(y + 1);
}

constexpr int kWidth = 64, kHeight = 36;

/// A bright half plane seen straight from above, one metre for each pixel.
Scene halfPlane(const Edge& e) {
  Scene scene;
  const std::uint32_t bright = addMaterial(scene, emitter(glm::vec3(1)));
  const auto at = [&](double x) { return glm::vec3(glm::dvec3(x, 0, -(e.slope * x + e.rise))); };
  scene.positions = {at(-64), at(64), {64, 0, 128}, {-64, 0, 128}};
  scene.triangles = {{0, 2, 1, bright}, {0, 3, 2, bright}};
  scene.cameras = {lookingDown()};
  scene.cameras[0].ymag = kHeight / 2.0F;
  return scene;
}

/// RMSE of the pixels that the edge crosses; exact area of each in double.
double edgeError(const Edge& e, const FloatImage& image) {
  double sum = 0, count = 0;
  for (int j = 0; j < kHeight; ++j) {
    for (int i = 0; i < kWidth; ++i) {
      const double area = areaBelow(e, i - kWidth / 2.0, kHeight / 2.0 - 1 - j);
      if (area <= 0 || area >= 1) continue;
      const double off =
          red(image, static_cast<std::size_t>(j) * kWidth + static_cast<std::size_t>(i)) - area;
      sum += off * off, ++count;
    }
  }
  return std::sqrt(sum / count);
}

/// Slope of log RMSE over log samples, by least squares; several edges are averaged.
double slopeOf(Sampler sampler, const std::vector<int>& samples, double* last) {
  const Edge edges[] = {{0.3437, 0.2113}, {-0.5519, 1.3171}, {0.1271, -2.7183}};
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const int n : samples) {
    double squares = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      Settings settings = caseSettings(kWidth, kHeight);
      settings.keepFeatures |=
          bitsOf({Feature::SAMPLER_RANDOM, Feature::SAMPLER_STRATIFIED, Feature::SAMPLER_SOBOL});
      settings.sampler = sampler;
      settings.raysPerPixel = n;
      settings.seed = 11 + k;
      const double error = edgeError(edges[k], seen(halfPlane(edges[k]), settings).radiance);
      squares += error * error / 3;
    }
    *last = std::sqrt(squares);
    const double x = std::log(n), y = std::log(*last);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const auto m = static_cast<double>(samples.size());
  return (m * sxy - sx * sy) / (m * sxx - sx * sx);
}

/// Random samples: the deviation of a mean. Jittered ones: only the strata that the edge crosses are
/// uncertain, some sqrt(N) of N, so N^(-3/4) (Mitchell 1996). Sobol points do no worse than those.
TEST(CaseFilm, EdgesConvergeAsTheirSamplersPromise) {
  const std::vector<int> samples =
      longCases() ? std::vector<int>{4, 16, 64, 256, 1024, 4096} : std::vector<int>{4, 16, 64};
  double last = 0;
  const auto text = [&](double slope) {
    return fmt::format("slope {:.3f}, RMSE {:.2e} at the end", slope, last);
  };
  const std::string what =
      fmt::format("edge of a half plane, {} to {} samples", samples.front(), samples.back());
  const double random = slopeOf(Sampler::Random, samples, &last);
  record({"32", what + ", random", "slope -1/2", text(random), std::abs(random + 0.5), "slope", 0.07});
  const double jittered = slopeOf(Sampler::Stratified, samples, &last);
  record(
      {"32", what + ", stratified", "slope -3/4", text(jittered), std::abs(jittered + 0.75), "slope", 0.07});
  const double sobol = slopeOf(Sampler::Sobol, samples, &last);
  record({"32", what + ", Sobol", "slope -3/4 or steeper", text(sobol), std::max(0.0, sobol + 0.75), "slope",
          0.07});
}

}  // namespace
}  // namespace whittle::test
