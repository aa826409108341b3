// whittle compare: how far a picture is from a reference.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "image/metrics.h"

namespace whittle::cli {
namespace {

struct CompareOptions {
  std::filesystem::path a, b;
  bool json = false;
};

int runCompare(const CompareOptions& o) {
  const FloatImage a = readFloatImage(o.a);
  const FloatImage b = readFloatImage(o.b);
  if (a.width != b.width || a.height != b.height) {
    fmt::print(stderr, "whittle: {} is {}×{} but {} is {}×{}\n", o.a.string(), a.width, a.height, o.b.string(), b.width, b.height);
    return 1;
  }
  const ImageMetrics m = compareImages(a, b);
  if (o.json) {
    const nlohmann::ordered_json json{{"rmse", m.rmse}, {"relMse", m.relMse}, {"maxAbs", m.maxAbs}, {"flip", m.flip},
                                      {"differingPixels", m.differingPixels}, {"nonFinite", m.nonFinite + m.nonFiniteReference}};
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("rmse             {:.6g}\nrelMse           {:.6g}\nmaxAbs           {:.6g}\nflip             {:.6g}\n"
               "differingPixels  {} of {}\n", m.rmse, m.relMse, m.maxAbs, m.flip, m.differingPixels,
               static_cast<long>(a.width) * a.height);
  }
  return 0;
}

}  // namespace

void addCompare(CLI::App& app, int& status) {
  auto o = std::make_shared<CompareOptions>();
  CLI::App* c = app.add_subcommand("compare", "error of picture A against reference B: rmse, relMse, maxAbs, flip, differingPixels");
  c->add_option("A", o->a, "picture")->required();
  c->add_option("B", o->b, "reference")->required();
  c->add_flag("--json", o->json, "as JSON");
  c->callback([o, &status] { status = runCompare(*o); });
}

}  // namespace whittle::cli
