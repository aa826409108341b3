// What stands left and right of the picture: settings, and what the render says of itself.
#pragma once

#include <map>
#include <string>

#include "view/view_model.h"

namespace whittle::view {

/// What the panels remember between two frames.
struct PanelState {
  std::map<std::string, std::string> edited;    ///< texts under way, by the control's id
  std::map<std::string, std::string> problems;  ///< of values that were not taken
  std::string fileText;                         ///< of a file to open
  bool showsHelp = false;
  bool showsPanels = true;
  bool showsEdit = false;  ///< lights and materials, and the lights' handles
  bool isLight = false;
  bool restyles = false;  ///< the style was changed
  bool hadRays = false;   ///< of a pixel, in the frame before
  // How the rays of a pixel are listed, and what that came to: the first one's number, and how many.
  bool sortsRays = false, hidesSmallRays = false;
  std::size_t firstRay = 0, listedRays = 0;

  /// Scripts set the two as "ray-order" (tree or share) and "hide-small-rays" (on or off).
  static bool has(const std::string& id);
  /// As ViewModel::set.
  std::string set(const std::string& id, const std::string& text);
};

/// Shown while the mouse is on the item before; nothing for an empty text.
void tip(const std::string& text);
/// One line, cut off with … where the window ends; then a tip has all of it.
void shortened(const std::string& text, bool isDim = false);
/// What of it fits into so many pixels.
std::string fitting(const std::string& text, float width);

/// A name on the left, its value on the right.
void row(const char* label, const std::string& value);

/// Into the current ImGui window.
void filePanel(ViewModel& model, PanelState& state);
void settingsPanel(ViewModel& model, PanelState& state);
/// One control: label, widget, the way back to its default. What is wrong with its value stands below it, or
/// where `hasPlace`, in a place that its panel keeps for that.
void controlRow(ViewModel& model, PanelState& state, const Control& c, bool hasPlace = false);
void editPanel(ViewModel& model, PanelState& state);
void statisticsPanel(const ViewModel& model);
void comparePanel(const ViewModel& model);
void cameraPanel(ViewModel& model);
void messageLine(const ViewModel& model);
/// A pixel's rays as a foldable list; returns the ray that the mouse is on, −1: none.
int explanationPanel(ViewModel& model, PanelState& state);
/// Keys and mouse.
void helpWindow(PanelState& state);

}  // namespace whittle::view
