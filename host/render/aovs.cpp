// See aovs.h.
#include "render/aovs.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

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

}  // namespace whittle
