#include "scene/memory_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scene/byte_counts.h"
#include "scene/input_error.h"

namespace whittle {
namespace {

/// Without --memory-limit: what a file of no size may take, and what each of its bytes adds. A JPEG of an
/// eighth of a byte for each pixel, decoded and copied to a device, takes 100 for one.
constexpr std::uint64_t kSmallFile = 4'000'000'000, kForEachByte = 256;

std::uint64_t sum(std::uint64_t a, std::uint64_t b) {
  return b > std::numeric_limits<std::uint64_t>::max() - a ? std::numeric_limits<std::uint64_t>::max()
                                                           : a + b;
}

}  // namespace

std::uint64_t MemoryBudget::most(Cause cause) const {
  if (limit_.isChosen || cause == Cause::CommandLine) return limit_.bytes;
  const std::uint64_t forFile =
      fileBytes_ > limit_.bytes / kForEachByte ? limit_.bytes : kSmallFile + kForEachByte * fileBytes_;
  return std::min(limit_.bytes, sum(forFile, commandLine_));
}

void MemoryBudget::check(std::uint64_t before, std::uint64_t bytes, std::string_view what,
                         Cause cause) const {
  const std::uint64_t total = sum(before, bytes), limit = most(cause);
  if (total <= limit) return;
  std::string whose;
  if (!limit_.isChosen)
    whose = limit < limit_.bytes ? fmt::format(" for input of {}", formatBytes(fileBytes_))
            : limit_.isUlimit    ? " of what ulimit leaves the program"
                                 : " on this machine";
  const bool looksAlike = formatBytes(total) == formatBytes(limit);
  const auto shown = [&](std::uint64_t b) {
    return looksAlike ? fmt::format("{} bytes", b) : formatBytes(b);
  };
  const std::string asked =
      before == 0 ? shown(total) : fmt::format("{}, {} with all else", formatBytes(bytes), shown(total));
  throw InputError(fmt::format("{} would take {}; the limit is {}{}: {} allows more", what, asked,
                               shown(limit), whose,
                               limit_.isChosen                            ? "a larger --memory-limit"
                               : limit_.isUlimit && limit == limit_.bytes ? "a larger ulimit -v or -d"
                                                                          : "--memory-limit SIZE"));
}

void MemoryBudget::checkReads(double values, std::string_view what) const {
  constexpr double kSmallFilesReads = 3e8, kReadsForEachByte = 64;
  const double most = kSmallFilesReads + kReadsForEachByte * static_cast<double>(fileBytes_);
  if (limit_.isChosen || values <= most) return;
  throw InputError(
      fmt::format("{} have {:.3g} million values to read; input of {} may have {:.3g} million: "
                  "--memory-limit SIZE allows more",
                  what, values / 1e6, formatBytes(fileBytes_), most / 1e6));
}

void MemoryBudget::pass(std::uint64_t bytes, std::string_view what) {
  check(held_, bytes, what, Cause::File);
  peak_ = std::max(peak_, sum(held_, bytes));
}

void MemoryBudget::hold(std::uint64_t bytes, std::string_view what) {
  check(sum(held_, promised_), bytes, what, Cause::File);
  held_ += bytes;
  peak_ = std::max(peak_, held_);
}

void MemoryBudget::promiseProgram(std::uint64_t bytes) {
  check(0, sum(sum(held_, promised_), bytes), "the program with its drivers", Cause::CommandLine);
  promised_ += bytes;
  commandLine_ += bytes;
}

void MemoryBudget::promise(std::uint64_t bytes, std::string_view what, Cause cause) {
  check(sum(held_, promised_), bytes, what, cause);
  promised_ += bytes;
  if (cause == Cause::CommandLine) commandLine_ += bytes;
}

}  // namespace whittle
