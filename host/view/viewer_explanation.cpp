// The rays of a pixel: asked of the render's thread, and put into words.
#include <fmt/format.h>

#include <utility>

#include "reference/blockers.h"
#include "reference/reference.h"
#include "render/explanation.h"
#include "report/text.h"
#include "view/viewer.h"

namespace whittle::view {

void Viewer::explain(double x, double y) {
  if (!scene_ || !(x >= 0 && x < 1 && y >= 0 && y < 1) || !hasMemory()) return;
  follow(static_cast<int>(x * settings_.width), static_cast<int>(y * settings_.height));
}

/// What stands in the way of lights comes later, and the reference last: it builds a tree over the scene of
/// its own.
void Viewer::follow(int x, int y) {
  const std::uint64_t number = ++follows_;
  Followed followed{number, request(), x, y, {}, {}};
  const bool isDone = isTraced(), compares = comparesWithReference_;
  live_.explain(
      followed.request, x, y, [this, compares, followed](const std::vector<RayTree>& trees) mutable {
        followed.tree = trees.at(0);
        deliver(followed);
        const Request& r = followed.request;
        findBlockers(*r.scene, followed.tree);
        deliver(followed);
        if (!compares) return;
        followed.reference = referenceTrees(*r.scene, r.settings, followed.x, followed.y, &r.camera, 1).at(0);
        deliver(followed);
      });
  if (!isDone) ask();  // it was cut off
  followed_ = number;
}

void Viewer::deliver(const Followed& followed) {
  {
    const std::lock_guard lock(mutex_);
    delivered_ = followed;
  }
  services_.wake();
}

ViewModel::Explained Viewer::explainedOf(Followed f) {
  const Scene& scene = *f.request.scene;
  const Settings& settings = f.request.settings;
  Explained e;
  e.x = f.x, e.y = f.y;
  e.tree = std::move(f.tree);
  std::optional<TreeComparison> comparison;
  std::optional<Beside> beside;
  if (f.reference) {
    comparison = compareTrees(e.tree, *f.reference);
    beside.emplace(Beside{*f.reference, *comparison});
    e.verdict = verdict(e.tree, *beside, scene);
    e.parts = comparison->parting.has_value();
  }
  e.shares = sharesOf(e.tree);
  for (std::size_t i = 0; i < e.tree.rays.size(); ++i) {
    e.titles.push_back(rayTitle(e.tree, i, scene));
    e.lines.push_back(rayLines(e.tree, i, scene, beside ? &*beside : nullptr));
  }
  e.drawn = drawnRays(e.tree, scene, f.request.camera, static_cast<double>(settings.width) / settings.height);
  const glm::dvec3 sum = sumOf(e.tree);
  e.sum = fmt::format(
      "sum of {}: {:.6g} {:.6g} {:.6g}; the {} has {:.6g} {:.6g} {:.6g}",
      formatSome(e.tree.rays.size(), "ray", "rays"), sum.x, sum.y, sum.z,
      settings.raysPerPixel > 1 ? fmt::format("first of {} samples", settings.raysPerPixel) : "pixel",
      e.tree.radiance.x, e.tree.radiance.y, e.tree.radiance.z);
  return e;
}

std::string Viewer::switchReference(const std::string& text) {
  if (text != "on" && text != "off") return fmt::format("with-reference: '{}' is not one of on|off", text);
  comparesWithReference_ = text == "on";
  if (explained_) follow(explained_->x, explained_->y);
  return {};
}

}  // namespace whittle::view
