// whittle devices: every OpenCL device, usable or not and why.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cl/device.h"
#include "cl/kernel_cache.h"
#include "cli/commands.h"
#include "cli/speech.h"
#include "report/text.h"
#include "scene/byte_counts.h"

namespace whittle::cli {
namespace {

void printJson(const DeviceList& list) {
  nlohmann::ordered_json json{{"devices", nlohmann::ordered_json::array()}, {"problems", list.problems}};
  for (const auto& d : list.devices)
    json["devices"].push_back({{"index", d.index},
                               {"kind", d.kind},
                               {"platform", d.platform},
                               {"name", d.name},
                               {"vendor", d.vendor},
                               {"version", d.version},
                               {"driver", d.driver},
                               {"computeUnits", d.computeUnits},
                               {"processors", processorsOf(d)},
                               {"globalMemory", d.globalMemory},
                               {"largestBuffer", d.largestBuffer},
                               {"maxWorkGroup", d.maxWorkGroup},
                               {"floatLanes", d.floatLanes},
                               {"usable", d.usable},
                               {"reason", d.reason}});
  tellJson(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

/// What holds, where the driver says something else.
std::string unitsOf(const DeviceInfo& d) {
  if (processorsOf(d) == d.computeUnits) return formatSome(d.computeUnits, "compute unit", "compute units");
  return fmt::format("{} (the driver says {} compute units)",
                     formatSome(processorsOf(d), "processor", "processors"), d.computeUnits);
}

void printTable(const DeviceList& list) {
  for (const auto& d : list.devices) {
    tell(fmt::format("{}  {}  {}\n", d.index, d.kind, d.name));
    tell(fmt::format("   {}\n", d.platform));
    tell(fmt::format("   {}\n   driver {}\n", d.version, d.driver));
    tell(fmt::format("   {}, {} of memory, {} at most in one buffer\n", unitsOf(d),
                     formatBytes(d.globalMemory), formatBytes(d.largestBuffer)));
    if (!d.usable) tell(fmt::format("   not usable: {}\n", d.reason));
  }
  for (const auto& problem : list.problems) tell(fmt::format("-  {}\n", problem));
  if (list.devices.empty())
    tell(
        "No OpenCL device. One that runs on any CPU is PoCL: `apt install pocl-opencl-icd` on Debian and\n"
        "Ubuntu, `dnf install pocl` on Fedora. A GPU needs its vendor's OpenCL driver.\n");
}

}  // namespace

void addDevices(CLI::App& app, int& status) {
  auto json = std::make_shared<bool>(false);
  CLI::App* c = app.add_subcommand("devices", "every OpenCL device, usable or not and why");
  c->option_defaults()->group("Output");
  c->add_flag("--json", *json, "as JSON");
  c->footer("Example: whittle devices; whittle render scene.glb --device 0");
  c->callback([json, &status] {
    warnIfAny(settleKernelCache());
    const DeviceList list = listDevices();
    *json ? printJson(list) : printTable(list);
    status = 0;
  });
}

}  // namespace whittle::cli
