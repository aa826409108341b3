// Lays out help texts. The groups come in the order in which the command added them.
#include "cli/help.h"

#include <algorithm>

#include "cli/text.h"

namespace whittle::cli {
namespace {

constexpr std::size_t kColumns = 80;
constexpr std::size_t kTextColumn = 30;

/// "-o, --output FILE".
std::string nameOf(const CLI::Option& option) {
  if (option.get_positional() && option.get_lnames().empty()) return option.get_name(true);
  std::string names;
  for (const auto& n : option.get_snames()) names += (names.empty() ? "-" : ", -") + n;
  for (const auto& n : option.get_lnames()) names += (names.empty() ? "--" : ", --") + n;
  const bool takesValue = option.get_items_expected_max() > 0 && !option.get_type_name().empty();
  return takesValue ? names + " " + option.get_type_name() : names;
}

std::string line(const std::string& name, const std::string& text) {
  const std::string head = padded("  " + name, kTextColumn);
  const std::string body = wrapped(text, kColumns - kTextColumn, kTextColumn);
  // At least two blanks between a name and its text, or the text goes below.
  if (columnsOf("  " + name) + 2 > kTextColumn) return head + "\n" + std::string(kTextColumn, ' ') + body + "\n";
  return head + body + "\n";
}

std::string textOf(const CLI::Option& option) {
  const std::string fallback = option.get_default_str();
  return option.get_description() + (fallback.empty() ? "" : " [" + fallback + "]");
}

std::string usage(const CLI::App& app, const std::string& path) {
  std::string text = "Usage: " + path;
  if (!app.get_subcommands([](const CLI::App*) { return true; }).empty()) return text + " COMMAND [options]\n";
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional()) text += option->get_required() ? " " + option->get_name(true) : " [" + option->get_name(true) + "]";
  return text + " [options]\n";
}

}  // namespace

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const {
  const std::string path = app->get_parent() ? app->get_parent()->get_name() + " " + app->get_name() : app->get_name();
  (void)name;
  std::string out = wrapped(app->get_description(), kColumns, 0) + "\n\n" + usage(*app, path);
  const auto commands = app->get_subcommands([](const CLI::App*) { return true; });
  if (!commands.empty()) out += "\nCommands\n";
  for (const CLI::App* command : commands) out += line(command->get_name(), command->get_description());
  std::vector<std::string> groups = app->get_groups();
  for (const auto& group : groups) {
    std::string lines;
    for (const CLI::Option* option : app->get_options())
      if (option->get_group() == group) lines += line(nameOf(*option), textOf(*option));
    if (!lines.empty() && !group.empty()) out += "\n" + group + "\n" + lines;
  }
  const std::string footer = app->get_footer();
  return footer.empty() ? out : out + "\n" + footer + "\n";
}

}  // namespace whittle::cli
