// Scripts that drive a window, a command a line: what tests, demonstrations and reports of faults are made
// of.
//
//   wait refined [SECONDS] | wait picture [SECONDS] | wait compared [SECONDS] | wait SECONDS
//   key NAME            as "r", "F12", "Escape", "Ctrl+S"
//   drag X0 Y0 X1 Y1 [left|middle|right]     click X Y [left|middle|right]     wheel X Y STEPS
//   set SETTING VALUE   resize WIDTH HEIGHT   minimise   restore   drop FILE   screenshot FILE
//   compare FILE   save-scene FILE
//   expect PATH <|<=|==|!=|>=|> VALUE         of the state as JSON: stats.rays.shadow > 0, view.coarse ==
//   false print PATH          # a comment           quit
//
// Coordinates are pixels of the picture from its top left; of the window behind the word `window`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace whittle::view {

/// What a script does things to: the window.
class Stage {
 public:
  virtual ~Stage() = default;
  /// Something was done to it: the frame is drawn.
  virtual void redraw() = 0;
  virtual void key(const std::string& name) = 0;
  struct Place {
    double x = 0, y = 0;
    bool ofWindow = false;
  };
  virtual void pointer(const Place& place) = 0;
  virtual void button(const std::string& name, bool isDown) = 0;
  virtual void wheel(double steps) = 0;
  virtual void resize(int width, int height) = 0;
  virtual void minimise() = 0;
  virtual void restore() = 0;
  virtual void drop(const std::string& file) = 0;
  /// Of the whole window, as it is drawn next.
  virtual void screenshot(const std::filesystem::path& file) = 0;
  virtual std::string set(const std::string& id, const std::string& text) = 0;  ///< as ViewModel::set
  virtual void saveScene(const std::filesystem::path& file) = 0;                ///< as EditModel::save
  virtual bool hasPicture() const = 0;  ///< of what was asked for last, coarse or not
  virtual bool isFinished() const = 0;
  /// Why what was asked for last will never be there; empty: it is there or on its way.
  virtual std::string impasse() const = 0;
  /// Files are being written.
  virtual bool isSaving() const = 0;
  /// Nothing that is known is still on its way to the window.
  virtual bool showsNewest() const = 0;
  virtual std::string stateJson() const = 0;
  virtual void print(const std::string& text) = 0;
  virtual double now() const = 0;  ///< seconds
  virtual void quit() = 0;
};

class Script {
 public:
  /// Throws InputError, in one line that names the script's line, for what is no command.
  explicit Script(const std::string& text);

  /// Does what can be done in this frame. False: it has ended. Throws, in one line that names the script's
  /// line: InputError where what is waited for will never come, since a file or an option was refused;
  /// std::runtime_error for what was expected and is not so, and for what was waited for too long.
  bool step(Stage& stage);

 private:
  struct Command {
    int line = 0;
    std::vector<std::string> words;
  };
  bool perform(Stage& stage, const Command& command);
  bool wait(Stage& stage, const Command& command);
  bool drag(Stage& stage, const Command& command);
  static void expect(const Stage& stage, const Command& command);

  std::vector<Command> commands_;
  std::size_t next_ = 0;
  int frame_ = 0;                  ///< of the command under way
  std::optional<double> started_;  ///< when it began
};

/// A value of the state by its path, "stats.rays.shadow"; throws std::invalid_argument where there is none.
std::string valueAt(const std::string& stateJson, const std::string& path);

}  // namespace whittle::view
