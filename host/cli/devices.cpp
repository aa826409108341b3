// whittle devices: every OpenCL device, usable or not and why.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cl/device.h"
#include "cl/program.h"
#include "cli/commands.h"

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
                               {"globalMemory", d.globalMemory},
                               {"largestBuffer", d.largestBuffer},
                               {"usable", d.usable},
                               {"reason", d.reason}});
  fmt::print("{}\n", json.dump(2));
}

void printTable(const DeviceList& list) {
  for (const auto& d : list.devices) {
    fmt::print("{}  {}  {}\n", d.index, d.kind, d.name);
    fmt::print("   {}, {}, driver {}\n", d.platform, d.version, d.driver);
    fmt::print("   {} compute units, {} memory, {} in one buffer\n", d.computeUnits, formatBytes(d.globalMemory), formatBytes(d.largestBuffer));
    if (!d.usable) fmt::print("   not usable: {}\n", d.reason);
  }
  for (const auto& problem : list.problems) fmt::print("-  {}\n", problem);
}

}  // namespace

void addDevices(CLI::App& app, int& status) {
  auto json = std::make_shared<bool>(false);
  CLI::App* c = app.add_subcommand("devices", "list every OpenCL device, usable or not and why");
  c->add_flag("--json", *json, "as JSON");
  c->callback([json, &status] {
    const DeviceList list = listDevices();
    *json ? printJson(list) : printTable(list);
    status = 0;
  });
}

}  // namespace whittle::cli
