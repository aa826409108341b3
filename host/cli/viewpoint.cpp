// See viewpoint.h.
#include "cli/viewpoint.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "cli/option_kinds.h"
#include "report/text.h"
#include "scene/input_error.h"

namespace whittle::cli {
namespace {

constexpr double kToDegrees = 180.0 / std::numbers::pi;
constexpr double kFarthest = 1e18, kLeastHeight = 1e-9;  // metres

glm::dvec3 parsePoint(const std::string& option, const std::string& text) {
  const auto n = parseNumbers(option, text, 3, 3);
  return {n[0], n[1], n[2]};
}

/// As short as it can be from nine digits on, and still within `off` of the value where a double can be.
std::string numberText(double value, double off) {
  constexpr int kShortest = 9, kExact = 17;  // digits that give back any float, any double
  for (int digits = kShortest; digits < kExact; ++digits) {
    std::string text = fmt::format("{:.{}g}", value, digits);
    if (std::abs(std::stod(text) - value) <= off) return text;
  }
  return fmt::format("{:.{}g}", value, kExact);
}

std::string pointText(const glm::dvec3& p, const glm::dvec3& off) {
  return fmt::format("{},{},{}", numberText(p.x, off.x), numberText(p.y, off.y), numberText(p.z, off.z));
}

constexpr double kFloatRounding = 0x1p-24;  ///< relative

}  // namespace

void addViewpointOptions(CLI::App& c, ViewpointOptions& o, CLI::Option* camera) {
  Viewpoint& v = o.viewpoint;
  o.camera = camera;
  o.eye = addText(c, "--eye", [&v](const std::string& t) { v.eye = parsePoint("--eye", t); },
                  {"X,Y,Z", "look from this point instead of a camera of the file, metres", ""});
  o.lookAt = addText(c, "--look-at", [&v](const std::string& t) { v.lookAt = parsePoint("--look-at", t); },
                     {"X,Y,Z", "at this one", "the scene's middle"});
  o.up = addText(c, "--up", [&v](const std::string& t) { v.up = parsePoint("--up", t); },
                 {"X,Y,Z", "what is up in the picture", "0,1,0"});
  o.fov = addText(c, "--fov",
                  [&v](const std::string& t) { v.yfov = parseReal("--fov", t, 0.001, 179) / kToDegrees; },
                  {"DEGREES", "vertical field of view of --eye and --orbit", "40.1"});
  o.orthoHeight = addText(
      c, "--ortho-height",
      [&v](const std::string& t) { v.orthoHeight = parseReal("--ortho-height", t, kLeastHeight, kFarthest); },
      {"METRES", "instead of --fov: an orthographic view, so high from edge to edge", "perspective"});
  o.orbit = addText(c, "--orbit",
                    [&v](const std::string& t) {
                      const auto n = parseNumbers("--orbit", t, 2, 3);
                      v.orbit = {n[0], n[1]};
                      v.distance = n.size() == 3 ? std::optional(n[2]) : std::nullopt;
                      if (v.distance && !(*v.distance > 0.0))
                        throw InputError("--orbit: the distance must be positive");
                    },
                    {"AZIMUTH,ELEVATION[,DISTANCE]",
                     "look at the scene's middle from there: degrees from +Z towards +X, degrees above it, "
                     "metres",
                     "all of the scene in the picture"});
}

std::optional<Viewpoint> chosenViewpoint(const ViewpointOptions& o) {
  const bool eye = given(o.eye), orbit = given(o.orbit);
  if (eye && orbit) throw InputError("--eye and --orbit: give one of the two");
  if ((eye || orbit) && given(o.camera))
    throw InputError(fmt::format("--camera and {}: give one of the two", eye ? "--eye" : "--orbit"));
  if (given(o.fov) && given(o.orthoHeight)) throw InputError("--fov and --ortho-height: give one of the two");
  if (!eye && given(o.lookAt)) throw InputError("--look-at: needs --eye");
  if (!eye && !orbit)
    for (const CLI::Option* option : {o.up, o.fov, o.orthoHeight})
      if (given(option)) throw InputError(fmt::format("{}: needs --eye or --orbit", option->get_name()));
  if (!eye && !orbit) return std::nullopt;
  return o.viewpoint;
}

std::string viewpointText(const Camera& c, const glm::dvec3& origin) {
  // Far from the file's origin it takes more digits: read back and brought to the scene's origin, the eye
  // must round to the same floats, and what it looks at, a metre away, must be nearer than they can tell.
  const glm::dvec3 place(c.position), eye = place + origin;
  const glm::dvec3 offEye = 0.25 * kFloatRounding * glm::abs(place), offTarget(0.1 * kFloatRounding);
  const double height = 2.0 * static_cast<double>(c.ymag);
  const std::string lens = c.orthographic
                               ? "--ortho-height " + numberText(height, 0.25 * kFloatRounding * height)
                               : fmt::format("--fov {:.7g}", static_cast<double>(c.yfov) * kToDegrees);
  return fmt::format("--eye {} --look-at {} --up {} {}", pointText(eye, offEye),
                     pointText(eye + glm::dvec3(c.forward), offTarget),
                     pointText(glm::dvec3(c.up), offTarget), lens);
}

}  // namespace whittle::cli
