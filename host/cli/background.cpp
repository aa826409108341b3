// See background.h.
#include "cli/background.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <sstream>
#include <vector>

#include "cli/option_kinds.h"
#include "image/image_header.h"
#include "image/image_io.h"
#include "report/text.h"
#include "scene/appearance.h"
#include "scene/input_error.h"
#include "scene/sky_light.h"

namespace whittle::cli {
namespace {

/// "R,G,B", or one number for grey.
bool parseRadiance(const std::string& text, glm::vec3& out) {
  std::istringstream in(text);
  char comma1 = 0, comma2 = 0;
  glm::vec3 v;
  if (!(in >> v.r)) return false;
  if (in.eof()) {
    out = glm::vec3(v.r);
    return true;
  }
  if (!(in >> comma1 >> v.g >> comma2 >> v.b) || comma1 != ',' || comma2 != ',' || !(in >> std::ws).eof())
    return false;
  out = v;
  return true;
}

/// The largest finite half: what a file of halves calls infinite was at least this bright.
constexpr float kLargestHalf = 65504.0F;

/// Texels with a channel of each kind that light cannot have.
struct Flaws {
  std::uint64_t notNumbers = 0, negative = 0, infinite = 0;
};

/// One channel as a sky may have it.
float mended(float value, bool& isNan, bool& isNegative, bool& isInfinite) {
  isNan |= std::isnan(value);
  isNegative |= value < 0.0F;
  const bool tooBright = std::isinf(value) && value > 0.0F;
  isInfinite |= tooBright;
  if (tooBright) return kLargestHalf;
  return value > 0.0F ? value : 0.0F;
}

void warnOf(const Flaws& flaws, const std::string& file, std::size_t texels, Notices& notices) {
  std::vector<std::string> kinds;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) kinds.push_back(fmt::format("{} {}", formatInteger(count), what));
  };
  add(flaws.notNumbers, "with NaN (taken as 0)");
  add(flaws.negative, "with negative values (taken as 0)");
  add(flaws.infinite, "with infinite values (taken as 65504)");
  if (!kinds.empty())
    notices.warn(fmt::format("--background: {}: of {} texels {}", file, formatInteger(texels),
                             fmt::join(kinds, ", ")));
}

/// The map as it is read, in the scene and on the device: floats each time.
void holdMap(const std::string& file, MemoryBudget& budget) {
  const auto header = headerOf(std::filesystem::path(file));
  if (!header) return;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  if (!unknown) budget.sawFile(size);
  budget.hold(sizeof(float) * 3 * 3 * header->pixels(),
              fmt::format("--background: the {}×{} texels of {}", header->width, header->height, file));
}

Background readBackground(const std::string& file, MemoryBudget& budget, Notices& notices) {
  holdMap(file, budget);
  FloatImage image;
  try {
    image = readFloatImage(file);
  } catch (const InputError& e) {
    throw InputError(fmt::format("--background: neither R,G,B nor a picture that can be read: {}", e.what()));
  }
  Background background{glm::vec3(1.0F), image.width, image.height, {}};
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t texels = image.pixels.size() / channels;
  background.map.reserve(texels * 3);
  Flaws flaws;
  for (std::size_t p = 0; p < texels; ++p) {
    bool isNan = false, isNegative = false, isInfinite = false;
    for (std::size_t c = 0; c < 3; ++c)
      background.map.push_back(
          mended(image.pixels[p * channels + (channels >= 3 ? c : 0)], isNan, isNegative, isInfinite));
    flaws.notNumbers += isNan ? 1 : 0;
    flaws.negative += isNegative ? 1 : 0;
    flaws.infinite += isInfinite ? 1 : 0;
  }
  warnOf(flaws, file, texels, notices);
  return background;
}

Background parseBackground(const std::string& text, MemoryBudget& budget, Notices& notices) {
  glm::vec3 radiance;
  if (!parseRadiance(text, radiance)) return readBackground(text, budget, notices);
  if (!(radiance.r >= 0.0F && radiance.g >= 0.0F && radiance.b >= 0.0F) ||
      !std::isfinite(radiance.r + radiance.g + radiance.b))
    throw InputError(fmt::format("--background: '{}': radiance must be finite and not negative", text));
  Background background;
  background.radiance = radiance;
  return background;
}

}  // namespace

std::optional<SkyChoice> parseSky(const std::string& option, const std::string& text) {
  if (text == "auto") return std::nullopt;
  if (text == "none") return SkyChoice{true, {}};
  std::vector<double> numbers;
  try {
    numbers = parseNumbers(option, text, 2, 3);
  } catch (const InputError&) {
    throw InputError(
        fmt::format("{}: '{}' is neither none nor auto nor ELEVATION,AZIMUTH or ELEVATION,AZIMUTH,TURBIDITY, "
                    "such as 30,120 or 30,120,6",
                    option, text));
  }
  SkyChoice choice;
  choice.sky.elevation = numbers[0];
  choice.sky.azimuth = numbers[1];
  if (numbers.size() == 3) choice.sky.turbidity = numbers[2];
  if (!isInRange(choice.sky))
    throw InputError(fmt::format(
        "{}: '{}': the elevation is {} (the end of civil twilight) to 90 degrees, the turbidity {} "
        "to {}",
        option, text, kLowestSun, kLeastTurbidity, kMostTurbidity));
  return choice;
}

void applyBackground(Scene& scene, const std::string& text, const Settings& settings, MemoryBudget& budget,
                     Notices& notices) {
  if (!text.empty()) scene.background = parseBackground(text, budget, notices);
  scene.background.unscaled = scene.background.radiance;
  turnAndScale(scene.background, settings);
  const bool isDark = isBlack(scene.background);
  if (settings.backgroundStrength != 1.0F && isDark && settings.backgroundStrength > 0.0F)
    notices.note("--background-strength changes nothing: what surrounds the scene is black");
  if (settings.backgroundRotation != 0.0 && scene.background.hasSun)
    notices.note("--background-rotation changes nothing: --sky says where its sun stands");
  else if (settings.backgroundRotation != 0.0 && (isDark || scene.background.map.empty()))
    notices.note("--background-rotation changes nothing: what surrounds the scene is the same all around");
}

}  // namespace whittle::cli
