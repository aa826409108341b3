// The memory of what devices do: an entry for each in a folder beside the cache of programs.
#include "cl/device_facts.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <optional>

#include "cl/kernel_cache.h"
#include "cl/program_cache.h"
#include "scene/whole_file.h"

namespace whittle {
namespace {

constexpr int kVersion = 1;  ///< of the probes: with another one all devices are tried anew
constexpr std::uint64_t kMemoryBytes = 1 << 20;
constexpr std::uint32_t kItemsCounted = 8;  ///< see loopBudget

ProgramCache memory() { return ProgramCache(programCacheFolder() / "devices", kMemoryBytes); }

std::string keyOf(const DeviceInfo& d) {
  return fmt::format("facts {}\n{}\n{}\n{}\n{}\n{}", kVersion, d.platform, d.vendor, d.name, d.version,
                     d.driver);
}

/// loopLimit, givesTimes.
using Record = std::array<std::uint32_t, 2>;

std::optional<DeviceFacts> remembered(const DeviceInfo& device) {
  const auto bytes = memory().load(keyOf(device));
  Record record{};
  if (!bytes || bytes->size() != sizeof(record)) return std::nullopt;
  std::memcpy(record.data(), bytes->data(), sizeof(record));
  return DeviceFacts{record[0], record[1] != 0};
}

void remember(const DeviceInfo& device, const DeviceFacts& facts) {
  const Record record{facts.loopLimit, facts.givesTimes ? 1U : 0U};
  std::array<unsigned char, sizeof(record)> bytes{};
  std::memcpy(bytes.data(), record.data(), sizeof(record));
  try {
    memory().store(keyOf(device), "what " + device.name + " does", bytes);
  } catch (const UnwritableFile&) {
    // It is tried again next time.
  }
}

}  // namespace

void learnFacts(Compute& compute) {
  if (const auto facts = remembered(compute.device())) {
    compute.know(*facts);
    return;
  }
  const DeviceProbe probe = probeDevice(compute);
  for (const Finding& finding : probe.findings)
    if (finding.verdict == Verdict::Wrong)
      throw ClError(
          fmt::format("{} computes wrongly ({}: {}): no picture is drawn on it; `whittle check` "
                      "tells more, --device takes another",
                      compute.device().name, finding.name, finding.seen));
  remember(compute.device(), probe.facts);
  compute.know(probe.facts);
}

void forgetFacts() { memory().clear(); }

std::uint32_t loopBudget(const DeviceInfo& device) { return device.facts.loopLimit / kItemsCounted / 2; }

}  // namespace whittle
