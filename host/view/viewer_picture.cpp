// From the newest result to the codes that are shown, on a thread of their own: exposure, tone map and layers
// cost the window's thread nothing.
#include <algorithm>
#include <exception>
#include <utility>

#include "view/false_colors.h"
#include "view/viewer.h"

namespace whittle::view {

bool Viewer::isFinished() const { return shown_.finished && shown_.request == request_; }

/// True: something is new.
bool Viewer::updatePicture() {
  Shown newest = live_.shown();
  if (newest.result != newest_.result || newest.finished != newest_.finished) {
    newest_ = std::move(newest);
    makeCodes();
  }
  std::optional<Made> made;
  {
    const std::lock_guard lock(mutex_);
    made.swap(made_);
  }
  if (!made) return false;
  takePicture(std::move(*made));
  return true;
}

/// Of the newest result, as the settings are now; in the place of any codes that are not begun.
void Viewer::makeCodes() {
  if (!newest_.result || !scene_) return;
  const std::uint64_t number = ++codesAsked_;
  coder_.give([this, number, shown = newest_, scene = scene_, settings = settings_, layer = layer_] {
    Made made{number, shown, scene, settings, {}, {}};
    try {
      codesInto(made, layer);
    } catch (const std::exception& e) {
      made.problem = e.what();
    }
    {
      const std::lock_guard lock(mutex_);
      made_ = std::move(made);
    }
    services_.wake();
  });
}

/// On the codes' thread.
void Viewer::codesInto(Made& made, const std::string& layer) const {
  const RenderResult& result = *made.shown.result;
  made.exposed.exposure = services_.stops(result.radiance, *made.scene, made.exposed);
  Picture& picture = made.picture;
  picture.width = result.radiance.width;
  picture.height = result.radiance.height;
  picture.coarse = made.shown.coarse && !made.shown.asked.crop;
  picture.serial = made.number;
  // The layers come with the first picture that is rendered for them.
  FalseColors colors;
  if (layer != kBeauty && result.aovs.contains(layer))
    colors = falseColors(result, layer);
  else
    colors.codes = services_.codes(result.radiance, *made.scene, made.exposed);
  picture.codes = std::move(colors.codes);
  picture.scale = std::move(colors.scale);
}

void Viewer::takePicture(Made made) {
  codesMade_ = made.number;
  if (!made.problem.empty()) return say(true, made.problem);
  shown_ = std::move(made.shown);
  picture_ = std::move(made.picture);
  if (shown_.request == request_) {
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - times_.asked).count();
    if (times_.first == 0) times_.first = seconds;
    if (times_.full == 0 && !shown_.coarse) times_.full = seconds;
    if (times_.refined == 0 && shown_.finished) times_.refined = seconds;
  }
  sayNeeds();
  if (!shown_.coarse)
    comparison_.show(shown_.result, [codes = services_.codes, scene = std::move(made.scene),
                                     exposed = std::move(made.exposed)](const FloatImage& light) {
      return codes(light, *scene, exposed);
    });
}

void Viewer::keepReference() {
  if (!shown_.result || picture_.coarse) return say(true, "there is no picture yet");
  comparison_.keep(shown_.result->radiance);
}

}  // namespace whittle::view
