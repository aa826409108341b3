// What hands do in the editor: undo, drags of the lights' handles, saving.
#include <cmath>
#include <utility>

#include "scene/camera.h"
#include "view/ray_drawing.h"
#include "view/scene_editor.h"

namespace whittle::view {

void SceneEditor::undo() {
  if (steps_.empty()) return;
  const Step step = std::move(steps_.back());
  steps_.pop_back();
  if (step.part == Part::Light)
    lights_[step.index] = step.light;
  else
    materials_[step.index] = step.material;
  choose(step.part, step.index);
  owner_.edited();
}

void SceneEditor::setDragging(bool isDragging) {
  if (isDragging != isDragging_) dragged_.clear();
  isDragging_ = isDragging;
}

std::vector<EditModel::Handle> SceneEditor::handles() const {
  std::vector<Handle> handles;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    if (!typeOf(ofFile_.lights[i].kind).isPlaced) continue;
    if (const auto at = placeInPicture(glm::dvec3(lights_[i].position), owner_.camera(), owner_.aspect()))
      handles.push_back({i, at->x, at->y});
  }
  return handles;
}

void SceneEditor::moveLight(std::size_t light, double right, double up) {
  const Camera& camera = owner_.camera();
  EditedLight& l = lights_.at(light);
  const glm::dvec3 place(l.position);
  const double depth = glm::dot(place - glm::dvec3(camera.position), glm::dvec3(camera.forward));
  const double height = 2.0 * halfHeight(camera, owner_.aspect()) * (camera.orthographic ? 1.0 : depth);
  const glm::dvec3 moved = place + height * (right * glm::dvec3(camera.right) + up * glm::dvec3(camera.up));
  if (!(height > 0.0) || !(glm::length(moved) < 1e30)) return;
  remember(Part::Light, light, "position");
  l.position = glm::vec3(moved);
  owner_.edited();
}

void SceneEditor::save(const std::filesystem::path& file) { owner_.save(file, ofFile_, appearance()); }

}  // namespace whittle::view
