// What the machine lets this process take (Linux: proc(5), cgroups(7), getrlimit(2)).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "scene/memory_budget.h"

namespace whittle {

/// What is free of the machine and of the control groups that the process is in, as the files below `root`
/// say; nothing where they say nothing.
std::optional<std::uint64_t> freeMemory(const std::filesystem::path& root = "/");

/// Bytes of addresses that this process may have (ulimit -v, RLIMIT_AS); unset: as many as there are.
std::optional<std::uint64_t> addressLimit();

/// The default of --memory-limit: four fifths of the least of freeMemory() and the process's own limits
/// (RLIMIT_AS, RLIMIT_DATA), the rest being for the others.
MemoryLimit memoryLimitOfMachine();

/// Gives freed memory back that the allocator keeps for more of the same: after phases that took much of it
/// in small pieces.
void returnFreedMemory();

}  // namespace whittle
