// Sub-commands put together.
#include "cli/application.h"

#include "cli/commands.h"

namespace whittle::cli {

int runApplication(int argc, const char* const* argv) {
  CLI::App app{"Whittle: a wavefront Whitted ray tracer for glTF scenes on any OpenCL device"};
  app.name("whittle");
  app.set_version_flag("--version", "whittle " WHITTLE_VERSION);
  app.require_subcommand(1);
  int status = 0;
  addRender(app, status);
  addReference(app, status);
  addInfo(app, status);
  addDevices(app, status);
  addCompare(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);  // --help, --version
  }
  return status;
}

}  // namespace whittle::cli
