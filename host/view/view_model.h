// What a window shows and what it may ask for, without a word of the window itself: the library that draws
// (host/window) knows nothing else of the program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/metrics.h"
#include "render/explanation.h"
#include "view/color_scale.h"
#include "view/difference.h"
#include "view/edit_model.h"
#include "view/live_render.h"
#include "view/ray_drawing.h"
#include "view/ray_shares.h"

namespace whittle::view {

/// Switches the comparison of explained rays with the double-precision reference, as ViewModel::set does the
/// settings; no control.
inline constexpr const char* kReferenceSwitch = "with-reference";

/// An orthographic view of so many metres, a vertical field of view in degrees, and a camera of the file by
/// name or number, likewise.
inline constexpr const char* kHeightSetting = "ortho-height";
inline constexpr const char* kFovSetting = "fov";
inline constexpr const char* kCameraSetting = "camera";

/// One setting as a widget: its value is text, as on the command line.
struct Control {
  /// Share: from 0 to 1. Amount: a number, more likely to be changed by a part of it. Angle: degrees. Color:
  /// three shares.
  enum class Kind : std::uint8_t { Switch, Whole, Real, Choice, Text, Share, Amount, Angle, Color };

  std::string id;  ///< its option without the hyphens in front: "rays-per-pixel"
  std::string group, label, unit;
  Kind kind = Kind::Text;
  std::vector<std::string> words;     ///< of a Choice; of others what they take besides numbers: "auto"
  std::vector<std::string> captions;  ///< what a Choice shows for each of its words, where it is another text
  std::string standard;               ///< the default
  std::string tip;                    ///< the option's help
  std::string remark;                 ///< when it takes effect, or empty
};

/// Codes as `whittle render` writes them into a .png of the same settings.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> codes;  ///< RGBA, row 0 at the top, A = 255
  std::uint64_t serial = 0;         ///< grows with each new one; 0: there is none yet
  bool coarse = false;
  std::optional<ColorScale> scale;  ///< what its colours mean, where they are a ramp
};

enum class CompareMode : std::uint8_t { Off, Split, Flip, Difference };
inline const std::vector<std::string> kCompareModes{"off", "split", "flip", "difference"};

/// A reference beside the picture.
struct CompareView {
  CompareMode mode = CompareMode::Off;
  double split = 0.5;   ///< where the reference begins, a share of the width
  std::string name;     ///< of the reference; empty: there is none
  std::string problem;  ///< why the two are not compared
  bool isOfCodes = false, isRelative = false;
  Picture reference, difference;        ///< no serial: not there (yet)
  ErrorScale scale;                     ///< of the difference
  std::optional<ImageMetrics> figures;  ///< the last there are
  bool isCurrent = false;               ///< they are of the picture that is shown
  std::vector<Code> colors;             ///< of this and every other ramp, from the low end
};

/// An axis-aligned view: from +Z, +X or +Y.
enum class Side : std::uint8_t { Front, Right, Top };

/// The window's thread alone calls these. None of them waits for the render.
class ViewModel {
 public:
  virtual ~ViewModel() = default;

  /// Takes over what the render's thread has made; call once a frame. True: something is new.
  virtual bool update() = 0;

  virtual const Picture& picture() const = 0;
  /// The newest result with its statistics; null: none yet.
  virtual const RenderResult* result() const = 0;
  virtual Progress progress() const = 0;
  /// The picture is the one that was asked for last, with all its samples.
  virtual bool isFinished() const = 0;
  /// It is of what was asked for last, coarse or not.
  virtual bool hasPicture() const = 0;
  /// Why what was asked for last will never be there, in one line; empty: it is there or on its way.
  virtual std::string impasse() const = 0;
  /// A picture or a copy of the scene is being written.
  virtual bool isSaving() const = 0;
  /// Its codes are of the newest result and of exposure, tone map and layer as they are set.
  virtual bool hasNewestCodes() const = 0;
  /// Lines for the user: notes of loading, what was written, what went wrong; the newest last.
  struct Message {
    bool isError = false;
    std::string text;
  };
  virtual const std::vector<Message>& messages() const = 0;

  virtual const std::vector<Control>& controls() const = 0;
  virtual std::string value(const std::string& id) const = 0;
  /// Lights and materials.
  virtual EditModel& edits() = 0;
  /// The settings that are not the defaults of `whittle render`, as its options.
  virtual std::string optionsText() const = 0;
  /// Returns what is wrong with the value, in the command line's words; empty: it was taken.
  virtual std::string set(const std::string& id, const std::string& text) = 0;

  // The camera. Lengths are shares of the picture's height, angles radians.
  /// Turns it about the point that holdPoint found.
  virtual void orbit(double right, double up) = 0;
  virtual void pan(double right, double up) = 0;
  /// Towards that point; factor > 1: nearer.
  virtual void zoom(double factor) = 0;
  /// Turns it on the spot.
  virtual void look(double right, double up) = 0;
  /// In units of a hundredth of the scene's size.
  virtual void fly(double right, double up, double ahead) = 0;
  /// What lies at this pixel of the picture, in [0, 1]² from the top left, is what orbit, pan and zoom are
  /// about.
  virtual void holdPoint(double x, double y) = 0;
  virtual void resetCamera() = 0;
  virtual void frameAll() = 0;
  virtual void seeFrom(Side side) = 0;
  virtual void switchOrthographic() = 0;
  virtual std::vector<std::string> cameras() const = 0;
  virtual void chooseCamera(std::size_t index) = 0;
  virtual double fieldOfView() const = 0;  ///< vertical, degrees
  virtual void setFieldOfView(double degrees) = 0;
  /// Metres of the scene from the picture's lower edge to its upper one; none: the view is in perspective.
  virtual std::optional<double> orthographicHeight() const = 0;
  virtual void setOrthographicHeight(double metres) = 0;
  /// As options of the command line, and back; a message says what is wrong with them.
  virtual std::string cameraText() const = 0;
  virtual void pasteCamera(const std::string& text) = 0;
  /// Asks for the rays of what lies at (x, y), in [0, 1]² from the picture's top left; the first sample's.
  virtual void explain(double x, double y) = 0;
  virtual void closeExplanation() = 0;
  struct Explained {
    int x = 0, y = 0;  ///< the pixel
    RayTree tree;
    RayShares shares;
    std::vector<std::string> titles;          ///< of each ray
    std::vector<std::vector<RayLine>> lines;  ///< and all there is to say of it
    std::vector<DrawnRay> drawn;
    std::string sum;      ///< of all shares, and what the pixel's sample has
    std::string verdict;  ///< how that compares with the reference; empty: not asked, or not there yet
    bool parts = false;   ///< it does so by more than rounding
  };
  /// Null: none is asked for, or it is not there yet.
  virtual const Explained* explained() const = 0;

  virtual const CompareView& compared() const = 0;
  /// What is shown becomes the reference.
  virtual void keepReference() = 0;
  /// What alone is rendered anew; none: all of the picture.
  virtual std::optional<Region> region() const = 0;

  /// While a hand is on the camera pictures are coarse first.
  virtual void setMoving(bool isMoving) = 0;

  /// Files that were opened, the newest first.
  virtual std::vector<std::filesystem::path> recentFiles() const = 0;
  /// A scene, or an environment (.hdr, .exr).
  virtual void open(const std::filesystem::path& file) = 0;
  virtual void reload() = 0;
  /// Writes what is shown, beside the window's thread, as .png and .exr, called after the scene, where the
  /// program was started; a message says where. With a region that alone is written, as `whittle render
  /// --crop` does, and its name says so.
  virtual void save() = 0;
  virtual void stop() = 0;
  /// Statistics and state as JSON text, for scripts: stats.…, view.….
  virtual std::string stateJson() const = 0;
};

}  // namespace whittle::view
