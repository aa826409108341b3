// Lays out help texts. The groups come in the order in which the command added them.
#include "cli/help.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/text.h"

namespace whittle::cli {
namespace {

constexpr std::size_t kColumns = 80;
constexpr std::size_t kMaxTextColumn = 30;

/// "-o, --output FILE".
std::string nameOf(const CLI::Option& option) {
  if (option.get_positional() && option.get_lnames().empty()) return option.get_name(true);
  std::string names;
  for (const auto& n : option.get_snames()) names += (names.empty() ? "-" : ", -") + n;
  for (const auto& n : option.get_lnames()) names += (names.empty() ? "--" : ", --") + n;
  const bool takesValue = option.get_items_expected_max() > 0 && !option.get_type_name().empty();
  return takesValue ? names + " " + option.get_type_name() : names;
}

std::string line(const std::string& name, const std::string& text, std::size_t textColumn) {
  const std::string head = "  " + name, body = wrapped(text, kColumns - textColumn, textColumn);
  // At least two blanks between a name and its text, or the text goes below.
  if (columnsOf(head) + 2 > textColumn) return head + "\n" + std::string(textColumn, ' ') + body + "\n";
  return padded(head, textColumn) + body + "\n";
}

/// Where the texts start: right of the widest name, within reason.
std::size_t textColumnOf(const CLI::App& app, const std::vector<const CLI::App*>& commands) {
  std::size_t widest = 0;
  for (const CLI::App* command : commands) widest = std::max(widest, columnsOf(command->get_name()));
  for (const CLI::Option* option : app.get_options()) widest = std::max(widest, columnsOf(nameOf(*option)));
  return std::min(widest + 4, kMaxTextColumn);
}

std::string textOf(const CLI::Option& option) {
  const std::string fallback = option.get_default_str();
  return option.get_description() + (fallback.empty() ? "" : " [" + fallback + "]");
}

std::string usage(const CLI::App& app, const std::string& path) {
  std::string text = "Usage: " + path;
  if (!app.get_subcommands([](const CLI::App*) { return true; }).empty())
    return text + " COMMAND [options]\n";
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional())
      text += option->get_required() ? " " + option->get_name(true) : " [" + option->get_name(true) + "]";
  return text + " [options]\n";
}

}  // namespace

std::string HelpFormatter::make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const {
  const std::string path =
      app->get_parent() ? app->get_parent()->get_name() + " " + app->get_name() : app->get_name();
  std::string out = wrapped(app->get_description(), kColumns, 0) + "\n\n" + usage(*app, path);
  const auto commands = app->get_subcommands([](const CLI::App*) { return true; });
  const std::size_t textColumn = textColumnOf(*app, commands);
  if (!commands.empty()) out += "\nCommands\n";
  for (const CLI::App* command : commands)
    out += line(command->get_name(), command->get_description(), textColumn);
  for (const auto& group : app->get_groups()) {
    std::string lines;
    for (const CLI::Option* option : app->get_options())
      if (option->get_group() == group) lines += line(nameOf(*option), textOf(*option), textColumn);
    if (!lines.empty() && !group.empty()) out += fmt::format("\n{}\n{}", group, lines);
  }
  const std::string footer = app->get_footer();
  return footer.empty() ? out : out + "\n" + footer + "\n";
}

}  // namespace whittle::cli
