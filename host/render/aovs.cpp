// See aovs.h.
#include "render/aovs.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "wavefront/film.h"

namespace whittle {

void askForAov(Settings& settings, const std::string& name) {
  if (std::find(kAovNames.begin(), kAovNames.end(), name) == kAovNames.end())
    throw std::invalid_argument(fmt::format("there is no auxiliary output '{}'", name));
  if (name == "error")
    settings.errorAov = true;
  else if (name == "bounce")
    settings.bounceAov = true;
  else if (name == "cost")
    settings.costAov = true;
  else
    settings.aovs = true;
}

void askForAllAovs(Settings& settings) {
  for (const auto& name : kAovNames)
    if (name != "error" || settings.raysPerPixel > 1) askForAov(settings, name);
}

std::map<std::string, FloatImage> readAovs(Compute& compute, const Settings& settings,
                                           const PictureBuffers& picture, SamplingLoop& loop,
                                           const std::optional<PixelRecorder>& recorder) {
  std::map<std::string, FloatImage> aovs;
  if (picture.aovs) {
    std::vector<float> planes(picture.aovs.bytes / sizeof(float));
    compute.read(picture.aovs, 0, picture.aovs.bytes, planes.data());
    std::vector<std::uint32_t> order(picture.order.bytes / sizeof(std::uint32_t));
    compute.read(picture.order, 0, picture.order.bytes, order.data());
    aovs = splitAovs(settings, order, planes);
    aovs["samples"] = loop.samples();
  }
  if (settings.errorAov && loop.counts().least() >= 2) aovs["error"] = loop.errors();
  if (settings.bounceAov) aovs["bounce"] = recorder->bounces();
  if (settings.costAov) aovs["cost"] = recorder->cost();
  return aovs;
}

}  // namespace whittle
