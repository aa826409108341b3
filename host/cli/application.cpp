// Sub-commands put together, and the parser's complaints in this program's words.
#include "cli/application.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "cli/commands.h"
#include "cli/help.h"
#include "cli/speech.h"
#include "programs/compiler_process.h"
#include "report/text.h"
#include "scene/input_error.h"

namespace whittle::cli {
namespace {

std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string near = closestWord(word, candidates);
  return near.empty() ? "" : fmt::format("did you mean '{}'? ", near);
}

/// The parser reads on past a wrong command; the command is looked at first.
void checkCommand(const CLI::App& app, const std::string& word) {
  std::vector<std::string> commands;
  for (const CLI::App* c : app.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(c->get_name());
  if (std::find(commands.begin(), commands.end(), word) != commands.end()) return;
  if (word == "-h" || word == "--help" || word == "--version") return;
  if (word.rfind('-', 0) == 0)
    throw InputError(
        fmt::format("{}: a command comes first, for instance `whittle render SCENE {}`", word, word));
  throw InputError(
      fmt::format("{}: no such command; {}`whittle --help` lists them", word, didYouMean(word, commands)));
}

/// The chosen command, or the application itself.
const CLI::App& chosen(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  return parsed.empty() ? app : *parsed.front();
}

[[noreturn]] void explainExtra(const CLI::App& command, const std::string& path) {
  const auto extras = command.remaining(true);
  const std::string word = extras.empty() ? "" : extras.front();
  if (word.rfind('-', 0) != 0)
    throw InputError(fmt::format("'{}': one argument too many for `{}`; see `{} --help`", word, path, path));
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> options;
  for (const CLI::Option* o : command.get_options())
    for (const auto& n : o->get_lnames()) options.push_back("--" + n);
  throw InputError(fmt::format("{}: no such option of `{}`; {}see `{} --help`", name, path,
                               didYouMean(name, options), path));
}

[[noreturn]] void explain(const CLI::ParseError& e, const CLI::App& app) {
  const CLI::App& command = chosen(app);
  const std::string path = &command == &app ? "whittle" : "whittle " + command.get_name();
  const std::string said = e.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&e)) explainExtra(command, path);
  if (dynamic_cast<const CLI::RequiredError*>(&e))
    throw InputError(fmt::format("{}; see `{} --help`", said, path));
  // "Could not convert: --quiet = yes": only flags leave their value to the parser.
  if (dynamic_cast<const CLI::ConversionError*>(&e) && said.rfind("Could not convert: ", 0) == 0)
    throw InputError(fmt::format("{}: takes no value", said.substr(19, said.find(' ', 19) - 19)));
  // "--width: 1 required PIXELS missing"
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&e) && said.find(" missing") != std::string::npos)
    throw InputError(
        fmt::format("{}: a value is missing; see `{} --help`", said.substr(0, said.find(':')), path));
  throw InputError(fmt::format("{}; see `{} --help`", said, path));
}

void addCommands(CLI::App& app, int& status, const std::vector<std::string>& arguments) {
  app.name("whittle");
  app.formatter(std::make_shared<HelpFormatter>());
  app.option_defaults()->group("Options");
  app.set_help_flag("-h,--help", "show this help; after a command, that command's");
  app.set_version_flag("--version", "whittle " WHITTLE_VERSION, "show the version");
  app.footer("Example: whittle render scenes/cornell_box.glb -o cornell_box.png");
  addRender(app, status, arguments);
  addReference(app, status);
  addInfo(app, status);
  addDevices(app, status);
  addCheck(app, status);
  addCache(app, status);
  addCompare(app, status);
  addBench(app, status);
  addScale(app, status, arguments);
  addView(app, status);
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    command->option_defaults()->group("Other");
    command->set_help_flag("-h,--help", "show this help");
  }
}

}  // namespace

int runApplication(int argc, const char* const* argv) {
  if (argc > 1 && argv[1] == std::string(kCompilerCommand)) {
    compilerProcessMain({argv + 2, argv + argc});
    return 0;
  }
  CLI::App app{"Whittle: a wavefront Whitted ray tracer for glTF scenes on any OpenCL device"};
  int status = 0;
  // `whittle -- render …`: what follows is no option of the program, which has none to speak of.
  const int skipped = argc > 2 && argv[1] == std::string("--") ? 1 : 0;
  addCommands(app, status, {argv + std::min(argc, 1 + skipped), argv + argc});
  if (argc < 2) {
    tellError(app.help());
    return 2;
  }
  checkCommand(app, argv[1 + skipped]);
  try {
    app.parse(argc - skipped, argv + skipped);
  } catch (const CLI::Success& e) {
    status = app.exit(e);  // --help, --version
  } catch (const CLI::ParseError& e) {
    explain(e, app);
  }
  finishOutput();
  return status;
}

}  // namespace whittle::cli
