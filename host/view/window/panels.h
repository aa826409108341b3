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
};

/// Shown while the mouse is on the item before; nothing for an empty text.
void tip(const std::string& text);

/// A name on the left, its value on the right.
void row(const char* label, const std::string& value);

/// Into the current ImGui window.
void filePanel(ViewModel& model, PanelState& state);
void settingsPanel(ViewModel& model, PanelState& state);
/// One control: label, widget, the way back to its default.
void controlRow(ViewModel& model, PanelState& state, const Control& c);
void editPanel(ViewModel& model, PanelState& state);
void statisticsPanel(const ViewModel& model);
void comparePanel(const ViewModel& model);
void cameraPanel(ViewModel& model);
void messageLine(const ViewModel& model);
/// A pixel's rays as a foldable list; returns the ray that the mouse is on, −1: none.
int explanationPanel(ViewModel& model);
void helpWindow(PanelState& state);

}  // namespace whittle::view
