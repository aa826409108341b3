// whittle compare: how far a picture is from a reference.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/outputs.h"
#include "cli/speech.h"
#include "image/metrics.h"
#include "report/text.h"

namespace whittle::cli {
namespace {

struct CompareOptions {
  std::filesystem::path a, b;
  bool json = false;
};

Shown shownAs(const std::filesystem::path& file) {
  return isToneMapped(file) ? Shown::AsItIs : Shown::ToneMapped;
}

int colorChannels(const FloatImage& image) { return image.channels >= 3 ? 3 : 1; }

std::string shapeOf(const std::filesystem::path& file, const FloatImage& image) {
  return fmt::format("{} is {}×{} with {}", file.string(), image.width, image.height,
                     colorChannels(image) == 3 ? "colours" : "one channel");
}

/// JSON has no NaN and no infinity: null says that the number is not finite.
nlohmann::ordered_json finiteOrNull(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

void print(const ImageMetrics& m, std::uint64_t pixels) {
  const auto line = [](const char* name, const std::string& value, const char* meaning) {
    tell(fmt::format("{:<16} {:>12}  {}\n", name, value, meaning));
  };
  line("rmse", fmt::format("{:.6g}", m.rmse), "root mean square difference");
  line("relMse", fmt::format("{:.6g}", m.relMse), "mean of (a-b)²/(b²+0.01)");
  line("maxAbs", fmt::format("{:.6g}", m.maxAbs), "largest difference of a channel");
  line("flip", fmt::format("{:.6g}", m.flip), "mean FLIP of the pictures as shown, 0 to 1");
  line("differingPixels", formatInteger(m.differingPixels),
       fmt::format("of {} have other bits", formatInteger(pixels)).c_str());
}

int runCompare(const CompareOptions& o) {
  const FloatImage a = readFloatImage(o.a);
  const FloatImage b = readFloatImage(o.b);
  if (a.width != b.width || a.height != b.height || colorChannels(a) != colorChannels(b)) {
    complain(fmt::format("{} but {}: they cannot be compared", shapeOf(o.a, a), shapeOf(o.b, b)));
    return 1;
  }
  if (isToneMapped(o.a) != isToneMapped(o.b))
    note(
        "one picture is linear, the other tone-mapped and cut off at white: their difference "
        "holds that too");
  if (a.hadAlpha || b.hadAlpha)
    note(fmt::format("alpha is left out: colours are compared as they stand in the files{}",
                     a.hadAlpha != b.hadAlpha ? ", and only one of these has an alpha" : ""));
  const ImageMetrics m = compareImages(a, b, shownAs(o.a), shownAs(o.b));
  const auto pixels = static_cast<std::uint64_t>(a.width) * static_cast<std::uint64_t>(a.height);
  if (m.nonFinite + m.nonFiniteReference > 0)
    warn(fmt::format("pixels that are not finite: {} in {}, {} in {}; {}", formatInteger(m.nonFinite),
                     o.a.string(), formatInteger(m.nonFiniteReference), o.b.string(),
                     o.json ? "numbers that are not finite are null" : "they make the numbers nan or inf"));
  if (!o.json) {
    print(m, pixels);
    return 0;
  }
  const nlohmann::ordered_json json{{"rmse", finiteOrNull(m.rmse)},
                                    {"relMse", finiteOrNull(m.relMse)},
                                    {"maxAbs", finiteOrNull(m.maxAbs)},
                                    {"flip", finiteOrNull(m.flip)},
                                    {"differingPixels", m.differingPixels},
                                    {"pixels", pixels},
                                    {"nonFinite", m.nonFinite},
                                    {"nonFiniteReference", m.nonFiniteReference}};
  tellJson(json.dump(2) + "\n");
  return 0;
}

}  // namespace

void addCompare(CLI::App& app, int& status) {
  auto o = std::make_shared<CompareOptions>();
  CLI::App* c = app.add_subcommand("compare", "how far picture A is from reference B");
  c->option_defaults()->group("Pictures");
  c->add_option("A", o->a, "picture, .exr, .hdr, .png or .jpg; sRGB is made linear")->required();
  c->add_option("B", o->b, "reference of the same size")->required();
  c->option_defaults()->group("Output");
  c->add_flag("--json", o->json, "as JSON; a number that is not finite is null");
  c->footer(
      "Of a file with layers R, G and B count, or those of its only layer; no alpha.\n"
      "FLIP is at 67 pixels a degree: of .png and .jpg by their own codes, of radiance\n"
      "after the tone map.\n"
      "Status 1 if the pictures have different sizes or numbers of colour channels.\n"
      "Example: whittle compare picture.exr right.exr");
  c->callback([o, &status] { status = runCompare(*o); });
}

}  // namespace whittle::cli
