// See comparison.h.
#include "view/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace whittle::view {
namespace {

const std::vector<std::string> kErrors{"absolute", "relative"};
constexpr const char* kKept = "kept picture";

/// JSON has no NaN and no infinity.
nlohmann::ordered_json finiteOrNull(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

std::string notOneOf(const std::string& id, const std::string& text, const std::vector<std::string>& words) {
  return fmt::format("{}: '{}' is not one of {}", id, text, fmt::join(words, "|"));
}

Control control(const char* id, const char* label, Control::Kind kind, const char* standard,
                const char* tip) {
  Control c;
  c.id = id, c.group = "Compare", c.label = label, c.kind = kind, c.standard = standard, c.tip = tip;
  return c;
}

bool isWord(const std::vector<std::string>& words, const std::string& text) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

}  // namespace

Comparison::Comparison(std::function<Reference(const std::filesystem::path&)> read,
                       std::function<void()> wake)
    : read_(std::move(read)), live_(std::move(wake)) {
  view_.colors = errorColors();
}

std::vector<Control> Comparison::controls() {
  std::vector<Control> all{
      control("reference", "reference", Control::Kind::Text, "",
              "an .exr or .hdr (radiance), or a .png or .jpg (codes), of the picture's size; Shift and drop, "
              "or K for the picture that is shown; empty: none"),
      control(
          "compare", "show", Control::Kind::Choice, "off",
          "split: the picture left of the line, the reference right of it; flip: the reference in its place; "
          "difference: the error of each pixel"),
      control("compare-error", "error", Control::Kind::Choice, "absolute",
              "relative: divided by the root of the reference's square + 0.01, as relMse has it"),
      control("compare-split", "line at", Control::Kind::Real, "0.5",
              "the line between picture and reference, a share of the width; the mouse drags it")};
  all[1].words = kCompareModes;
  all[2].words = kErrors;
  return all;
}

bool Comparison::has(const std::string& id) {
  return id == "reference" || id == "compare" || id == "compare-error" || id == "compare-split";
}

std::string Comparison::value(const std::string& id) const {
  if (id == "reference") return view_.name.empty() ? "" : file_;
  if (id == "compare") return kCompareModes[static_cast<std::size_t>(view_.mode)];
  if (id == "compare-error") return kErrors[view_.isRelative ? 1 : 0];
  return fmt::format("{:.4g}", view_.split);
}

std::string Comparison::set(const std::string& id, const std::string& text) {
  if (id == "reference") {
    if (text.empty())
      take(nullptr);
    else
      live_.open([read = read_, text] { return read(text); });
  } else if (id == "compare") {
    if (!isWord(kCompareModes, text)) return notOneOf(id, text, kCompareModes);
    if (text != "off" && !reference_) return "compare: there is no reference; K keeps the picture as one";
    view_.mode = static_cast<CompareMode>(std::find(kCompareModes.begin(), kCompareModes.end(), text) -
                                          kCompareModes.begin());
    if (isDue_) compare();
  } else if (id == "compare-error") {
    if (!isWord(kErrors, text)) return notOneOf(id, text, kErrors);
    view_.isRelative = text == "relative";
    compare();
  } else {
    char* end = nullptr;
    const double at = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0' || !(at >= 0 && at <= 1))
      return fmt::format("{}: '{}' is not a number from 0 to 1", id, text);
    view_.split = at;
  }
  return {};
}

void Comparison::take(std::shared_ptr<const Reference> reference) {
  const bool isFirst = !reference_;
  reference_ = std::move(reference);
  view_.name = reference_ ? reference_->name : "";
  view_.isOfCodes = reference_ && !reference_->isRadiance;
  view_.reference = view_.difference = {};
  view_.figures.reset();
  if (!reference_)
    view_.mode = CompareMode::Off;
  else if (isFirst && view_.mode == CompareMode::Off)
    view_.mode = CompareMode::Split;
  compare();
}

void Comparison::keep(const FloatImage& radiance) {
  file_ = kKept;
  take(std::make_shared<const Reference>(Reference{radiance, true, kKept}));
}

void Comparison::show(std::shared_ptr<const RenderResult> picture,
                      std::function<std::vector<std::uint8_t>(const FloatImage&)> codes) {
  pictures_.picture = std::move(picture);
  pictures_.codes = std::move(codes);
  compare();
}

std::string Comparison::problemOf(const Reference& reference) const {
  if (!pictures_.picture) return {};
  const FloatImage &own = pictures_.picture->radiance, &other = reference.light;
  if (own.width == other.width && own.height == other.height) return {};
  return fmt::format("{} is {}×{} but the picture is {}×{}: they are not compared", reference.name,
                     other.width, other.height, own.width, own.height);
}

void Comparison::compare() {
  ++pictures_.serial;
  view_.isCurrent = false;
  view_.problem = reference_ ? problemOf(*reference_) : "";
  if (!isComparable()) {
    view_.reference = view_.difference = {};
    view_.figures.reset();
    return;
  }
  isDue_ = view_.mode == CompareMode::Off;
  if (isDue_) return;
  pictures_.reference = reference_;
  pictures_.isRelative = view_.isRelative;
  live_.compare(pictures_);
}

bool Comparison::update(std::vector<ViewModel::Message>& messages) {
  bool isNew = false;
  if (auto opened = live_.takeOpened()) {
    isNew = true;
    const std::string problem = opened->reference ? problemOf(*opened->reference) : opened->problem;
    if (!opened->reference || (reference_ && !problem.empty())) {
      messages.push_back({true, problem});  // the one before stays
    } else {
      file_ = opened->reference->name;
      take(std::move(opened->reference));
    }
  }
  if (auto compared = live_.takeCompared();
      compared && compared->serial == pictures_.serial && isComparable()) {
    isNew = true;
    const FloatImage& shape = pictures_.picture->radiance;
    const auto asPicture = [&](Picture& to, std::vector<std::uint8_t> codes) {
      to = {shape.width, shape.height, std::move(codes), ++comparedSerial_, false, {}};
    };
    asPicture(view_.reference, std::move(compared->referenceCodes));
    asPicture(view_.difference, std::move(compared->differenceCodes));
    view_.scale = compared->scale;
    view_.isCurrent = compared->figures.has_value();
    if (compared->figures) view_.figures = compared->figures;
  }
  if (view_.problem != said_) {
    said_ = view_.problem;
    if (!said_.empty()) messages.push_back({true, said_}), isNew = true;
  }
  return isNew;
}

nlohmann::ordered_json Comparison::state() const {
  nlohmann::ordered_json state{
      {"mode", value("compare")}, {"reference", view_.name},    {"error", value("compare-error")},
      {"split", view_.split},     {"ofCodes", view_.isOfCodes}, {"current", view_.isCurrent},
      {"problem", view_.problem}, {"low", view_.scale.low},     {"high", view_.scale.high}};
  if (!view_.figures) return state;
  const ImageMetrics& m = *view_.figures;
  state["rmse"] = finiteOrNull(m.rmse);
  state["relMse"] = finiteOrNull(m.relMse);
  state["maxAbs"] = finiteOrNull(m.maxAbs);
  state["flip"] = finiteOrNull(m.flip);
  state["differingPixels"] = m.differingPixels;
  return state;
}

}  // namespace whittle::view
