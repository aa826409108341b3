// Lights and materials of the scene that is shown, as edited by hand, with undo.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/appearance.h"
#include "view/edit_model.h"
#include "view/edited_light.h"
#include "view/view_model.h"

namespace whittle::view {

class SceneEditor : public EditModel {
 public:
  /// What the editor asks of whoever shows the picture.
  struct Owner {
    std::function<void()> edited;  ///< another picture is wanted
    std::function<void(bool isError, std::string)> say;
    /// Writes a copy of the scene's file and says what was written, or why nothing was.
    std::function<void(const std::filesystem::path& copy, const Appearance& file, const Appearance& edited)>
        save;
    std::function<const Camera&()> camera;
    std::function<double()> aspect;  ///< of the picture
  };
  explicit SceneEditor(Owner owner) : owner_(std::move(owner)) {}

  /// Another scene, as its file has it. `keeps`: the edits stay where a light or material of the same number
  /// has the same name.
  void take(const Scene& scene, bool keeps);
  /// Of the next request; the background is left to the owner.
  Appearance appearance() const;

  static bool isId(const std::string& id);
  /// Throws std::invalid_argument for what is no id of this scene.
  std::string value(const std::string& id) const;
  /// As ViewModel::set.
  std::string set(const std::string& id, const std::string& text);
  /// For scripts: values by part, number and name.
  nlohmann::ordered_json state() const;

  std::size_t count(Part part) const override;
  std::string title(Part part, std::size_t index) const override;
  bool isEdited(Part part, std::size_t index) const override;
  std::vector<Control> controls(Part part, std::size_t index) const override;
  std::size_t chosen(Part part) const override;
  void choose(Part part, std::size_t index) override;
  void reset(Part part, std::size_t index) override;
  bool hasUndo() const override { return !steps_.empty(); }
  void undo() override;
  void setDragging(bool isDragging) override;
  std::vector<Handle> handles() const override;
  void moveLight(std::size_t light, double right, double up) override;
  void save(const std::filesystem::path& file) override;

 private:
  /// A value before it was changed.
  struct Step {
    Part part;
    std::size_t index;
    EditedLight light;
    Material material;
  };
  void remember(Part part, std::size_t index, const std::string& field);

  Owner owner_;
  glm::dvec3 origin_{0.0};  ///< Scene::origin
  Appearance ofFile_;
  std::vector<EditedLight> lights_;
  std::vector<Material> materials_;
  std::size_t light_ = 0, material_ = 0;  ///< chosen
  std::vector<Step> steps_;
  bool isDragging_ = false;
  std::vector<std::string> dragged_;  ///< fields that have their step of this drag
};

}  // namespace whittle::view
