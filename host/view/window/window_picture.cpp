// The picture in the window: its texture, its place, and the rays of a pixel over it.
#include <fmt/format.h>
#include <GLFW/glfw3.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "view/window/style.h"
#include "view/window/window.h"

namespace whittle::view {

void Window::upload(const Picture& p, Texture& to) {
  if (p.serial == to.serial || p.serial == 0) return;
  glBindTexture(GL_TEXTURE_2D, to.name);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  if (p.width != to.width || p.height != to.height)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, p.width, p.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, p.codes.data());
  else
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, p.width, p.height, GL_RGBA, GL_UNSIGNED_BYTE, p.codes.data());
  to = {to.name, p.width, p.height, p.serial, p.coarse};
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/// 1:1 in the middle where there is room, else as large as fits.
Window::Rect Window::pictureRect(float left, float top, float width, float height) const {
  const auto w = static_cast<float>(std::max(1, std::atoi(model_.value("width").c_str())));
  const auto h = static_cast<float>(std::max(1, std::atoi(model_.value("height").c_str())));
  float scale = std::min(width / w, height / h);
  scale = scale >= 1 ? std::floor(scale) : std::max(scale, 1e-3F);
  return {std::floor(left + (width - w * scale) / 2), std::floor(top + (height - h * scale) / 2), w * scale,
          h * scale};
}

ImVec2 Window::inPicture(const ImVec2& at) const {
  return {(at.x - picture_.x) / picture_.width, (at.y - picture_.y) / picture_.height};
}

ImVec2 Window::inWindow(double x, double y) const {
  return {picture_.x + static_cast<float>(x) * picture_.width,
          picture_.y + static_cast<float>(y) * picture_.height};
}

void Window::draw(const Texture& texture, float from, float to) {
  glBindTexture(GL_TEXTURE_2D, texture.name);
  const float scale = picture_.width / static_cast<float>(texture.width);
  const int filter = texture.isCoarse || scale != std::floor(scale) ? GL_LINEAR : GL_NEAREST;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  // It hides what is behind it: nothing is blended.
  list.AddCallback([](const ImDrawList*, const ImDrawCmd*) { glDisable(GL_BLEND); }, nullptr);
  list.AddImage(std::bit_cast<ImTextureID>(static_cast<std::uintptr_t>(texture.name)),
                {picture_.x + from * picture_.width, picture_.y},
                {picture_.x + to * picture_.width, picture_.y + picture_.height}, {from, 0}, {to, 1});
  list.AddCallback([](const ImDrawList*, const ImDrawCmd*) { glEnable(GL_BLEND); }, nullptr);
}

/// What is behind everything: cleared, not filled, which is most of a frame where OpenGL is software.
void Window::clear(int width, int height) const {
  const auto with = [](const ImVec4& color) {
    glClearColor(color.x, color.y, color.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
  };
  with(ImGui::GetStyleColorVec4(ImGuiCol_WindowBg));
  const ImVec2 toPixels = ImGui::GetIO().DisplayFramebufferScale;
  const auto pixels = [](float places) { return static_cast<int>(std::lround(places)); };
  const int left = pixels(ground_.x * toPixels.x), bottom = height - pixels(ground_.height * toPixels.y);
  glScissor(left, bottom, std::min(width, pixels(ground_.width * toPixels.x)), height - bottom);
  glEnable(GL_SCISSOR_TEST);
  with(groundColor(panels_.isLight));
  glDisable(GL_SCISSOR_TEST);
}

void Window::drawPicture() {
  upload(model_.picture(), texture_);
  if (texture_.serial == 0) return;
  const Picture* const beside = pictureBeside();
  if (!beside) return draw(texture_, 0, 1);
  upload(*beside, beside_);
  const float from = isSplit() ? splitPlace() : 0;
  draw(texture_, 0, from);
  draw(beside_, from, 1);
  if (isSplit()) drawSplit();
  drawNames();
}

/// What the colours mean that are shown.
void Window::drawScales() {
  if (texture_.serial == 0) return;
  constexpr int kHalves = 2;
  const CompareView& c = model_.compared();
  if (pictureBeside() == &c.difference)
    drawScale(differenceScale(c), kDecades);
  else if (const auto& scale = model_.picture().scale)
    drawScale(*scale, kHalves);
}

/// Under the picture, or over its lower left where there is no room: it moves nothing. So many equal steps
/// have numbers at their ends.
void Window::drawScale(const ColorScale& scale, int steps) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const float line = ImGui::GetTextLineHeight(), margin = line / 2;
  const float width = std::min(line * (4.0F * static_cast<float>(steps) + 8), picture_.width - 4 * margin);
  if (width < line * 6 || picture_.height < 4 * line) return;
  const char* const title = scale.quantity.c_str();
  const float titleHeight = ImGui::CalcTextSize(title, nullptr, false, width).y;
  const float inner = titleHeight + 1.5F * line, height = inner + 2 * margin;
  const float bottom = picture_.y + picture_.height;
  const bool hasRoom = ImGui::GetIO().DisplaySize.y - bottom > height + 3 * line;
  const ImVec2 at{picture_.x + margin, hasRoom ? bottom + 2 * margin : bottom - inner - margin};
  draw.AddRectFilled({at.x - margin, at.y - margin}, {at.x + width + margin, at.y + inner + margin},
                     IM_COL32(0, 0, 0, 190), 4);
  draw.AddText(nullptr, 0, at, IM_COL32_WHITE, title, nullptr, width);
  const auto& colors = model_.compared().colors;
  const float step = width / static_cast<float>(colors.size()), bar = at.y + titleHeight + 0.1F * line;
  float left = at.x;
  for (const Code& code : colors) {
    draw.AddRectFilled({left, bar}, {left + step + 0.5F, bar + line * 0.4F},
                       IM_COL32(code[0], code[1], code[2], 255));
    left += step;
  }
  const auto numberAt = [&](double share) { return fmt::format("{:.3g}", scale.valueAt(share)); };
  while (steps > 1 && steps % 2 == 0) {  // as many numbers as stand apart
    float taken = 0;
    for (int i = 0; i <= steps; ++i)
      taken += ImGui::CalcTextSize(numberAt(static_cast<double>(i) / steps).c_str()).x + line / 2;
    if (taken < width) break;
    steps /= 2;
  }
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const std::string number = numberAt(share);
    const float room = width - ImGui::CalcTextSize(number.c_str()).x;
    draw.AddText({at.x + static_cast<float>(share) * room, bar + 0.45F * line}, IM_COL32_WHITE,
                 number.c_str());
  }
}

namespace {

struct Stroke {
  ImU32 color;
  float width, dash, gap;  ///< pixels; no gap: solid

  Stroke scaled(float by) const { return {color, width * by, dash * by, gap * by}; }
};

/// Told apart by pattern as well as by colour.
Stroke strokeOf(Line line) {
  switch (line) {
    case Line::Eye:
      return {IM_COL32_WHITE, 2, 0, 0};
    case Line::Reflected:
      return {kSeries[0], 2, 0, 0};
    case Line::Refracted:
      return {kSeries[1], 2, 10, 5};
    case Line::Straight:
      return {kSeries[2], 2, 2, 5};
    case Line::Shadow:
      return {kSeries[3], 1, 0, 0};
    case Line::Blocked:
      break;
  }
  return {IM_COL32_BLACK, 1.5F, 6, 6};
}

void drawStroke(ImDrawList& draw, ImVec2 a, ImVec2 b, const Stroke& s, float thicker) {
  const float dx = b.x - a.x, dy = b.y - a.y, length = std::sqrt(dx * dx + dy * dy);
  const float period = s.gap > 0 ? s.dash + s.gap : length;
  if (!(length > 0) || !(length < 1e5F)) return;
  for (float at = 0; at < length; at += period) {
    const float end = std::min(length, at + (s.gap > 0 ? s.dash : length));
    const ImVec2 from{a.x + dx * at / length, a.y + dy * at / length},
        to{a.x + dx * end / length, a.y + dy * end / length};
    draw.AddLine(from, to, IM_COL32(0, 0, 0, 110), s.width + thicker + 2);  // seen before anything
    draw.AddLine(from, to, s.color, s.width + thicker);
  }
}

}  // namespace

void Window::drawRays(int emphasised) {
  const ViewModel::Explained* const e = model_.explained();
  if (!e) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.PushClipRect({picture_.x, picture_.y}, {picture_.x + picture_.width, picture_.y + picture_.height});
  const auto at = [&](double x, double y) { return inWindow(x, y); };
  for (const DrawnRay& d : e->drawn) {
    const bool isOn = static_cast<int>(d.ray) == emphasised;
    drawStroke(draw, at(d.x0, d.y0), at(d.x1, d.y1), strokeOf(d.line).scaled(scale_), isOn ? 2 * scale_ : 0);
    if (d.line == Line::Eye) {
      draw.AddCircle(at(d.x0, d.y0), 7 * scale_, IM_COL32_BLACK, 0, 4 * scale_);
      draw.AddCircle(at(d.x0, d.y0), 7 * scale_, IM_COL32_WHITE, 0, 2 * scale_);
    }
  }
  draw.PopClipRect();
}

}  // namespace whittle::view
