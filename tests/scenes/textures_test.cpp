// Textures of the scene kit: they repeat without a seam, and what is baked is what the functions say.
#include "png.h"
#include "textures/noise.h"
#include "textures/surfaces.h"

namespace generator::test {
namespace {

struct Named {
  const char* name;
  SurfaceFunction surface;
};

std::vector<Named> allSurfaces() {
  return {{"wood", woodSurface(2)},
          {"marble", marbleSurface()},
          {"plaster", plasterSurface({0.6, 0.5, 0.4})},
          {"tiles", tileSurface(4, {0.3, 0.4, 0.4})},
          {"brushed metal", brushedMetalSurface({0.9, 0.7, 0.3}, 0.3, 1e-6)},
          {"pearled metal", pearledMetalSurface(6, {0.7, 0.7, 0.6}, 0.3)},
          {"striped metal", stripedMetalSurface(4, {0.7, 0.7, 0.6}, 0.3)},
          {"fabric", fabricSurface(12, {0.5, 0.3, 0.1})},
          {"leather", leatherSurface(18, {0.1, 0.2, 0.1})}};
}

double difference(const SurfacePoint& a, const SurfacePoint& b) {
  return glm::length(a.color - b.color) + std::abs(a.roughness - b.roughness);
}

/// Mean difference over a short step across the line at `at`, in x or in y.
double meanStep(const SurfaceFunction& surface, double at, bool isAcrossX) {
  constexpr int kSteps = 400;
  constexpr double h = 1e-4;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double along = (i + 0.5) / kSteps, before = at - h < 0 ? at - h + 1 : at - h;
    sum += isAcrossX ? difference(surface({before, along}), surface({at + h, along}))
                     : difference(surface({along, before}), surface({along, at + h}));
  }
  return sum / kSteps;
}

TEST(SceneKitTextures, RepeatWithoutASeam) {
  for (const auto& [name, surface] : allSurfaces()) {
    for (const bool isAcrossX : {true, false}) {
      // Sharp lines are part of some: the seam may be as sharp as the sharpest of many lines.
      double sharpest = 0;
      for (int line = 1; line < 240; ++line)
        sharpest = std::max(sharpest, meanStep(surface, line / 240.0, isAcrossX));
      EXPECT_LE(meanStep(surface, 0, isAcrossX), 1.5 * sharpest + 1e-9) << name << (isAcrossX ? " x" : " y");
    }
  }
}

TEST(SceneKitTextures, StayWithinWhatAMaterialCanBe) {
  for (const auto& [name, surface] : allSurfaces()) {
    for (int i = 0; i < 10000; ++i) {
      const SurfacePoint p = surface({(i % 100 + 0.5) / 100, (i / 100 + 0.5) / 100});
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(p.color, glm::dvec3(0)))) << name;
      EXPECT_TRUE(glm::all(glm::lessThanEqual(p.color, glm::dvec3(1.06)))) << name;
      EXPECT_GE(p.roughness, 0) << name;
      EXPECT_LE(p.roughness, 1) << name;
      EXPECT_LT(std::abs(p.height), 0.01) << name;
    }
  }
}

TEST(SceneKitTextures, NoiseWrapsAround) {
  for (int i = 0; i < 100; ++i) {
    const glm::dvec2 uv(0.37 + i * 0.01, 0.11 * i);
    EXPECT_NEAR(fractalNoise(uv, {5, 7}, 3, 4), fractalNoise(uv + glm::dvec2(1, -2), {5, 7}, 3, 4), 1e-9);
    EXPECT_NEAR(cellNoise(uv, {5, 7}, 3).nearest, cellNoise(uv + glm::dvec2(2, 1), {5, 7}, 3).nearest, 1e-9);
  }
}

TEST(SceneKitTextures, CellNoiseFindsTheNearestTwo) {
  // Where the nearest distance is smallest there is a point; over a fine grid all points of the cells turn
  // up.
  constexpr int n = 4, kGrid = 400;
  std::map<std::uint32_t, std::pair<double, glm::dvec2>> points;
  for (int y = 0; y < kGrid; ++y) {
    for (int x = 0; x < kGrid; ++x) {
      const glm::dvec2 uv((x + 0.5) / kGrid, (y + 0.5) / kGrid);
      const CellHit hit = cellNoise(uv, {n, n}, 5);
      const auto [at, isNew] = points.try_emplace(hit.id, hit.nearest, uv);
      if (!isNew && hit.nearest < at->second.first) at->second = {hit.nearest, uv};
    }
  }
  EXPECT_EQ(points.size(), std::size_t{n * n});
  for (int i = 0; i < 50; ++i) {
    const glm::dvec2 uv(0.02 * i, 0.013 * i);
    std::vector<double> distances;
    for (const auto& [id, point] : points) {
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          distances.push_back(n * glm::distance(uv, point.second + glm::dvec2(dx, dy)));
    }
    std::sort(distances.begin(), distances.end());
    const CellHit hit = cellNoise(uv, {n, n}, 5);
    EXPECT_NEAR(hit.nearest, distances[0], 2.0 * n / kGrid);
    EXPECT_NEAR(hit.second, distances[1], 2.0 * n / kGrid);
  }
}

/// The pixel of a PNG that encodePng() stored: rows lie in the file as they are, in blocks of 65535 bytes.
std::array<int, 4> firstPixel(const std::vector<std::uint8_t>& png) {
  // Signature 8, IHDR 25, IDAT's length and type 8, zlib's header 2, the block's 5, the row's filter 1.
  constexpr std::size_t kFirst = 8 + 25 + 8 + 2 + 5 + 1;
  return {png[kFirst], png[kFirst + 1], png[kFirst + 2], png[kFirst + 3]};
}

TEST(SceneKitBake, FlatSurfacesHaveUprightNormals) {
  const BakedSurface baked = bake({8, 8, 0.1}, [](glm::dvec2) {
    return SurfacePoint{{0.5, 1, 0}, 0.3, 0.2};
  });
  EXPECT_EQ(firstPixel(baked.normal), (std::array<int, 4>{128, 128, 255, 255}));
  EXPECT_EQ(firstPixel(baked.color), (std::array<int, 4>{188, 255, 0, 255}));  // sRGB of ½ is 0.735
  EXPECT_EQ(firstPixel(baked.roughness), (std::array<int, 4>{255, 51, 255, 255}));
}

TEST(SceneKitBake, NormalsLeanAgainstTheSlope) {
  // 45° up to the right, and 45° up towards the top: the height is a saw, whose first pixel lies on its
  // slope.
  const auto saw = [](double t) { return 0.1 * std::abs(t < 0.5 ? t : 1 - t); };
  const BakedSurface right = bake({8, 8, 0.1}, [&](glm::dvec2 uv) {
    return SurfacePoint{.height = saw(uv.x - 0.25 < 0 ? uv.x + 0.75 : uv.x - 0.25)};
  });
  // At x = 1/16 the saw falls: the surface looks to the right.
  EXPECT_EQ(firstPixel(right.normal), (std::array<int, 4>{218, 128, 218, 255}));
  const BakedSurface down = bake({8, 8, 0.1}, [&](glm::dvec2 uv) {
    return SurfacePoint{.height = saw(uv.y - 0.25 < 0 ? uv.y + 0.75 : uv.y - 0.25)};
  });
  // Falling downwards, it looks down, which is dark green.
  EXPECT_EQ(firstPixel(down.normal), (std::array<int, 4>{128, 37, 218, 255}));
}

}  // namespace
}  // namespace generator::test
