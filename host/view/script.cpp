// See script.h.
#include "view/script.h"

#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "scene/input_error.h"

namespace whittle::view {
namespace {

/// Frames that a drag takes: a hand is no faster.
constexpr int kDragFrames = 8;
constexpr double kPatience = 120.0;  ///< seconds that `wait` waits where it is not told

struct Arity {
  std::size_t least, most;
};
const std::map<std::string, Arity> kCommands{
    {"wait", {1, 2}},     {"key", {1, 1}},     {"drag", {4, 6}},       {"click", {2, 4}},
    {"wheel", {3, 4}},    {"set", {2, 2}},     {"resize", {2, 2}},     {"drop", {1, 1}},
    {"expect", {3, 3}},   {"quit", {0, 0}},    {"screenshot", {1, 1}}, {"print", {1, 1}},
    {"minimise", {0, 0}}, {"restore", {0, 0}}, {"save-scene", {1, 1}}, {"compare", {1, 1}}};

[[noreturn]] void fail(int line, const std::string& text) {
  throw std::runtime_error(fmt::format("script, line {}: {}", line, text));
}

std::optional<double> number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' ? std::optional(value) : std::nullopt;
}

}  // namespace

Script::Script(const std::string& text) {
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream in(line);
    Command command{number, {}};
    for (std::string word; in >> word && word[0] != '#';) command.words.push_back(word);
    if (command.words.empty()) continue;
    const auto known = kCommands.find(command.words[0]);
    if (known == kCommands.end())
      throw InputError(fmt::format("--script: line {}: '{}' is no command", number, command.words[0]));
    const std::size_t count = command.words.size() - 1;
    if (count < known->second.least || count > known->second.most)
      throw InputError(fmt::format(
          "--script: line {}: '{}' takes {}{} words", number, command.words[0], known->second.least,
          known->second.most == known->second.least ? "" : fmt::format(" to {}", known->second.most)));
    commands_.push_back(std::move(command));
  }
}

bool Script::step(Stage& stage) {
  while (next_ < commands_.size()) {
    if (!started_ && stage.isSaving())
      return true;  // what was to be written is there before the next command
    if (!started_) started_ = stage.now(), frame_ = 0;
    const Command& command = commands_[next_];
    if (command.words[0] != "wait") stage.redraw();
    const bool isDone = perform(stage, command);
    ++frame_;
    if (!isDone) return true;
    ++next_;
    started_.reset();
    // What it did is seen and drawn before the next command.
    if (command.words[0] != "expect" && command.words[0] != "print" && command.words[0] != "wait")
      return true;
  }
  return false;
}

bool Script::wait(Stage& stage, const Command& command) {
  const auto& w = command.words;
  const double waited = stage.now() - *started_;
  if (const auto seconds = number(w[1])) return waited >= *seconds;
  const double patience = w.size() > 2 ? number(w[2]).value_or(kPatience) : kPatience;
  const auto isThere = [&] {
    if (w[1] == "picture") return stage.hasPicture();
    return stage.isFinished() &&
           (w[1] == "refined" || valueAt(stage.stateJson(), "compare.current") == "true");
  };
  if (w[1] != "refined" && w[1] != "picture" && w[1] != "compared")
    fail(command.line, fmt::format("wait for '{}'?", w[1]));
  // The command before may need a frame to be noticed.
  if (frame_ > 1 && isThere()) return true;
  const std::string why = stage.impasse();
  if (frame_ > 1 && !why.empty())
    throw InputError(fmt::format("script, line {}: nothing to wait for: {}", command.line, why));
  if (waited > patience) fail(command.line, fmt::format("waited {:.0f} s for '{}'", waited, w[1]));
  return false;
}

bool Script::drag(Stage& stage, const Command& command) {
  std::vector<double> at;
  std::string name = "left";
  bool ofWindow = false;
  for (std::size_t i = 1; i < command.words.size(); ++i) {
    const std::string& word = command.words[i];
    if (const auto value = number(word))
      at.push_back(*value);
    else if (word == "window")
      ofWindow = true;
    else
      name = word;
  }
  const bool isClick = command.words[0] == "click";
  if (at.size() != (isClick ? 2U : 4U)) fail(command.line, "places are numbers");
  if (isClick)
    for (double& place : at) place += 0.5;  // the middle of the pixel, however small it is drawn
  const double x1 = isClick ? at[0] : at[2], y1 = isClick ? at[1] : at[3];
  if (frame_ == 0) {
    stage.pointer({at[0], at[1], ofWindow});
    return false;
  }
  if (frame_ == 1) {
    stage.button(name, true);
    return false;
  }
  const int steps = isClick ? 1 : kDragFrames, moved = frame_ - 1;
  if (moved <= steps) {
    const double share = static_cast<double>(moved) / steps;
    stage.pointer({at[0] + (x1 - at[0]) * share, at[1] + (y1 - at[1]) * share, ofWindow});
    return false;
  }
  stage.button(name, false);
  return true;
}

bool Script::perform(Stage& stage, const Command& command) {
  const auto& w = command.words;
  if (w[0] == "wait") return wait(stage, command);
  if (w[0] == "drag" || w[0] == "click") return drag(stage, command);
  try {
    if (w[0] == "key") stage.key(w[1]);
    if (w[0] == "wheel") {
      stage.pointer({number(w[1]).value_or(0), number(w[2]).value_or(0), w.size() > 4});
      stage.wheel(number(w[3]).value_or(0));
    }
    if (w[0] == "set")
      if (const std::string problem = stage.set(w[1], w[2]); !problem.empty()) fail(command.line, problem);
    if (w[0] == "resize")
      stage.resize(static_cast<int>(number(w[1]).value_or(0)), static_cast<int>(number(w[2]).value_or(0)));
    if (w[0] == "minimise") stage.minimise();
    if (w[0] == "restore") stage.restore();
    if (w[0] == "drop") stage.drop(w[1]);
    if (w[0] == "save-scene") stage.saveScene(w[1]);
    if (w[0] == "compare") stage.set("reference", w[1]);  // what is wrong with it is a message
    // One frame later all of the last one is drawn; codes come from another thread.
    if (w[0] == "screenshot") {
      if (frame_ < 2 || !stage.showsNewest()) return false;
      stage.screenshot(w[1]);
    }
    if (w[0] == "expect") expect(stage, command);
    if (w[0] == "print") stage.print(fmt::format("{} = {}", w[1], valueAt(stage.stateJson(), w[1])));
    if (w[0] == "quit") stage.quit();
  } catch (const std::invalid_argument& e) {
    fail(command.line, e.what());
  }
  return true;
}

void Script::expect(const Stage& stage, const Command& command) {
  const auto& w = command.words;
  const std::string seen = valueAt(stage.stateJson(), w[1]);
  const auto a = number(seen), b = number(w[3]);
  bool holds = false;
  if (w[2] == "==")
    holds = a && b ? *a == *b : seen == w[3];
  else if (w[2] == "!=")
    holds = a && b ? *a != *b : seen != w[3];
  else if (!a || !b)
    fail(command.line, fmt::format("{} is '{}', no number", w[1], seen));
  else if (w[2] == "<")
    holds = *a < *b;
  else if (w[2] == "<=")
    holds = *a <= *b;
  else if (w[2] == ">=")
    holds = *a >= *b;
  else if (w[2] == ">")
    holds = *a > *b;
  else
    fail(command.line, fmt::format("'{}' compares nothing", w[2]));
  if (!holds) fail(command.line, fmt::format("{} is {}, not {} {}", w[1], seen, w[2], w[3]));
}

std::string valueAt(const std::string& stateJson, const std::string& path) {
  const auto state = nlohmann::json::parse(stateJson);
  const nlohmann::json* at = &state;
  std::istringstream in(path);
  for (std::string part; std::getline(in, part, '.');) {
    if (at->is_object() && at->contains(part))
      at = &(*at)[part];
    else if (at->is_array() && number(part) && static_cast<std::size_t>(*number(part)) < at->size())
      at = &(*at)[static_cast<std::size_t>(*number(part))];
    else
      throw std::invalid_argument(fmt::format("there is no '{}' in the state", path));
  }
  return at->is_string() ? at->get<std::string>() : at->dump();
}

}  // namespace whittle::view
