// See sky.h.
#include "scene/sky_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whittle {
namespace {

constexpr double kChanceUnits = 1 << 24;  ///< of chance

/// What `until` is for things of these weights, of which there are fewer than units. `before` adds the same
/// numbers as `sum` in the same order, so it ends at exactly that.
void setUntil(const std::vector<double>& weights, float* until) {
  double sum = 0.0, some = 0.0;
  for (const double w : weights) sum += w, some += w > 0.0 ? 1.0 : 0.0;
  const double shared = kChanceUnits - some;
  double before = 0.0, counted = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    before += weights[i], counted += weights[i] > 0.0 ? 1.0 : 0.0;
    const double units = sum > 0.0 ? counted + std::floor(shared * (before / sum)) : kChanceUnits;
    until[i] = static_cast<float>(units / kChanceUnits);
  }
}

}  // namespace

double skyBrightness(const Background& b, int x, int y) {
  const auto row = static_cast<std::size_t>(std::clamp(y, 0, b.height - 1));
  const float* rgb = &b.map[3 * (row * b.width + (x + b.width) % b.width)];
  return static_cast<double>(rgb[0]) + static_cast<double>(rgb[1]) + static_cast<double>(rgb[2]);
}

SkyTable skyTableOf(const Background& b) {
  if (b.map.empty()) return {};
  const auto columns = static_cast<std::size_t>(b.width), rows = static_cast<std::size_t>(b.height) + 1;
  SkyTable table{b.width, b.height, std::vector<float>(rows + rows * columns)};
  std::vector<double> ofRows(rows), ofColumns(columns);
  for (int y = 0; y <= b.height; ++y) {
    double row = 0.0;
    for (int x = 0; x < b.width; ++x) {
      const auto both = [&](int line) { return skyBrightness(b, x, line) + skyBrightness(b, x + 1, line); };
      ofColumns[x] = both(y - 1) + both(y);
      row += ofColumns[x];
    }
    setUntil(ofColumns, &table.until[rows + columns * y]);
    const double top = std::max(0.0, y - 0.5), bottom = std::min<double>(b.height, y + 0.5);
    const double step = std::numbers::pi / b.height;
    ofRows[y] = row * (std::cos(step * top) - std::cos(step * bottom));
  }
  setUntil(ofRows, table.until.data());
  return table;
}

bool isBlack(const Background& background) { return background.radiance == glm::vec3(0.0F); }

bool addSkyLight(Scene& scene) {
  if (isBlack(scene.background)) return false;
  Light light;
  light.name = "sky";
  light.kind = LightKind::Sky;
  scene.lights.push_back(light);
  return true;
}

bool hasSkyLight(const Scene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const Light& l) { return l.kind == LightKind::Sky; });
}

float ambientOf(const Scene& scene, const Settings& settings) {
  return hasSkyLight(scene) ? 0.0F : settings.ambient.value_or(0.0F);
}

}  // namespace whittle
