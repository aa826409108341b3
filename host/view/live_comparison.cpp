// See live_comparison.h.
#include "view/live_comparison.h"

#include <array>
#include <utility>

#include "image/tone_map.h"

namespace whittle::view {
namespace {

/// What the thread does; reading before comparing.
enum class Work : std::uint8_t { Read, Compare };

/// Linear light, RGB, of RGBA codes.
FloatImage lightOfCodes(const std::vector<std::uint8_t>& codes, int width, int height) {
  std::array<float, 256> light{};
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = static_cast<float>(srgbDecode(static_cast<double>(i) / 255));
  FloatImage image{width, height, 3, {}};
  image.pixels.resize(static_cast<std::size_t>(width) * height * 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = light[codes[i / 3 * 4 + i % 3]];
  return image;
}

std::vector<std::uint8_t> withAlpha(const std::vector<std::uint8_t>& rgb) {
  std::vector<std::uint8_t> rgba(rgb.size() / 3 * 4, 255);
  for (std::size_t i = 0; i < rgb.size(); ++i) rgba[i / 3 * 4 + i % 3] = rgb[i];
  return rgba;
}

/// The two as they are held against each other, and how they are shown.
struct Lights {
  FloatImage picture, reference;
  whittle::Shown shown = whittle::Shown::ToneMapped;
};

/// Of codes both are codes: the picture's are what `render` writes into a .png.
Lights lightsOf(const Comparable& c, const std::vector<std::uint8_t>& referenceCodes) {
  const FloatImage& radiance = c.picture->radiance;
  if (c.reference->isRadiance) return {radiance, c.reference->light};
  return {lightOfCodes(c.codes(radiance), radiance.width, radiance.height),
          lightOfCodes(referenceCodes, radiance.width, radiance.height), whittle::Shown::AsItIs};
}

}  // namespace

LiveComparison::LiveComparison(std::function<void()> wake)
    : wake_(std::move(wake)), worker_(static_cast<std::size_t>(Work::Compare) + 1) {}

void LiveComparison::open(std::function<Reference()> toRead) {
  worker_.give([this, toRead = std::move(toRead)] { read(toRead); }, static_cast<std::size_t>(Work::Read));
}

void LiveComparison::compare(Comparable pictures) {
  worker_.give([this, pictures = std::move(pictures)] { work(pictures); },
               static_cast<std::size_t>(Work::Compare));
}

std::optional<LiveComparison::Opened> LiveComparison::takeOpened() {
  const std::lock_guard lock(mutex_);
  return std::exchange(opened_, std::nullopt);
}

std::optional<Compared> LiveComparison::takeCompared() {
  const std::lock_guard lock(mutex_);
  return std::exchange(compared_, std::nullopt);
}

void LiveComparison::publish(const Compared& compared) {
  {
    const std::lock_guard lock(mutex_);
    compared_ = compared;
  }
  wake_();
}

void LiveComparison::read(const std::function<Reference()>& read) {
  Opened opened;
  try {
    opened.reference = std::make_shared<const Reference>(read());
  } catch (const std::exception& e) {
    opened.problem = e.what();
  }
  {
    const std::lock_guard lock(mutex_);
    opened_ = std::move(opened);
  }
  wake_();
}

void LiveComparison::work(const Comparable& c) {
  Compared compared;
  compared.serial = c.serial;
  // Codes of a screen go back to what they were; exposure and tone map are in them.
  compared.referenceCodes = c.reference->isRadiance
                                ? c.codes(c.reference->light)
                                : withAlpha(toneMap(c.reference->light, 0, nullptr, false));
  const Lights lights = lightsOf(c, compared.referenceCodes);
  const std::vector<float> errors = pixelErrors(lights.picture, lights.reference, c.isRelative);
  compared.scale = scaleOf(errors);
  compared.differenceCodes = errorCodes(errors, compared.scale);
  publish(compared);
  if (worker_.hasNewer()) return;  // FLIP takes long
  compared.figures = compareImages(lights.picture, lights.reference, lights.shown, lights.shown);
  publish(compared);
}

}  // namespace whittle::view
