// What a window may ask for of lights and materials. As settings they are controls, set by their ids:
// "light.0.intensity", "material.3.roughness" (ViewModel::set).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace whittle::view {

struct Control;

/// What can be edited.
enum class Part : std::uint8_t { Light, Material };

class EditModel {
 public:
  virtual ~EditModel() = default;

  virtual std::size_t count(Part part) const = 0;
  /// Its number and its name.
  virtual std::string title(Part part, std::size_t index) const = 0;
  virtual bool isEdited(Part part, std::size_t index) const = 0;
  /// In the order in which a window shows them; Control::standard is the file's value.
  virtual std::vector<Control> controls(Part part, std::size_t index) const = 0;

  /// The one whose controls are shown.
  virtual std::size_t chosen(Part part) const = 0;
  virtual void choose(Part part, std::size_t index) = 0;

  /// Back to the file's values.
  virtual void reset(Part part, std::size_t index) = 0;
  virtual bool hasUndo() const = 0;
  virtual void undo() = 0;
  /// What is set while a hand drags is one step of undo for each control.
  virtual void setDragging(bool isDragging) = 0;

  /// A light with a place before the camera, in [0, 1]² from the picture's top left or beside it.
  struct Handle {
    std::size_t light = 0;
    double x = 0, y = 0;
  };
  virtual std::vector<Handle> handles() const = 0;
  /// In the plane through it that is parallel to the picture; shares of the picture's height.
  virtual void moveLight(std::size_t light, double right, double up) = 0;

  /// A copy of the scene's file with what was edited; without a name beside the file, under the first that is
  /// free. A message says where, or what is wrong.
  virtual void save(const std::filesystem::path& file) = 0;
};

}  // namespace whittle::view
