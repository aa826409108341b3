// whittle check: proves that a device computes what it should, in some seconds.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "check/device_check.h"
#include "cl/kernel_cache.h"
#include "cli/commands.h"
#include "cli/progress_bar.h"
#include "cli/speech.h"

namespace whittle::cli {
namespace {

const char* wordOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::Right:
      return "right";
    case Verdict::WorkedRound:
      return "around";
    case Verdict::Wrong:
      return "wrong";
  }
  return "";
}

void printJson(const CheckReport& report) {
  nlohmann::ordered_json json{{"device", report.device.name},
                              {"platform", report.device.platform},
                              {"driver", report.device.driver},
                              {"right", report.isRight()},
                              {"loopLimit", report.device.facts.loopLimit},
                              {"givesTimes", report.device.facts.givesTimes},
                              {"seconds", report.seconds},
                              {"checks", nlohmann::ordered_json::array()}};
  for (const CheckLine& line : report.lines)
    json["checks"].push_back({{"name", line.finding.name},
                              {"verdict", wordOf(line.finding.verdict)},
                              {"seen", line.finding.seen},
                              {"consequence", line.finding.consequence},
                              {"seconds", line.seconds}});
  tellJson(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void printTable(const CheckReport& report) {
  tell(
      fmt::format("{}, {}, driver {}\n\n", report.device.name, report.device.platform, report.device.driver));
  for (const CheckLine& line : report.lines) {
    tell(
        fmt::format("{:<6} {:<33} {}\n", wordOf(line.finding.verdict), line.finding.name, line.finding.seen));
    if (!line.finding.consequence.empty()) tell(fmt::format("{:>40} {}\n", "→", line.finding.consequence));
  }
  tell(fmt::format(
      "\n{} checks in {:.1f} s: {}\n", report.lines.size(), report.seconds,
      report.isRight() ? "pictures of this device can be trusted" : "do not draw on this device"));
}

}  // namespace

void addCheck(CLI::App& app, int& status) {
  auto device = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  CLI::App* c = app.add_subcommand("check", "proves that a device computes what it should");
  c->add_option("DEVICE", *device,
                "index from `whittle devices`, part of a name, cpu or gpu [the first CPU]");
  c->option_defaults()->group("Output");
  c->add_flag("--json", *json, "as JSON");
  c->footer("Example: whittle check; whittle check rusticl --json");
  c->callback([device, json, &status] {
    warnIfAny(settleKernelCache());
    prepareCpuThreads(0, 0);
    const DeviceInfo info = selectDevice(listDevices(), *device);
    CheckReport report;
    {
      ProgressBar bar(false);
      report = checkDevice(info, [&](const std::string& name) { bar.phase("checking " + name); });
    }
    *json ? printJson(report) : printTable(report);
    status = report.isRight() ? 0 : 1;
  });
}

}  // namespace whittle::cli
