// An alphabet of strokes on a grid, swept with a round section.
#include "shapes/lettering.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>

#include "shapes/sweep.h"

namespace generator {
namespace {

constexpr double kGlyphWidth = 4, kGlyphHeight = 6, kAdvance = 5.8;  // in units of the grid
constexpr double kRound = 1.7;                                       // radius of corners

/// Strokes are words of points, a digit for x and one for y each. An r before a stroke rounds its corners;
/// such a one is closed where it ends where it began.
struct Glyph {
  char letter;
  const char* strokes;
};

constexpr Glyph kGlyphs[] = {{' ', ""},
                             {'-', "1333"},
                             {'.', "2021"},
                             {'0', "r0006464000"},
                             {'1', "152620"},
                             {'2', "r050646430040"},
                             {'3', "r0506464313 r1343400001"},
                             {'4', "30360242"},
                             {'5', "r46060343400001"},
                             {'6', "r45460600404303"},
                             {'7', "064610"},
                             {'8', "r0306464303 r0300404303"},
                             {'9', "r43030646400001"},
                             {'A', "002640 1333"},
                             {'B', "0006 r06363303 r03434000"},
                             {'C', "r454606004041"},
                             {'D', "0006 r06464000"},
                             {'E', "46060040 0333"},
                             {'F', "460600 0333"},
                             {'G', "r45460600404323"},
                             {'H', "0006 4046 0343"},
                             {'I', "2026"},
                             {'J', "r46400001"},
                             {'K', "0006 460340"},
                             {'L', "060040"},
                             {'M', "0006234640"},
                             {'N', "00064046"},
                             {'O', "r0006464000"},
                             {'P', "0006 r06464303"},
                             {'Q', "r0006464000 2240"},
                             {'R', "0006 r06464303 2340"},
                             {'S', "r4546060343400001"},
                             {'T', "0646 2026"},
                             {'U', "r06004046"},
                             {'V', "062046"},
                             {'W', "0610243046"},
                             {'X', "0046 0640"},
                             {'Y', "0623 4623 2320"},
                             {'Z', "06460040"}};

const char* strokesOf(char letter) {
  for (const Glyph& glyph : kGlyphs)
    if (glyph.letter == letter) return glyph.strokes;
  throw std::logic_error(fmt::format("there is no glyph for '{}'", letter));
}

/// The stroke as paths on the grid. At a sharp corner one ends and another begins: around a corner that is
/// sharper than the stroke is wide a single one would fold into itself, its normals with it.
std::vector<Outline> strokePaths(const std::string& stroke) {
  const bool isRound = stroke[0] == 'r';
  std::vector<Corner> corners;
  for (std::size_t i = isRound ? 1 : 0; i + 1 < stroke.size(); i += 2)
    corners.push_back(
        {static_cast<double>(stroke[i] - '0'), static_cast<double>(stroke[i + 1] - '0'), kRound});
  std::vector<Outline> paths;
  for (std::size_t i = 0; !isRound && i + 1 < corners.size(); ++i)
    paths.push_back(roundCorners({corners[i], corners[i + 1]}, false));
  if (!isRound) return paths;
  const bool isClosed = corners.front().x == corners.back().x && corners.front().y == corners.back().y;
  if (isClosed) corners.pop_back();
  paths.push_back(roundCorners(corners, isClosed, 0.4));
  return paths;
}

/// `place` takes a point (to the right, up) of the line of text, whose middle is 0, to where it goes.
Mesh makeTextWhere(std::string_view text, double height, double stroke,
                   const std::function<glm::dvec3(glm::dvec2)>& place) {
  Mesh mesh;
  const double unit = height / kGlyphHeight;
  double x = -0.5 * (static_cast<double>(text.size() - 1) * kAdvance + kGlyphWidth);
  for (const char letter : text) {
    std::istringstream words(strokesOf(letter));
    for (std::string word; words >> word;) {
      for (const Outline& path : strokePaths(word)) {
        SweepSpec sweep;
        for (const OutlinePoint& p : path.points)
          sweep.path.push_back(place(unit * (p.position + glm::dvec2(x, 0))));
        sweep.isClosed = path.isClosed;
        sweep.section = circleOutline(stroke / 2, 8);
        sweep.capLength = stroke / 2;
        append(mesh, makeSweep(sweep));
      }
    }
    x += kAdvance;
  }
  return mesh;
}

}  // namespace

Mesh makeText(std::string_view text, double height, double stroke) {
  return makeTextWhere(text, height, stroke,
                       [height](glm::dvec2 p) { return glm::dvec3(p.x, 0, height / 2 - p.y); });
}

Mesh makeTextOnCircle(std::string_view text, double height, double stroke, double radius) {
  return makeTextWhere(text, height, stroke, [radius](glm::dvec2 p) {
    const double angle = p.x / radius, far = radius + p.y;
    return glm::dvec3(far * std::sin(angle), 0, -far * std::cos(angle));
  });
}

}  // namespace generator
