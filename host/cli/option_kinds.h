// The few kinds of options there are. Each checks its own value and throws InputError in one line that names
// the option, so that nobody meets a parser's words. The last of several values counts.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/input_error.h"
#include "scene/settings.h"

namespace whittle::cli {

using StringSetter = std::function<void(const std::string&)>;

/// What an option shows in the help: `--name PLACEHOLDER   text [fallback]`.
struct OptionHelp {
  std::string valueName;
  std::string text;
  std::string fallback;  ///< the default as a person reads it; empty: none shown
};

CLI::Option* addText(CLI::App& command, const std::string& name, const StringSetter& set,
                     const OptionHelp& help);

/// Whether it stands on the command line; null: the command does not have it.
inline bool given(const CLI::Option* option) { return option && option->count() > 0; }

/// Throws InputError that names `option` unless `text` is a number in [low, high], wholly.
std::int64_t parseWhole(const std::string& option, const std::string& text, std::int64_t low,
                        std::int64_t high);
double parseReal(const std::string& option, const std::string& text, double low, double high);
/// `least` to `most` numbers with commas between them, each as parseReal has it.
std::vector<double> parseNumbers(const std::string& option, const std::string& text, std::size_t least,
                                 std::size_t most, double low = -1e18, double high = 1e18);
/// The same, or nothing for "auto".
std::optional<float> parseRealOrAuto(const std::string& option, const std::string& text, double low,
                                     double high);

template <typename T>
CLI::Option* addWhole(CLI::App& command, const std::string& name, T& value, std::int64_t low,
                      std::int64_t high, const std::string& valueName, const std::string& text,
                      const std::string& fallback = {}) {
  return addText(command, name,
                 [&value, name, low, high](const std::string& word) {
                   value = static_cast<T>(parseWhole(name, word, low, high));
                 },
                 {valueName, text, fallback.empty() ? std::to_string(value) : fallback});
}

/// T: float, double or an optional of them. `name` may list aliases after commas; messages name the first.
template <typename T>
CLI::Option* addReal(CLI::App& command, const std::string& name, T& value, double low, double high,
                     const std::string& valueName, const std::string& text, const std::string& fallback) {
  return addText(command, name,
                 [&value, said = name.substr(0, name.find(',')), low, high](const std::string& word) {
                   if constexpr (std::is_same_v<T, double>)
                     value = parseReal(said, word, low, high);
                   else
                     value = static_cast<float>(parseReal(said, word, low, high));
                 },
                 {valueName, text, fallback});
}

/// One of the words that scene/settings.h has for T; the help shows them in their order.
template <typename T>
CLI::Option* addChoice(CLI::App& command, const std::string& name, T& value, const std::string& text) {
  std::string words, fallback;
  for (const auto& c : wordsOf(value)) {
    words += (words.empty() ? "" : "|") + std::string(c.word);
    if (c.value == value) fallback = c.word;
  }
  const auto set = [&value, words, name](const std::string& word) {
    for (const auto& c : wordsOf(value))
      if (word == c.word) {
        value = c.value;
        return;
      }
    throw InputError(name + ": '" + word + "' is not one of " + words);
  };
  return addText(command, name, set, {words, text, fallback});
}

CLI::Option* addFile(CLI::App& command, const std::string& name, std::filesystem::path& value,
                     const std::string& valueName, const std::string& text);
/// May be given several times, one value each time.
template <typename T>
CLI::Option* addSeveral(CLI::App& command, const std::string& name, std::vector<T>& values,
                        const std::string& valueName, const std::string& text) {
  return command.add_option(name, values, text)->type_name(valueName)->allow_extra_args(false);
}

}  // namespace whittle::cli
