// Options that check themselves.
#include "cli/option_kinds.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>

namespace whittle::cli {
namespace {

template <typename T>
bool parseWholly(const std::string& text, T& value) {
  const char* const begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(begin, end, value);
  return error == std::errc{} && stopped == end;
}

}  // namespace

CLI::Option* addText(CLI::App& command, const std::string& name, const StringSetter& set,
                     const OptionHelp& help) {
  return command.add_option_function<std::string>(name, set, help.text)
      ->type_name(help.valueName)
      ->default_str(help.fallback)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

std::int64_t parseWhole(const std::string& option, const std::string& text, std::int64_t low,
                        std::int64_t high) {
  std::int64_t value = 0;
  if (!parseWholly(text, value) || value < low || value > high)
    throw InputError(fmt::format("{}: '{}' is not a whole number from {} to {}", option, text, low, high));
  return value;
}

namespace {

[[noreturn]] void refuseReal(const std::string& option, const std::string& text, const std::string& expected,
                             double low, double high) {
  const bool anyWill = high == std::numeric_limits<double>::max() && low == -high;
  throw InputError(fmt::format("{}: '{}' is {} number{}", option, text, expected,
                               anyWill ? "" : fmt::format(" from {:g} to {:g}", low, high)));
}

/// Written so that NaN is out of range.
bool isReal(const std::string& text, double low, double high, double& value) {
  return parseWholly(text, value) && value >= low && value <= high;
}

}  // namespace

double parseReal(const std::string& option, const std::string& text, double low, double high) {
  double value = 0.0;
  if (!isReal(text, low, high, value)) refuseReal(option, text, "not a", low, high);
  return value;
}

std::vector<double> parseNumbers(const std::string& option, const std::string& text, std::size_t least,
                                 std::size_t most, double low, double high) {
  std::vector<double> numbers;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(parseReal(option, text.substr(begin, end - begin), low, high));
    begin = end + 1;
  }
  if (numbers.size() < least || numbers.size() > most)
    throw InputError(
        fmt::format("{}: '{}' is not {} numbers with commas between them", option, text,
                    least == most ? std::to_string(least) : fmt::format("{} or {}", least, most)));
  return numbers;
}

std::optional<float> parseRealOrAuto(const std::string& option, const std::string& text, double low,
                                     double high) {
  if (text == "auto") return std::nullopt;
  double value = 0.0;
  if (!isReal(text, low, high, value)) refuseReal(option, text, "neither auto nor a", low, high);
  return static_cast<float>(value);
}

CLI::Option* addFile(CLI::App& command, const std::string& name, std::filesystem::path& value,
                     const std::string& valueName, const std::string& text) {
  const auto set = [&value, name](const std::string& word) {
    if (word.empty()) throw InputError(name + ": its value is empty; it names a file or folder");
    value = word;
  };
  return addText(command, name, set, {valueName, text, {}});
}

}  // namespace whittle::cli
